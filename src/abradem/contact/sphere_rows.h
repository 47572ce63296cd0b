// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "abradem/core/archive.h"
#include "abradem/core/large_pages.h"
#include "abradem/core/vec3.h"

/// Spheres in numbers, as the contact search and the forces among them see them.
namespace abradem::contact {

/// One sphere: three quads of doubles, each loaded whole. 96 bytes; no quad crosses a cache line.
struct alignas(32) SphereRow {
  double x = 0.0, y = 0.0, z = 0.0, radius = 0.0;         ///< [m]
  double vx = 0.0, vy = 0.0, vz = 0.0, inverse_mass = 0;  ///< [m/s], [1/kg]
  double wx = 0.0, wy = 0.0, wz = 0.0, material = 0.0;    ///< spin [rad/s]; number of the material

  [[nodiscard]] Vec3 position() const noexcept { return {x, y, z}; }
  [[nodiscard]] Vec3 velocity() const noexcept { return {vx, vy, vz}; }
  [[nodiscard]] Vec3 spin() const noexcept { return {wx, wy, wz}; }
  void set_position(const Vec3& p) noexcept { x = p.x, y = p.y, z = p.z; }
  void set_velocity(const Vec3& v) noexcept { vx = v.x, vy = v.y, vz = v.z; }
  void set_spin(const Vec3& w) noexcept { wx = w.x, wy = w.y, wz = w.z; }
};

/// What acts on one sphere, and beside it what the step's stability depends on.
struct alignas(64) LoadRow {
  double fx = 0.0, fy = 0.0, fz = 0.0;  ///< [N]
  double stiffening = 0.0;              ///< sum over the contacts of 2 D_n dt + S_n dt^2: M (2 g + W) [kg]
  double tx = 0.0, ty = 0.0, tz = 0.0;  ///< [N m]
  double unused = 0.0;

  [[nodiscard]] Vec3 force() const noexcept { return {fx, fy, fz}; }
  [[nodiscard]] Vec3 torque() const noexcept { return {tx, ty, tz}; }
  LoadRow& operator+=(const LoadRow& o) noexcept {
    fx += o.fx, fy += o.fy, fz += o.fz, stiffening += o.stiffening;
    tx += o.tx, ty += o.ty, tz += o.tz;
    return *this;
  }
};

/// What a contact remembers: the tangential spring of the sphere that owns it [m], or where the pair's
/// options ask for it, the elastic rolling torque on it and, last, that about the normal [N m].
struct alignas(32) SpringRow {
  double x = 0.0, y = 0.0, z = 0.0, twist = 0.0;
};

using SphereRows = std::vector<SphereRow, core::LargePages<SphereRow>>;
using LoadRows = std::vector<LoadRow, core::LargePages<LoadRow>>;

/// Spheres in numbers. Their order follows a space-filling curve and changes when the list of neighbours is
/// made anew; `id` stays with a sphere for life.
struct Spheres {
  SphereRows row;
  std::vector<std::int32_t> id;  ///< < 0: to be taken out at the next rebuild
  /// Which clump each belongs to; spheres of one do not touch one another. < 0: none; empty: no sphere does.
  std::vector<std::int32_t> clump;
  [[nodiscard]] std::size_t size() const noexcept { return row.size(); }

  template <typename Self, typename Archive>
  static void visit(Self& self, Archive& archive) {
    archive("row", self.row)("id", self.id)("clump", self.clump);
  }
};

}  // namespace abradem::contact

/// Rows are kept as the doubles that they are.
template <>
struct abradem::core::archive_detail::Plain<abradem::contact::SphereRow> {
  using Scalar = double;
};
template <>
struct abradem::core::archive_detail::Plain<abradem::contact::LoadRow> {
  using Scalar = double;
};
template <>
struct abradem::core::archive_detail::Plain<abradem::contact::SpringRow> {
  using Scalar = double;
};
