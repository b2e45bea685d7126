#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that the front door is small: the words of README, and the lines and names of the first programs in docs/start.md.

usage: test_first_screen.py ROOT
"""

import re
import sys
from pathlib import Path

MOST_WORDS, MOST_LINES, MOST_NAMES = 700, 12, 8


def program(page, language):
    """The lines of the program of a page in a language, without includes and the braces of main()."""
    code = re.search(rf"```{language}\n(.*?)```", page, re.DOTALL)[1]
    if language == "cpp":
        code = re.search(r"int main\(\) \{\n(.*)\n\}", code, re.DOTALL)[1]
    return [line for line in code.splitlines() if line.strip()]


def names(lines):
    """What a program uses of cellwalk: what it names, and what it calls of that."""
    text = "\n".join(lines)
    return set(re.findall(r"cellwalk(?:::|\.)(\w+)", text)) | set(re.findall(r"rope\.(\w+)", text))


def breaches(readme, start):
    found = []
    words = len(readme.split())
    if words > MOST_WORDS:
        found.append(f"README.md has {words} words, more than {MOST_WORDS}")
    for page, where, languages in ((readme, "README.md", ["cpp"]), (start, "docs/start.md", ["cpp", "python"])):
        for language in languages:
            lines = program(page, language)
            if len(lines) > MOST_LINES:
                found.append(f"{where}: {len(lines)} lines of {language}, more than {MOST_LINES}")
            if not 4 < len(names(lines)) <= MOST_NAMES:
                found.append(f"{where}: {len(names(lines))} names in {language}, more than {MOST_NAMES}: {sorted(names(lines))}")
    return found


def main():
    root = Path(sys.argv[1])
    readme, start = ((root / name).read_text(encoding="utf-8") for name in ("README.md", "docs/start.md"))
    found = breaches(readme, start)
    print("\n".join(found or ["the front door is small"]))
    longer = start.replace("int main() {", "int main() {" + 12 * "\n  cellwalk::more();", 1)
    if len(breaches(readme + 700 * " word", longer)) < 2:
        found.append("what is too long passes")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
