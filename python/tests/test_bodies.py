# SPDX-License-Identifier: LGPL-3.0-or-later
"""Bodies: placed, moved, held back by walls, and refused where they cross one."""

import pathlib
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk import Feature

TETRAHEDRON = numpy.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
FACES = numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
BY_RULE = {"rule": "reject_at_target", "report": "blocked"}


class Bodies(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("hexes", cells=4)
        self.body = cellwalk.Body(self.environment, TETRAHEDRON + 1.5, faces=FACES)

    def test_what_it_is_made_of(self):
        self.assertEqual((len(self.body), len(self.body.edges), len(self.body.faces)), (4, 6, 4))
        self.assertTrue((self.body.positions == TETRAHEDRON + 1.5).all())
        wire = cellwalk.Body(self.environment, TETRAHEDRON + 1.5, numpy.array([[0, 1], [2, 1]]))
        self.assertEqual(wire.edges.tolist(), [[0, 1], [1, 2]])
        self.assertEqual(wire.faces.shape, (0, 3))

    def test_a_fall_ends_on_the_floor(self):
        view = self.body.positions
        met = []
        for _ in range(30):
            met.append(self.body.step(view + [0.0, 0.0, -0.125], sweep="faces"))
        contacts = numpy.concatenate(met)
        self.body.validate()
        self.assertGreater(len(contacts), 0)
        self.assertEqual(contacts["point"][0, 2], 0)
        self.assertTrue((contacts["normal"] == [0, 0, 1]).all())
        self.assertTrue((view[:, 2] >= 0).all())
        self.assertEqual(view[0, 2], 0)
        self.assertEqual(self.body.counts["moves"], 4 * 30)
        self.assertEqual(self.body.counts["contacts"], len(contacts))

    def test_an_edge_meets_a_corner_that_no_vertex_meets(self):
        points = numpy.array([[x, y] for y in range(4) for x in range(4)], dtype=float)
        cells = [[x + 4 * y, x + 1 + 4 * y, x + 5 + 4 * y, x + 4 + 4 * y] for y in range(3) for x in range(3)]
        del cells[4]
        plane = cellwalk.Environment.from_arrays(points, numpy.array(cells))
        bar = cellwalk.Body(plane, numpy.array([[0.5, 0.5], [2.5, 0.5]]), numpy.array([[0, 1]]))
        contacts = bar.move_vertex(1, [2.5, 2.5])
        self.assertEqual(contacts["body"].tolist(), [Feature.EDGE])
        self.assertAlmostEqual(contacts["time"][0], 1 / 3, delta=1e-15)
        self.assertEqual(bar.positions.tolist(), [[0.5, 0.5], [2.5, 0.5]])
        self.assertEqual(len(bar.move_vertex(1, [2.5, 0.75])), 0)
        self.assertEqual(bar.positions[1].tolist(), [2.5, 0.75])
        bar.validate()

    def test_the_same_steps_give_the_same_bytes(self):
        other = cellwalk.Body(self.environment, TETRAHEDRON + 1.5, faces=FACES)
        rng = numpy.random.default_rng(5)
        count = 0
        for _ in range(50):
            motion = rng.uniform(-0.5, 0.5, 3)
            a = self.body.step(self.body.positions + motion)
            b = other.step(other.positions + motion)
            self.assertEqual(a.tobytes(), b.tobytes())
            count += len(a)
        self.assertGreater(count, 10)
        self.body.validate()

    def test_the_rule_of_the_paper_against_walks_and_sweeps(self):
        """Edges at their targets decide as questions about the same motions do, vertex by vertex."""
        environment = cellwalk.Environment.generate("hexes", cells=6, solid=0.1)
        rng = numpy.random.default_rng(11)
        shape = 0.6 * (TETRAHEDRON - 0.25)
        for sweep in ("three_segments", "triangle"):
            seen = dict.fromkeys(("vertex", "edge", "swept", "free"), 0)
            for _ in range(60):
                try:
                    body = cellwalk.Body(environment, shape + rng.uniform(0.5, 5.5, 3), faces=FACES)
                except cellwalk.OutsideError:
                    continue
                for _ in range(10):
                    targets = body.positions + rng.uniform(-0.5, 0.5, 3) + rng.uniform(-0.1, 0.1, (4, 3))
                    expected, now = [], body.positions.copy()
                    for vertex in range(4):
                        expected.append(self.rule(environment, now, vertex, targets[vertex], body, sweep))
                        if not (expected[-1][0] or expected[-1][1]):
                            now[vertex] = targets[vertex]
                    rows = body.step(targets, sweep=sweep, **BY_RULE)
                    self.assertEqual(body.positions.tobytes(), now.tobytes())
                    told = {row["vertex"]: row for row in rows}
                    self.assertEqual(list(told), sorted(told))
                    for vertex, (is_blocked, edges, swept) in enumerate(expected):
                        row = told.get(vertex)
                        self.assertEqual(row is not None, bool(is_blocked or edges or swept))
                        if row is None:
                            seen["free"] += 1
                            continue
                        self.assertEqual(bool(row["is_vertex_blocked"]), is_blocked)
                        self.assertEqual((row["edges"], row["swept_edges"]), (edges, swept))
                        self.assertEqual(bool(row["stays"]), bool(is_blocked or edges))
                        self.assertEqual(row["cell"] >= 0, bool(row["stays"]))
                        self.assertEqual(numpy.isnan(row["time"]), not row["stays"])
                        seen["vertex"] += is_blocked
                        seen["edge"] += edges != 0
                        seen["swept"] += swept != 0
                body.validate()
            least = {"vertex": 150, "edge": 40, "swept": 40 if sweep == "triangle" else 0, "free": 1500}
            for what, count in least.items():
                self.assertGreaterEqual(seen[what], count, f"{sweep}: {what}")

    @staticmethod
    def rule(environment, positions, vertex, target, body, sweep):
        """Whether a wall is in the way of a vertex, of which edges where it goes, and of which on the way."""
        start, end = positions[vertex : vertex + 1], target[None, :].copy()
        if environment.walk(start, end).status[0] == cellwalk.Status.CONTACT:
            return True, 0, 0
        edges = swept = 0
        for i, other in enumerate(body.neighbours(vertex)):
            q = positions[other : other + 1]
            if environment.walk(end, q).status[0] == cellwalk.Status.CONTACT:
                edges |= 1 << i
            if sweep == "triangle" and environment.sweep(start, end, q).status[0] == cellwalk.Status.CONTACT:
                swept |= 1 << i
        return False, edges, swept

    def test_what_blocks_at_once(self):
        rows = self.body.step(self.body.positions + [0.0, 0.0, 3.0], **BY_RULE)
        self.assertEqual(rows["vertex"].tolist(), [0, 1, 2, 3])
        self.assertTrue(rows["is_vertex_blocked"].all() and rows["stays"].all())
        self.assertTrue((rows["point"][:, 2] == 4).all() and (rows["normal"] == [0, 0, -1]).all())
        self.assertEqual(rows["kind"].tolist(), [Feature.FACET] * 4)
        self.assertTrue((self.body.positions == TETRAHEDRON + 1.5).all())
        self.assertEqual(len(self.body.step(self.body.positions + [0.0, 0.0, 1.5], **BY_RULE)), 0)
        self.assertEqual(self.body.positions[3, 2], 4, "touching is free")
        self.assertEqual(self.body.counts["contacts"], 4)

    def test_refusals(self):
        with self.assertRaisesRegex(cellwalk.OutsideError, "vertex 1") as caught:
            cellwalk.Body(self.environment, TETRAHEDRON + 3.5, faces=FACES)
        self.assertEqual(caught.exception.code, 5)
        with self.assertRaisesRegex(ValueError, r"edges has shape \(4, 3\): \(N, 2\) is needed"):
            cellwalk.Body(self.environment, TETRAHEDRON, FACES)
        with self.assertRaisesRegex(ValueError, r"targets has shape \(3, 3\): \(4, 3\), a row for each of the vertices, is needed"):
            self.body.step(numpy.zeros((3, 3)))
        targets = self.body.positions.copy()
        targets[2, 1] = numpy.inf
        with self.assertRaisesRegex(ValueError, "the target of vertex 2 is not finite"):
            self.body.step(targets)
        with self.assertRaisesRegex(IndexError, "no vertex 4"):
            self.body.move_vertex(4, [1.0, 1.0, 1.0])
        with self.assertRaisesRegex(IndexError, "no vertex 9"):
            self.body.neighbours(9)
        with self.assertRaisesRegex(ValueError, "the target of vertex 2 is not finite"):
            self.body.step(targets, **BY_RULE)
        with self.assertRaisesRegex(cellwalk.UsageError, "needs rule=.reject_at_target"):
            self.body.step(self.body.positions, report="blocked")
        with self.assertRaisesRegex(cellwalk.UsageError, "rule.*stay"):
            self.body.step(self.body.positions, rule="stay")
        angles = numpy.arange(66) / 10
        star = numpy.stack([2 + numpy.cos(angles), 2 + numpy.sin(angles), 1 + angles / 10], axis=1)
        star[0] = 2.0
        spokes = numpy.array([[0, i] for i in range(1, 66)])
        many = cellwalk.Body(self.environment, star, spokes)
        with self.assertRaisesRegex(cellwalk.UsageError, "vertex 0 has 65 edges: rule=.reject_at_target. takes at most 64"):
            many.step(star, **BY_RULE)
        self.assertEqual(many.neighbours(0).tolist(), list(range(1, 66)))
        self.assertEqual(len(cellwalk.Body(self.environment, star[:-1].copy(), spokes[:-1].copy()).step(star[:-1].copy(), **BY_RULE)), 0)
        self.assertTrue((self.body.positions == TETRAHEDRON + 1.5).all())

    def test_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "line.csv"
            path.write_text("x,y,z\n0.5,0.5,0.5\n1.5,0.5,0.5\n1.5,1.5,0.5\n")
            body = cellwalk.Body.read(self.environment, path)
        self.assertEqual(body.edges.tolist(), [[0, 1], [1, 2]])


if __name__ == "__main__":
    unittest.main()
