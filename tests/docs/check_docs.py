#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks what the documents claim and a script can know.

    check_docs.py SOURCE_DIR [PROGRAM]   prints every breach, exit code 1 if there is one
    check_docs.py --self-test            checks the checker on a small tree with one breach of each kind

The rules: every relative link of a Markdown file leads to a file or folder, and to a heading in it; every
docs/… page that the code points to exists, with the heading; the headings of the step in docs/architecture.md
are the functions that Simulation::step calls, in order; the two commands of the README exist and, with
PROGRAM given, the first of them passes --dry-run; the columns of wear.csv and the other tables are those that
docs/reference/output.md describes; every promise of docs/reliability.md names a test, and every test it names
exists.
"""
import fnmatch
import pathlib
import re
import subprocess
import sys
import tempfile

LINK = re.compile(r"(?<!\\)\[[^\]]*\]\(([^)\s]+)(?:\s+\"[^\"]*\")?\)")
POINTER = re.compile(r"\bdocs/[A-Za-z0-9_/-]+\.md(?:#[A-Za-z0-9_-]+)?")
COLUMN = re.compile(r'"([a-z][A-Za-z0-9_]*_(?:mm|mm2|mm3|um|N|s|deg|chi2)|element|contacts|revolution)"')
TEST = re.compile(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
INSTANCE = re.compile(r"^INSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+)", re.MULTILINE)
CTEST = re.compile(r"\badd_test\(NAME ([\w.]+) ")
TEST_NAME = re.compile(r"`((?:[A-Z]\w*/)?[A-Z]\w*\.[\w*…]+)`")
SKIPPED = {".git", "build", "out", "node_modules"}


def without_code(text):
    """Markdown without fenced and inline code, where brackets are not links."""
    text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
    return re.sub(r"`[^`\n]*`", "", text)


def anchors(path):
    """The anchors of a Markdown file: headings as GitHub names them, and <a id=…>."""
    text = path.read_text(encoding="utf-8")
    found = set(re.findall(r'<a\s+(?:id|name)="([^"]+)"', text))
    for heading in re.findall(r"^#{1,6}\s+(.*?)\s*#*$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        found.add(re.sub(r"[^\w\- ]", "", plain).replace(" ", "-"))
    return found


def files(root, pattern):
    return sorted(p for p in root.rglob(pattern)
                  if not SKIPPED & set(p.relative_to(root).parts) and not p.is_symlink())


def check_target(root, target, anchor, where):
    """The breach of a link to `target` (a path) and `anchor` (may be empty), or nothing."""
    if not target.exists():
        return [f"{where}: there is no {target.relative_to(root) if target.is_relative_to(root) else target}"]
    if anchor and target.suffix == ".md" and anchor not in anchors(target):
        return [f"{where}: {target.relative_to(root)} has no heading '#{anchor}'"]
    return []


def check_links(root):
    breaches = []
    for page in files(root, "*.md"):
        for link in LINK.findall(without_code(page.read_text(encoding="utf-8"))):
            if re.match(r"[a-z][a-z0-9+.-]*:", link):
                continue  # the network is not asked
            path, _, anchor = link.partition("#")
            target = (page.parent / path).resolve() if path else page
            breaches += check_target(root, target, anchor, f"{page.relative_to(root)}: link '{link}'")
    return breaches


def check_pointers(root):
    breaches = []
    for folder in ("src", "tests", "examples", "bench", "packaging", "cmake"):
        for pattern in ("*.h", "*.cpp", "*.txt", "*.sh", "*.cmake"):
            for source in files(root / folder, pattern) if (root / folder).is_dir() else []:
                for pointer in POINTER.findall(source.read_text(encoding="utf-8", errors="replace")):
                    path, _, anchor = pointer.partition("#")
                    breaches += check_target(root, root / path, anchor, f"{source.relative_to(root)}: '{pointer}'")
    return breaches


def check_step(root):
    """Headings of 'The step', the line of arrows above them, and the calls of Simulation::step agree."""
    page = (root / "docs/architecture.md").read_text(encoding="utf-8")
    code = (root / "src/abradem/simulation/simulation.cpp").read_text(encoding="utf-8")
    body = re.search(r"^void Simulation::step\(\) \{\n(.*?)^\}", code, re.MULTILINE | re.DOTALL)
    section = re.search(r"^## The step\n(.*?)(?=^## )", page, re.MULTILINE | re.DOTALL)
    if not body or not section:
        return ["docs/architecture.md or simulation.cpp: no step found"]
    calls = re.findall(r"^\s*(\w+)\(\);", body[1], re.MULTILINE)
    headings = re.findall(r"^### (\w+)$", section[1], re.MULTILINE)
    arrows = re.search(r"^`(\w+(?: → \w+)+)`$", section[1], re.MULTILINE)
    breaches = []
    if not calls or headings != calls:
        breaches.append(f"docs/architecture.md: headings {headings}; Simulation::step calls {calls}")
    if not arrows or arrows[1].split(" → ") != calls:
        breaches.append(f"docs/architecture.md: the line of arrows differs from Simulation::step, {calls}")
    return breaches


def check_commands(root, program):
    """The README's first block of commands is ./abradem run CASE and ./test, and both can be run."""
    block = re.search(r"^```sh\n(.*?)^```", (root / "README.md").read_text(encoding="utf-8"), re.M | re.S)
    commands = [line.split("#")[0].split() for line in block[1].splitlines() if line.strip()] if block else []
    if [c[0] for c in commands] != ["./abradem", "./test"]:
        return [f"README.md: the first commands are {commands}; expected ./abradem run CASE and ./test"]
    breaches = []
    for command in commands:
        file = root / command[0]
        if not file.is_file() or not file.stat().st_mode & 0o111:
            breaches.append(f"README.md: {command[0]} is no program")
    arguments = commands[0][1:]
    if arguments[:1] != ["run"] or len(arguments) != 2 or not (root / arguments[1]).is_file():
        breaches.append(f"README.md: './abradem {' '.join(arguments)}' does not run a case that is there")
    elif program:
        done = subprocess.run([program, *arguments, "--dry-run"], cwd=root, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            breaches.append(f"README.md: {' '.join(commands[0])} --dry-run: {done.returncode}\n{done.stderr}")
    return breaches


def check_columns(root):
    """Every column that the tables' writers name is in docs/reference/output.md."""
    page = (root / "docs/reference/output.md").read_text(encoding="utf-8")
    breaches, seen = [], 0
    for name in ("wear_tables.cpp", "run_recorder.cpp", "wall_tables.cpp"):
        for column in COLUMN.findall((root / "src/abradem/io" / name).read_text(encoding="utf-8")):
            seen += 1
            if f"`{column}`" not in page:
                breaches.append(f"docs/reference/output.md: column '{column}' of {name} is not described")
    return breaches if seen > 30 else breaches + [f"src/abradem/io: only {seen} columns found"]


def named_tests(root):
    """The tests of the sources as ctest lists them, without the numbers of parametrised ones; and plain ones."""
    suites, tests = {}, set()
    sources = [path.read_text(encoding="utf-8") for path in files(root / "tests", "*.cpp")]
    for source in sources:
        for instance, suite in INSTANCE.findall(source):
            suites.setdefault(suite, set()).add(instance)
    for source in sources:
        for suite, test in TEST.findall(source):
            tests.add(f"{suite}.{test}")
            tests |= {f"{instance}/{suite}.{test}" for instance in suites.get(suite, ())}
    plain = {name for path in files(root / "tests", "CMakeLists.txt")
             for name in CTEST.findall(path.read_text(encoding="utf-8"))}
    return tests, plain


def check_promises(root):
    """Rows under a header that ends with 'test' name one in their last cell; every name of a test is one's."""
    page = (root / "docs/reliability.md").read_text(encoding="utf-8")
    tests, plain = named_tests(root)
    breaches, promises, promising = [], 0, False
    for number, line in enumerate(page.splitlines(), 1):
        where = f"docs/reliability.md:{number}"
        for name in TEST_NAME.findall(line):
            if not fnmatch.filter(tests, name.replace("…", "*")):
                breaches.append(f"{where}: there is no test '{name}'")
        if not line.startswith("|"):
            promising = False
            continue
        last = line.strip().strip("|").split("|")[-1]
        if last.strip() == "test":
            promising = True
        elif promising and not set(last.strip()) <= set("-: "):
            promises += 1
            if not TEST_NAME.search(last) and not plain & set(re.findall(r"`([\w.]+)`", last)):
                breaches.append(f"{where}: a promise without a test")
    return breaches if promises else breaches + ["docs/reliability.md: no promises found"]


def self_test():
    """One good tree of links and steps, then one breach of each kind."""
    good_step = "void Simulation::step() {\n  move_walls();\n  record();\n}\n"
    good_page = "# A\n## The step\n`move_walls → record`\n### move_walls\n### record\n## End\n"
    good_promise = "| promise | test |\n|---|---|\n| a | `Run.Goes` |\n| b | `All/Any.R…`, `Run.*` |\n| c | `soak` |\n"

    def breaches(check, changes):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            tree = {"docs/architecture.md": good_page, "src/abradem/simulation/simulation.cpp": good_step,
                    "docs/a.md": "[x](architecture.md#the-step) `[no](link)` <a id=\"b\"></a>\n",
                    "src/a.h": "// docs/a.md#b\n", "cases/c.toml": "", "abradem": "", "test": "",
                    "docs/reliability.md": good_promise, "tests/CMakeLists.txt": "add_test(NAME soak COMMAND x)\n",
                    "tests/a.cpp": "TEST(Run, Goes) {}\nTEST_P(Any, Rule) {}\nINSTANTIATE_TEST_SUITE_P(All, Any)\n",
                    "README.md": "```sh\n./abradem run cases/c.toml  # x\n./test\n```\n"} | changes
            for name, text in tree.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding="utf-8")
            for name in ("abradem", "test"):
                (root / name).chmod(0o755)
            return check(root)

    def commands(root):
        return check_commands(root, None)

    cases = [  # check, changes, breaches expected
        (check_links, {}, 0), (check_pointers, {}, 0), (check_step, {}, 0), (commands, {}, 0), (check_promises, {}, 0),
        (check_links, {"docs/a.md": "[x](nowhere.md)"}, 1),
        (check_links, {"docs/a.md": "[x](architecture.md#nowhere)"}, 1),
        (check_links, {"docs/a.md": "![x](nowhere.png)"}, 1),
        (check_pointers, {"src/a.h": "// docs/nowhere.md"}, 1),
        (check_pointers, {"src/a.h": "// docs/a.md#nowhere"}, 1),
        (check_step, {"docs/architecture.md": good_page.replace("### record\n", "")}, 1),
        (check_step, {"docs/architecture.md": good_page.replace("move_walls → record", "record → move_walls")}, 1),
        (check_step, {"src/abradem/simulation/simulation.cpp": good_step.replace("  record();\n", "")}, 2),
        (commands, {"README.md": "```sh\n./abradem run cases/other.toml\n./test\n```\n"}, 1),
        (commands, {"README.md": "```sh\n./test\n```\n"}, 1),
        (check_promises, {"tests/a.cpp": "TEST_P(Any, Rule) {}\nINSTANTIATE_TEST_SUITE_P(All, Any)\n"}, 2),
        (check_promises, {"tests/a.cpp": "TEST(Run, Goes) {}\nTEST_P(Any, Rule) {}\n"}, 1),
        (check_promises, {"tests/CMakeLists.txt": ""}, 1),
        (check_promises, {"docs/reliability.md": good_promise + "| d | none |\n"}, 1),
        (check_promises, {"docs/reliability.md": good_promise + "\nSee `Run.Stops`.\n"}, 1),
        (check_promises, {"docs/reliability.md": "# Nothing\n"}, 1),
    ]
    failures = [f"{check.__name__} {changes}: {found}" for check, changes, expected in cases
                if len(found := breaches(check, changes)) != expected]
    print("\n".join(failures) or f"{len(cases)} cases as expected")
    return bool(failures)


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    if len(sys.argv) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1]).resolve()
    program = sys.argv[2] if len(sys.argv) == 3 else None
    breaches = (check_links(root) + check_pointers(root) + check_step(root) + check_commands(root, program) +
                check_columns(root) + check_promises(root))
    print("\n".join(breaches) or "links, pointers, step, commands, columns and promises are as the documents say")
    return bool(breaches)


if __name__ == "__main__":
    sys.exit(main())
