#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a flat ring in the plane z = 0 as ASCII STL [mm], normals along +z.

    make_disc.py INNER_MM OUTER_MM SIZE_MM FILE

Staggered rings of near-equilateral triangles; prints how many. (A peer's input: our own program meshes its discs
itself.)
"""
import math
import sys


def vertices(inner, outer, size):
    """Rings of equally many vertices, every second one turned by half a spacing."""
    rings = max(1, round((outer - inner) / (size * math.sqrt(3) / 2)))
    count = round(math.pi * (inner + outer) / size)
    step = 2 * math.pi / count
    return [[((inner + (outer - inner) * k / rings) * math.cos((i + 0.5 * (k % 2)) * step),
              (inner + (outer - inner) * k / rings) * math.sin((i + 0.5 * (k % 2)) * step))
             for i in range(count)] for k in range(rings + 1)]


def triangles(rings):
    """Counter-clockwise corners of every triangle between neighbouring rings."""
    for k in range(len(rings) - 1):
        inside, outside, shift = rings[k], rings[k + 1], k % 2
        count = len(inside)
        for i in range(count):
            j = (i + 1) % count
            if shift == 0:  # the outer ring is the turned one
                yield inside[i], outside[i], inside[j]
                yield inside[j], outside[i], outside[j]
            else:
                yield inside[i], outside[i], outside[j]
                yield inside[i], outside[j], inside[j]


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    inner, outer, size = (float(text) for text in sys.argv[1:4])
    written = 0
    with open(sys.argv[4], "w", encoding="ascii") as file:
        file.write("solid disc\n")
        for corners in triangles(vertices(inner, outer, size)):
            file.write("facet normal 0 0 1\nouter loop\n")
            for x, y in corners:
                file.write(f"vertex {x:.9g} {y:.9g} 0\n")
            file.write("endloop\nendfacet\n")
            written += 1
        file.write("endsolid disc\n")
    print(written)


if __name__ == "__main__":
    main()
