#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that docs/api_by_task.md names what there is: C++ names in the headers of their row, Python names in the stubs.

usage: test_api_names.py ROOT

Then it spoils each name, one after the other, and expects that to be reported.
"""

import ast
import re
import sys
from pathlib import Path

PAGE = Path("docs/api_by_task.md")
PYTHON = ["python/cellwalk/_cellwalk.pyi", "python/cellwalk/_codes.py", "python/cellwalk/_errors.py", "python/cellwalk/catheter/_lumen.py",
          "python/cellwalk/catheter/_environment.py"]
FEWEST = {"C++": 60, "Python": 40}  # so that a test that finds nothing does not pass
COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
TYPE = r"(?:class|struct|enum(?: class)?)\s+{}\b[^;{{]*\{{|using\s+{}\s*="


def body_of(text, name):
    """What stands between the braces of a class, struct or enumeration; None if it is not declared."""
    start = re.search(TYPE.format(name, name), text)
    if start is None:
        return None
    depth = 1
    for i in range(start.end(), len(text)):
        depth += {"{": 1, "}": -1}.get(text[i], 0)
        if depth == 0:
            return text[start.end():i]
    return ""


def is_declared(name, texts):
    """`f()` is a function, `A::f()` one of a class, `A` a type."""
    scope, _, last = name.removesuffix("()").rpartition("::")
    places = [body_of(text, scope) or "" for text in texts] if scope else texts
    if name.endswith("()"):
        return any(re.search(rf"[\w>&*\]]\s+\*?&?{last}\(", place) for place in places)
    return any(body_of(place, last) is not None for place in places)


def python_names(root):
    """All classes with their members, as A and A.f."""
    names = set()
    for file in PYTHON:
        for node in ast.parse((root / file).read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef):
                names.add(node.name)
                names |= {f"{node.name}.{member.name}" for member in node.body if isinstance(member, ast.FunctionDef)}
            elif isinstance(node, ast.FunctionDef):
                names.add(node.name)
    return names


def check(root, text, in_python, headers):
    """The names by language, and a line for each that does not exist."""
    named, problems = {"C++": [], "Python": []}, []
    for row in re.findall(r"^\| (?!To \||-)(.*) \|$", text, re.MULTILINE):
        task, cpp, links, python = re.split(r" ?\| ?", row + " ")
        files = re.findall(r"\]\(\.\./(include/[^)]*)\)", links)
        for file in files:
            if file not in headers:
                headers[file] = COMMENT.sub("", (root / file).read_text(encoding="utf-8"))
        for name in re.findall(r"`([^`]*)`", cpp):
            named["C++"].append(name)
            if not is_declared(name, [headers[file] for file in files]):
                problems.append(f"{PAGE}: {task}: {name} is not in {', '.join(files)}")
        for name in re.findall(r"`([^`]*)`", python):
            named["Python"].append(name)
            if name not in in_python:
                problems.append(f"{PAGE}: {task}: {name} is not in the stubs")
    return named, problems


def main():
    root = Path(sys.argv[1])
    text, in_python, headers = (root / PAGE).read_text(encoding="utf-8"), python_names(root), {}
    named, problems = check(root, text, in_python, headers)
    problems += [f"only {len(named[language])} names of {language}" for language, fewest in FEWEST.items() if len(named[language]) < fewest]
    if not problems:
        for name in sorted({*named["C++"], *named["Python"]}):
            spoiled = name.removesuffix("()") + "_x" + ("()" if name.endswith("()") else "")
            if not check(root, text.replace(f"`{name}`", f"`{spoiled}`"), in_python, headers)[1]:
                problems.append(f"{spoiled} is not reported")
    print("\n".join(problems))
    print(f"{len(named['C++'])} names of C++, {len(named['Python'])} of Python, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
