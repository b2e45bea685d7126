# SPDX-License-Identifier: LGPL-3.0-or-later
"""Edits in a with statement: by hand, what the environment says afterwards, and what is refused."""

import unittest

import numpy

import cellwalk
from cellwalk import Feature, Place, Status
from edit_worlds import plane, room, thread, walls_inside


class ByHand(unittest.TestCase):
    """Squares with a thread from cell 5 to cell 6, a particle in no cell and one in cell 0."""

    def setUp(self):
        self.environment = plane()
        other = thread(self.environment, [3.5, 2.25], [3.5, 2.75])
        self.bodies = [other, thread(self.environment, [1.5, 1.5], [2.5, 1.5])]
        self.particles = cellwalk.Particles(self.environment, numpy.array([[9.0, 9.0], [0.5, 0.5]]))
        self.valve = self.environment.select(box=((2, 0), (2, 3))).facets

    def editing(self):
        return self.environment.editing(bodies=self.bodies, particles=[self.particles])

    def test_facets(self):
        self.assertEqual(self.valve["cell"].tolist(), [1, 5, 9])
        with self.editing() as edits:
            closed = edits.close(self.valve)
            self.assertEqual(closed.made.tolist(), [True, False, True])
            self.assertEqual(closed.reasons, ["", "something lies on both sides of the facet", ""])
            self.assertEqual((len(closed), repr(closed)), (3, "<cellwalk.Changes, 2 of 3 made>"))
            held = closed.held_by
            self.assertEqual([(h["row"], h["is_particle"], h["owner"], h["body"], h["feature"]) for h in held], [(1, False, 1, Feature.EDGE, 0)])
            self.assertEqual(walls_inside(self.environment), 2)
            self.assertTrue(edits.close(self.valve[[0]]).made.all(), "a wall stays one")
        motions = self.environment.walk(numpy.array([[1.5, 0.5], [1.5, 1.5]]), numpy.array([[2.5, 0.5], [2.5, 1.5]]))
        self.assertEqual(motions.status.tolist(), [Status.CONTACT, Status.FREE])
        self.assertEqual(self.environment.certificate["membranes"], 2)
        self.bodies[1].step(self.bodies[1].positions - [1.25, 0])
        with self.editing() as edits:
            self.assertTrue(edits.close(self.valve).made.all())
            contacts = motions.contacts
            self.assertTrue(edits.open(contacts).made.all(), "a contact names its wall")
            self.assertEqual(walls_inside(self.environment), 2)
            self.assertTrue(edits.open([(5, int(self.valve["facet"][1])), (9, int(self.valve["facet"][2]))]).made.all())
            self.assertEqual(walls_inside(self.environment), 0)
            boundary = self.environment.facets()
            boundary = boundary[boundary["neighbour"] == -1]
            opened = edits.open(boundary)
            self.assertFalse(opened.made.any())
            self.assertIn("boundary", opened.reasons[0])
        for body in self.bodies:
            body.validate()

    def test_cells(self):
        with self.editing() as edits:
            filled = edits.fill(self.environment.cells())
            self.assertEqual(numpy.flatnonzero(~filled.made).tolist(), [0, 5, 6, 11])
            self.assertEqual(filled.reasons[5], "something lies in the cell")
            held = {(h["row"], h["is_particle"], h["owner"], h["body"], h["feature"]) for h in filled.held_by}
            self.assertEqual(held, {(0, True, 0, Feature.VERTEX, 1), (5, False, 1, Feature.VERTEX, 0), (5, False, 1, Feature.EDGE, 0),
                                    (6, False, 1, Feature.VERTEX, 1), (6, False, 1, Feature.EDGE, 0), (11, False, 0, Feature.VERTEX, 0),
                                    (11, False, 0, Feature.VERTEX, 1)})
            self.assertTrue(edits.excavate([1, 2]).made.all())
            self.assertEqual(numpy.flatnonzero(self.environment.cells()["solid"]).tolist(), [3, 4, 7, 8, 9, 10])
            self.assertEqual(len(edits.fill([])), 0)
        self.assertEqual(self.environment.locate(numpy.array([[3.5, 0.5], [1.5, 0.5]])).status.tolist(), [Place.SOLID, Place.FREE])
        self.assertEqual(self.particles.move(numpy.array([[9.0, 9.0], [0.5, 1.5]])).status.tolist(), [Status.OUTSIDE, Status.CONTACT])

    def test_rows_whose_cells_were_replaced(self):
        environment = room()
        cells, facets = environment.cells(), environment.facets()
        shared = facets[facets["cell"] == 7]
        with environment.editing() as edits:
            edits.insert_point(7, cells["mean"][7])
            filled = edits.fill(cells[6:9])
            self.assertEqual((filled.made.tolist(), filled.reasons), ([True, False, True], ["", "it was replaced by others", ""]))
            self.assertTrue(edits.fill([7]).made.all(), "the number is that of a new cell")
            inside = shared[shared["neighbour"] > 8]
            self.assertGreater(len(inside), 0)
            for row in inside:
                again = edits.close([row])
                self.assertTrue(again.made[0] or again.reasons == ["it was replaced by others"])
            for call in (lambda: edits.insert_point(cells[7], cells["mean"][7]), lambda: edits.split_vertex(0, cells[[7]], (1, 1, 1))):
                with self.assertRaisesRegex(cellwalk.UsageError, "replaced by others: list them again"):
                    call()


class Replacing(unittest.TestCase):
    def test_insert_flip_split_and_collapse(self):
        environment = cellwalk.Environment.generate("triangles", cells=(2, 2))
        view = environment.points
        with environment.editing() as edits:
            row = environment.cells()[0]
            inserted = edits.insert_point(row, row["mean"])
            self.assertTrue(inserted and inserted.made and inserted.reason == "")
            self.assertEqual((inserted.point, inserted.cells.tolist()), (9, [0, 8, 9]))
            self.assertEqual(environment.points[9].tolist(), row["mean"].tolist())
            self.assertEqual((environment.cell_count, repr(inserted)), (10, "<cellwalk.Replacement, 3 cells>"))
            refused = edits.insert_point(0, row["mean"])
            self.assertFalse(refused)
            self.assertEqual((refused.point, len(refused.cells)), (None, 0))
            self.assertIn("refused: ", repr(refused))
            facets = environment.facets()
            flat = facets[facets["neighbour"] >= 0]
            made = [edits.flip(f) for f in flat[:1]]
            self.assertTrue(all(len(m.cells) == 2 and m.point is None for m in made if m))
            self.assertFalse(edits.flip(facets[facets["neighbour"] == -1][0]))
            corner = int(row["points"][0])
            removed = edits.collapse(9, corner)
            self.assertEqual((removed.made, removed.point), (True, 9))
            self.assertEqual(environment.cell_count, 8)
            facets = environment.facets()
            inner = facets[facets["neighbour"] >= 0][0]
            split = edits.split_edge(*map(int, inner["points"]), inner["mean"])
            self.assertEqual((split.made, split.point, len(split.cells)), (True, 9, 4))
        self.assertEqual(environment.certificate["cells"], environment.cell_count)
        self.assertEqual(len(view), 9, "an earlier view stays as it was")

    def test_remove_edge_and_relax(self):
        environment = cellwalk.Environment.generate("tets", cells=(3, 3, 3), jitter=0.15)
        points = numpy.arange(len(environment.points))
        with environment.editing() as edits:
            report = edits.relax(points, good_enough=0.5)
            self.assertGreater(report.operations, 0)
            self.assertGreaterEqual(report.least_after, report.least_before)
            self.assertEqual(edits.relax(points[:0]).operations, 0)
            nothing = edits.relax(points, good_enough=0.9, smooth=False, flip=False, split=False, collapse=False)
            self.assertEqual((nothing.operations, nothing.tried > 0), (0, True))
            one = edits.relax(points, good_enough=0.9, most_operations=1)
            self.assertEqual(one.operations, 1)
            tried = [edits.remove_edge(*map(int, row["points"][:2])) for row in environment.cells()[:8]]
            self.assertTrue(all(t.made == (t.reason == "") == (len(t.cells) > 0) for t in tried))
            self.assertIn("", [t.reason for t in tried])
            self.assertGreater(edits.counts["made"], 0)
        environment.certificate

    def test_cuts(self):
        environment = room((3, 3, 3))
        with environment.editing() as edits:
            edits.fill(environment.cells())
            blade = numpy.array([[1.4, -1, -1], [1.4, 4, -1], [1.4, 4, 4], [1.4, -1, 4]])
            report = edits.cut(blade, opening=0.05)
            self.assertEqual((report.refused, report.edges), (0, report.split + report.snapped))
            self.assertGreater(report.opened, 0)
            self.assertGreater(report.facets, 0)
            made = report.points
            self.assertTrue((made["point"] >= 64).all() and (made["share"] <= 1).all())
            taken_back = made[made["between"][:, 0] == made["between"][:, 1]]
            on_edges = made[made["between"][:, 0] != made["between"][:, 1]]
            self.assertEqual((len(on_edges), len(taken_back) > 0), (report.split, True))
            for row in on_edges:
                a, b = environment.points[row["between"]]
                self.assertAlmostEqual((a + row["share"] * (b - a))[0], environment.points[row["point"], 0])
            self.assertLess(environment.cells()["solid"].sum(), environment.cell_count)
            self.assertGreater(report.cells, 0)
            self.assertEqual(report.slit, 0)
        self.assertGreater(environment.certificate["free_volume"], 0)
        # The gap is sewn up, but for where a particle stands.
        pairs = [(int(row["point"]), int(row["between"][0])) for row in taken_back[::-1]]
        cells = environment.cells()
        gap = cells[~cells["solid"] & (numpy.isin(cells["points"], pairs[0]).sum(axis=1) == 2)]
        particle = cellwalk.Particles(environment, gap["mean"][:1])
        with environment.editing(particles=[particle]) as edits:
            held = edits.merge_vertices(*pairs[0])
            self.assertEqual((held.made, held.point), (False, None))
            self.assertIn("something lies", held.reason)
            self.assertEqual(held.held_by[["is_particle", "owner", "feature"]].tolist(), [(True, 0, 0)])
        with environment.editing() as edits:
            merged = [edits.merge_vertices(*pair) for pair in pairs]
            self.assertTrue(all(m.made and m.point == p and not len(m.held_by) for m, (p, _) in zip(merged, pairs)))
            with self.assertRaisesRegex(cellwalk.UsageError, "not with itself"):
                edits.merge_vertices(0, 0)
        self.assertEqual(environment.certificate["free_volume"], 0)

    def test_slits(self):
        environment = room((4, 4, 4))
        facets = environment.facets()
        with environment.editing() as edits:
            edits.close(facets[facets["mean"][:, 2] == 2])
            blade = numpy.array([[2.3, 0.7, 1], [2.3, 3.1, 1], [2.3, 3.1, 3], [2.3, 0.7, 3]])
            report = edits.cut(blade, opening=0.1)
            self.assertGreater(report.slit, 5)
            self.assertEqual((report.facets, report.refused), (0, 0))
        self.assertEqual(environment.certificate["components"], 1)


class Refusals(unittest.TestCase):
    def setUp(self):
        self.environment = room()

    def refused(self, error, message, call):
        before = self.environment.facets().tobytes()
        with self.environment.editing() as edits:
            with self.assertRaisesRegex(error, message):
                call(edits)
            self.assertEqual(self.environment.facets().tobytes(), before)

    def test_names(self):
        wall = self.environment.select(box=((1, 0, 0), (1, 2, 2))).facets[:1]
        first = [int(wall["cell"][0]), int(wall["facet"][0])]
        self.refused(ValueError, r"facets\[1\]: there is no cell 48", lambda e: e.close([first, [48, 0]]))
        self.refused(ValueError, r"facets\[1\]: there is no cell -1", lambda e: e.close([first, [-1, 0]]))
        self.refused(ValueError, r"facets\[1\]: cell 3 has no facet 4, but 4, numbered from 0", lambda e: e.close([first, [3, 4]]))
        self.refused(ValueError, r"facets\[0\]: cell 3 has no facet -1", lambda e: e.open([[3, -1]]))
        self.refused(ValueError, r"cells\[1\]: there is no cell 99", lambda e: e.fill([0, 99]))
        self.refused(ValueError, r"facets has shape \(3,\): \(N, 2\) is needed", lambda e: e.close(numpy.array([1, 2, 3])))
        self.refused(TypeError, r"facets must be .*and is float64", lambda e: e.close(numpy.zeros((2, 2))))
        self.refused(TypeError, "facets must be", lambda e: e.close(None))
        self.refused(TypeError, r"cells must be integers \(N,\), or rows of cells\(\), and is float64 of shape \(1,\)", lambda e: e.fill([0.5]))
        self.refused(ValueError, r"cells has shape \(1, 2\): \(N,\) is needed", lambda e: e.fill([[1, 2]]))
        self.refused(ValueError, "facet names 2 of them: give one", lambda e: e.flip([first, first]))
        self.refused(ValueError, "cell names 0 of them: give one", lambda e: e.insert_point([], (1, 1, 1)))

    def test_positions_points_and_blades(self):
        self.refused(ValueError, r"position has shape \(2,\): \(3,\) is needed", lambda e: e.insert_point(0, (1, 1)))
        self.refused(TypeError, "target must be real numbers.* and is NoneType", lambda e: e.split_vertex(0, [0], None))
        self.refused(cellwalk.InputError, "not finite", lambda e: e.insert_point(0, (numpy.nan, 0, 0)))
        self.refused(cellwalk.UsageError, "there is no edge", lambda e: e.split_edge(0, 26, (1, 1, 1)))
        self.refused(cellwalk.UsageError, "there is no", lambda e: e.collapse(99, 0))
        self.refused(cellwalk.UsageError, "cell 5 is no solid simplex with point 0", lambda e: e.split_vertex(0, [5], (1, 1, 1)))
        self.refused(ValueError, r"points\[1\] is 27: there are 27 points", lambda e: e.relax([0, 27]))
        blade = numpy.array([[1.5, -1, -1], [1.5, 4, -1], [1.5, 4, 4]])
        self.refused(cellwalk.UsageError, "pieces and sweep exclude", lambda e: e.cut(blade, pieces=numpy.array([[0, 1, 2]]), sweep=(0, 0, 1)))
        self.refused(ValueError, r"pieces has shape \(1, 2\): \(N, 3\) is needed", lambda e: e.cut(blade, pieces=numpy.array([[0, 1]])))
        self.refused(ValueError, r"pieces\[0, 2\] is 3", lambda e: e.cut(blade, pieces=numpy.array([[0, 1, 3]])))
        self.refused(cellwalk.InputError, "opened by a positive length", lambda e: e.cut(blade, opening=0.0))
        self.refused(cellwalk.InputError, "a blade has at least", lambda e: e.cut(blade[:2].copy()))
        self.refused(cellwalk.InputError, "not convex at corner", lambda e: e.cut(numpy.array([[1.5, -1, -1], [1.5, 4, 4], [1.5, 4, -1], [1.5, -1, 4.0]])))
        self.refused(cellwalk.InputError, "off the plane of others", lambda e: e.cut(numpy.array([[1.5, -1, -1], [1.5, 4, -1], [1.5, 4, 4], [2.5, -1, 4.0]])))
        self.refused(TypeError, "blade must be real numbers", lambda e: e.cut(blade.astype(complex)))
        with plane().editing() as edits:
            with self.assertRaisesRegex(cellwalk.UsageError, "sweep is for 3D"):
                edits.cut(numpy.zeros((2, 2)), sweep=(0, 1))

    def test_cells_that_are_no_simplices(self):
        environment = plane()
        with environment.editing() as edits:
            with self.assertRaisesRegex(cellwalk.UsageError, "is not a simplex"):
                edits.flip((0, 1))


if __name__ == "__main__":
    unittest.main()
