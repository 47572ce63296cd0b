#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes docs/images/bulk-cases.png from runs of the ready cases: tools/make_bulk_picture.py RUNS PICTURE

RUNS/hopper, RUNS/transfer-chute, RUNS/liner-life, RUNS/rotating-drum, RUNS/angle-of-repose and RUNS/pebbles are output
folders of these cases.
Needs matplotlib and VTK's Python (Debian: python3-matplotlib, python3-vtk9).
"""
import math
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def last_frame(folder, name):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(sorted(folder.glob(f"vtk/{name}_*.vtp"))[-1]))
    reader.Update()
    return reader.GetOutput()


def points_mm(data):
    return 1e3 * vtk_to_numpy(data.GetPoints().GetData())


def point_array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def draw_grains(axes, folder, title, x, z):
    """Seen along y, coloured by speed."""
    data = last_frame(folder, "particles")
    p = points_mm(data)
    near = np.argsort(-p[:, 1])
    d = 2e3 * point_array(data, "radius")[near]
    speed = np.linalg.norm(point_array(data, "velocity_m_per_s"), axis=1)[near]
    grains = EllipseCollection(d, d, 0 * d, offsets=p[near][:, [0, 2]], units="xy", transOffset=axes.transData,
                               array=speed, cmap="viridis", linewidths=0.2, edgecolors="k")
    axes.add_collection(grains)
    axes.set(xlim=x, ylim=z, title=title, xlabel="x [mm]", ylabel="z [mm]", aspect="equal")
    plt.colorbar(grains, ax=axes, label="speed [m/s]", shrink=0.7)


def draw_liner(axes, folder, title, unit, um):
    """In its own plane, 50 degrees steep; depths in a unit of so many micrometres."""
    data = last_frame(folder, "liner")
    p = points_mm(data)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    down = p[:, 0] * math.cos(math.radians(50)) - p[:, 2] * math.sin(math.radians(50))
    depth = point_array(data, "depth_um") / um
    colours = axes.tripcolor(p[:, 1], -down, triangles, depth, cmap="inferno_r", shading="gouraud")
    axes.set(title=title, xlabel="across [mm]", ylabel="up the slope [mm]", aspect="equal")
    plt.colorbar(colours, ax=axes, label=f"depth worn [{unit}]", shrink=0.7)


def main():
    runs, picture = pathlib.Path(sys.argv[1]), sys.argv[2]
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.6))
    axes = axes.ravel()
    draw_grains(axes[0], runs / "hopper", "hopper", (-66, 66), (-25, 80))
    for side in (-1, 1):
        axes[0].plot([side * 62.7, side * 62.7, side * 12.5], [80, 0, 0], "k")
    draw_liner(axes[1], runs / "transfer-chute", "transfer-chute: liner after 0.8 s", "µm", 1.0)
    draw_liner(axes[2], runs / "liner-life", "liner-life: after 500 hours", "mm", 1000.0)
    draw_grains(axes[3], runs / "rotating-drum", "rotating-drum", (-105, 105), (-105, 105))
    drum = points_mm(last_frame(runs / "rotating-drum", "drum"))
    front = drum[drum[:, 1] < -19.9]  # half a turn later it lies upside down
    axes[3].plot(-front[:, 0], -front[:, 2], "k.", markersize=1.5)
    for place, case in ((4, "angle-of-repose"), (5, "pebbles")):
        draw_grains(axes[place], runs / case, case, (-40, 40), (-8, 30))
        axes[place].plot([-32, 32], [0, 0], "k")
    figure.tight_layout()
    figure.savefig(picture, dpi=90)


if __name__ == "__main__":
    main()
