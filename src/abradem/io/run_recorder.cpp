// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/run_recorder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "abradem/analysis/wall_contours.h"
#include "abradem/core/error.h"
#include "abradem/io/run_particles.h"
#include "abradem/io/wear_map_tables.h"

namespace abradem::io {

namespace {

using simulation::Simulation;

constexpr int kProfiles = 8;          // positions whose whole profile is written
constexpr double kForceRows = 500.0;  // of the thinned series, per output

std::filesystem::path made(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw IoError(fmt::format("cannot create the folder '{}': {}", folder.string(), error.message()));
  return folder;
}

/// What the tables' column `revolution` counts: turns or cycles; output intervals where nothing turns.
double revolution_of(const Simulation& run) {
  return run.turns() ? run.revolution() : run.output_intervals();
}

std::vector<std::string> particle_columns(const Simulation& run) {
  std::vector<std::string> columns{"time_s",           "particles",        "mass_kg",        "inserted",
                                   "removed",          "removed_mass_kg",  "contacts",       "wall_contacts",
                                   "kinetic_energy_J", "elastic_energy_J", "fastest_m_per_s"};
  // What flows, flows in the time that is modelled.
  if (run.acceleration() > 1.0) columns.emplace_back("modelled_time_s");
  return columns;
}

/// How far each vertex has sunk below where it began [um].
std::vector<double> depths_um(const wear::WearingSurface& surface) {
  std::vector<double> depth(surface.mesh().vertices.size());
  for (std::size_t v = 0; v < depth.size(); ++v)
    depth[v] = 1e6 * norm(surface.mesh().vertices[v] - surface.reference()[v]);
  return depth;
}

bool moves_rigidly(const simulation::WallSetup& wall) noexcept {
  for (std::size_t k = 0; k < wall.motions(); ++k)
    if (wall.motion_at(k).kind != simulation::MotionKind::none) return true;
  return false;
}

std::vector<double> components(const std::vector<Vec3>& vectors) {
  std::vector<double> numbers;
  for (const Vec3& v : vectors) numbers.insert(numbers.end(), {v.x, v.y, v.z});
  return numbers;
}

/// From where a wall's nodes are in its own frame to where its motion has carried them [m].
std::vector<double> moved_m(const simulation::Wall& wall, double time) {
  const geometry::Pose pose = wall.pose_at(time);
  std::vector<double> moved;
  for (const Vec3& v : wall.surface().mesh().vertices) {
    const Vec3 way = pose.to_world(v) - v;
    moved.insert(moved.end(), {way.x, way.y, way.z});
  }
  return moved;
}

}  // namespace

RunRecorder::RunRecorder(Simulation& run, std::filesystem::path folder)
    : RunRecorder(run, std::move(folder), State{}) {
  if (particles_) write_particles();
  write_frame();
}

RunRecorder::RunRecorder(Simulation& run, std::filesystem::path folder, State state)
    : run_(run),
      folder_(std::move(folder)),
      state_(std::move(state)),
      tables_(made(folder_ / "tables"), state_.tables),
      groove_(run, folder_, state_.groove_tables),
      loads_(run, folder_, state_.wall_tables),
      force_(folder_ / "tables" / "force.csv",
             {"time_s", "revolution", "normal_force_N", "tangential_force_N", "overlap_um", "contacts",
              "normal_along_N", "normal_across_N", "normal_sum_N"},
             CsvWriter::Growing{state_.force_table}) {
  if (run.setup().output.frames != simulation::Frames::none) made(folder_ / "vtk");
  if (!run.setup().insertions.empty())
    particles_.emplace(folder_ / "tables" / "particles.csv", particle_columns(run),
                       CsvWriter::Growing{state_.particle_table});
  worn_wall_ = analysis::worn_wall(run.walls());
  const bool around =
      worn_wall_ && leading_motion(run.walls()[*worn_wall_].setup()).kind == simulation::MotionKind::rotation;
  normality_.emplace(folder_ / "tables", around ? analysis::Ends::joined : analysis::Ends::open,
                     state_.normality_table);
  for (std::size_t p = run.particles().size(); p-- > 0;)
    if (norm2(run.particles().load[p]) > 0.0) watched_particle_ = p;
  force_stride_ = static_cast<std::uint64_t>(
      std::max(1.0, std::floor(static_cast<double>(run.steps_per_output()) / kForceRows)));
  run.on_step([this](const Simulation& now) { observe(now); });
}

bool RunRecorder::output_due() const noexcept {
  return run_.steps() > state_.outputs_until && run_.at_output();
}

RunRecorder::State RunRecorder::state() const {
  State now = state_;
  now.tables = tables_.positions();
  now.groove_tables = groove_.positions();
  now.wall_tables = loads_.positions();
  now.force_table = force_.position();
  now.normality_table = normality_->position();
  if (particles_) now.particle_table = particles_->position();
  return now;
}

void RunRecorder::sync() {
  tables_.sync();
  groove_.sync();
  loads_.sync();
  normality_->sync();
  force_.sync();
  if (particles_) particles_->sync();
}

void RunRecorder::observe(const Simulation& run) {
  if (loads_.due(run.steps())) loads_.add_loads(run, revolution_of(run));
  if (run.particles().size() == 0) return;
  const simulation::ForceSample f = run.force_on(watched_particle_);
  state_.normal_force.add(f.normal);
  if (run.steps() % force_stride_ != 0) return;
  const simulation::NormalParts parts = run.normal_parts_on(watched_particle_);
  force_.row({run.test_time(), revolution_of(run), f.normal, f.tangential, 1e6 * f.overlap,
              static_cast<double>(run.elements_in_contact(watched_particle_)), parts.along, parts.across,
              parts.sum});
}

std::vector<analysis::Contour> RunRecorder::cut_contours() const {
  return analysis::wall_contours(run_.walls()[*worn_wall_], run_.setup().output.contours);
}

void RunRecorder::keep_some_profiles(std::vector<analysis::Contour>& contours) {
  const std::size_t every = std::max<std::size_t>(1, contours.size() / kProfiles);
  for (std::size_t i = 0; i < contours.size(); ++i)
    if (i % every != 0) contours[i].profile.clear();
}

void RunRecorder::output(bool last) {
  state_.ledger = run_.ledger();
  std::vector<analysis::Contour> contours = worn_wall_ ? cut_contours() : std::vector<analysis::Contour>{};
  groove_.add(run_, state_.ledger, revolution_of(run_), contours);
  loads_.add(run_, revolution_of(run_));
  keep_some_profiles(contours);
  state_.last = analysis::revolution_row(revolution_of(run_), run_.test_time(),
                                         {state_.ledger.law, state_.ledger.swept, state_.ledger.paper},
                                         contours, state_.normal_force);
  state_.normal_force = {};
  state_.outputs_until = run_.steps();
  tables_.add(*state_.last, contours);
  normality_->add(state_.last->revolution, contours);
  if (particles_) write_particles();
  tables_.flush();
  groove_.flush();
  loads_.flush();
  normality_->flush();
  force_.flush();
  if (particles_) particles_->flush();
  if (last || run_.setup().output.frames == simulation::Frames::all) write_frame();
}

void RunRecorder::write_frame() {
  if (run_.setup().output.frames == simulation::Frames::none) return;
  const double time = run_.test_time();
  triangles_.resize(run_.walls().size());
  for (std::size_t w = 0; w < run_.walls().size(); ++w) {
    const simulation::Wall& wall = run_.walls()[w];
    if (wall.is_plane() || !wall.present(run_.time())) continue;
    // A wall that keeps its shape, has no map and stays where it is among particles in numbers is written
    // once.
    const bool moves = run_.bulk() && moves_rigidly(wall.setup());
    const bool still = wall.setup().deformation == simulation::DeformationRule::none &&
                       run_.map_of(w) == nullptr && !moves && state_.frame > 0;
    const std::string file = fmt::format("vtk/{}_{:04}.vtp", wall.setup().name, still ? 0 : state_.frame);
    if (!still) {
      const std::vector<double> depth = depths_um(wall.surface());
      const std::vector<double> moved = moves ? moved_m(wall, run_.time()) : std::vector<double>{};
      std::vector<VtpArray> points{{"depth_um", depth, 1}};
      if (moves) points.push_back({"moved_m", moved, 3});
      const MapArrays cells = map_arrays(run_, w);
      if (!triangles_[w]) triangles_[w].emplace(wall.surface().mesh().triangles);
      write_vtp(folder_ / file, wall.surface().mesh().vertices, *triangles_[w], points, cells.arrays);
    }
    state_.frames.push_back({time, file, static_cast<int>(w)});
  }
  if (run_.particles().size() > 0 || run_.bulk()) {
    const std::string file = fmt::format("vtk/particles_{:04}.vtp", state_.frame);
    write_spheres(folder_ / file);
    if (run_.bulk() && !run_.bulk()->clumps().shapes().empty()) write_clumps(folder_ / clumps_beside(file));
    state_.frames.push_back({time, file, static_cast<int>(run_.walls().size())});
  }
  write_pvd(folder_ / "series.pvd", state_.frames);
  ++state_.frame;
}

/// The named particles, then those in numbers, by id.
void RunRecorder::write_spheres(const std::filesystem::path& path) const {
  std::vector<Vec3> position = run_.particles().position, velocity = run_.particles().velocity,
                    spin = run_.particles().spin;
  std::vector<double> radius = run_.particles().radius, id(radius.size()),
                      material(run_.particles().material.begin(), run_.particles().material.end());
  std::vector<double> clump(radius.size(), -1.0), turn;  // where there are any
  for (std::size_t p = 0; p < radius.size(); ++p) turn.insert(turn.end(), {1.0, 0.0, 0.0, 0.0});
  std::iota(id.begin(), id.end(), 0.0);
  if (run_.bulk()) {
    const contact::Spheres& spheres = run_.bulk()->spheres();
    std::vector<std::size_t> order(spheres.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return spheres.id[i]; });
    for (const std::size_t i : order) {
      if (spheres.id[i] < run_.bulk()->named()) continue;
      position.push_back(spheres.row[i].position());
      velocity.push_back(spheres.row[i].velocity());
      spin.push_back(spheres.row[i].spin());
      material.push_back(spheres.row[i].material);
      radius.push_back(spheres.row[i].radius);
      id.push_back(spheres.id[i]);
      if (run_.bulk()->clumps().shapes().empty()) continue;
      const std::int32_t number = spheres.clump.empty() ? -1 : spheres.clump[i];
      const simulation::Clump* c =
          number < 0 ? nullptr : &run_.bulk()->clumps().clumps()[static_cast<std::size_t>(number)];
      const geometry::Quaternion q = c != nullptr ? c->turn : geometry::Quaternion{};
      clump.push_back(c != nullptr ? c->id : -1.0);
      turn.insert(turn.end(), {q.w, q.x, q.y, q.z});
    }
  }
  const std::vector<double> speeds = components(velocity), spins = components(spin);
  std::vector<VtpArray> arrays{{"velocity_m_per_s", speeds, 3},
                               {"spin_rad_per_s", spins, 3},
                               {"id", id, 1},
                               {"material", material, 1}};
  if (!run_.setup().shapes.empty()) {
    arrays.push_back({"clump", clump, 1});
    arrays.push_back({"orientation", turn, 4});
  }
  write_vtp_spheres(path, position, radius, arrays);
}

/// The clumps as wholes: of two spheres alone nobody could tell how they are turned.
void RunRecorder::write_clumps(const std::filesystem::path& path) const {
  std::vector<Vec3> position, velocity, spin;
  std::vector<double> radius, id, material, shape, turn;
  for (const simulation::Clump& c : run_.bulk()->clumps().clumps()) {
    position.push_back(c.position);
    velocity.push_back(c.velocity);
    spin.push_back(c.spin());
    radius.push_back(c.radius);
    id.push_back(c.id);
    material.push_back(c.material);
    shape.push_back(c.shape);
    turn.insert(turn.end(), {c.turn.w, c.turn.x, c.turn.y, c.turn.z});
  }
  const std::vector<double> speeds = components(velocity), spins = components(spin);
  write_vtp_spheres(path, position, radius,
                    std::vector<VtpArray>{{"velocity_m_per_s", speeds, 3},
                                          {"spin_rad_per_s", spins, 3},
                                          {"id", id, 1},
                                          {"material", material, 1},
                                          {"shape", shape, 1},
                                          {"orientation", turn, 4}});
}

/// tables/particles.csv: what became of the particles in numbers.
void RunRecorder::write_particles() {
  const simulation::BulkState s = run_.bulk_state();
  std::vector<double> row{run_.test_time(),
                          static_cast<double>(s.present),
                          s.mass,
                          static_cast<double>(s.inserted),
                          static_cast<double>(s.removed),
                          s.removed_mass,
                          static_cast<double>(s.pair_contacts),
                          static_cast<double>(s.wall_contacts),
                          s.kinetic_energy,
                          s.elastic_energy,
                          s.fastest};
  if (run_.acceleration() > 1.0) row.push_back(run_.time());
  particles_->row(row);
}

void RunRecorder::close() {
  run_.on_step({});
  tables_.close();
  normality_->close();
  groove_.close(run_);
  loads_.close(run_);
  force_.close();
  if (particles_) particles_->close();
  write_wear_maps(folder_ / "tables", run_, worn_wall_);
}

}  // namespace abradem::io
