# SPDX-License-Identifier: LGPL-3.0-or-later
"""The stubs say what the module has: the same names, the same parameters with the same defaults; everything is documented; and mypy
accepts them, and finds mistakes by them. Needs Debian's package mypy: scripts/setup.sh. CELLWALK_EXAMPLES: the folder of the examples."""

import ast
import inspect
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import cellwalk
from cellwalk import _cellwalk

PACKAGE = pathlib.Path(cellwalk.__file__).parent
STUBS = ast.parse((PACKAGE / "_cellwalk.pyi").read_text(encoding="utf-8"))
CLASSES = [value for value in vars(_cellwalk).values() if isinstance(value, type)]


def value_of(default):
    """A default of a stub; ... stands for any."""
    return ... if default is None or isinstance(default, ast.Constant) and default.value is ... else ast.literal_eval(default)


def stub_parameters(function):
    """Names, kinds and defaults of parameters, in order."""
    given, empty = function.args, inspect.Parameter.empty
    defaults = [empty] * (len(given.args) - len(given.defaults)) + [value_of(d) for d in given.defaults]
    found = [(a.arg, "positional", d) for a, d in zip(given.args, defaults)]
    found += [(a.arg, "by name", empty if d is None else value_of(d)) for a, d in zip(given.kwonlyargs, given.kw_defaults)]
    return found + ([("**", given.kwarg.arg, empty)] if given.kwarg else [])


def bound_parameters(function):
    kinds = {inspect.Parameter.POSITIONAL_OR_KEYWORD: "positional", inspect.Parameter.KEYWORD_ONLY: "by name"}
    return [(p.name, kinds[p.kind], p.default) if p.kind in kinds else ("**", p.name, p.default)
            for p in inspect.signature(function).parameters.values()]


class Stubs(unittest.TestCase):
    def test_names(self):
        public = {n for n in dir(_cellwalk) if not n.startswith("_")} | {"__version__"}
        stubbed = set()
        for node in STUBS.body:
            if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                stubbed.add(node.name)
            elif isinstance(node, ast.AnnAssign):
                stubbed.add(node.target.id)
        self.assertEqual({n for n in stubbed if not n.startswith("_") or n == "__version__"}, public)
        self.assertTrue((PACKAGE / "py.typed").is_file())
        for name in cellwalk.__all__:
            self.assertTrue(hasattr(cellwalk, name), name)
        self.assertLessEqual({cls.__name__ for cls in CLASSES} | {"draw", "build_features"}, set(cellwalk.__all__))

    def compare(self, stub, function, name):
        of_stub, bound = stub_parameters(stub), bound_parameters(function)
        self.assertEqual([part[:2] for part in of_stub], [part[:2] for part in bound], name)
        for (parameter, _, default), (_, _, in_module) in zip(of_stub, bound):
            if default is not ...:
                self.assertEqual(default, in_module, f"{name}({parameter})")

    def test_members_and_parameters(self):
        compared = 0
        for node in STUBS.body:
            if isinstance(node, ast.FunctionDef):
                self.compare(node, getattr(_cellwalk, node.name), node.name)
                compared += 1
            if not isinstance(node, ast.ClassDef) or node.name.startswith("_"):
                continue
            bound = getattr(_cellwalk, node.name)
            stubbed = {member.name: member for member in node.body}
            public = {n for n in vars(bound) if not n.startswith("_")}
            self.assertEqual({n for n in stubbed if not n.startswith("_")}, public, node.name)
            for name, member in stubbed.items():
                attribute = getattr(bound, name)
                if not isinstance(attribute, property):
                    self.compare(member, attribute, f"{node.name}.{name}")
                    compared += 1
        self.assertGreaterEqual(compared, 50)

    def test_classes_have_the_signature_of_their_constructor(self):
        for cls in (cellwalk.Body, cellwalk.Particles):
            self.assertEqual(str(inspect.signature(cls)), str(inspect.signature(cls.__init__)).replace("self, ", ""))
        self.assertEqual(str(inspect.signature(cellwalk.Particles)), "(environment, points, *, threads=0)")
        environment = cellwalk.Environment.generate("squares", cells=2)
        self.assertEqual(str(inspect.signature(environment.locate)), "(points, *, threads=0)")

    def test_everything_is_documented(self):
        documented = 0
        for cls in CLASSES:
            self.assertGreater(len(cls.__doc__), 20, cls)
            self.assertEqual(cls.__module__, "cellwalk")
            for member in vars(cls):
                if not member.startswith("_"):
                    text = getattr(cls, member).__doc__ or ""
                    self.assertGreater(len(text.strip()), 3, f"{cls.__name__}.{member}")
                    self.assertNotIn("cellwalk._cellwalk", text)
                    documented += 1
        self.assertGreater(documented, 100)
        for name in cellwalk.__all__:
            if name != "__version__":
                self.assertTrue(getattr(cellwalk, name).__doc__, name)

    def test_every_result_has_a_repr(self):
        for cls in CLASSES:
            self.assertIn("__repr__", vars(cls), cls)


class Mypy(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)

    def mypy(self, *arguments):
        done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", self.folder / "cache", *arguments], capture_output=True,
                              text=True, env={**os.environ, "MYPYPATH": str(PACKAGE.parent)})
        return done.returncode, done.stdout + done.stderr

    def test_the_package_and_a_typed_example(self):
        code, said = self.mypy(PACKAGE / "_cellwalk.pyi", *sorted(PACKAGE.rglob("*.py")), pathlib.Path(os.environ["CELLWALK_EXAMPLES"]) / "arrays.py")
        self.assertEqual(code, 0, said)

    def test_mistakes_are_found(self):
        wrong = self.folder / "wrong.py"
        wrong.write_text("import cellwalk\n"
                         "e = cellwalk.Environment.generate('hexes', cells=2)\n"
                         "e.walk([[1, 1, 1]], [[2, 2, 2]], touch='never')\n"
                         "e.locate()\n"
                         "e.locate([[1, 1, 1]]).cells\n"
                         "e.to_arrays().walls + 'x'\n"
                         "cellwalk.Environment([[0, 0, 0]], [[0]])\n")
        code, said = self.mypy(wrong)
        self.assertEqual(code, 1, said)
        for line in range(3, 8):
            self.assertIn(f"wrong.py:{line}: error:", said)
        self.assertIn("Found 5 errors in 1 file", said)


if __name__ == "__main__":
    unittest.main()
