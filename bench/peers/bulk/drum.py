#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The turning drum of bench/bulk.cpp by Abradem and by LIGGGHTS: same spheres, law, step, skin and triangles, one core.

    bench/peers/bulk/drum.py --bulk build/bench/bench/abradem_bulk [--triangles 5000 50000] [--steps 200] [--runs 5]

20,000 spheres of 6 mm in a shell of 300 mm, half a turn a second. Abradem turns it for --warm steps and writes every
sphere's place, velocity and spin; LIGGGHTS goes on from there, takes 200 steps, and both are timed for --steps, --runs
times. Both track wear: Abradem by Archard's law, and it moves the nodes; LIGGGHTS by Finnie's, and its mesh keeps its
shape. LAMMPS has no wall of triangles that wears.
"""
import argparse
import math
import os
import pathlib
import re
import statistics
import struct
import subprocess
import tempfile

from run import DENSITY, FRICTION, POISSON, RADIUS, RESTITUTION, SKIN, STEP, YOUNG, find, print_table

DRUM_RADIUS, DRUM_LENGTH = 0.15, 0.152
STEEL_YOUNG, STEEL_POISSON = 2 * 7.8e10 * 1.3, 0.3

DECK = """atom_style granular
units si
boundary f f f
newton off
communicate single vel yes
hard_particles yes
read_data state.data
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes one 10000 page 1000000
fix p1 all property/global youngsModulus peratomtype {young} {steel_young}
fix p2 all property/global poissonsRatio peratomtype {nu} {steel_nu}
fix p3 all property/global coefficientRestitution peratomtypepair 2 {e} {e} {e} {e}
fix p4 all property/global coefficientFriction peratomtypepair 2 {mu} {mu} {mu} {mu}
fix p5 all property/global k_finnie peratomtypepair 2 1.0 1.0 1.0 1.0
pair_style gran model hertz tangential history
pair_coeff * *
timestep {step}
fix shell all mesh/surface/stress file shell.stl type 2 stress on wear finnie
fix w all wall/gran model hertz tangential history mesh n_meshes 1 meshes shell
fix turn all move/mesh mesh shell rotate origin 0. 0. 0. axis 0. 1. 0. period 2.0
fix y0 all wall/gran model hertz tangential history primitive type 2 yplane {low}
fix y1 all wall/gran model hertz tangential history primitive type 2 yplane {high}
fix g all gravity 9.81 vector 0 0 -1
fix n all nve/sphere
compute c all contact/atom
compute contacts all reduce sum c_c
thermo_style custom step atoms ke c_contacts
thermo 1000000
thermo_modify lost error norm no
run 200
"""


def write_shell(path, triangles):
    """The mesh of bench/bulk.cpp: a cylinder about the y axis, seen from inside."""
    around = 2 * math.pi * DRUM_RADIUS
    edge = math.sqrt(2 * around * DRUM_LENGTH / triangles)
    n, m = round(around / edge), round(DRUM_LENGTH / edge)

    def vertex(k, i):
        angle = 2 * math.pi * (i % n) / n
        return DRUM_RADIUS * math.cos(angle), (k / m - 0.5) * DRUM_LENGTH, DRUM_RADIUS * math.sin(angle)

    with open(path, "wb") as file:
        file.write(b"shell".ljust(80) + struct.pack("<I", 2 * n * m))
        for k in range(m):
            for i in range(n):
                a, b, c, d = vertex(k, i), vertex(k, i + 1), vertex(k + 1, i), vertex(k + 1, i + 1)
                for corners in (a, b, c), (c, b, d):
                    inward = [-corners[0][0] / DRUM_RADIUS, 0.0, -corners[0][2] / DRUM_RADIUS]
                    file.write(struct.pack("<12fH", *inward, *(x for p in corners for x in p), 0))


def write_state(path, spheres):
    half = 1.1 * DRUM_RADIUS
    lines = ["spheres", "", f"{len(spheres)} atoms", "2 atom types", ""]
    lines += [f"{-half} {half} {x}lo {x}hi" for x in "xyz"]
    lines += ["", "Atoms", ""]
    lines += [f"{i + 1} 1 {2 * RADIUS} {DENSITY} {' '.join(s[:3])}" for i, s in enumerate(spheres)]
    lines += ["", "Velocities", ""]
    lines += [f"{i + 1} {' '.join(s[3:9])}" for i, s in enumerate(spheres)]
    path.write_text("\n".join(lines) + "\n")


def run_ours(args, triangles, state):
    out = subprocess.run([args.bulk, "drum", str(triangles), str(args.steps), str(args.runs), str(args.warm), str(state)],
                         capture_output=True, text=True, check=True, env=dict(os.environ, OMP_NUM_THREADS="1")).stdout
    median, best = re.search(r"median (\S+), best (\S+)", out).groups()
    pairs, walls, residual = re.search(r"(\d+) contacts among spheres, (\d+) with walls.*residual\s+(\S+),", out,
                                       re.DOTALL).groups()
    return [f"{triangles}", "Abradem, wear and shape", median, best, f"{pairs} contacts, {walls} with walls, ledger {residual}"]


def run_liggghts(args, triangles, state):
    name = [f"{triangles}", "LIGGGHTS, wear"]
    program = find("liggghts")
    if program is None:
        return name + ["not installed", "", ""]
    spheres = [line.split(",") for line in state.read_text().splitlines()]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        write_shell(folder / "shell.stl", triangles)
        write_state(folder / "state.data", spheres)
        deck = DECK.format(skin=SKIN, young=YOUNG, steel_young=STEEL_YOUNG, nu=POISSON, steel_nu=STEEL_POISSON,
                           e=RESTITUTION, mu=FRICTION, step=STEP, low=-0.5 * DRUM_LENGTH, high=0.5 * DRUM_LENGTH)
        (folder / "in").write_text(deck + f"run {args.steps}\n" * args.runs)
        # Line by line, or what it says before it aborts is lost.
        done = subprocess.run(["stdbuf", "-oL", program, "-in", "in"], cwd=folder, capture_output=True, text=True,
                              env=dict(os.environ, OMP_NUM_THREADS="1"))
    loops = [float(t) for t in re.findall(r"Loop time of ([0-9.e+-]+)", done.stdout)][-args.runs:]
    if done.returncode != 0 or len(loops) < args.runs:
        said = (done.stdout + done.stderr).strip().splitlines()
        return name + ["stopped: " + next((line for line in said if "ERROR" in line), said[-1]), "", ""]
    work = len(spheres) * args.steps
    contacts = re.findall(r"^\s*\d+\s+(\d+)\s+(\S+)\s+(\S+)\s*$", done.stdout, re.MULTILINE)[0]
    return name + [f"{work / statistics.median(loops):.3g}", f"{work / min(loops):.3g}",
                   f"{float(contacts[2]) / 2:.0f} contacts"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bulk", default="build/bench/bench/abradem_bulk")
    parser.add_argument("--triangles", type=int, nargs="+", default=[5000, 50000])
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--warm", type=int, default=12000)
    args = parser.parse_args()
    rows = [["triangles", "code", "median, particle-steps/s", "best", "at the start"]]
    with tempfile.TemporaryDirectory() as folder:
        state = pathlib.Path(folder) / "state.csv"
        for triangles in args.triangles:
            rows.append(run_ours(args, triangles, state))
            rows.append(run_liggghts(args, triangles, state))
    print(f"drum, 1 core, {args.runs} runs of {args.steps} steps of {STEP:.4g} s, wall time")
    print_table(rows)


if __name__ == "__main__":
    main()
