#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the meshes of the ready cases (cases/meshes/*.stl, binary, millimetres): tools/make_equipment.py FOLDER"""
import math
import pathlib
import struct
import sys


def quads(grid):
    """Triangles of a grid of points, rows by columns; seen from the side that the normals point to, rows go up."""
    for i in range(len(grid) - 1):
        for j in range(len(grid[0]) - 1):
            a, b, c, d = grid[i][j], grid[i][j + 1], grid[i + 1][j + 1], grid[i + 1][j]
            yield from ((a, b, c), (a, c, d)) if (i + j) % 2 == 0 else ((a, b, d), (b, c, d))


def write_stl(path, triangles):
    triangles = list(triangles)
    with open(path, "wb") as f:
        f.write(b"Abradem ready case, mm".ljust(80) + struct.pack("<I", len(triangles)))
        for t in triangles:
            f.write(struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0))
    print(f"{path}: {len(triangles)} triangles")


def between(a, b, pitch):
    """From a to b without b, in steps of about `pitch`."""
    n = max(1, round(math.dist(a, b) / pitch))
    return [tuple(p + (q - p) * k / n for p, q in zip(a, b)) for k in range(n)]


def plate(corner, along, across, pitch):
    """A parallelogram; its normal is along x across."""
    steps = lambda v: max(1, round(math.hypot(*v) / pitch))
    n, m = steps(along), steps(across)
    point = lambda s, t: tuple(c + a * s + b * t for c, a, b in zip(corner, along, across))
    return quads([[point(j / n, i / m) for j in range(n + 1)] for i in range(m + 1)])


def chute(slope, length, width, height):
    """Sides of the chute, beside a liner centred on the origin that falls towards +x."""
    c, s = math.cos(slope), math.sin(slope)
    along = (length * c, 0, -length * s)
    for side in (-1, 1):
        start = (-0.5 * length * c, side * 0.5 * width, 0.5 * length * s - 5)
        yield from plate(start, along, (0, 0, height), 60) if side > 0 else plate(start, (0, 0, height), along, 60)


def drum(radius, length, lifters, lifter, pitch):
    """A drum around the y axis with rectangular lifters on its inside."""
    profile = []
    for k in range(lifters):
        middle = 2 * math.pi * k / lifters
        half = math.asin(0.5 * lifter / radius)
        axis, side = (math.cos(middle), math.sin(middle)), (-math.sin(middle), math.cos(middle))
        foot = radius * math.cos(half)
        corner = lambda r, t: tuple(r * a + t * b for a, b in zip(axis, side))
        a, b = corner(foot, -0.5 * lifter), corner(radius - lifter, -0.5 * lifter)
        c, d = corner(radius - lifter, 0.5 * lifter), corner(foot, 0.5 * lifter)
        profile += between(a, b, pitch) + between(b, c, pitch) + between(c, d, pitch)
        arc = 2 * math.pi / lifters - 2 * half
        n = round(radius * arc / pitch)
        profile += [(radius * math.cos(middle + half + arc * i / n), radius * math.sin(middle + half + arc * i / n))
                    for i in range(n)]
    profile.append(profile[0])
    rows = round(length / pitch)
    return quads([[(x, -0.5 * length + length * i / rows, z) for x, z in profile] for i in range(rows + 1)])


def cylinder(radius, length, pitch):
    """A smooth drum around the y axis."""
    n, rows = round(2 * math.pi * radius / pitch), round(length / pitch)
    circle = [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n)) for i in range(n)]
    circle.append(circle[0])
    return quads([[(x, -0.5 * length + length * i / rows, z) for x, z in circle] for i in range(rows + 1)])


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    slope, length, width = math.radians(50), 300, 150
    c, s = math.cos(slope), math.sin(slope)
    write_stl(folder / "chute-liner.stl",
              plate((-0.5 * length * c, -0.5 * width, 0.5 * length * s), (length * c, 0, -length * s), (0, width, 0), 6))
    write_stl(folder / "chute-sides.stl", chute(slope, length, width, 120))
    write_stl(folder / "drum.stl", drum(100, 40, 8, 12, 4))
    write_stl(folder / "smooth-drum.stl", cylinder(120, 24, 6))
