#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Times whole pin-on-disc runs with the program and prints medians. What is run: bench/README.md.

    bench/pin_on_disc.py [--repeat N] [--threads N] [--program PATH] [--rev R] [CASE …]

CASE: small, large, quasi_static (default: all). Nothing else should run on the machine meanwhile.
"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The mesh is 0.1 mm everywhere and the contact the same (5 N at 22 mm); only the ring around it grows.
CASES = {
    "small": {"run.end": "1 rev"},
    "large": {"run.end": "1 rev", "wall.disc.mesh.inner": "2 mm", "wall.disc.mesh.outer": "57.5 mm"},
    "quasi_static": {"run.end": "12 rev", "run.method": "quasi_static"},
}
# What the median shall reach: (name of the goal, does (steps, steps/s) reach it?).
GOALS = {
    "small": ("500,000 steps/s", lambda steps, speed: speed >= 500e3),
    "quasi_static": ("stepping in 0.2 s", lambda steps, speed: steps / speed <= 0.2),
}


def run(options, case, folder):
    """One run; returns its manifest and the number of triangles."""
    settings = dict(CASES[case])
    if options.rev:
        settings["run.end"] = f"{options.rev} rev"
        settings["output.every"] = f"{options.rev} rev"
    command = [options.program, "run", ROOT / "cases" / "pin-on-disc.toml", "-o", folder, "--force", "--quiet",
               "--threads", options.threads]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    result = subprocess.run([str(part) for part in command], stderr=subprocess.PIPE, text=True)
    if result.returncode != 0:
        sys.exit(f"{case}: exit code {result.returncode}\n{result.stderr}")
    manifest = json.loads((folder / "run.json").read_text(encoding="utf-8"))
    log = (folder / "run.log").read_text(encoding="utf-8")
    return manifest, int(log.split(" triangles,")[0].split()[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--repeat", type=int, default=5, help="runs of each case (default 5)")
    parser.add_argument("--threads", type=int, default=1, help="threads of each run (default 1)")
    parser.add_argument("--program", default=str(ROOT / "abradem"), help="default: the launcher of this tree")
    parser.add_argument("--rev", type=float, help="revolutions instead of the case's own, to try the script")
    parser.add_argument("case", nargs="*", help="small, large, quasi_static (default: all)")
    options = parser.parse_args()
    if unknown := [case for case in options.case if case not in CASES]:
        parser.error(f"unknown case {', '.join(unknown)}; known are {', '.join(CASES)}")
    medians = {}
    print(f"{'case':<14}{'triangles':>11}{'steps':>9}{'steps/s':>11}{'lowest':>11}{'highest':>11}"
          f"{'stepping s':>12}{'whole s':>9}  state")
    with tempfile.TemporaryDirectory() as scratch:
        for case in options.case or CASES:
            runs = [run(options, case, pathlib.Path(scratch) / case) for _ in range(options.repeat)]
            speeds = [manifest["steps_per_second"] for manifest, _ in runs]
            hashes = {manifest["state_hash"] for manifest, _ in runs}
            if len(hashes) != 1:
                sys.exit(f"{case}: the runs differ: {hashes}")
            medians[case] = statistics.median(speeds)
            steps = runs[0][0]["steps"]
            whole = statistics.median(manifest["wall_seconds"] for manifest, _ in runs)
            print(f"{case:<14}{runs[0][1]:>11}{steps:>9}{medians[case]:>11.0f}{min(speeds):>11.0f}"
                  f"{max(speeds):>11.0f}{steps / medians[case]:>12.3f}{whole:>9.3f}  {hashes.pop()}", flush=True)
            if case in GOALS and not options.rev:
                goal, reached = GOALS[case]
                print(f"{'':<14}goal: {goal}: {'reached' if reached(steps, medians[case]) else 'missed'}", flush=True)
    if "small" in medians and "large" in medians:
        print(f"large / small: {medians['large'] / medians['small']:.3f} of the speed")


if __name__ == "__main__":
    main()
