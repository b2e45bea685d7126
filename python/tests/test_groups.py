# SPDX-License-Identifier: LGPL-3.0-or-later
"""Groups of facets and cells that the file of an environment names."""

import pathlib
import tempfile
import unittest

import numpy

import cellwalk

# Two triangles with a common edge.
FILE = """OVM ASCII
Vertices
4
0 0 0
1 0 0
1 1 0
0 1 0
Edges
5
0 1
1 2
2 0
2 3
3 0
Faces
2
3 0 2 4
3 5 6 8
Polyhedra
0
EProp bool "group valve"
0 0 1 1 0
FProp bool "group upper part"
0 1
"""


class Groups(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name) / "square.ovm"
        self.path.write_text(FILE)

    def check(self, environment, facets=2, cells=1):
        self.assertEqual(environment.groups, ["upper part", "valve"])
        valve, upper = environment.select(group="valve"), environment.select(group="upper part")
        self.assertEqual((len(valve.facets), len(valve.cells)), (facets, 0))
        self.assertEqual((len(upper.facets), len(upper.cells)), (0, cells))
        return valve.facets, upper.cells

    def test_names_and_places(self):
        for make in (cellwalk.Environment.load, cellwalk.Environment.import_mesh):
            facets, cells = self.check(make(self.path))
            self.assertEqual(cells["cell"].tolist(), [1])
            self.assertEqual(sorted(map(tuple, facets["mean"].tolist())), [(0.5, 0.5), (0.5, 1)])
            self.assertEqual(sorted(facets["neighbour"].tolist()), [-1, 1])
        self.assertEqual(cellwalk.Environment.generate("squares", cells=2).groups, [])

    def test_edits_and_files(self):
        environment = cellwalk.Environment.load(self.path)
        again = self.path.with_name("again.ovm")
        with environment.editing() as edits:
            facets, cells = self.check(environment)
            self.assertTrue(edits.close(facets).made.all())
            self.assertTrue(edits.fill(cells).made.all())
            self.check(environment)
        environment.save(again)
        facets, cells = self.check(cellwalk.Environment.load(again))
        self.assertTrue(facets["wall"].all() and cells["solid"].all())
        with environment.editing() as edits:
            self.assertTrue(edits.insert_point(1, environment.cells()["mean"][1]))
            self.check(environment, facets=2, cells=0)
        environment.save(again)
        self.check(cellwalk.Environment.load(again), facets=2, cells=0)

    def test_refusals(self):
        environment = cellwalk.Environment.load(self.path)
        with self.assertRaisesRegex(ValueError, 'there is no group "gate": the environment has upper part, valve'):
            environment.select(group="gate")
        with self.assertRaisesRegex(ValueError, 'there is no group "gate": the environment has none'):
            cellwalk.Environment.generate("squares", cells=2).select(group="gate")
        with self.assertRaisesRegex(cellwalk.UsageError, "a group and places exclude each other"):
            environment.select(group="valve", box=((0, 0), (1, 1)))
        self.path.write_text(FILE.replace("FProp bool", "FProp int"))
        with self.assertRaisesRegex(cellwalk.InputError, "square.ovm:23: 'FProp int"):
            cellwalk.Environment.load(self.path)


if __name__ == "__main__":
    unittest.main()
