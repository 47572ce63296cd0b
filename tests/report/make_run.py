#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes a plausible output folder of a pin-on-disc run, for the tests of the report.

    make_run.py FOLDER [--size MM] [--revolutions N] [--title TEXT] [--unworn]

A ring of 20 to 24 mm with a groove about 8 um deep and 0.75 mm wide at radius 22 mm. Same arguments, same bytes.
"""
import argparse
import base64
import json
import math
import pathlib
import random
import struct
import zlib

TRACK, RADIUS = 22.0, 3.0  # of the track and of the ball [mm]


def depth_at(angle, r, turn, turns):
    """Depth [mm] of the groove at an angle [rad], radius [mm] and revolution."""
    deepest = 0.008 * (turn / turns) ** (2 / 3) * (1 + 0.03 * math.sin(3 * angle) + 0.015 * math.sin(17 * angle + 1))
    half = 0.375 * (turn / turns) ** (1 / 3) if turn else 0.0
    s = (r - TRACK) / half if half else 2.0
    return deepest * (1 - s * s) if abs(s) < 1 else 0.0


def ring(size, rng):
    rows, columns = round(4 / size), round(2 * math.pi * TRACK / size)
    points = []
    for v in range(rows + 1):
        for u in range(columns):
            jitter = 0.25 * size if 0 < v < rows else 0.0
            r = 20 + 4 * v / rows + jitter * rng.uniform(-1, 1)
            a = 2 * math.pi * (u + 0.5 * (v % 2) + 0.25 * rng.uniform(-1, 1)) / columns
            points.append((r, a))
    triangles = []
    for v in range(rows):
        for u in range(columns):
            a, b = v * columns + u, v * columns + (u + 1) % columns
            c, d = a + columns, b + columns
            # Rows are shifted by half a column, so the diagonal alternates; counter-clockwise seen from +z.
            triangles += [(a, c, b), (b, c, d)] if v % 2 == 0 else [(a, d, b), (a, c, d)]
    return points, triangles


class Appended:
    """Arrays in the appended section of a VTK XML file: base64, zlib."""

    def __init__(self):
        self.text = ""

    def add(self, raw):
        offset, size = len(self.text), 32768
        blocks = [zlib.compress(raw[k:k + size]) for k in range(0, len(raw), size)]
        head = struct.pack(f"<{3 + len(blocks)}I", len(blocks), size, len(raw) % size, *map(len, blocks))
        self.text += base64.b64encode(head).decode() + base64.b64encode(b"".join(blocks)).decode()
        return offset


def write_vtp(file, points, triangles):
    data = Appended()
    xyz = data.add(b"".join(struct.pack("<3d", *p) for p in points))
    corners = data.add(b"".join(struct.pack("<3i", *t) for t in triangles))
    offsets = data.add(struct.pack(f"<{len(triangles)}i", *range(3, 3 * len(triangles) + 1, 3)))
    file.write_text(f"""<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian" header_type="UInt32" compressor="vtkZLibDataCompressor">
<PolyData>
<Piece NumberOfPoints="{len(points)}" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0" NumberOfPolys="{len(triangles)}">
<Points><DataArray type="Float64" Name="Points" NumberOfComponents="3" format="appended" offset="{xyz}"/></Points>
<Polys>
<DataArray type="Int32" Name="connectivity" format="appended" offset="{corners}"/>
<DataArray type="Int32" Name="offsets" format="appended" offset="{offsets}"/>
</Polys>
</Piece>
</PolyData>
<AppendedData encoding="base64">_{data.text}</AppendedData>
</VTKFile>
""")


def write_table(file, header, rows):
    lines = [header] + [",".join("" if x is None else f"{x:.10g}" for x in row) for row in rows]
    file.write_text("\n".join(lines) + "\n")


def spread(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1))


def tables(folder, turns, rng):
    contours, revolutions, profiles, force = [], [], [], []
    samples = max(4, 6000 // turns)
    for turn in range(1, turns + 1):
        depths, widths, areas, forces = [], [], [], []
        for n in range(360):
            angle = math.radians(n)
            depth = depth_at(angle, TRACK, turn, turns) * (1 + rng.gauss(0, 0.02))
            width = 0.75 * (turn / turns) ** (1 / 3) * (1 + rng.gauss(0, 0.015))
            depths.append(depth), widths.append(width), areas.append(2 / 3 * depth * width)
            contours.append((turn, n, depth, width, areas[-1]))
        for n in range(8):
            for k in range(81):
                r = TRACK - 0.8 + 0.02 * k
                profiles.append((turn, 45 * n, r, -depth_at(math.radians(45 * n), r, turn, turns)))
        for k in range(samples):
            time, normal = 2 * (turn - 1 + k / samples), 5.005 + rng.gauss(0, 0.02 + 0.002 * turn)
            forces.append(normal)
            force.append((time, turn, normal, 0.98 * normal, 40.8 + rng.gauss(0, 0.3), rng.randint(9, 14)))
        d, w, f = spread(depths), spread(widths), spread(forces)
        area = sum(areas) / len(areas)
        volume = 2 * math.pi * TRACK * area
        revolutions.append((turn, 2 * turn, volume, volume, 0.41 * volume, *d, min(depths), max(depths), *w, area, *f,
                            min(forces), max(forces), 0.31, None if turn == 1 else 0.012))
    write_table(folder / "contours.csv", "revolution,angle_deg,depth_mm,width_mm,area_mm2", contours)
    write_table(folder / "profiles.csv", "revolution,angle_deg,radius_mm,height_mm", profiles)
    write_table(folder / "force.csv", "time_s,revolution,normal_force_N,tangential_force_N,overlap_um,contacts", force)
    header = ("revolution,time_s,law_volume_mm3,swept_volume_mm3,paper_volume_mm3,depth_mean_mm,depth_sd_mm,depth_min_mm,"
              "depth_max_mm,width_mean_mm,width_sd_mm,area_mean_mm2,force_mean_N,force_sd_N,force_min_N,force_max_N,"
              "depth_p_chi2,width_p_chi2")
    write_table(folder / "revolutions.csv", header, revolutions)
    return dict(zip(header.split(","), revolutions[-1]))


CASE = """schema = 1
title = {title}

[material.iron_ore]
density = "4850 kg/m^3"
shear_modulus = "0.1 GPa"
poisson_ratio = 0.24

[wall.disc]
material = "mild_steel"
mesh = {{ shape = "annulus", inner = "20 mm", outer = "24 mm", size = "{size} mm" }}
"""


def manifest(last, turns, title):
    volume = last["swept_volume_mm3"]
    return {
        "status": "completed", "exit_code": 0, "version": "0.1.0", "commit": "0123456789ab", "compiler": "GNU 12.2.0",
        "threads": 2, "seed": 1, "steps": 142857 * turns, "wall_seconds": 3.21, "steps_per_second": 142857 * turns / 3.21,
        "state_hash": "9f3c0d1be2a47715",
        "ledger": {"law_volume_mm3": volume, "deposited_volume_mm3": volume, "swept_volume_mm3": volume * (1 + 3e-13),
                   "residual_relative": 3.1e-13, "kappa": 1.0},
        "results": last, "case_title": title,
        "limits": [
            {"name": "Displacement per update over smallest altitude", "value": 0.0031, "limit": 0.1, "ok": True},
            {"name": "Time step over the Hertz limit", "value": 0.14, "limit": 0.2, "ok": True},
            {"name": "Wear updates per patch length", "value": "3", "limit": "at least 4", "ok": False}],
        "warnings": ["Contours 0.5 degrees apart are correlated over 1.4 degrees: of 360 contours 257 are independent."],
        "setup": {"Wall": "disc, annulus 20 to 24 mm, 110 400 triangles", "Pin": "radius 3 mm, load 5 N, guided",
                  "Wear": "Archard, 6.81e-11 1/Pa", "Rules": "patch, hertz footprint, conserving", "Revolutions": turns},
        "measurement": {"wear_volume_mm3": {"mean": 0.565, "sd": 0.089}, "depth_mm": {"low": 0.010, "high": 0.014},
                        "width_mm": {"low": 0.65, "high": 0.80}, "revolutions": 1302.5},
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--size", type=float, default=0.2, help="of the mesh [mm]")
    parser.add_argument("--revolutions", type=int, default=12)
    parser.add_argument("--title", default="Pin on disc: iron ore on mild steel")
    parser.add_argument("--unworn", action="store_true", help="no frames, no rows: a run stopped at once")
    options = parser.parse_args()
    rng = random.Random(1)
    folder, turns = options.folder, options.revolutions
    for name in ("tables", "vtk"):
        (folder / name).mkdir(parents=True, exist_ok=True)
    last = tables(folder / "tables", turns, rng)
    record = manifest(last, turns, options.title)
    if options.unworn:
        for table in (folder / "tables").glob("*.csv"):
            table.write_text(table.read_text().splitlines()[0] + "\n")
        record.update(status="interrupted", exit_code=130, results={}, limits=[], warnings=[], setup={}, measurement={})
        record["ledger"] = dict.fromkeys(record["ledger"], 0.0) | {"kappa": None}
    else:
        points, triangles = ring(options.size, rng)
        for turn in (0, turns):
            moved = [(1e-3 * r * math.cos(a), 1e-3 * r * math.sin(a), -1e-3 * depth_at(a, r, turn, turns)) for r, a in points]  # [m]
            write_vtp(folder / "vtk" / f"disc_{turn:04d}.vtp", moved, triangles)
        entries = "\n".join(f'<DataSet timestep="{2 * t}" part="0" file="vtk/disc_{t:04d}.vtp"/>' for t in (0, turns))
        (folder / "series.pvd").write_text(
            f'<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1">\n<Collection>\n{entries}\n</Collection>\n</VTKFile>\n')
    (folder / "run.json").write_text(json.dumps(record, indent=2))
    (folder / "case.resolved.toml").write_text(CASE.format(title=json.dumps(options.title), size=options.size))


if __name__ == "__main__":
    main()
