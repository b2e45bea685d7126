# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of facets and cells, all and by place."""

import unittest

import numpy

import cellwalk
from edit_worlds import plane, room


class Tables(unittest.TestCase):
    def test_cells(self):
        cells = plane().cells()
        self.assertEqual(cells["cell"].tolist(), list(range(12)))
        self.assertEqual(cells["mean"][5].tolist(), [1.5, 1.5])
        self.assertEqual(sorted(cells["points"][5].tolist()), [6, 7, 11, 12])
        self.assertFalse(cells["solid"].any())

    def test_facets(self):
        environment = plane()
        facets = environment.facets()
        self.assertEqual(len(facets), 4 * 4 + 5 * 3)
        on_boundary = facets["neighbour"] == -1
        self.assertEqual(numpy.count_nonzero(on_boundary), 14)
        self.assertTrue((facets["wall"] == on_boundary).all())
        self.assertTrue((facets["neighbour"][~on_boundary] > facets["cell"][~on_boundary]).all())
        means = environment.points[facets["points"]].mean(axis=1)
        self.assertTrue((means == facets["mean"]).all())
        self.assertEqual(len({(f["cell"], f["facet"]) for f in facets}), len(facets))
        self.assertEqual(facets["facet"].min(), 0)
        self.assertEqual(facets["facet"].max(), 3)

    def test_cells_of_several_shapes(self):
        """Fewer points than the largest cell, or facet, are filled up with -1."""
        lattice = None
        for seed in range(1, 9):
            lattice = cellwalk.Environment.generate("lattice", cells=3, seed=seed)
            cells, facets = lattice.cells(), lattice.facets()
            if (cells["points"] == -1).any() and (facets["points"] == -1).any():
                break
        for table in (cells, facets):
            count = (table["points"] >= 0).sum(axis=1)
            self.assertEqual(count.max(), table["points"].shape[1])
            for row, n in zip(table, count):
                self.assertTrue((row["points"][:n] >= 0).all() and (row["points"][n:] == -1).all())
                self.assertTrue(numpy.allclose(lattice.points[row["points"][:n]].mean(axis=0), row["mean"]))
        self.assertEqual(len(cells), lattice.cell_count)
        self.assertEqual(numpy.count_nonzero(cells["solid"]), lattice.certificate["solid_cells"])
        self.assertEqual(numpy.count_nonzero(facets["wall"]), lattice.certificate["walls"])
        self.assertEqual(repr(lattice), f"<cellwalk.Environment, 3D, {len(cells)} cells, {numpy.count_nonzero(facets['wall'])} walls>")
        self.assertEqual(len(facets), lattice.certificate["facets"])


class Selecting(unittest.TestCase):
    def test_by_place(self):
        environment = plane()
        in_box = environment.select(box=((0, 0), (2, 1)))
        self.assertEqual(in_box.cells["cell"].tolist(), [0, 1])
        self.assertEqual(sorted(map(tuple, in_box.facets["mean"].tolist())), [(0.5, 1), (1, 0.5), (1.5, 1), (2, 0.5)])
        self.assertEqual(environment.select(ball=((2.5, 1.5), 0.4)).cells["cell"].tolist(), [6])
        self.assertEqual(len(environment.select(ball=([2.5, 1.5], 0.5)).facets), 4)
        across = environment.select(plane=((1.9, 0), (2, 0)))
        self.assertTrue((across.facets["mean"][:, 0] == 2).all())
        self.assertEqual((len(across.facets), len(across.cells)), (3, 6))
        both = environment.select(plane=((1.9, 0), (2, 0)), box=((0, 0), (4, 1)))
        self.assertEqual((len(both.facets), both.cells["cell"].tolist()), (1, [2, 3]))
        self.assertEqual(len(environment.select(ball=((9, 9), 1)).cells), 0)

    def test_as_the_tables_say(self):
        environment = room()
        facets, cells = environment.facets(), environment.cells()
        chosen = environment.select(box=((0.2, 0.2, 0.2), (1.5, 1.5, 1.0)))
        inside = lambda table: ((table["mean"] >= 0.2) & (table["mean"] <= [1.5, 1.5, 1.0])).all(axis=1)
        self.assertTrue((chosen.cells == cells[inside(cells)]).all())
        self.assertTrue((chosen.facets == facets[inside(facets) & (facets["neighbour"] >= 0)]).all())
        self.assertTrue(len(chosen.cells) and len(chosen.facets))

    def test_refusals(self):
        environment = plane()
        for message, part in (("takes a box, a ball, a plane or a group", {}), ("exclude each other", {"box": ((0, 0), (1, 1)), "ball": ((0, 0), 1)})):
            with self.assertRaisesRegex(cellwalk.UsageError, message):
                environment.select(**part)
        for message, part in (("lower one in all coordinates", {"box": ((0, 1), (1, 0))}), ("positive number", {"ball": ((0, 0), 0)}),
                              ("positive number", {"ball": ((0, 0), numpy.inf)}), ("normal cannot be zero", {"plane": ((0, 0), (0, 0))}),
                              ("box has a coordinate", {"box": ((0, numpy.nan), (1, 1))}), ("plane has a", {"plane": ((0, 0), (numpy.inf, 0))})):
            with self.assertRaisesRegex(ValueError, message):
                environment.select(**part)
        with self.assertRaisesRegex(ValueError, r"box has shape \(2, 3\): \(N, 2\) is needed"):
            environment.select(box=((0, 0, 0), (1, 1, 1)))
        for message, part in (("ball must be a pair of a point and a number", {"ball": 3}), ("plane must be real numbers", {"plane": "x"})):
            with self.assertRaisesRegex(TypeError, message):
                environment.select(**part)

if __name__ == "__main__":
    unittest.main()
