#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""The settled box of bench/bulk.cpp, by LAMMPS, LIGGGHTS, Yade and Abradem: same spheres, law, step, skin and walls.

    abradem_bulk make 10000 box.csv
    bench/peers/bulk/run.py box.csv --bulk build/bench/bench/abradem_bulk [--steps 200] [--runs 5] [--threads 1]

A code that is not installed gets a row that says so (Debian: lammps, liggghts, yade). All start from the positions of
box.csv at rest, take 200 steps, and are then timed for --steps, --runs times. The contacts and the elastic energy
that Abradem counts in the positions each code has after the 200 steps tell whether they do the same work.
"""
import argparse
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile

RADIUS, DENSITY, SHEAR, POISSON, RESTITUTION, FRICTION = 3e-3, 2500.0, 1e8, 0.25, 0.5, 0.5
YOUNG = 2 * SHEAR * (1 + POISSON)
STEP = 0.2 * math.pi * RADIUS * math.sqrt(DENSITY / SHEAR) / (0.1631 * POISSON + 0.8766)
SKIN = 0.1 * 2 * RADIUS


def data_file(path, side, points):
    top = max(p[2] for p in points) + 10 * RADIUS
    lines = ["spheres", "", f"{len(points)} atoms", "1 atom types", "", f"0 {side} xlo xhi", f"0 {side} ylo yhi",
             f"0 {top} zlo zhi", "", "Atoms", ""]
    lines += [f"{i + 1} 1 {2 * RADIUS} {DENSITY} {x} {y} {z}" for i, (x, y, z) in enumerate(points)]
    path.write_text("\n".join(lines) + "\n")


COMMON = """units si
boundary f f f
newton off
comm_modify mode single vel yes
read_data {data}
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes
"""

LAWS = {
    "LAMMPS gran/hertz/history": ("lmp", "atom_style sphere", """
pair_style gran/hertz/history {kn} {kt} {gamma} NULL {mu} 1
pair_coeff * *
fix x all wall/gran hertz/history {kn} {kt} {gamma} NULL {mu} 1 xplane 0 {side}
fix y all wall/gran hertz/history {kn} {kt} {gamma} NULL {mu} 1 yplane 0 {side}
fix z all wall/gran hertz/history {kn} {kt} {gamma} NULL {mu} 1 zplane 0 NULL
"""),
    "LAMMPS granular, the same law": ("lmp", "atom_style sphere", """
pair_style granular
pair_coeff * * hertz/material {young} {e} {nu} tangential mindlin NULL 1.0 {mu} damping tsuji
fix x all wall/gran granular hertz/material {young} {e} {nu} tangential mindlin NULL 1.0 {mu} damping tsuji xplane 0 {side}
fix y all wall/gran granular hertz/material {young} {e} {nu} tangential mindlin NULL 1.0 {mu} damping tsuji yplane 0 {side}
fix z all wall/gran granular hertz/material {young} {e} {nu} tangential mindlin NULL 1.0 {mu} damping tsuji zplane 0 NULL
"""),
    "LIGGGHTS hertz, tangential history": ("liggghts", "atom_style granular", """
fix p1 all property/global youngsModulus peratomtype {young}
fix p2 all property/global poissonsRatio peratomtype {nu}
fix p3 all property/global coefficientRestitution peratomtypepair 1 {e}
fix p4 all property/global coefficientFriction peratomtypepair 1 {mu}
pair_style gran model hertz tangential history
pair_coeff * *
fix x0 all wall/gran model hertz tangential history primitive type 1 xplane 0
fix x1 all wall/gran model hertz tangential history primitive type 1 xplane {side}
fix y0 all wall/gran model hertz tangential history primitive type 1 yplane 0
fix y1 all wall/gran model hertz tangential history primitive type 1 yplane {side}
fix z0 all wall/gran model hertz tangential history primitive type 1 zplane 0
"""),
}


def find(program):
    for name in {"lmp": ("lmp", "lmp_stable", "lammps"), "liggghts": ("liggghts",)}[program]:
        if shutil.which(name):
            return name
    return None


def deck(name, side, data, steps, runs):
    program, style, law = LAWS[name]
    g_eff = SHEAR / (2 * (2 - POISSON))
    e_eff = YOUNG / (2 * (1 - POISSON**2))
    text = style + "\n" + COMMON.format(data=data, skin=SKIN) + law.format(
        # gran/hertz/history: F = kn sqrt(R_eff) delta^(3/2), S_t = kt a; its damping is another law, of a like size.
        kn=4 / 3 * e_eff, kt=8 * g_eff, gamma=2e6, mu=FRICTION, side=side, young=YOUNG, nu=POISSON, e=RESTITUTION)
    text += f"""
fix g all gravity 9.81 vector 0 0 -1
fix n all nve/sphere
timestep {STEP}
thermo 1000000
run 200
write_dump all custom {data}.dump x y z modify format float %.17g
"""
    if program == "liggghts":
        text = text.replace("comm_modify mode single vel yes", "communicate single vel yes")
        text = re.sub(r"write_dump .*", f"dump d all custom 1 {data}.dump x y z\ndump_modify d format \"%.17g %.17g %.17g\"\nrun 0\nundump d", text)
    return text + f"run {steps}\n" * runs


def run_peer(name, side, points, args):
    program = find(LAWS[name][0])
    if program is None:
        return [name, "not installed", "", "", ""]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        data_file(folder / "box.data", side, points)
        (folder / "in").write_text(deck(name, side, "box.data", args.steps, args.runs))
        command = [program, "-in", "in", "-log", "log"] if program != "liggghts" else [program, "-in", "in"]
        if args.threads > 1:
            command = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-np", str(args.threads)] + command
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True,
                              env=dict(os.environ, OMP_NUM_THREADS="1"))
        loops = [float(t) for t in re.findall(r"Loop time of ([0-9.e+-]+)", done.stdout)][-args.runs:]
        if done.returncode != 0 or not loops:
            return [name, "failed: " + (done.stdout + done.stderr).strip().splitlines()[-1], "", "", ""]
        rows = (folder / "box.data.dump").read_text().splitlines()
        start = max(i for i, row in enumerate(rows) if row.startswith("ITEM: ATOMS")) + 1
        places = "\n".join(",".join(r.split()[:3]) for r in rows[start:] if r) + "\n"
        return table_row(name, side, places, len(points), loops, folder, args)


def table_row(name, side, places, spheres, loops, folder, args):
    after = folder / "after.csv"
    after.write_text(f"{side}\n{places}")
    contacts, energy = count(args, after)
    work = spheres * args.steps
    return [name, f"{work / statistics.median(loops):.3g}", f"{work / min(loops):.3g}", contacts, energy]


def run_yade(side, points, args):
    """As run_peer; a script instead of a deck."""
    name = "Yade Mindlin"
    if shutil.which("yade") is None:
        return [name, "not installed", "", "", ""]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        after = folder / "places"
        (folder / "task").write_text(json.dumps(dict(
            young=YOUNG, poisson=POISSON, density=DENSITY, friction=FRICTION, restitution=RESTITUTION, side=side,
            radius=RADIUS, points=points, skin=SKIN, step=STEP, steps=args.steps, runs=args.runs, after=str(after))))
        script = pathlib.Path(__file__).with_name("yade_box.py")
        done = subprocess.run(["yade", "-n", "-x", "-j", str(args.threads), str(script)], cwd=folder,
                              capture_output=True, text=True, env=dict(os.environ, BOX=str(folder / "task")))
        loops = [float(t) for t in re.findall(r"Loop time of ([0-9.e+-]+)", done.stdout)]
        if len(loops) != args.runs:
            return [name, "failed: " + (done.stdout + done.stderr).strip().splitlines()[-1], "", "", ""]
        return table_row(name, side, after.read_text(), len(points), loops, folder, args)


def count(args, path):
    out = subprocess.run([args.bulk, "count", str(path)], capture_output=True, text=True, check=True).stdout
    return re.search(r"(\d+) contacts.*energy (\S+) J", out).groups()


def run_ours(args):
    out = subprocess.run([args.bulk, "time", args.positions, str(args.steps), str(args.runs)], capture_output=True,
                         text=True, check=True, env=dict(os.environ, OMP_NUM_THREADS=str(args.threads))).stdout
    median, best = re.search(r"wall time: median (\S+), best ([^;]+);", out).groups()
    contacts, energy = re.search(r"start (\d+) contacts.*energy (\S+) J", out).groups()
    return ["Abradem", median, best, contacts, energy]


def print_table(rows):
    width = [max(map(len, column)) for column in zip(*rows)]
    for row in rows:
        print("  ".join(cell.ljust(w) for cell, w in zip(row, width)).rstrip())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("positions")
    parser.add_argument("--bulk", default="build/bench/bench/abradem_bulk")
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--threads", type=int, default=1)
    args = parser.parse_args()
    lines = pathlib.Path(args.positions).read_text().split()
    side, points = float(lines[0]), [tuple(map(float, line.split(","))) for line in lines[1:]]
    rows = [["code", "median, particle-steps/s", "best", "contacts", "elastic energy [J]"], run_ours(args)]
    rows += [run_peer(name, side, points, args) for name in LAWS]
    rows.append(run_yade(side, points, args))
    print(f"{len(points)} spheres, {args.threads} core(s), {args.runs} runs of {args.steps} steps of {STEP:.4g} s, wall time")
    print_table(rows)


if __name__ == "__main__":
    main()
