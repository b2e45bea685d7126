#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes docs/python_reference.md from the signatures and docstrings of the Python module.

usage: PYTHONPATH=build/release/python scripts/python_reference.py [--check]

  --check   writes nothing; exit code 1 if the page is not as it would be
"""

import enum
import inspect
import sys
from pathlib import Path

import cellwalk

PAGE = Path(__file__).resolve().parent.parent / "docs" / "python_reference.md"
HEAD = """# Reference of the Python module

Made from the module itself by `scripts/python_reference.py`. [A mesh from Python](tutorials/python.md) introduces it, [Embedding](embedding.md#from-python) says how it is installed, and
[Functions by task](api_by_task.md) has its functions beside those of C++. Points are arrays of shape (N, 3), or (N, 2) in the plane.
"""


def text_of(thing):
    """A docstring as Markdown: lines as they are, those that begin with a name and a colon apart."""
    doc = inspect.getdoc(thing) or ""
    if "\n\n" in doc and doc.startswith(getattr(thing, "__name__", "\0") + "("):
        doc = doc.split("\n\n", 1)[1]
    return doc.replace("<", "&lt;").replace("\n", "  \n")


def signature_of(function):
    try:
        return str(inspect.signature(function)).replace("(self, ", "(").replace("(self)", "()")
    except ValueError:
        return "(...)"


def heading(level, text):
    return f"{'#' * level} {text}"


def class_lines(name, kind):
    lines = [heading(2, name), text_of(kind)]
    if issubclass(kind, BaseException):
        return lines
    if issubclass(kind, enum.IntEnum):
        return lines + ["| | |\n|---|---|\n" + "\n".join(f"| `{m.name}` | {m.value} |" for m in kind)]
    properties, methods = [], []
    for member, value in vars(kind).items():
        if member == "__init__" and not inspect.getdoc(value).startswith("Initialize self"):
            methods.insert(0, f"**`{name}{signature_of(value)}`**\n\n{text_of(value)}")
        elif member.startswith("_"):
            continue
        elif isinstance(value, property):
            properties.append(f"| `{member}` | {' '.join((inspect.getdoc(value) or '').split())} |")
        else:
            function = value.__func__ if isinstance(value, staticmethod) else value
            owner = f"{name}." if isinstance(value, staticmethod) else ""
            methods.append(f"**`{owner}{member}{signature_of(function)}`**\n\n{text_of(function)}")
    if properties:
        lines.append("| | |\n|---|---|\n" + "\n".join(properties))
    return lines + methods


def page():
    things = {name: getattr(cellwalk, name) for name in cellwalk.__all__ if not name.startswith("__")}
    lines = [HEAD.strip()]
    functions = [name for name, thing in things.items() if not inspect.isclass(thing) and callable(thing)]
    for name in sorted(name for name, thing in things.items() if inspect.isclass(thing)):
        lines += class_lines(name, things[name])
    lines.append(heading(2, "Functions"))
    lines += [f"**`{name}{signature_of(things[name])}`**\n\n{text_of(things[name])}" for name in sorted(functions)]
    return "\n\n".join(line for line in lines if line) + "\n"


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        sys.exit(__doc__)
    text = page()
    if "--check" in sys.argv:
        if not PAGE.exists() or PAGE.read_text(encoding="utf-8") != text:
            sys.exit("docs/python_reference.md is not that of the module: run scripts/python_reference.py")
    else:
        PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
