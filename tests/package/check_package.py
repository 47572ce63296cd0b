#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Installs the build somewhere else and uses it as a stranger would.

    check_package.py consumer BUILD_DIR   install, then find_package(abradem) from tests/package/consumer and examples
    check_package.py deb BUILD_DIR        pack a .deb, check its fields and its list of files
"""
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def run(*command, cwd=None):
    """Runs a command; returns what it printed; a failure shows it and ends the test."""
    result = subprocess.run([str(part) for part in command], cwd=cwd, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT)
    if result.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\n{result.stdout}\nexit code {result.returncode}")
    return result.stdout


def check_consumer(build, scratch):
    prefix = scratch / "prefix with a space"
    run("cmake", "--install", build, "--prefix", prefix)
    run("cmake", "-S", HERE / "consumer", "-B", scratch / "consumer", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", scratch / "consumer")
    print(run(scratch / "consumer" / "consumer"), end="")
    run("cmake", "-S", HERE.parent.parent / "examples", "-B", scratch / "examples", "-G", "Ninja",
        "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={prefix}")
    run("cmake", "--build", scratch / "examples")
    print(run("ctest", "--test-dir", scratch / "examples", "--output-on-failure", "--no-tests=error"), end="")
    program = prefix / "bin" / "abradem"
    if has_program(build):
        print(run(program, "--version"), end="")
    # What is installed must not point back into the source or the build.
    for path in prefix.rglob("*.cmake"):
        text = path.read_text(encoding="utf-8")
        for folder in (build, HERE.parent.parent):
            if str(folder) in text:
                sys.exit(f"{path} names {folder}")


def check_deb(build, scratch):
    run("cpack", "-G", "DEB", "-B", scratch, cwd=build)
    packages = sorted(scratch.glob("*.deb"))
    if len(packages) != 1:
        sys.exit(f"expected one .deb, got {packages}")
    package = packages[0]
    fields = {name: run("dpkg-deb", "--field", package, name).strip()
              for name in ("Package", "Version", "Depends", "Recommends", "Architecture")}
    print(fields)
    contents = {line.split()[5].removeprefix("./") for line in run("dpkg-deb", "--contents", package).splitlines()}
    machine = run("dpkg", "--print-architecture").strip()
    wanted = [r"usr/lib/(.*/)?libabradem\.a", r"usr/include/abradem/core/version\.h",
              r"usr/include/abradem/simulation/setup\.h", r"usr/lib/(.*/)?cmake/abradem/abradem-config\.cmake",
              r"usr/lib/(.*/)?cmake/abradem/abradem-targets\.cmake", r"usr/share/doc/abradem/copyright"]
    if has_program(build):
        wanted.append(r"usr/bin/abradem")
    problems = [f"missing: {pattern}" for pattern in wanted
                if not any(re.fullmatch(pattern, name) for name in contents)]
    problems += [f"not wanted: {name}" for name in sorted(contents)
                 if not re.fullmatch(r"|usr/(bin|lib|include|share)?(/.*)?", name) or re.search(r"\.cpp$|/cli/", name)]
    if fields["Package"] != "abradem" or fields["Architecture"] != machine:
        problems.append(f"fields: {fields}")
    if has_program(build):
        problems += [f"Depends lacks {library}: {fields['Depends']}" for library in ("libc6", "libstdc++6", "libfmt", "libmuparser")
                     if library not in fields["Depends"]]
    if problems:
        sys.exit("\n".join(problems))
    print(f"{package.name}: {len(contents)} entries")


def has_program(build):
    return (build / "src" / "abradem" / "abradem").is_file()


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in ("consumer", "deb"):
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[2]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        {"consumer": check_consumer, "deb": check_deb}[sys.argv[1]](build, pathlib.Path(folder))


if __name__ == "__main__":
    main()
