// SPDX-License-Identifier: BSD-3-Clause
// The parts of a step and of the start of a run, each alone, on the pin-on-disc test: a 3 mm ball pressed
// with 5 N on a flat ring (20 to 24 mm).
#include <benchmark/benchmark.h>

#include "abradem/contact/patch.h"
#include "abradem/contact/point_contacts.h"
#include "abradem/geometry/generators.h"
#include "abradem/wear/footprint.h"
#include "abradem/wear/wearing_surface.h"

namespace {

using namespace abradem;

constexpr double kRadius = 3e-3, kLoad = 5.0;
constexpr double kFine = 0.0923e-3;  // 150,000 triangles between 20 and 24 mm

contact::PairProperties ore_on_steel() {
  contact::PairProperties pair = material::effective_moduli({4850.0, 0.1e9, 0.24}, {7932.0, 78e9, 0.30});
  pair.beta = material::damping_ratio(0.4);
  pair.static_friction = 1.0;
  return pair;
}

/// The ball at rest under its load, and the candidates under it.
struct Scene {
  explicit Scene(double size)
      : surface(geometry::make_annulus(0.020, 0.024, size, 1)),
        grid(surface.mesh()),
        overlap(contact::hertz_overlap(pair, kRadius, kLoad)),
        c(0.022, 0.0, kRadius - overlap) {
    gather();
  }
  void gather() {
    candidates.update({surface.mesh(), grid, surface.revision(), surface.odometer(), surface.deepest_sink()},
                      c, {0.0, 0.0, -1.0}, kRadius + 0.5 * overlap, {1e-4, 1e-5});
  }
  const contact::PairProperties pair = ore_on_steel();
  wear::WearingSurface surface;
  geometry::TriangleGrid grid;
  double overlap;
  Vec3 c;
  contact::MeshCandidates candidates;
};

double size_of(const benchmark::State& state) { return 1e-6 * static_cast<double>(state.range(0)); }

void counts(benchmark::State& state, const Scene& scene) {
  state.counters["candidates"] = static_cast<double>(scene.candidates.triangle_count());
}

void gather_candidates(benchmark::State& state) {
  Scene scene(size_of(state));
  for (auto _ : state) {
    scene.candidates.reset();
    scene.gather();
  }
  counts(state, scene);
}

void evaluate_patch(benchmark::State& state) {
  Scene scene(size_of(state));
  contact::PatchEvaluator patches;
  for (auto _ : state)
    benchmark::DoNotOptimize(patches.evaluate(scene.candidates, scene.c, kRadius, scene.pair).data());
  counts(state, scene);
}

void resolved_points(benchmark::State& state) {
  Scene scene(size_of(state));
  contact::PointContactFinder points;
  for (auto _ : state) benchmark::DoNotOptimize(points.resolved(scene.candidates, scene.c, kRadius).data());
  counts(state, scene);
}

void per_triangle_points(benchmark::State& state) {
  Scene scene(size_of(state));
  contact::PointContactFinder points;
  for (auto _ : state)
    benchmark::DoNotOptimize(points.per_triangle(scene.candidates, scene.c, kRadius).data());
  counts(state, scene);
}

void hertz_footprint(benchmark::State& state) {
  Scene scene(size_of(state));
  contact::PatchEvaluator patches;
  const auto found = patches.evaluate(scene.candidates, scene.c, kRadius, scene.pair);
  const wear::OverlapField field{patches.node_excess(), kRadius, found.front().deepest, {}, {}, scene.c};
  wear::FootprintIntegrator footprint;
  for (auto _ : state)
    benchmark::DoNotOptimize(footprint.hertz(scene.candidates, field, scene.overlap, false).total);
  counts(state, scene);
}

/// What the wear of one step costs: its volume shared out over the candidates' nodes, and the nodes moved.
void deposit_and_deform(benchmark::State& state) {
  Scene scene(size_of(state));
  constexpr double kVolume =
      1e-26;  // [m^3] so little that the surface stays flat for a thousand million steps
  const std::size_t nodes = scene.candidates.node_count();
  for (auto _ : state) {
    for (std::size_t i = 0; i < nodes; ++i)
      scene.surface.deposit_at_vertex(scene.candidates.node[i], kVolume / static_cast<double>(nodes));
    scene.surface.deform_conserving();
  }
  counts(state, scene);
  state.counters["nodes"] = static_cast<double>(nodes);
}

void mesh_ring(benchmark::State& state) {
  double triangles = 0.0;
  for (auto _ : state) {
    const geometry::TriangleMesh mesh = geometry::make_annulus(0.020, 0.024, kFine, 1);
    triangles = static_cast<double>(mesh.triangle_count());
  }
  state.counters["triangles"] = triangles;
}

void build_grid(benchmark::State& state) {
  const geometry::TriangleMesh mesh = geometry::make_annulus(0.020, 0.024, kFine, 1);
  for (auto _ : state) {
    const geometry::TriangleGrid grid(mesh);
    benchmark::DoNotOptimize(&grid);
  }
  state.counters["triangles"] = static_cast<double>(mesh.triangle_count());
}

// Edge of a triangle [um].
BENCHMARK(gather_candidates)->Arg(100)->Arg(200);
BENCHMARK(evaluate_patch)->Arg(50)->Arg(100)->Arg(200)->Arg(500);
BENCHMARK(resolved_points)->Arg(100)->Arg(500);
BENCHMARK(per_triangle_points)->Arg(100)->Arg(500);
BENCHMARK(hertz_footprint)->Arg(50)->Arg(100)->Arg(200)->Arg(500);
BENCHMARK(deposit_and_deform)->Arg(100)->Arg(200);
BENCHMARK(mesh_ring)->Unit(benchmark::kMillisecond);
BENCHMARK(build_grid)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
