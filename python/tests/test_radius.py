# SPDX-License-Identifier: LGPL-3.0-or-later
"""Motions and bodies with a radius: answers that are known by heart, and what is refused."""

import itertools
import pathlib
import pickle
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk import Feature, Status
from edit_worlds import thread


def boxes(*planes, left_out=()):
    """The boxes between planes across each axis, without some of them."""
    points = numpy.array(list(itertools.product(*planes)), dtype=float)
    strides = [int(numpy.prod([len(p) for p in planes[k + 1 :]])) for k in range(len(planes))]
    loop = [(0, 0), (1, 0), (1, 1), (0, 1)]
    corners = loop if len(planes) == 2 else [(x, y, z) for z in (0, 1) for x, y in loop]
    cells = [[sum((at + step) * stride for at, step, stride in zip(cell, corner, strides)) for corner in corners]
             for cell in itertools.product(*(range(len(p) - 1) for p in planes)) if cell not in left_out]
    return cellwalk.Environment.from_arrays(points, numpy.array(cells))


def with_membrane(dimension):
    """The room [0,8]^3, or the square, in which the facet x = 4, 2 <= y, z <= 6 is a wall."""
    environment = boxes([0, 2, 4, 6, 8], *[[0, 2, 6, 8]] * (dimension - 1))
    membrane = environment.select(box=((4, *[2] * (dimension - 1)), (4, *[6] * (dimension - 1)))).facets
    with environment.editing() as edits:
        assert len(membrane) == 1 and edits.close(membrane).made.all()
    return environment


# Radius, motion of p to t with q at rest, and the answer: free, or the nearest wall's distance, or time, kinds and normal.
FREE = "free"
ULP = 2.0**-51
IN_A_ROOM = {
    "touch_ends": (1, (2, 4, 4), (3, 4, 4), (2, 5, 4), FREE),
    "touch_and_one_ulp": (1, (2, 4, 4), (3 + ULP, 4, 4), (2, 5, 4), (0.9999999999999996, Feature.VERTEX, Feature.FACET, (-1, 0, 0))),
    "starts_at_r_leaves": (1, (3, 4, 4), (2, 4, 4), (3, 5, 4), FREE),
    "starts_at_r_enters": (1, (3, 4, 4), (4, 4, 4), (3, 5, 4), (0, Feature.VERTEX, Feature.FACET, (-1, 0, 0))),
    "beyond_two_walls": (1, (2, 4, 4), (10, 4, 4), (2, 5, 4), (1 / 8, Feature.VERTEX, Feature.FACET, (-1, 0, 0))),
    "past_the_rim_at_r": (1, (2, 7, 4), (6, 7, 4), (2, 7, 5), FREE),
    "past_the_rim_too_near": (1, (2, 7 - 4 * ULP, 4), (6, 7 - 4 * ULP, 4), (2, 7 - 4 * ULP, 5),
                              (0.4999999850988388, Feature.VERTEX, Feature.EDGE, (0, 1, 0))),
    "past_a_rim_corner": (1, (2, 7, 7), (6, 6.5, 6.5), (2, 7, 6.5),
                          (0.6058952099257188, Feature.EDGE, Feature.VERTEX, (0.039008, 0.745124, 0.665784))),
    "rod_turns_about_rim": (1, (1, 7, 4), (2, 4, 4), (5, 7, 4), (0, Feature.EDGE, Feature.EDGE, (0, 1, 0))),
    "too_close_elsewhere": (1, (1, 7.25, 4), (1, 4, 4), (5, 7, 4), 0.75),
    "corner_of_room_three_walls": (1, (2, 2, 2), (0, 0, 0), (3, 3, 3), (1 / 2, Feature.VERTEX, Feature.FACET, (1, 0, 0))),
    "corner_reached_exactly": (1, (2, 2, 2), (1, 1, 1), (3, 3, 3), FREE),
    "starts_too_close": (1, (3.5, 4, 4), (2, 4, 4), (2, 5, 4), 0.5),
    "edge_crosses_membrane": (1, (2, 4, 4), (2, 5, 4), (6, 4, 4), 0),
    "still_point": (1, (3, 4, 4), (3, 4, 4), (3, 4, 4), FREE),
    "passes_through_q": (1, (2.5, 4, 4), (2.5, 4, 0), (2.5, 4, 3), (3 / 4, Feature.VERTEX, Feature.FACET, (0, 0, 1))),
    "r_larger_than_room": (100, (2, 4, 4), (2, 5, 4), (2, 4, 5), 2),
    "tiny_r": (5e-324, (2, 4, 4), (6, 4, 4), (2, 5, 4), (0.49999999999999994, Feature.VERTEX, Feature.FACET, (-1, 0, 0))),
    "huge_r": (1e308, (2, 4, 4), (6, 4, 4), (2, 5, 4), 2),
}
IN_A_SQUARE = {
    "membrane_both_sides": (1, (3, 4), (3, 5), (3, 2), FREE),
    "round_the_end": (1, (2, 7), (5, 6), (4, 7), (0, Feature.EDGE, Feature.VERTEX, (0, 1))),
    "start_close": (1, (2, 4), (6, 7), (4, 7), 0.5547001962252291),
    "end_by_quadratic": (1, (2, 5), (4, 6), (2, 7), (1 / 2, Feature.VERTEX, Feature.FACET, (-1, 0))),
}
OVER_A_STEP = {
    "over_convex_edge": (1, (2, 4, 5), (6, 4, 5), (2, 5, 5), FREE),
    "over_convex_edge_below": (1, (2, 4, 4.5), (6, 4, 4.5), (2, 5, 4.5),
                               (0.2834936490538903, Feature.VERTEX, Feature.EDGE, (-0.866025, 0, 0.5))),
    "along_reflex_edge": (1, (3, 2, 1), (3, 6, 1), (3, 1, 1), FREE),
    "rod_edge_on_convex_edge": (1, (2, 4, 7), (7, 4, 4), (2, 4, 2),
                                (0.35520818569092444, Feature.EDGE, Feature.EDGE, (-0.911438, 0, 0.411438))),
}
IN_A_CHANNEL = {
    "channel_exactly_2r": (1, (2, 4, 1), (6, 4, 1), (1, 4, 1), FREE),
    "channel_exactly_2r_up": (1, (2, 4, 1), (6, 4, 1 + ULP / 2), (1, 4, 1), (0, Feature.VERTEX, Feature.FACET, (0, 0, -1))),
    "channel_less_than_2r": (1 + 2 * ULP, (2, 4, 1), (6, 4, 1), (3, 4, 1), 1),
}


class Sweeps(unittest.TestCase):
    def check(self, environment, cases):
        radii = numpy.array([case[0] for case in cases.values()], dtype=float)
        p, t, q = (numpy.array([case[k] for case in cases.values()], dtype=float) for k in (1, 2, 3))
        motions = environment.sweep(p, t, q, radius=radii)
        for row, (name, case) in enumerate(cases.items()):
            with self.subTest(name):
                self.row(motions, row, case)
                self.row(environment.sweep(p[[row]], t[[row]], q[[row]], radius=case[0]), 0, case)

    def row(self, motions, row, case):
        answer = case[4]
        rows = motions.contacts[motions.contacts["row"] == row]
        if answer == FREE:
            self.assertEqual((motions.status[row], motions.time[row], len(rows)), (Status.FREE, 1, 0))
            self.assertTrue(numpy.isnan(motions.distance[row]))
        elif isinstance(answer, tuple):
            time, body, kind, normal = answer
            self.assertEqual((motions.status[row], motions.time[row], len(rows)), (Status.CONTACT, time, 1))
            self.assertEqual((rows["time"][0], rows["body"][0], rows["kind"][0]), (time, body, kind))
            numpy.testing.assert_allclose(rows["normal"][0], normal, atol=1e-6)
            self.assertTrue(numpy.isnan(motions.distance[row]))
        else:
            self.assertEqual((motions.status[row], motions.cell[row]), (Status.CLOSE, -1))
            self.assertTrue(answer * (1 - 1e-15) <= motions.distance[row] <= answer, "rounded down")
            self.assertTrue(numpy.isnan(motions.time[row]) and numpy.isnan(rows["time"][0]))
            self.assertLessEqual(numpy.linalg.norm(rows["point"][0] - numpy.array(case[1])), 8, "a point of the wall")

    def test_a_room(self):
        self.check(with_membrane(3), IN_A_ROOM)

    def test_a_square(self):
        self.check(with_membrane(2), IN_A_SQUARE)

    def test_a_step(self):
        self.check(boxes([0, 4, 8], [0, 8], [0, 4, 8], left_out=[(1, 0, 0)]), OVER_A_STEP)

    def test_a_channel(self):
        self.check(boxes([0, 8], [0, 8], [0, 2]), IN_A_CHANNEL)

    def test_a_point(self):
        room = with_membrane(3)
        starts = numpy.array([[2.0, 4, 4], [3.5, 4, 4]])
        motions = room.walk(starts, starts + [4, 0, 0], radius=1.0)
        self.assertEqual(motions.status.tolist(), [Status.CONTACT, Status.CLOSE])
        self.assertEqual((motions.time[0], motions.distance[1]), (0.25, 0.5))
        self.assertEqual(motions.contacts["normal"].tolist(), [[-1, 0, 0], [0, 0, 0]])
        self.assertEqual(motions.contacts["point"].tolist(), [[4, 4, 4]] * 2)

    def test_a_radius_of_0_is_none(self):
        environment = cellwalk.Environment.generate("hexes", cells=6, solid=0.1)
        rng = numpy.random.default_rng(3)
        p, t, q = (rng.integers(0, 25, (4000, 3)) / 4 for _ in range(3))
        nothing = numpy.zeros(len(p))
        for ask in (lambda **radius: environment.walk(p, t, **radius), lambda **radius: environment.sweep(p, t, q, **radius)):
            without = ask()
            for radius in (0, 0.0, -0.0, nothing, -nothing):
                motions = ask(radius=radius)
                for name in ("status", "time", "cell", "cells", "contacts", "distance"):
                    self.assertEqual(getattr(motions, name).tobytes(), getattr(without, name).tobytes(), name)
                self.assertEqual(motions.counts, without.counts)


class Bodies(unittest.TestCase):
    def setUp(self):
        self.environment = with_membrane(3)
        self.points = numpy.array([[2.0, 4, 4], [2, 5, 4], [2, 3, 4]])

    def fork(self, radius):
        """An edge to y = 5 and one to y = 3; rows that are not in order, one of them twice."""
        return cellwalk.Body(self.environment, self.points, numpy.array([[2, 0], [0, 1], [0, 2]]), radius=radius)

    def test_radii_are_those_of_rows_of_edges(self):
        self.assertEqual(self.fork(0.5).radii.tolist(), [0.5, 0.5])
        fork = self.fork(numpy.array([0.25, 1, 0.5]))
        self.assertEqual((fork.edges.tolist(), fork.radii.tolist()), ([[0, 1], [0, 2]], [1, 0.5]))
        fork.radii[:] = 9
        self.assertEqual(fork.radii.tolist(), [1, 0.5], "an array of its own")
        sail = cellwalk.Body(self.environment, self.points, numpy.array([[1, 0]]), numpy.array([[0, 1, 2]]), numpy.array([0.5]))
        self.assertEqual((sail.edges.tolist(), sail.radii.tolist()), ([[0, 1], [0, 2], [1, 2]], [0.5, 0, 0]))
        self.assertEqual(cellwalk.Body(self.environment, self.points, radius=0.5).radii.tolist(), [])
        self.assertEqual(self.fork(0).radii.tolist(), [0, 0])

    def test_each_edge_keeps_its_own(self):
        """Case 47: the edge of radius 1 is blocked at 1/4, that of 1/4 alone at 7/16."""
        for radii, time, feature in (([0, 1, 0.25], 0.25, 0), ([0.25, 0.25, 0.25], 7 / 16, None)):
            fork = self.fork(numpy.array(radii, dtype=float))
            contact = fork.move_vertex(0, [6.0, 4, 4])
            self.assertEqual((contact["time"].tolist(), contact["normal"].tolist()), ([time], [[-1, 0, 0]]))
            self.assertEqual(contact["point"].tolist(), [[4, 4, 4]])
            self.assertEqual(len(fork.move_vertex(0, [2 + 4 * time, 4, 4])), 0, "exactly at r")
            fork.validate()

    def test_a_rod_comes_to_rest_at_its_radius(self):
        rod = cellwalk.Body(self.environment, self.points + [0, 0, 1], numpy.array([[0, 1], [0, 2]]), radius=0.5)
        met = [rod.step(rod.positions - [0.0, 0.0, 0.375]) for _ in range(20)]
        contacts = numpy.concatenate(met)
        self.assertGreater(len(contacts), 10)
        self.assertTrue((contacts["normal"] == [0, 0, 1]).all())
        self.assertTrue((rod.positions[:, 2] == 0.5).all())
        rod.validate()

    def test_without_a_radius_the_same_bytes(self):
        rng = numpy.random.default_rng(5)
        bodies = [self.fork(radius) for radius in (0.0, 0, numpy.zeros(3), numpy.array([0.5, 0, 0.5]))]
        bodies[-1].set_radii(0)
        bodies.append(cellwalk.Body(self.environment, self.points, numpy.array([[0, 1], [0, 2]])))
        met = 0
        for _ in range(100):
            motion = rng.uniform(-1, 1, (3, 3))
            contacts, *others = [body.step(body.positions + motion) for body in bodies]
            for other, body in zip(others, bodies[1:]):
                self.assertEqual(other.tobytes(), contacts.tobytes())
                self.assertEqual(body.positions.tobytes(), bodies[0].positions.tobytes())
            met += len(contacts)
        self.assertGreater(met, 50)

    def test_radii_change(self):
        """Case 53: a radius may shrink, and grow up to the distance of the next wall."""
        rod = thread(self.environment, [3.0, 4, 4], [3.0, 5, 4])
        rod.set_radii(1)
        with self.assertRaisesRegex(cellwalk.OutsideError, "edge 0 of the body.* distance of 1 .*radius 1.5"):
            rod.set_radii(1.5)
        self.assertEqual(rod.radii.tolist(), [1])
        for radius in (0.5, 1, numpy.array([0.25]), 0.0):
            rod.set_radii(radius)
            self.assertEqual(rod.radii.tolist(), [radius])
        self.assertEqual(len(rod.move_vertex(0, [5.0, 3, 4])), 1, "no wall is crossed")
        fork = self.fork(0)
        fork.set_radii(numpy.array([0.25, 1]))
        self.assertEqual(fork.radii.tolist(), [0.25, 1])

    def test_clearances(self):
        fork = self.fork(0.0)
        self.assertEqual(fork.clearances(1.5).tolist(), [1.5, 1.5])
        numpy.testing.assert_allclose(fork.clearances(9), [2, 2], rtol=1e-12)
        self.assertTrue((fork.clearances(9) <= 2).all())
        fork.step(fork.positions + [1.0, 0.0, 0.0])
        numpy.testing.assert_allclose(fork.clearances(9), [1, 1], rtol=1e-12)
        self.assertEqual(fork.clearances(0).tolist(), [0, 0])
        fork.set_radii(1)
        self.assertEqual(fork.clearances(9).tolist(), [1, 1], "not below the radius")
        for up_to in (-1, numpy.inf, numpy.nan):
            with self.assertRaisesRegex(cellwalk.UsageError, "clearances take a finite number"):
                fork.clearances(up_to)

    def test_pickles_have_the_radii(self):
        fork = self.fork(numpy.array([0.25, 1, 0.5]))
        other = pickle.loads(pickle.dumps(fork))
        self.assertEqual(other.radii.tolist(), [1, 0.5])
        self.assertEqual(other.move_vertex(0, [6.0, 4, 4]).tobytes(), fork.move_vertex(0, [6.0, 4, 4]).tobytes())

    def test_files_have_radii(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "rope.csv"
            path.write_text("x,y,z,radius\n2,3,4,0.25\n2,4,4,1\n2,5,4,\n")
            self.assertEqual(cellwalk.Body.read(self.environment, path).radii.tolist(), [0.25, 1])
            path.write_text("x,y,z,radius\n2,3,4,0.25\n2,4,4,-1\n2,5,4,\n")
            with self.assertRaisesRegex(cellwalk.InputError, r"rope.csv:3: radius: takes a finite number of at least 0, not -1"):
                cellwalk.Body.read(self.environment, path)

    def test_a_facet_stays_open_round_a_thick_edge(self):
        """Case 51: it may close at exactly r."""
        membrane = self.environment.select(box=((4, 2, 2), (4, 6, 6))).facets
        for radius, reasons in ((1.0, [""]), (1 + ULP / 2, ["something is nearer to the facet than its radius"])):
            with self.environment.editing() as edits:
                self.assertTrue(edits.open(membrane).made.all())
            rod = cellwalk.Body(self.environment, numpy.array([[3.0, 3, 3], [3, 3, 3.5]]), numpy.array([[0, 1]]), radius=radius)
            with self.environment.editing(bodies=[rod]) as edits:
                closed = edits.close(membrane)
            self.assertEqual(closed.reasons, reasons)
            self.assertEqual([(held["owner"], held["body"], held["feature"]) for held in closed.held_by], [(0, Feature.EDGE, 0)] * (reasons != [""]))

    def test_refusals(self):
        with self.assertRaisesRegex(cellwalk.OutsideError, "edge 0 of the body.* distance of 2 from a wall.* less than its radius 3"):
            self.fork(3.0)
        with self.assertRaisesRegex(cellwalk.OutsideError, "vertex 0 of the body"):
            cellwalk.Body(self.environment, self.points, radius=3.0)
        for radius, error, text in ((-1, ValueError, "radius must be a finite number of at least 0, and is -1"),
                                    (numpy.nan, ValueError, "and is nan"), (numpy.inf, ValueError, "and is inf"),
                                    (numpy.ones(2), ValueError, r"radius has shape \(2,\): \(3,\), one for each of the edges, is needed"),
                                    (numpy.array([1, -2.0, 0]), ValueError, r"radius\[1\] must be"),
                                    (["0.5"] * 3, TypeError, "radius must be real numbers"), (None, TypeError, "radius must be a number, or an array")):
            with self.assertRaisesRegex(error, text):
                self.fork(radius)
        fork = self.fork(0.5)
        for radius, error, text in ((-1, ValueError, "and is -1"), (numpy.ones(3), ValueError, r"radius has shape \(3,\): \(2,\), one for each of the edges, is needed"),
                                    ("1", TypeError, "and is str")):
            with self.assertRaisesRegex(error, text):
                fork.set_radii(radius)
        self.assertEqual(fork.radii.tolist(), [0.5, 0.5])
        for words in ({"touch": "stop"}, {"search": "exhaustive"}):
            with self.assertRaises(cellwalk.UsageError):
                fork.step(fork.positions, **words)
        with self.environment.editing() as edits:
            self.assertTrue(edits.fill(self.environment.select(box=((6, 6, 6), (8, 8, 8))).cells).made.all())
            for use in (lambda: fork.radii, lambda: fork.set_radii(0), lambda: fork.clearances(1)):
                with self.assertRaisesRegex(cellwalk.UsageError, "leave the with statement"):
                    use()
        with self.assertRaisesRegex(cellwalk.UsageError, "register_again"):
            fork.set_radii(0)
        with self.assertRaisesRegex(cellwalk.UsageError, "register_again"):
            fork.clearances(1)
        self.assertEqual(fork.radii.tolist(), [0.5, 0.5])


if __name__ == "__main__":
    unittest.main()
