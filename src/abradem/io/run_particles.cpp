// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/io/run_particles.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "abradem/core/error.h"
#include "abradem/io/case_file.h"
#include "abradem/io/vtp_read.h"
#include "abradem/simulation/clumps.h"

namespace abradem::io {

namespace {

namespace fs = std::filesystem;
using namespace simulation;

/// Material and shape by name; no shape: spheres.
using Kind = std::pair<std::string, std::string>;

std::string title_of(const Kind& kind) {
  return kind.second.empty() ? fmt::format("spheres of '{}'", kind.first)
                             : fmt::format("'{}' of '{}'", kind.second, kind.first);
}

/// The particles of one kind.
struct Left {
  std::vector<PlacedSphere> placed;
  std::vector<geometry::Quaternion> turns;  ///< of clumps
  std::vector<geometry::Ball> spheres;      ///< of one of them, as clump_shape() has its shape's
};

Setup case_of(const fs::path& folder) {
  const fs::path file = folder / "case.resolved.toml";
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) throw IoError(fmt::format("'{}' cannot be read", file.string()));
  return parse_case(text, file.string(), folder, {}, NamedFiles::kept).setup;
}

/// The frames of the particles: their part in the series follows those of the walls.
std::vector<SeriesFrame> frames_of(const fs::path& folder, const Setup& setup) {
  std::vector<SeriesFrame> frames = read_pvd(folder / "series.pvd");
  std::erase_if(frames, [&](const SeriesFrame& f) { return f.part != std::to_string(setup.walls.size()); });
  if (frames.empty()) throw InputError(fmt::format("'{}' has no frames of particles", folder.string()));
  return frames;
}

/// The frame of a time, by default the last one. A time written by hand need not be a whole number of steps.
fs::path frame_at(const fs::path& folder, const std::vector<SeriesFrame>& frames, std::optional<double> at) {
  if (!at) return frames.back().file;
  constexpr double kSlack = 0.01;  // of the way to the next frame
  const auto off = [&](const SeriesFrame& f) { return std::abs(f.time - *at); };
  const SeriesFrame& nearest = *std::ranges::min_element(frames, {}, off);
  double gap = frames.size() > 1 ? std::numeric_limits<double>::infinity() : 0.0;
  for (const SeriesFrame& f : frames)
    if (f.time != nearest.time) gap = std::min(gap, std::abs(f.time - nearest.time));
  if (off(nearest) <= kSlack * gap || off(nearest) == 0.0) return nearest.file;
  throw InputError(fmt::format(
      "'{}' has no frame at {:.6g} s; the nearest is at {:.6g} s, the last at {:.6g} s ([output] every and "
      "frames of its case say which are written)",
      folder.string(), *at, nearest.time, frames.back().time));
}

/// The arrays of a frame, by particle.
class Arrays {
 public:
  explicit Arrays(fs::path file) : file_(std::move(file)), frame_(read_vtp(file_)) {}
  [[nodiscard]] std::size_t size() const noexcept { return frame_.mesh.vertices.size(); }
  [[nodiscard]] const Vec3& position(std::size_t i) const { return frame_.mesh.vertices[i]; }
  [[nodiscard]] const std::vector<double>& of(const char* name, int components) const {
    const auto found = frame_.point_data.find(name);
    if (found == frame_.point_data.end())
      throw IoError(
          fmt::format("{}: has no array '{}'; a version that did not write it made this frame: "
                      "run the case again",
                      file_.string(), name));
    if (found->second.values.size() != static_cast<std::size_t>(components) * size())
      fail(fmt::format("'{}' has another length than there are particles", name));
    for (const double x : found->second.values)
      if (!std::isfinite(x)) fail(fmt::format("'{}' holds what is no finite number", name));
    return found->second.values;
  }
  [[nodiscard]] std::vector<Vec3> vectors(const char* name) const {
    const std::vector<double>& v = of(name, 3);
    std::vector<Vec3> vectors(size());
    for (std::size_t i = 0; i < size(); ++i) vectors[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
    return vectors;
  }
  /// Places in a list of `count`.
  [[nodiscard]] std::vector<std::size_t> numbers(const char* name, std::size_t count) const {
    std::vector<std::size_t> numbers;
    for (const double x : of(name, 1)) {
      if (!(x >= 0.0 && x < static_cast<double>(count)))
        fail(fmt::format("'{}' names number {:g} of {}", name, x, count));
      numbers.push_back(static_cast<std::size_t>(x));
    }
    return numbers;
  }
  [[nodiscard]] std::vector<PlacedSphere> placed() const {
    const std::vector<double>& radius = of("radius", 1);
    const std::vector<Vec3> velocity = vectors("velocity_m_per_s"), spin = vectors("spin_rad_per_s");
    std::vector<PlacedSphere> placed;
    for (std::size_t i = 0; i < size(); ++i) {
      if (!(radius[i] > 0.0)) fail(fmt::format("particle {} has no radius > 0", i));
      placed.push_back({position(i), radius[i], velocity[i], spin[i]});
    }
    return placed;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(fmt::format("{}: {}", file_.string(), what));
  }

 private:
  fs::path file_;
  VtpSurface frame_;
};

/// Lengths after which space repeats itself; 0 along open axes.
Vec3 period_of(const std::optional<DomainSetup>& domain) {
  if (!domain) return {};
  const std::string_view axes =
      std::array{"", "x", "y", "z", "xy", "xz", "yz", "xyz"}[static_cast<std::size_t>(domain->periodic)];
  const Vec3 e = domain->high - domain->low;
  return {axes.find('x') != axes.npos ? e.x : 0.0, axes.find('y') != axes.npos ? e.y : 0.0,
          axes.find('z') != axes.npos ? e.z : 0.0};
}
/// The shortest of a vector's images.
Vec3 nearest(const Vec3& d, const Vec3& period) {
  const auto along = [](double x, double length) {
    return length > 0.0 ? x - length * std::round(x / length) : x;
  };
  return {along(d.x, period.x), along(d.y, period.y), along(d.z, period.z)};
}

/// What a run left, by kind.
class RunParticles {
 public:
  RunParticles(const fs::path& folder, std::optional<double> at) : setup_(case_of(folder)) {
    const fs::path file = frame_at(folder, frames_of(folder, setup_), at);
    const Arrays spheres(file);
    read_spheres(spheres);
    if (std::error_code error; !setup_.shapes.empty() && fs::exists(clumps_beside(file), error))
      read_clumps(Arrays(clumps_beside(file)), spheres);
  }
  [[nodiscard]] const std::map<Kind, Left>& kinds() const noexcept { return kinds_; }

 private:
  /// Those that are no clump's; named particles have the first ids.
  void read_spheres(const Arrays& frame) {
    const std::vector<double>& id = frame.of("id", 1);
    const auto named = static_cast<double>(
        std::ranges::count_if(setup_.particles, [](const ParticleSetup& p) { return p.shape.empty(); }));
    const auto material = frame.numbers("material", setup_.materials.size());
    const std::vector<double> clump =
        setup_.shapes.empty() ? std::vector<double>(frame.size(), -1.0) : frame.of("clump", 1);
    const std::vector<PlacedSphere> placed = frame.placed();
    for (std::size_t i = 0; i < placed.size(); ++i)
      if (id[i] >= named && clump[i] < 0.0)
        kinds_[{setup_.materials[material[i]].name, ""}].placed.push_back(placed[i]);
  }

  void read_clumps(const Arrays& frame, const Arrays& spheres) {
    const auto material = frame.numbers("material", setup_.materials.size());
    const auto shape = frame.numbers("shape", setup_.shapes.size());
    const std::vector<double>&turn = frame.of("orientation", 4), &id = frame.of("id", 1);
    const std::vector<PlacedSphere> placed = frame.placed();
    std::map<double, std::vector<std::size_t>> members;
    const std::vector<double>& clump = spheres.of("clump", 1);
    for (std::size_t i = 0; i < clump.size(); ++i) members[clump[i]].push_back(i);
    const std::vector<double>& radius = spheres.of("radius", 1);
    const Vec3 period = period_of(setup_.domain);
    for (std::size_t k = 0; k < placed.size(); ++k) {
      Left& left = kinds_[{setup_.materials[material[k]].name, setup_.shapes[shape[k]].name}];
      const geometry::Quaternion q{turn[4 * k], turn[4 * k + 1], turn[4 * k + 2], turn[4 * k + 3]};
      if (std::abs(q.norm2() - 1.0) > 1e-6)
        frame.fail(fmt::format("clump {} is not turned by a rotation", k));
      left.placed.push_back(placed[k]);
      left.turns.push_back(q);
      if (!left.spheres.empty()) continue;
      for (const std::size_t m : members[id[k]])
        left.spheres.push_back(
            {q.turn_back(nearest(spheres.position(m) - placed[k].position, period)) / placed[k].radius,
             radius[m] / placed[k].radius});
    }
  }

  Setup setup_;
  std::map<Kind, Left> kinds_;
};

/// Is a shape what the particles of that name were?
bool same_spheres(const ClumpShape& shape, const std::vector<geometry::Ball>& were) {
  constexpr double kRounding = 1e-6;  // of the radius
  return std::ranges::equal(shape.spheres, were, [&](const geometry::Ball& a, const geometry::Ball& b) {
    return norm(a.centre - b.centre) < kRounding && std::abs(a.radius - b.radius) < kRounding;
  });
}

void take(InsertionSetup& i, const RunParticles& run, const Setup& setup) {
  const auto found = run.kinds().find({i.material, i.shape});
  if (found == run.kinds().end()) {
    std::vector<std::string> there;
    for (const auto& [kind, left] : run.kinds())
      there.push_back(fmt::format("{} {}", left.placed.size(), title_of(kind)));
    throw InputError(fmt::format(
        "insertion '{}': '{}' left no {}; it left {}", i.name, i.volume.run, title_of({i.material, i.shape}),
        there.empty() ? std::string("no particles in numbers") : fmt::format("{}", fmt::join(there, ", "))));
  }
  const Left& left = found->second;
  if (!i.shape.empty()) {
    const ClumpShape shape = clump_shape(*std::ranges::find(setup.shapes, i.shape, &ShapeSetup::name));
    if (!same_spheres(shape, left.spheres))
      throw InputError(
          fmt::format("insertion '{}': '{}' in '{}' was another shape than [shape.{}] here; give "
                      "both cases the same",
                      i.name, i.shape, i.volume.run, i.shape));
  }
  i.placed = left.placed;
  i.turns = left.turns;
}

}  // namespace

std::string why_no_run(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error))
    return fmt::format("the folder '{}' does not exist (relative names start at the folder of the case file)",
                       folder.string());
  if (fs::exists(folder / "batch.json", error))
    return fmt::format("'{}' holds many runs; name one of the folders in it", folder.string());
  if (!fs::is_regular_file(folder / "case.resolved.toml", error))
    return fmt::format("'{}' is not the folder of a run: it has no case.resolved.toml", folder.string());
  if (!fs::is_regular_file(folder / "series.pvd", error))
    return fmt::format(
        "the run '{}' has no frames: its case says output.frames = \"none\", or it has not "
        "begun",
        folder.string());
  return {};
}

fs::path clumps_beside(fs::path spheres) {
  constexpr std::string_view kSpheres = "particles";
  const std::string name = spheres.filename().string();
  return spheres.replace_filename("clumps" + name.substr(std::min(kSpheres.size(), name.size())));
}

std::vector<fs::path> frame_files(const VolumeSetup& volume) {
  const fs::path spheres = frame_at(volume.run, frames_of(volume.run, case_of(volume.run)), volume.at);
  std::vector<fs::path> files{spheres};
  if (std::error_code error; fs::exists(clumps_beside(spheres), error))
    files.push_back(clumps_beside(spheres));
  return files;
}

std::vector<std::string> take_from_runs(Setup& setup) {
  std::map<std::pair<std::string, std::optional<double>>, RunParticles> runs;
  std::map<std::pair<std::string, std::optional<double>>, std::set<Kind>> taken;
  for (InsertionSetup& i : setup.insertions) {
    if (i.volume.shape != VolumeShape::run) continue;
    const std::pair key(i.volume.run, i.volume.at);
    auto run = runs.find(key);
    if (run == runs.end()) {
      if (const std::string why = why_no_run(i.volume.run); !why.empty())
        throw InputError(fmt::format("insertion '{}': {}", i.name, why));
      run = runs.emplace(key, RunParticles(i.volume.run, i.volume.at)).first;
    }
    take(i, run->second, setup);
    if (!taken[key].insert({i.material, i.shape}).second)
      throw InputError(fmt::format("insertion '{}': another insertion already takes the {} of '{}'", i.name,
                                   title_of({i.material, i.shape}), i.volume.run));
  }
  std::vector<std::string> notes;
  for (const auto& [key, run] : runs)
    for (const auto& [kind, left] : run.kinds())
      if (!taken[key].contains(kind))
        notes.push_back(fmt::format("note: '{}' also left {} {}, which no insertion takes", key.first,
                                    left.placed.size(), title_of(kind)));
  return notes;
}

}  // namespace abradem::io
