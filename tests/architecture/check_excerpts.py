#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that code in pages is what files hold that are compiled and run. Prints one line per difference.

usage: check_excerpts.py ROOT [--fix]

A page names the part of a file before the block of code:

    <!-- excerpt examples/first_walk.cpp walk -->

and the file marks the part by two lines that end with [walk] after //! or ##. --fix writes the parts into the pages.
"""

import re
import sys
import textwrap
from pathlib import Path

EXCERPT = re.compile(r"<!-- excerpt (\S+)(?: (\S+))? -->\n```(\w*)\n(.*?)```\n", re.DOTALL)
MARK = re.compile(r"\s*(?://!|##) \[\w+\]\s*$")


def part(path, name):
    """The lines between the two marks of a name, without marks of other parts and without common indentation; without a name the
    whole file but its licence line. Raises ValueError if the marks are not two."""
    lines = path.read_text(encoding="utf-8").splitlines()
    if name is None:
        return "\n".join(line for line in lines if "SPDX-License-Identifier" not in line and not MARK.match(line)) + "\n"
    marks = [i for i, line in enumerate(lines) if MARK.match(line) and line.rstrip().endswith(f"[{name}]")]
    if len(marks) != 2:
        raise ValueError(f"{path} has {len(marks)} marks [{name}], not 2")
    inside = [line for line in lines[marks[0] + 1:marks[1]] if not MARK.match(line)]
    return textwrap.dedent("\n".join(inside)).strip("\n") + "\n"


def pages(root):
    return [root / "README.md"] + sorted((root / "docs").rglob("*.md"))


def check(root, fix=False):
    """The number of excerpts, and a line for each that differs."""
    root = Path(root)
    count, breaches = 0, []
    for page in pages(root):
        text = page.read_text(encoding="utf-8")

        def current(match):
            nonlocal count
            count += 1
            where = f"{page.relative_to(root)}:{text.count(chr(10), 0, match.start()) + 1}"
            try:
                code = part(root / match.group(1), match.group(2))
            except (OSError, ValueError) as error:
                breaches.append(f"{where}: {error}")
                return match.group(0)
            if code != match.group(4) and not fix:
                breaches.append(f"{where}: is not what {match.group(1)} holds; check_excerpts.py --fix writes it")
            start = match.start(4) - match.start(0)
            return match.group(0)[:start] + code + "```\n"

        changed = EXCERPT.sub(current, text)
        declared = text.count("<!-- excerpt ")
        if declared != len(EXCERPT.findall(text)):
            breaches.append(f"{page.relative_to(root)}:1: an excerpt is not followed by a block of code")
        if fix and changed != text:
            page.write_text(changed, encoding="utf-8")
    return count, breaches


def main():
    arguments = sys.argv[1:]
    fix = "--fix" in arguments
    if len(arguments) != 1 + fix or not Path(arguments[0]).is_dir():
        print(__doc__, file=sys.stderr)
        return 2
    count, breaches = check(arguments[0], fix)
    if count == 0:
        breaches.append("there is no excerpt at all")
    print("\n".join(breaches + [f"{count} excerpts"]))
    return 1 if breaches else 0


if __name__ == "__main__":
    sys.exit(main())
