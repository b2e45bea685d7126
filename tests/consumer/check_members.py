#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that a source names every public member of the classes, and every function, that headers declare `extern template`.

usage: check_members.py FOLDER_OF_HEADERS SOURCE

Constructors, destructors and operators are not looked for, nor what is in a folder "detail".
"""

import re
import sys
from pathlib import Path

FEWEST = 100  # members, so that headers that cannot be read do not pass
DECLARED = re.compile(r"extern template (?:(class|struct) )?([^;]*);", re.DOTALL)


def top_level(body):
    """The declarations of a class body: what stands in braces is left out, and ends one."""
    text, braces, parentheses = "", 0, 0
    for c in body:
        if c == "{":
            braces += 1
        elif c == "}":
            braces -= 1
            if braces < 0:
                return text
            if braces == 0 and parentheses == 0:
                text += ";"
        elif braces == 0:
            parentheses += (c == "(") - (c == ")")
            text += c
    raise ValueError("a class does not end")


def public_members(text, name):
    """The names of the functions and constants of a class that are public."""
    start = re.search(rf"\b(class|struct) {name} \{{", text)
    access, members = "private" if start[1] == "class" else "public", set()
    for part in re.split(r"\b((?:public|private|protected):)", top_level(text[start.end():])):
        if part.endswith(":") and part[:-1] in ("public", "private", "protected"):
            access = part[:-1]
        elif access == "public":
            for declaration in part.split(";"):
                found = re.search(r"(~?\w+) ?\(", declaration) or re.search(r"static constexpr .*?(\w+) =", declaration)
                if found and found[1].lstrip("~") != name and "operator" not in declaration:
                    members.add(found[1])
    return members


def main():
    headers, source = Path(sys.argv[1]), Path(sys.argv[2]).read_text(encoding="utf-8")
    looked_for, problems = set(), set()
    for header in sorted(headers.rglob("*.h")):
        if header.parent.name == "detail":
            continue
        text = re.sub(r"//[^\n]*", "", header.read_text(encoding="utf-8"))
        for kind, declared in DECLARED.findall(text):
            if kind:
                name = declared.split("<")[0]
                wanted = {f"{name}<D>::{member}" for member in public_members(text, name)}
            else:
                wanted = {re.search(r"(\w+)(?:<\d>)?\(", declared)[1]}
            looked_for |= wanted
            problems |= {f"{header}: {sys.argv[2]} lacks &{name}" for name in wanted
                         if not re.search(rf"&(io::)?{name}\b", source)}
    if len(looked_for) < FEWEST:
        problems.add(f"only {len(looked_for)} members found in {headers}")
    print("\n".join(sorted(problems)))
    print(f"members: {len(looked_for)} looked for, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
