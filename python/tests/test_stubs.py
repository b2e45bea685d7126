# SPDX-License-Identifier: LGPL-3.0-or-later
"""The stubs say what the module has: the same names, the same parameters with the same defaults; and everything is documented."""

import ast
import pathlib
import re
import unittest

import cellwalk
from cellwalk import _cellwalk

PACKAGE = pathlib.Path(cellwalk.__file__).parent
STUBS = ast.parse((PACKAGE / "_cellwalk.pyi").read_text(encoding="utf-8"))


def stub_parameters(function):
    """Names of positional and of keyword-only parameters, in order, `self` left out."""
    given = function.args
    positional = [a.arg for a in given.args if a.arg != "self"]
    return positional + (["*"] if given.kwonlyargs else []) + [a.arg for a in given.kwonlyargs]


def bound_parameters(doc):
    """The same, as pybind11 writes them into the first line of a docstring."""
    signature = re.match(r"\w+\((.*)\)(?: -> .*)?$", doc.splitlines()[0]).group(1)
    names = []
    for part in re.split(r", (?=\*|\w+:)", signature):
        name = part.split(":")[0].strip()
        if name and name not in ("self", "**kwargs"):
            names.append(name)
    return names


class Stubs(unittest.TestCase):
    def test_names(self):
        public = {n for n in dir(_cellwalk) if not n.startswith("_")} | {"__version__"}
        stubbed = set()
        for node in STUBS.body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                stubbed.add(node.name)
            elif isinstance(node, ast.AnnAssign):
                stubbed.add(node.target.id)
        self.assertEqual(stubbed, public)
        self.assertTrue((PACKAGE / "py.typed").is_file())
        for name in cellwalk.__all__:
            self.assertTrue(hasattr(cellwalk, name), name)

    def test_members_and_parameters(self):
        compared = 0
        for node in STUBS.body:
            if not isinstance(node, ast.ClassDef):
                continue
            bound = getattr(_cellwalk, node.name)
            stubbed = {member.name: member for member in node.body}
            public = {n for n in vars(bound) if not n.startswith("_")}
            self.assertEqual({n for n in stubbed if not n.startswith("_")}, public, node.name)
            for name, member in stubbed.items():
                attribute = getattr(bound, name)
                if isinstance(attribute, property) or name == "__len__":
                    continue
                self.assertEqual(stub_parameters(member), bound_parameters(attribute.__doc__), f"{node.name}.{name}")
                compared += 1
        self.assertGreaterEqual(compared, 12)

    def test_everything_is_documented(self):
        for name in ("Body", "Changes", "CutReport", "Edits", "Environment", "Locations", "Motions", "Particles", "RelaxReport", "Replacement",
                     "Selection", "Traces", "WallMoves"):
            bound = getattr(cellwalk, name)
            self.assertGreater(len(bound.__doc__), 20, name)
            for member, attribute in vars(bound).items():
                if not member.startswith("_"):
                    text = getattr(bound, member).__doc__ or ""
                    prose = text if isinstance(attribute, property) else "\n".join(text.splitlines()[1:])
                    self.assertGreater(len(prose.strip()), 3, f"{name}.{member}")
        for name in ("Error", "InputError", "NotCertifiedError", "OutsideError", "UsageError", "Status", "Place", "Feature", "MoveEnd"):
            self.assertTrue(getattr(cellwalk, name).__doc__, name)


if __name__ == "__main__":
    unittest.main()
