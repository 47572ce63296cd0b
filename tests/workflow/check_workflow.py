#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Carries out what `abradem sweep --export` writes, and compares its table with the sweep's own.

    check_workflow.py snakemake|slurm PROGRAM CASE    exit code 77 where snakemake is not installed

For Slurm, a stand-in named sbatch runs the script it is handed, once for every number of the array.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

# A value with a quote, blanks and a comma each, so that the quoting is put to the test; one run that fails.
SWEEP = ["--set", "run.method=dynamic", "--set", "wall.disc.mesh.inner=21 mm", "--set",
         "wall.disc.mesh.outer=23 mm", "--set", "wall.disc.mesh.size=0.5 mm", "--set", "run.end=0.02 rev",
         "--set", "output.every=0.01 rev", "--set", "output.contours=8", "--set", "title=it's {a}, a \"title\"",
         "--vary", "particle.pin.load=5 N,[0, 0, \"-6 N\"],50 kN",
         "--vary", "wear.\"iron_ore/mild_steel\".wear_coefficient=1e-11..2e-11 1/Pa:2"]

SBATCH = """#!/usr/bin/env python3
import os, re, subprocess, sys
script = sys.stdin.read()
array = next((a.split("=")[1] for a in sys.argv if a.startswith("--array=")), None)
depends = next((a for a in sys.argv if a.startswith("--dependency=")), None)
log = next(a.split("=", 1)[1] for a in sys.argv if a.startswith("--output="))
assert "--parsable" in sys.argv and (array is None) == (depends == "--dependency=afterany:4711"), sys.argv
first, last = map(int, array.split("-")) if array else (1, 1)
for task in range(last, first - 1, -1):  # an order is not promised
    environment = dict(os.environ)
    if array:
        environment["SLURM_ARRAY_TASK_ID"] = str(task)
    with open(log.replace("%a", str(task)), "w") as out:
        subprocess.run(["bash", "-c", script], env=environment, stdout=out, stderr=out, cwd="/")
print("4711;cluster")
"""


def run(command, folder, expected=0, **options):
    done = subprocess.run(command, cwd=folder, text=True, capture_output=True, check=False, **options)
    if done.returncode != expected:
        sys.exit(f"{command}: exit code {done.returncode}, expected {expected}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def carry_out(what, script, scratch):
    if what == "snakemake":
        environment = {**os.environ, "XDG_CACHE_HOME": str(scratch / "cache")}
        command = ["snakemake", "--snakefile", str(script), "--cores", "2", "--quiet"]
        run(command, scratch, env=environment)
        again = run([*command[:-1], "--dry-run"], scratch, env=environment)
        if "Nothing to be done" not in again:
            sys.exit(f"the workflow would do something again:\n{again}")
    else:
        run(["bash", "-n", str(script)], scratch)
        tools = scratch / "tools"
        tools.mkdir()
        (tools / "sbatch").write_text(SBATCH, encoding="utf-8")
        (tools / "sbatch").chmod(0o755)
        run(["bash", str(script)], scratch, env={**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"})


def main():
    what, program, case = sys.argv[1:]
    if what == "snakemake" and shutil.which("snakemake") is None:
        print("snakemake is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        scratch = pathlib.Path(folder) / "a folder"
        scratch.mkdir()
        failed = 4  # of the runs with 50 kN
        run([program, "sweep", case, *SWEEP, "-o", "direct", "--quiet"], scratch, expected=failed)
        script = scratch / "script"
        run([program, "sweep", case, *SWEEP, "-o", "exported", "--export", what, "--to", str(script)], scratch)
        if (scratch / "exported").exists():
            sys.exit("exporting alone made the folder")
        carry_out(what, script, scratch)
        direct, exported = (scratch / name / "summary.csv" for name in ("direct", "exported"))
        if not exported.is_file():
            logs = "\n".join(p.read_text() for p in scratch.glob("exported-logs/*"))
            sys.exit(f"no table was made\n{logs}")
        if direct.read_bytes() != exported.read_bytes():
            sys.exit(f"the tables differ:\n{direct.read_text()}\n{exported.read_text()}")
        rows = direct.read_text(encoding="utf-8").splitlines()
        if len(rows) != 7 or sum(",failed," in row for row in rows) != 2:
            sys.exit("the table does not have six runs, two of them failed:\n" + "\n".join(rows))
        print(f"{what}: {len(rows) - 1} runs, the same table byte for byte")
    return 0


if __name__ == "__main__":
    sys.exit(main())
