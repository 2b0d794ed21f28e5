#!/usr/bin/env python3
"""Holds the includes of the libraries to the order of their folders, and the lists of CMake to the files.

    python3 tests/layers.py [ROOT]

A folder includes only folders on lines before its own, so that no folders include each other in a circle. Prints
every include that goes up or sideways, every circle, and every file that no CMakeLists.txt names and that therefore
nobody compiles, tests or installs; status 1 where there is one.
"""

import re
import sys
from collections import defaultdict
from pathlib import Path

# A line a layer; folders of one layer do not include each other.
ORDER = {
    "polyaffine": """
        core
        mesh material
        geometry meshing rules
        kinematics mesh_io
        linear quadrature vtk
        fields system
        check solve
    """,
    "cardiac": """
        core
        tissue contraction circulation
        anatomy activation
        fibres
        scene
        reduction protocol
        strain
        model
        training
        run
        report
        validation
        bench
    """,
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"](polyaffine|cardiac)/(\w+)/(\w+\.hpp)[>"]')


def includes(root, library):
    """(file, folder, included library, included folder, included file) of every include of the libraries."""
    base = root / f"lib{library}" / library
    for file in sorted(base.rglob("*.[ch]pp")):
        for number, line in enumerate(file.read_text().splitlines(), 1):
            if found := INCLUDE.match(line):
                yield f"{file.relative_to(root)}:{number}", file.parent.name, *found.groups()


def circles(graph):
    """Sets of folders that reach each other (Tarjan 1972)."""
    index, low, stack, found = {}, {}, [], []

    def visit(v):
        index[v] = low[v] = len(index)
        stack.append(v)
        for w in sorted(graph[v]):
            if w not in index:
                visit(w)
                low[v] = min(low[v], low[w])
            elif w in stack:
                low[v] = min(low[v], index[w])
        if low[v] == index[v]:
            part = stack[stack.index(v):]
            del stack[stack.index(v):]
            if len(part) > 1:
                found.append(sorted(part))

    for v in sorted(graph):
        if v not in index:
            visit(v)
    return found


def check(root, library):
    layer = {f: i for i, line in enumerate(ORDER[library].split("\n")) for f in line.split()}
    wrong, graph = [], defaultdict(set)
    folders = {p.parent.name for p in (root / f"lib{library}" / library).glob("*/*.cpp")}
    for folder in sorted(folders - layer.keys()):
        wrong.append(f"{library}/{folder}: has no place in the order of tests/layers.py")
    for place, folder, other, target, name in includes(root, library):
        if other != library:
            if library == "polyaffine":
                wrong.append(f"{place}: libpolyaffine includes {other}/{target}/{name}")
            continue
        if target == folder:
            continue
        graph[folder].add(target)
        graph[target]  # so that it is visited
        if folder in layer and target in layer and layer[target] >= layer[folder]:
            way = "sideways" if layer[target] == layer[folder] else "up"
            wrong.append(f"{place}: {folder} includes {way} {target}/{name}")
    for part in circles(graph):
        wrong.append(f"{library}: a circle of " + ", ".join(part))
    return wrong


def unlisted(root):
    """Sources and headers whose folder and name stand in no list of sources."""
    lists = {
        "apps": r"()(cardiac/\w+)\.cpp",
        "libcardiac": r"add_sources\(\w+ ([\w/]+) ([^)]*)\)",
        "libpolyaffine": r"add_sources\(\w+ ([\w/]+) ([^)]*)\)",
        "tests": r"add_(?:test_folder|sparse_tests)\((\w+ \w+) ([^)]*)\)",
    }
    for part, pattern in lists.items():
        listed = set()
        for folder, names in re.findall(pattern, (root / part / "CMakeLists.txt").read_text()):
            for name in names.split():
                listed.add(f"{folder.replace(' ', '/')}/{name}".lstrip("/"))
        kinds = {"apps": "*.cpp", "tests": "*_test.cpp"}
        for file in sorted((root / part).rglob(kinds.get(part, "*.[ch]pp"))):
            name = file.relative_to(root / part).with_suffix("").as_posix().removesuffix("_test" if part == "tests" else "")
            if name not in listed:
                yield f"{file.relative_to(root)}: is not in {part}/CMakeLists.txt"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).resolve().parent.parent)
    wrong = [text for library in ORDER for text in check(root, library)] + list(unlisted(root))
    print("\n".join(wrong) if wrong else "The folders are in order, and the lists complete.")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
