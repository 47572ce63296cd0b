#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes cases/meshes/pebble.obj: a sphere of 320 triangles, stretched to 6 : 4.8 : 3.6 mm and with three worn faces.

usage: make_pebble_mesh.py cases/meshes/pebble.obj
"""
import math
import sys

AXES = (3.0, 2.4, 1.8)  # half lengths [mm]
FACES = (((0.1, 0.3, 1.0), 0.80), ((-0.8, 0.5, -0.4), 0.85), ((0.7, -0.7, -0.2), 0.85))  # direction, distance


def unit(v):
    length = math.sqrt(sum(x * x for x in v))
    return tuple(x / length for x in v)


def icosphere(levels):
    g = (1 + math.sqrt(5)) / 2
    points = [unit(p) for a in (-1, 1) for b in (-g, g) for p in ((a, b, 0), (0, a, b), (b, 0, a))]
    edge = min(math.dist(points[0], p) for p in points[1:])
    near = lambda i, j: abs(math.dist(points[i], points[j]) - edge) < 1e-9
    triangles = []
    for i in range(12):
        for j in range(i + 1, 12):
            for k in range(j + 1, 12):
                if near(i, j) and near(j, k) and near(k, i):
                    a, b, c = points[i], points[j], points[k]
                    cross = (b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0])
                    triangles.append((i, j, k) if sum(x * y for x, y in zip(a, cross)) > 0 else (i, k, j))
    for _ in range(levels):
        middle, finer = {}, []

        def between(i, j):
            key = (min(i, j), max(i, j))
            if key not in middle:
                middle[key] = len(points)
                points.append(unit([x + y for x, y in zip(points[i], points[j])]))
            return middle[key]

        for i, j, k in triangles:
            a, b, c = between(i, j), between(j, k), between(k, i)
            finer += [(i, a, c), (a, j, b), (c, b, k), (a, b, c)]
        triangles = finer
    return points, triangles


def worn(p):
    for direction, distance in FACES:
        n = unit(direction)
        beyond = sum(x * y for x, y in zip(p, n)) - distance
        if beyond > 0:
            p = tuple(x - beyond * y for x, y in zip(p, n))
    return tuple(x * a for x, a in zip(p, AXES))


points, triangles = icosphere(2)
with open(sys.argv[1], "w") as out:
    out.write("# a pebble [mm], written by tools/make_pebble_mesh.py\n")
    for p in points:
        out.write("v {:.6f} {:.6f} {:.6f}\n".format(*worn(p)))
    for t in triangles:
        out.write("f {} {} {}\n".format(*(i + 1 for i in t)))
