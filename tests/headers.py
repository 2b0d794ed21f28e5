#!/usr/bin/env python3
"""Compiles every installed header alone, with all warnings and for a processor without AVX.

    python3 tests/headers.py INCLUDE_FOLDER EIGEN_FOLDER

INCLUDE_FOLDER is that of an installation. A header may include the standard library, Eigen and the headers beside it,
nothing else. CXX names another compiler than c++. Prints what is wrong; status 1 when anything is.
"""

import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
OWN = re.compile(r"(polyaffine|cardiac)/.*\.hpp$")
STANDARD = re.compile(r"[a-z_]+$")
OPTIONS = """-std=c++20 -fsyntax-only -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wpedantic -Werror
             -DEIGEN_MAX_ALIGN_BYTES=32 -DEIGEN_MAX_STATIC_ALIGN_BYTES=32""".split()
# Eigen is most of the time that a header takes. Those that reach the header below begin with Eigen/Core whatever
# they forget, so that it may come compiled; the others are compiled without it.
WITH_EIGEN = "polyaffine/core/types.hpp"


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    root, eigen = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    compiler = [os.environ.get("CXX", "c++"), *OPTIONS, f"-I{root}", "-isystem", str(eigen)]
    headers = sorted(p.relative_to(root).as_posix() for p in root.rglob("*.hpp") if OWN.match(p.relative_to(root).as_posix()))
    if not headers:
        sys.exit(f"no headers in {root}")
    includes = {h: [name for _, name in INCLUDE.findall((root / h).read_text())] for h in headers}
    wrong = []
    for header in headers:
        for name in includes[header]:
            if OWN.match(name) and name not in includes:
                wrong.append(f"{header}: includes {name}, which is not installed")
            elif not (OWN.match(name) or name.startswith("Eigen/") or STANDARD.match(name)):
                wrong.append(f"{header}: includes {name}, which a user need not have")

    def reaches_eigen(header, seen):
        seen.add(header)
        return header == WITH_EIGEN or any(
            reaches_eigen(name, seen) for name in includes.get(header, []) if name not in seen)

    with tempfile.TemporaryDirectory() as folder:
        core = Path(folder) / "core.hpp"
        core.write_text("#include <Eigen/Core>\n")
        precompile = [option for option in compiler if option != "-fsyntax-only"]
        subprocess.run([*precompile, "-x", "c++-header", str(core), "-o", f"{core}.gch"], check=True)

        def check(header):
            first = ["-include", str(core)] if reaches_eigen(header, set()) else []
            done = subprocess.run([*compiler, *first, "-include", str(root / header), "-x", "c++", os.devnull],
                                  capture_output=True, text=True)
            return "" if done.returncode == 0 else f"{header}: does not compile alone\n{done.stderr}"

        with ThreadPoolExecutor(os.cpu_count()) as pool:
            wrong += [text for text in pool.map(check, headers) if text]
    print("\n".join(wrong) if wrong else f"Each of {len(headers)} headers compiles alone.")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
