// SPDX-License-Identifier: BSD-3-Clause
#include "abradem/report/surface_view.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "abradem/core/error.h"

namespace abradem::report {
namespace {

using geometry::Index;
using geometry::Triangle;
using geometry::TriangleMesh;

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kWornFraction = 0.01;  // of the largest depth: what counts as track
constexpr double kMargin = 1.0 / 3.0;   // of the track's width, shown unworn on each side
constexpr int kMapRows = 48;            // across the track
constexpr int kMapColumns = 720;        // along it: half a degree

std::size_t at(Index index) noexcept { return static_cast<std::size_t>(index); }

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices.size());
  for (Index t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3 area = geometry::area_vector(mesh, t);
    for (const Index v : mesh.triangles[at(t)]) normals[at(v)] += area;
  }
  for (Vec3& n : normals) n = normalized(n);
  return normals;
}

/// The two coordinates the track is unrolled into.
struct Chart {
  bool polar = false;

  [[nodiscard]] std::array<double, 2> operator()(const Vec3& p) const noexcept {
    if (!polar) return {p.x, p.y};
    const double angle = std::atan2(p.y, p.x) * kDegrees;
    return {angle < 0.0 ? angle + 360.0 : angle, std::hypot(p.x, p.y)};
  }
};

struct Window {
  double u_low = 0.0, u_high = 0.0, v_low = 0.0, v_high = 0.0;
  [[nodiscard]] bool holds(const std::array<double, 2>& p) const noexcept {
    return p[0] >= u_low && p[0] <= u_high && p[1] >= v_low && p[1] <= v_high;
  }
};

/// A track is a ring about z when worn vertices are found all around (at least 30 of 36 sectors) and none
/// near the axis: their radii span less than the mean radius.
Chart choose_chart(const std::vector<Vec3>& worn) {
  std::array<bool, 36> seen{};
  double low = std::numeric_limits<double>::max(), high = 0.0;
  const Chart polar{true};
  for (const Vec3& p : worn) {
    const auto [angle, radius] = polar(p);
    seen[static_cast<std::size_t>(std::min(35.0, angle / 10.0))] = true;
    low = std::min(low, radius);
    high = std::max(high, radius);
  }
  return {std::count(seen.begin(), seen.end(), true) >= 30 && high - low < 0.5 * (high + low)};
}

Window window_of(const std::vector<Vec3>& worn, const Chart& chart) {
  constexpr double kFar = std::numeric_limits<double>::max();
  Window w{kFar, -kFar, kFar, -kFar};
  for (const Vec3& p : worn) {
    const auto [u, v] = chart(p);
    w = {std::min(w.u_low, u), std::max(w.u_high, u), std::min(w.v_low, v), std::max(w.v_high, v)};
  }
  const double margin =
      kMargin * (chart.polar ? w.v_high - w.v_low : std::min(w.u_high - w.u_low, w.v_high - w.v_low));
  w.v_low -= margin;
  w.v_high += margin;
  if (chart.polar) {
    w.u_low = 0.0;
    w.u_high = 360.0;
  } else {
    w.u_low -= margin;
    w.u_high += margin;
  }
  return w;
}

WearMap empty_map(const Chart& chart, const Window& window, int columns, int rows) {
  WearMap map;
  map.polar = chart.polar;
  map.u_count = columns;
  map.v_count = rows;
  map.u_step = (window.u_high - window.u_low) / columns;
  map.v_step = (window.v_high - window.v_low) / rows;
  map.u_first = window.u_low + 0.5 * map.u_step;
  map.v_first = window.v_low + 0.5 * map.v_step;
  map.depth_um.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows),
                      std::numeric_limits<float>::quiet_NaN());
  return map;
}

/// Corners of a triangle on the chart; one that crosses angle 0 is drawn once on each side.
struct ChartTriangle {
  std::array<std::array<double, 2>, 3> corner;
  std::array<double, 3> depth;
};

void rasterise(const ChartTriangle& t, WearMap& map) {
  const auto& [a, b, c] = t.corner;
  const double twice_area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
  if (twice_area == 0.0) return;
  const auto [u_low, u_high] = std::minmax({a[0], b[0], c[0]});
  const auto [v_low, v_high] = std::minmax({a[1], b[1], c[1]});
  const int first_u = std::max(0, static_cast<int>(std::ceil((u_low - map.u_first) / map.u_step)));
  const int last_u =
      std::min(map.u_count - 1, static_cast<int>(std::floor((u_high - map.u_first) / map.u_step)));
  const int first_v = std::max(0, static_cast<int>(std::ceil((v_low - map.v_first) / map.v_step)));
  const int last_v =
      std::min(map.v_count - 1, static_cast<int>(std::floor((v_high - map.v_first) / map.v_step)));
  for (int iv = first_v; iv <= last_v; ++iv) {
    for (int iu = first_u; iu <= last_u; ++iu) {
      const double u = map.u_first + iu * map.u_step, v = map.v_first + iv * map.v_step;
      const double wb = ((u - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (v - a[1])) / twice_area;
      const double wc = ((b[0] - a[0]) * (v - a[1]) - (u - a[0]) * (b[1] - a[1])) / twice_area;
      constexpr double kEdge = -1e-9;  // a cell centre on a shared edge belongs to both triangles
      if (wb < kEdge || wc < kEdge || wb + wc > 1.0 - kEdge) continue;
      map.depth_um[static_cast<std::size_t>(iv) * static_cast<std::size_t>(map.u_count) +
                   static_cast<std::size_t>(iu)] =
          static_cast<float>((1.0 - wb - wc) * t.depth[0] + wb * t.depth[1] + wc * t.depth[2]);
    }
  }
}

void fill_map(const TriangleMesh& mesh, const std::vector<double>& depth, const Chart& chart, WearMap& map) {
  for (const Triangle& triangle : mesh.triangles) {
    ChartTriangle t{};
    double u_low = std::numeric_limits<double>::max(), u_high = -u_low;
    for (std::size_t k = 0; k < 3; ++k) {
      t.corner[k] = chart(mesh.vertices[at(triangle[k])]);
      t.depth[k] = depth[at(triangle[k])];
      u_low = std::min(u_low, t.corner[k][0]);
      u_high = std::max(u_high, t.corner[k][0]);
    }
    if (chart.polar && u_high - u_low > 180.0) {
      for (auto& corner : t.corner) corner[0] += corner[0] < 180.0 ? 360.0 : 0.0;
      rasterise(t, map);
      for (auto& corner : t.corner) corner[0] -= 360.0;
    }
    rasterise(t, map);
  }
}

void add_vertex(SurfaceView& view, const Vec3& p, const Vec3& n, double depth) {
  view.x_mm.push_back(static_cast<float>(p.x));
  view.y_mm.push_back(static_cast<float>(p.y));
  view.z_mm.push_back(static_cast<float>(p.z));
  view.nx.push_back(static_cast<float>(n.x));
  view.ny.push_back(static_cast<float>(n.y));
  view.nz.push_back(static_cast<float>(n.z));
  view.depth_um.push_back(static_cast<float>(depth));
}

void add_triangle(SurfaceView& view, Index a, Index b, Index c) {
  view.i.push_back(a);
  view.j.push_back(b);
  view.k.push_back(c);
}

/// The band's own triangles.
SurfaceView select(const TriangleMesh& mesh, const std::vector<Vec3>& normals,
                   const std::vector<double>& depth, const std::vector<bool>& inside) {
  SurfaceView view;
  std::vector<Index> number(mesh.vertices.size(), -1);
  for (const Triangle& triangle : mesh.triangles) {
    if (!inside[at(triangle[0])] || !inside[at(triangle[1])] || !inside[at(triangle[2])]) continue;
    std::array<Index, 3> renamed{};
    for (std::size_t k = 0; k < 3; ++k) {
      Index& n = number[at(triangle[k])];
      if (n < 0) {
        n = static_cast<Index>(view.x_mm.size());
        add_vertex(view, mesh.vertices[at(triangle[k])], normals[at(triangle[k])], depth[at(triangle[k])]);
      }
      renamed[k] = n;
    }
    add_triangle(view, renamed[0], renamed[1], renamed[2]);
  }
  return view;
}

/// A grid over the window, for bands with too many triangles: the depth is interpolated, the height and the
/// normal are taken as those of a plane through the band.
SurfaceView resample(const WearMap& map, double z_mm, const Vec3& normal) {
  SurfaceView view;
  view.resampled = true;
  std::vector<Index> number(map.depth_um.size(), -1);
  const auto cell_of = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(map.u_count) +
           static_cast<std::size_t>(column);
  };
  for (int v = 0; v < map.v_count; ++v) {
    for (int u = 0; u < map.u_count; ++u) {
      const std::size_t cell = cell_of(u, v);
      if (std::isnan(map.depth_um[cell])) continue;
      number[cell] = static_cast<Index>(view.x_mm.size());
      const double s = map.u_first + u * map.u_step, r = map.v_first + v * map.v_step;
      const Vec3 p =
          map.polar ? Vec3{r * std::cos(s / kDegrees), r * std::sin(s / kDegrees), z_mm} : Vec3{s, r, z_mm};
      add_vertex(view, p, normal, map.depth_um[cell]);
    }
  }
  const int columns = map.polar ? map.u_count : map.u_count - 1;
  for (int v = 0; v + 1 < map.v_count; ++v) {
    for (int u = 0; u < columns; ++u) {
      const int next = (u + 1) % map.u_count;
      const auto id = [&](int column, int row) { return number[cell_of(column, row)]; };
      const Index a = id(u, v), b = id(next, v), c = id(next, v + 1), d = id(u, v + 1);
      if (a < 0 || b < 0 || c < 0 || d < 0) continue;
      // Seen from the normal's side; angle against radius is left-handed, x against y right-handed.
      if (map.polar) {
        add_triangle(view, a, c, b);
        add_triangle(view, a, d, c);
      } else {
        add_triangle(view, a, b, c);
        add_triangle(view, a, c, d);
      }
    }
  }
  return view;
}

std::size_t triangles_inside(const TriangleMesh& mesh, const std::vector<bool>& inside) {
  return static_cast<std::size_t>(std::count_if(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const Triangle& t) { return inside[at(t[0])] && inside[at(t[1])] && inside[at(t[2])]; }));
}

}  // namespace

std::vector<double> sunk_um(const TriangleMesh& before, const TriangleMesh& after) {
  if (before.vertices.size() != after.vertices.size() || before.triangles.size() != after.triangles.size()) {
    throw IoError(fmt::format(
        "the first and the last frame of the worn wall differ: {} and {} vertices, {} and {} triangles; they "
        "must be "
        "frames of one mesh",
        before.vertices.size(), after.vertices.size(), before.triangles.size(), after.triangles.size()));
  }
  const std::vector<Vec3> normals = vertex_normals(before);
  std::vector<double> depth(before.vertices.size());
  for (std::size_t v = 0; v < depth.size(); ++v) {
    depth[v] = -1e3 * dot(after.vertices[v] - before.vertices[v], normals[v]);
  }
  return depth;
}

std::optional<WornSurface> worn_surface(const TriangleMesh& before, const std::vector<double>& depth,
                                        std::size_t max_triangles) {
  double deepest = 0.0;
  for (const double d : depth) deepest = std::isfinite(d) ? std::max(deepest, d) : deepest;
  if (before.triangles.empty() || deepest < 1e-6) return std::nullopt;
  const std::vector<Vec3> normals = vertex_normals(before);

  std::vector<Vec3> worn;
  for (std::size_t v = 0; v < depth.size(); ++v) {
    if (depth[v] > kWornFraction * deepest) worn.push_back(before.vertices[v]);
  }
  const Chart chart = choose_chart(worn);
  const Window window = window_of(worn, chart);
  std::vector<bool> inside(before.vertices.size());
  for (std::size_t v = 0; v < inside.size(); ++v) inside[v] = window.holds(chart(before.vertices[v]));

  WornSurface out;
  out.max_depth_um = deepest;
  out.mesh_triangles = before.triangles.size();
  out.map = empty_map(chart, window, kMapColumns, kMapRows);
  fill_map(before, depth, chart, out.map);
  if (triangles_inside(before, inside) <= max_triangles) {
    out.view = select(before, normals, depth, inside);
  } else {
    const int rows = 40;
    const int columns = static_cast<int>(max_triangles / (2 * static_cast<std::size_t>(rows)));
    WearMap fine = empty_map(chart, window, columns, rows);
    fill_map(before, depth, chart, fine);
    Vec3 normal;
    for (std::size_t v = 0; v < inside.size(); ++v) normal += inside[v] ? normals[v] : Vec3{};
    out.view = resample(fine, worn.front().z, normalized(normal));
  }
  return out;
}

}  // namespace abradem::report
