#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Tests ./abradem with stand-ins for apt-get, dpkg-query, id, sudo and cmake: no network, no build.

    check_launcher.py SOURCE_DIR
"""
import os
import pathlib
import pty
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else pathlib.Path.cwd()
REAL_TOOLS = ["awk", "bash", "cat", "chmod", "date", "dirname", "env", "find", "flock", "grep", "mkdir", "mktemp",
              "mv", "nproc", "readlink", "rm", "sed", "sh", "sleep", "sort", "tail", "touch", "tr"]
ALL = ["g++", "cmake", "ninja-build", "libfmt-dev", "libboost-dev", "libeigen3-dev", "nlohmann-json3-dev",
       "libmuparser-dev", "zlib1g-dev", "libtomlplusplus-dev", "libcli11-dev"]
# "Builds" a program that prints its folder and its arguments, and returns 7 when the first is `fail`.
CMAKE = r"""
printf 'cmake %s\n' "$*" >>"$LOG"
if [[ $1 == --build ]]; then
  if [[ -e $SCRATCH/break ]]; then echo 'x.cpp:1:2: error: broken on purpose'; exit 1; fi
  sleep "${BUILD_SECONDS:-0}"
  mkdir -p "$2/src/abradem"
  printf '%s\n' '#!/bin/bash' 'printf "%s|" "$PWD" "$@"' '[[ ${1:-} != fail ]] || exit 7' >"$2/src/abradem/abradem"
  chmod +x "$2/src/abradem/abradem"
fi
"""


class Launcher(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        scratch = pathlib.Path(self.folder.name).resolve()
        self.scratch, self.log = scratch, scratch / "calls"
        self.log.touch()
        self.tree = scratch / "a checkout"  # with a space
        for name in ("abradem", "packaging/launch.sh", "packaging/debian-deps.txt", "CMakeLists.txt",
                     "CMakePresets.json"):
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(SOURCE / name, self.tree / name)
        (self.tree / "src").mkdir()
        self.source = self.tree / "src" / "a.cpp"
        self.source.touch()
        self.cwd = scratch / "elsewhere"
        self.cwd.mkdir()
        self.tools = scratch / "tools"
        self.tools.mkdir()
        for name in REAL_TOOLS:
            (self.tools / name).symlink_to(shutil.which(name))
        self.tool("git", "exit 128")
        self.tool("id", "echo 0")
        self.tool("apt-get", 'printf "apt-get %s\\n" "$*" >>"$LOG"')
        self.tool("sudo", 'printf "sudo " >>"$LOG"; exec "$@"')
        self.tool("cmake", CMAKE)
        self.installed(ALL)

    def tearDown(self):
        self.folder.cleanup()

    def tool(self, name, script):
        path = self.tools / name
        path.write_text("#!/bin/bash\n" + script + "\n")
        path.chmod(0o755)

    def installed(self, packages):
        known = "|".join(packages) or "-"
        self.tool("dpkg-query", f'code=0; for p in "${{@:3}}"; do case $p in {known}) echo "ii  $p";; '
                                '*) code=1;; esac; done; exit $code')

    def environment(self, **more):
        return {"PATH": str(self.tools), "LOG": str(self.log), "SCRATCH": str(self.scratch), "LC_ALL": "C", **more}

    def start(self, *arguments, **more):
        return subprocess.run([self.tree / "abradem", *arguments], cwd=self.cwd, env=self.environment(**more),
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60)

    def calls(self, name):
        return [line for line in self.log.read_text().splitlines() if name in line]

    def test_runs_the_program_with_the_same_arguments_where_the_user_stands(self):
        result = self.start("run", "my case.toml", "--set", "a=1 rev")
        self.assertEqual(result.stdout, f"{self.cwd}|run|my case.toml|--set|a=1 rev|", result.stderr)
        self.assertEqual(result.returncode, 0)

    def test_returns_what_the_program_returns(self):
        self.assertEqual(self.start("fail").returncode, 7)

    def test_nothing_missing_means_no_apt_call(self):
        self.start()
        self.assertEqual(self.calls("apt-get"), [])

    def test_root_installs_only_what_is_missing(self):
        self.installed([p for p in ALL if p not in ("libfmt-dev", "cmake")])
        result = self.start()
        self.assertEqual(result.returncode, 0, result.stderr)
        update, install = self.calls("apt-get")
        self.assertIn(" update", update)
        self.assertIn("--no-install-recommends cmake libfmt-dev", install)
        self.assertNotIn("sudo", update + install)

    def test_an_alternative_counts_as_installed(self):
        self.installed([p for p in ALL if p != "libboost-dev"] + ["libboost1.74-dev"])
        self.start()
        self.assertEqual(self.calls("apt-get"), [])

    def test_a_failed_installation_is_told(self):
        self.installed([])
        self.tool("apt-get", "echo 'E: no network'; exit 100")
        result = self.start()
        self.assertEqual(result.returncode, 5)
        self.assertIn("E: no network", result.stderr)
        self.assertEqual(self.calls("cmake"), [])

    def test_others_without_a_terminal_are_told_what_to_run(self):
        self.tool("id", "echo 1000")
        self.installed([p for p in ALL if p != "cmake"])
        result = self.start()
        self.assertEqual(result.returncode, 2)
        self.assertIn("sudo apt-get install --no-install-recommends cmake", result.stderr)
        self.assertEqual(self.log.read_text(), "")

    def answer(self, text):
        """Starts with a terminal as standard input and types text."""
        try:
            mine, theirs = pty.openpty()
        except OSError:
            self.skipTest("this machine has no terminals to give")
        os.write(mine, text.encode())
        result = subprocess.run([self.tree / "abradem", "run"], cwd=self.cwd, env=self.environment(), stdin=theirs,
                                capture_output=True, text=True, timeout=60)
        os.close(mine)
        os.close(theirs)
        return result

    def test_others_at_a_terminal_are_asked(self):
        self.tool("id", "echo 1000")
        self.installed([])
        self.assertEqual(self.answer("n\n").returncode, 2)
        self.assertEqual(self.log.read_text(), "")
        self.assertEqual(self.answer("\n").returncode, 0)
        self.assertEqual(len(self.calls("sudo apt-get")), 2)

    def test_other_systems_go_on_with_what_is_there(self):
        (self.tools / "dpkg-query").unlink()
        result = self.start("run")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("libtomlplusplus-dev", result.stderr)
        self.assertEqual(self.calls("apt-get"), [])

    def test_builds_only_when_something_changed(self):
        self.start()
        built = len(self.calls("cmake"))
        again = self.start()
        self.assertEqual(len(self.calls("cmake")), built)
        self.assertEqual(again.stderr, "")
        time.sleep(0.02)  # file times are coarse
        self.source.touch()
        self.start()
        self.assertEqual(len(self.calls("cmake")), 2 * built)
        time.sleep(0.02)
        self.source.unlink()
        self.start()
        self.assertEqual(len(self.calls("cmake")), 3 * built)

    def test_a_failed_build_shows_its_error_and_is_tried_again(self):
        (self.scratch / "break").touch()
        result = self.start()
        self.assertEqual(result.returncode, 1)
        self.assertIn("x.cpp:1:2: error: broken on purpose", result.stderr)
        self.assertEqual(result.stdout, "")
        (self.scratch / "break").unlink()
        self.assertEqual(self.start().returncode, 0)

    def test_two_at_once_build_once(self):
        both = [subprocess.Popen([self.tree / "abradem"], cwd=self.cwd, env=self.environment(BUILD_SECONDS="1"),
                                 stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                for _ in range(2)]
        for process in both:
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, 0)
        self.assertEqual(len(self.calls("cmake --build")), 1)

    def test_a_moved_checkout_is_configured_anew(self):
        self.start()
        cache = self.tree / "build" / "release" / "CMakeCache.txt"
        cache.write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/somewhere/else\n")
        self.source.touch()
        self.start()
        self.assertFalse(cache.exists())

    def test_a_link_to_the_launcher_works(self):
        link = self.cwd / "abradem"
        link.symlink_to(self.tree / "abradem")
        result = subprocess.run([link, "check"], cwd=self.cwd, env=self.environment(), stdin=subprocess.DEVNULL,
                                capture_output=True, text=True, timeout=60)
        self.assertEqual(result.stdout, f"{self.cwd}|check|", result.stderr)


if __name__ == "__main__":
    unittest.main()
