#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Enforces the order of the rooms (docs/architecture.md).

    check_rooms.py SOURCE_DIR     checks src/abradem; prints every breach, exit code 1 if there is one
    check_rooms.py --self-test    checks the checker on small trees with one breach each

The rules: a room includes only itself and the rooms before it; every include of ours is written
"abradem/<room>/<file>.h" and exists; no file includes itself through others; the heavy headers stay out of
headers; every file of ours states its licence.
"""
import pathlib
import re
import sys
import tempfile

ROOMS = ["core", "geometry", "material", "contact", "wear", "simulation", "analysis", "study", "io", "report",
         "cli"]
HEAVY = ("toml++/", "CLI/", "nlohmann/", "boost/", "Eigen/", "muParser")  # seconds of compile time each
LICENCE = "// SPDX-License-Identifier: BSD-3-Clause"
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def includes(path):
    """(quote, name) of every include line of a file."""
    return INCLUDE.findall(path.read_text(encoding="utf-8"))


def check_file(path, library):
    """Breaches in one file, as lines of text."""
    relative = path.relative_to(library)
    where = f"abradem/{relative}"
    if len(relative.parts) != 2 or relative.parts[0] not in ROOMS:
        return [f"{where}: not in a room; rooms are {', '.join(ROOMS)}"]
    room = relative.parts[0]
    breaches = []
    if not path.read_text(encoding="utf-8").startswith(LICENCE):
        breaches.append(f"{where}: the first line must be '{LICENCE}'")
    for quote, name in includes(path):
        if name.startswith("abradem/"):
            other = name.split("/")[1]
            if other not in ROOMS:
                breaches.append(f"{where}: includes {name}: there is no room '{other}'")
            elif ROOMS.index(other) > ROOMS.index(room):
                breaches.append(f"{where}: includes {name}: '{room}' must not know '{other}', a room to its right")
            elif not (library.parent / name).is_file():
                breaches.append(f"{where}: includes {name}, which does not exist")
        elif quote == '"':
            breaches.append(f'{where}: includes "{name}": write "abradem/<room>/<file>.h"')
        elif path.suffix == ".h" and name.startswith(HEAVY):
            breaches.append(f"{where}: includes <{name}>, a heavy header; only a .cpp may")
    return breaches


def find_cycles(files, library):
    """Cycles among files (a header that reaches itself), each named once."""
    names = {f"abradem/{path.relative_to(library)}": path for path in files}
    edges = {name: [n for _, n in includes(path) if n in names] for name, path in names.items()}
    cycles, state = [], dict.fromkeys(names, "new")

    def visit(name, trail):
        state[name] = "open"
        for other in edges[name]:
            if state[other] == "open":
                trail_to_other = trail[trail.index(other):]
                cycles.append("cycle: " + " -> ".join(trail_to_other + [other]))
            elif state[other] == "new":
                visit(other, trail + [other])
        state[name] = "done"

    for name in sorted(names):
        if state[name] == "new":
            visit(name, [name])
    return cycles


def check(source_dir):
    library = pathlib.Path(source_dir) / "src" / "abradem"
    files = sorted(path for path in library.rglob("*") if path.suffix in (".h", ".cpp"))
    breaches = [breach for path in files for breach in check_file(path, library)]
    breaches += find_cycles(files, library)
    listed = re.search(r"set\(ABRADEM_ROOMS ([^)]*)\)", (library / "CMakeLists.txt").read_text(encoding="utf-8"))
    if listed is None or listed.group(1).split() != ROOMS[:-1]:
        breaches.append("src/abradem/CMakeLists.txt: ABRADEM_ROOMS is not the order of rooms of this check")
    return len(files), breaches


def self_test():
    """Each tree has exactly one breach (or none), named by a word that the message must hold."""
    ok = LICENCE + "\n"
    cases = [
        ({"core/a.h": ok, "io/b.cpp": ok + '#include "abradem/core/a.h"\n#include <toml++/toml.h>\n'}, None),
        ({"core/a.h": ok + '#include "abradem/io/b.h"\n', "io/b.h": ok}, "a room to its right"),
        ({"contact/a.cpp": ok + ' #  include "abradem/wear/b.h"\n', "wear/b.h": ok}, "a room to its right"),
        ({"core/a.h": ok + '#include "b.h"\n', "core/b.h": ok}, "write "),
        ({"core/a.h": ok + '#include "abradem/core/none.h"\n'}, "does not exist"),
        ({"io/a.h": ok + "#include <nlohmann/json.hpp>\n"}, "heavy header"),
        ({"core/a.h": "#pragma once\n"}, "first line"),
        ({"a.h": ok}, "not in a room"),
        ({"misc/a.h": ok}, "not in a room"),
        ({"core/a.h": ok + '#include "abradem/core/b.h"\n',
          "core/b.h": ok + '#include "abradem/core/c.h"\n',
          "core/c.h": ok + '#include "abradem/core/a.h"\n'}, "cycle"),
    ]
    failures = 0
    for number, (tree, expected) in enumerate(cases):
        with tempfile.TemporaryDirectory() as folder:
            library = pathlib.Path(folder) / "src" / "abradem"
            for name, text in tree.items():
                path = library / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            (library / "CMakeLists.txt").write_text(f"set(ABRADEM_ROOMS {' '.join(ROOMS[:-1])})\n")
            _, breaches = check(folder)
        right = not breaches if expected is None else len(breaches) == 1 and expected in breaches[0]
        if not right:
            failures += 1
            print(f"self-test {number}: expected {expected!r}, got {breaches}")
    print(f"{len(cases) - failures} of {len(cases)} trees judged rightly")
    return 1 if failures else 0


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    if sys.argv[1] == "--self-test":
        return self_test()
    count, breaches = check(sys.argv[1])
    for breach in breaches:
        print(breach)
    print(f"{count} files, {len(breaches)} breach(es)")
    return 1 if breaches or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
