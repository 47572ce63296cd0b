#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A long run with everything in it: balls slide and collide in a tray that shakes and wears.

    soak.py PROGRAM [SECONDS]    about so long (default 20), half of it for each of two runs of the same case

The first run goes through; its memory is looked at all the time and must stay flat. The second is stopped again and
again (Ctrl-C, SIGTERM, SIGKILL in turn, on another number of threads each time) and taken up again from its
checkpoint. Both must end complete, with a ledger that closes, something worn, and the same bits in every table, frame
and in the state.
"""
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

CASE = """schema = 1
title = "Soak"
[material.ore]
density = "4850 kg/m^3"
shear_modulus = "0.1 GPa"
poisson_ratio = 0.24
[material.steel]
density = "7932 kg/m^3"
shear_modulus = "78 GPa"
poisson_ratio = 0.3
[contact."ore/steel"]
restitution = 0.5
static_friction = 0.4
rolling_friction = 0.05
[contact."ore/ore"]
restitution = 0.5
static_friction = 0.4
[wear."ore/steel"]
wear_coefficient = "5e-11 1/Pa"
[wall.tray]
material = "steel"
mesh = {{ file = "tray.obj", unit = "mm" }}
motion = {{ kind = "oscillation", amplitude = ["2 mm", "1.5 mm", 0], frequency = "12 Hz" }}
deformation = "conserving"
[run]
end = "{end:.9g} s"
gravity = [0, 0, "-9.81 m/s^2"]
[output]
every = "{every:.9g} s"
contours = 16
frames = "ends"
checkpoint_every = "{checkpoint:.3g} s"
"""
BALL = """[particle.ball{number}]
material = "ore"
radius = "2 mm"
position = ["{x} mm", "{y} mm", "2.1 mm"]
velocity = ["{u} m/s", "{v} m/s", 0]
"""
OUTPUTS = 50


def tray(half=8.0, height=4.0, edge=0.5):
    """An open box as OBJ, its triangles facing inwards."""
    lines, count = [], 0

    def patch(origin, u, v, n, m):
        nonlocal count
        for i in range(n + 1):
            for j in range(m + 1):
                lines.append("v " + " ".join(f"{o + a * i / n + b * j / m:.9g}" for o, a, b in zip(origin, u, v)))
        for i in range(n):
            for j in range(m):
                a = count + i * (m + 1) + j + 1
                b, c, d = a + m + 1, a + m + 2, a + 1
                lines.extend((f"f {a} {b} {c}", f"f {a} {c} {d}"))
        count += (n + 1) * (m + 1)

    n, m, w = int(2 * half / edge), int(height / edge), 2 * half
    patch((-half, -half, 0), (w, 0, 0), (0, w, 0), n, n)
    patch((-half, -half, 0), (0, w, 0), (0, 0, height), n, m)
    patch((half, -half, 0), (0, 0, height), (0, w, 0), m, n)
    patch((-half, -half, 0), (0, 0, height), (w, 0, 0), m, n)
    patch((-half, half, 0), (w, 0, 0), (0, 0, height), n, m)
    return "\n".join(lines) + "\n"


def write_case(folder, end, checkpoint):
    balls = "".join(BALL.format(number=k, x=5 * (k % 3) - 5, y=5 * (k // 3) - 2.5, u=0.2 - 0.1 * k, v=0.05 * k)
                    for k in range(6))
    text = CASE.format(end=end, every=end / OUTPUTS, checkpoint=checkpoint)
    (folder / "case.toml").write_text(text.replace("[run]\n", balls + "[run]\n"))
    (folder / "tray.obj").write_text(tray())


def manifest(folder):
    return json.loads((folder / "run.json").read_text())


def start(program, folder, *arguments):
    return subprocess.Popen([program, *arguments, "--quiet", "--no-report"], cwd=folder, stderr=subprocess.PIPE,
                            text=True)


def resident(process):
    """Memory of a process in kB; 0 when it is gone."""
    try:
        for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
            if line.startswith("VmRSS:"):
                return int(line.split()[1])
    except (FileNotFoundError, ProcessLookupError):
        pass
    return 0


def finish(process, what):
    said = process.stderr.read()
    if process.wait() != 0:
        sys.exit(f"{what}: exit code {process.returncode}\n{said}")


def run_through(program, folder):
    """@return memory, looked at some hundred times [kB]"""
    process, memory = start(program, folder, "run", "case.toml", "-o", "whole", "--threads", "1"), []
    while process.poll() is None:
        if (now := resident(process)) > 0:
            memory.append(now)
        time.sleep(0.05)
    finish(process, "the run that goes through")
    return memory


def run_in_pieces(program, folder, seconds):
    """@return how often it was stopped"""
    stops, chance = 0, random.Random(1)
    arguments = ["run", "case.toml", "-o", "cut"]
    while True:
        process = start(program, folder, *arguments, "--threads", str(1 + stops % 2))
        try:
            process.wait(timeout=chance.uniform(0.3, 0.4 * seconds / 2 + 0.3))
        except subprocess.TimeoutExpired:
            process.send_signal((signal.SIGINT, signal.SIGTERM, signal.SIGKILL)[stops % 3])
            process.wait()
            stops += 1
            if (folder / "cut" / "case.resolved.toml").exists():
                arguments = ["resume", "cut"]
            else:
                arguments = ["run", "case.toml", "-o", "cut", "--force"]
            continue
        finish(process, "the run in pieces")
        return stops


def differences(one, other):
    names = sorted(p.relative_to(one) for part in ("tables", "vtk") for p in (one / part).iterdir())
    return [str(n) for n in names if (one / n).read_bytes() != (other / n).read_bytes()]


def main():
    program, seconds = os.path.abspath(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) > 2 else 20.0
    problems = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        trial = 0.05  # [s] of the case, to learn how fast it goes here
        write_case(folder, trial, 1)
        begun = time.monotonic()
        finish(start(program, folder, "run", "case.toml", "-o", "trial"), "the trial")
        end = trial * (0.5 * seconds) / (time.monotonic() - begun)
        write_case(folder, end, max(0.5, seconds / 60))
        memory = run_through(program, folder)
        stops = run_in_pieces(program, folder, seconds)
        whole, cut = manifest(folder / "whole"), manifest(folder / "cut")
        for name, run in (("whole", whole), ("cut", cut)):
            if run["status"] != "completed":
                problems.append(f"{name}: {run['status']}")
            if not abs(run["ledger"]["residual_relative"]) < 1e-9 or not run["ledger"]["law_volume_mm3"] > 0:
                problems.append(f"{name}: the ledger is {run['ledger']}")
        if whole["state_hash"] != cut["state_hash"] or whole["ledger"] != cut["ledger"]:
            problems.append(f"hashes {whole['state_hash']} and {cut['state_hash']}")
        problems += [f"{name} differs" for name in differences(folder / "whole", folder / "cut")]
        # What is there at the start (mesh, first lists) is there after a fifth of the run; a megabyte is its noise.
        early, late = max(memory[:max(1, len(memory) // 5)]), max(memory)
        if late > early + 1024:
            problems.append(f"memory grew from {early} kB to {late} kB")
        if stops == 0:
            problems.append("it was never stopped")
        print(f"{whole['steps']} steps, {end:.3g} s of the case, {stops} stops, memory {early} to {late} kB, "
              f"worn {whole['ledger']['law_volume_mm3']:.4g} mm^3, residual "
              f"{whole['ledger']['residual_relative']:.2g}, hash {whole['state_hash']}")
    print("\n".join(problems))
    sys.exit(bool(problems))


if __name__ == "__main__":
    main()
