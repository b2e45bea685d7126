#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that public headers do not compile without IEEE arithmetic, and do with it.

usage: check_ieee.py ROOT COMPILER

A header refuses if it includes, directly or not, the one that has the #error. Those that compute nothing need not.
"""

import re
import subprocess
import sys
from pathlib import Path

SAID = "cellwalk decides exactly and needs IEEE arithmetic"
CHECKED = "cellwalk/kernel/point.h"
WITHOUT_ARITHMETIC = {f"cellwalk/{name}.h" for name in (
    "edge/contact_search", "kernel/error", "meshing/mesher_limits")}
FEWEST_HEADERS = 40  # so that a folder that cannot be read does not pass
INCLUDE = re.compile(r"^#include <(cellwalk/[^>]+)>", re.MULTILINE)


def included_by(folders, header, seen):
    """All headers of cellwalk that a header includes, itself too."""
    if header in seen:
        return seen
    seen.add(header)
    text = next((folder / header).read_text(encoding="utf-8") for folder in folders if (folder / header).exists())
    for inner in INCLUDE.findall(text):
        included_by(folders, inner, seen)
    return seen


def compiles(root, compiler, flags):
    """Whether the headers are accepted with these flags, and what the compiler says."""
    done = subprocess.run([compiler, "-std=c++20", "-x", "c++", "-E", *flags, f"-I{root}/include", f"-I{root}/src/shared",
                           root / "include" / CHECKED], capture_output=True, text=True)
    return done.returncode == 0, done.stderr


def main():
    root, compiler = Path(sys.argv[1]), sys.argv[2]
    problems = []
    for flags in (["-O2"], ["-O3", "-ffp-contract=off"], ["-Ofast", "-fno-fast-math"]):
        accepted, said = compiles(root, compiler, flags)
        if not accepted:
            problems.append(f"{' '.join(flags)} is refused: {said}")
    for flags in (["-ffast-math"], ["-Ofast"], ["-O2", "-ffinite-math-only"], ["-O3", "-ffast-math", "-ffp-contract=off"]):
        accepted, said = compiles(root, compiler, flags)
        if accepted or SAID not in said:
            problems.append(f"{' '.join(flags)} is not refused as it ought to be: {said}")
    folders = (root / "include", root / "src/shared")
    headers = [str(path.relative_to(folders[0])) for path in sorted(folders[0].rglob("*.h"))]
    if len(headers) < FEWEST_HEADERS:
        problems.append(f"only {len(headers)} headers are there")
    for header in headers:
        refuses = CHECKED in included_by(folders, header, set())
        if refuses == (header in WITHOUT_ARITHMETIC):
            problems.append(f"{header} {'refuses, and need not be listed here' if refuses else 'does not include ' + CHECKED}")
    print("\n".join(problems) or f"{len(headers)} headers need IEEE arithmetic, or none")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
