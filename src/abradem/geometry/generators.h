// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "abradem/geometry/triangle_mesh.h"

namespace abradem::geometry {

/// Flat ring in the plane z = 0, centred on the origin, normals along +z. Unstructured, near-equilateral
/// triangles of the given edge length; the same seed gives the same mesh, bit for bit. Mean quality above
/// 0.97 for ten or more triangles across the ring, least quality above 0.55 (docs/theory/meshes.md). Vertices
/// and triangles are numbered along a space-filling curve. O(n log n), about 1 s for 10^6 triangles.
/// @param inner,outer radii [m], 0 < inner < outer   @param size target edge length [m]
/// @throws InputError when the sizes cannot be meshed (not positive, size larger than the ring's width,
///         more than 10^8 triangles)
[[nodiscard]] TriangleMesh make_annulus(double inner, double outer, double size, std::uint64_t seed);

/// Flat disc in the plane z = 0, centred on the origin, normals along +z; otherwise as make_annulus.
[[nodiscard]] TriangleMesh make_disc(double radius, double size, std::uint64_t seed);

/// Flat rectangle in the plane z = 0, centred on the origin, length along x and width along y; otherwise as
/// make_annulus.
[[nodiscard]] TriangleMesh make_plate(double length, double width, double size, std::uint64_t seed);

}  // namespace abradem::geometry
