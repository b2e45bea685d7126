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
        plane = cellwalk.Environment(points, numpy.array(cells))
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

    def test_refusals(self):
        with self.assertRaisesRegex(cellwalk.OutsideError, "vertex 1") as caught:
            cellwalk.Body(self.environment, TETRAHEDRON + 3.5, faces=FACES)
        self.assertEqual(caught.exception.code, 5)
        with self.assertRaisesRegex(ValueError, "edges has 3 columns"):
            cellwalk.Body(self.environment, TETRAHEDRON, FACES)
        with self.assertRaisesRegex(ValueError, "targets has 3 rows, and the body has 4"):
            self.body.step(numpy.zeros((3, 3)))
        targets = self.body.positions.copy()
        targets[2, 1] = numpy.inf
        with self.assertRaisesRegex(ValueError, "the target of vertex 2 is not finite"):
            self.body.step(targets)
        with self.assertRaisesRegex(IndexError, "no vertex 4"):
            self.body.move_vertex(4, [1.0, 1.0, 1.0])
        self.assertTrue((self.body.positions == TETRAHEDRON + 1.5).all())

    def test_from_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "line.csv"
            path.write_text("x,y,z\n0.5,0.5,0.5\n1.5,0.5,0.5\n1.5,1.5,0.5\n")
            body = cellwalk.Body.read(self.environment, path)
        self.assertEqual(body.edges.tolist(), [[0, 1], [1, 2]])


if __name__ == "__main__":
    unittest.main()
