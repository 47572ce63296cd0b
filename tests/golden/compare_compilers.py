#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds what a run needs with g++ and clang at -O0 and -O2, and compares the hashes of short runs.

    compare_compilers.py [FOLDER]    keeps the builds in FOLDER; exit code 1 where hashes differ
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("core", "geometry", "material", "contact", "wear", "simulation")
# cmake/compiler.cmake
OPTIONS = ["-std=c++20", "-w", "-fopenmp", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-Isrc",
           "-Itests"]
LAUNCHER = ["ccache"] if shutil.which("ccache") else []


def hashes(compiler, level, folder):
    sources = [p for room in ROOMS for p in sorted((ROOT / "src/abradem" / room).glob("*.cpp"))]
    sources.append(ROOT / "tests/golden/state_hashes.cpp")
    folder.mkdir(parents=True, exist_ok=True)
    # Function multiversioning of clang 16 does not start without optimisation.
    options = [*OPTIONS, "-DABRADEM_NO_DISPATCH"] if level == "-O0" else OPTIONS

    def compile_one(source):
        made = folder / f"{source.parent.name}-{source.stem}.o"
        subprocess.run([*LAUNCHER, compiler, *options, level, "-c", source.relative_to(ROOT), "-o", made], cwd=ROOT,
                       check=True)
        return made

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        objects = list(pool.map(compile_one, sources))
    program = folder / "state_hashes"
    subprocess.run([compiler, "-fopenmp", *objects, "-lfmt", "-o", program], check=True)
    return subprocess.run([program], check=True, capture_output=True, text=True).stdout


def main():
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else scratch).resolve()
        found = {(c, o): hashes(c, o, folder / (c + o)) for c in ("g++", "clang++-16") for o in ("-O0", "-O2")}
    first = next(iter(found.values()))
    print(first, end="")
    for build, text in found.items():
        other = [line for line, mine in zip(text.splitlines(), first.splitlines()) if line != mine]
        print(" ".join(build), "the same" if text == first else "differs:\n  " + "\n  ".join(other))
    sys.exit(any(text != first for text in found.values()))


if __name__ == "__main__":
    main()
