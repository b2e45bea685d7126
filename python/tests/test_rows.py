# SPDX-License-Identifier: LGPL-3.0-or-later
"""Moves of some particles, and of some vertices of a body: by numbers or by a mask."""

import unittest

import numpy

import cellwalk
from cellwalk import Status


def scattered(count=300, seed=5):
    return numpy.random.default_rng(seed).uniform(0.1, 3.9, (count, 3))


class Particles(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("hexes", cells=4, solid=0.1, seed=2)
        points = scattered()
        self.points = points[self.environment.locate(points).status == cellwalk.Place.FREE]
        self.targets = scattered(len(self.points), seed=6)
        self.particles = cellwalk.Particles(self.environment, self.points)

    def test_rows_of_the_result_are_those_of_the_subset(self):
        whole = cellwalk.Particles(self.environment, self.points).move(self.targets, at_contact="stop")
        self.assertEqual(set(whole.status), {Status.FREE, Status.CONTACT})
        rows = numpy.random.default_rng(7).permutation(len(self.points))[:60]
        motions = self.particles.move(self.targets[rows], rows=rows, at_contact="stop")
        self.assertEqual(len(motions), 60)
        for name in ("status", "time", "cell", "cells"):
            self.assertTrue(numpy.array_equal(getattr(motions, name), getattr(whole, name)[rows]), name)
        self.assertTrue(numpy.array_equal(motions.contacts["row"], numpy.flatnonzero(motions.status == Status.CONTACT)))
        by_row = {row: k for k, row in enumerate(whole.contacts["row"])}
        for contact in motions.contacts:
            same = whole.contacts[by_row[rows[contact["row"]]]]
            self.assertEqual((contact["time"], contact["cell"], contact["point"].tolist()), (same["time"], same["cell"], same["point"].tolist()))
        still = numpy.setdiff1d(numpy.arange(len(self.points)), rows)
        self.assertTrue((self.particles.positions[still] == self.points[still]).all())
        arrived = motions.status == Status.FREE
        self.assertTrue((self.particles.positions[rows[arrived]] == self.targets[rows[arrived]]).all())

    def test_a_mask_names_rows_in_order(self):
        mask = self.points[:, 0] < 2
        other = cellwalk.Particles(self.environment, self.points)
        by_mask = self.particles.move(self.targets[mask], rows=mask)
        by_number = other.move(self.targets[mask], rows=numpy.flatnonzero(mask).tolist())
        self.assertEqual(by_mask.contacts.tobytes(), by_number.contacts.tobytes())
        self.assertTrue((self.particles.positions == other.positions).all())

    def test_none_and_all(self):
        self.assertEqual(len(self.particles.move([], rows=[])), 0)
        self.assertEqual(len(self.particles.move(numpy.zeros((0, 3)), rows=numpy.zeros(len(self.points), bool))), 0)
        self.assertTrue((self.particles.positions == self.points).all())
        everything = self.particles.move(self.targets, rows=numpy.arange(len(self.points), dtype=numpy.uint16))
        self.assertEqual(len(everything), len(self.points))

    def test_refusals(self):
        n = len(self.points)
        for error, message, rows in (
            (IndexError, rf"rows\[1\] is {n}: there are {n} particles, numbered from 0", [0, n]),
            (IndexError, r"rows\[0\] is -1: there are", [-1, 0]),
            (IndexError, rf"rows has shape \({n - 1},\): a mask of the particles has shape \({n},\)", numpy.ones(n - 1, bool)),
            (ValueError, r"rows\[2\] is 3, as rows\[0\] is: give each once", [3, 1, 3]),
            (ValueError, r"rows has shape \(1, 2\): \(N,\) is needed", [[0, 1]]),
            (TypeError, r"rows must be integers \(N,\), or a boolean mask", [0.0, 1.0]),
            (TypeError, "and is slice", slice(2)),
        ):
            with self.assertRaisesRegex(error, message):
                self.particles.move(self.targets[:2], rows=rows)
        with self.assertRaisesRegex(cellwalk.InputError, r"targets has shape \(2, 3\): \(3, 3\), a row for each of rows, is needed"):
            self.particles.move(self.targets[:2], rows=[0, 1, 2])
        with self.assertRaises(cellwalk.RowError) as caught:
            self.particles.move(self.targets[:1], rows=[n])
        self.assertIsInstance(caught.exception, (cellwalk.Error, IndexError, ValueError))
        self.assertTrue((self.particles.positions == self.points).all())


class Bodies(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("hexes", cells=4)
        self.points = numpy.array([[1.0 + 0.25 * i, 1.0, 1.0] for i in range(6)])
        self.edges = [[i, i + 1] for i in range(5)]

    def body(self, **more):
        return cellwalk.Body(self.environment, self.points, self.edges, **more)

    def test_the_others_stand_still(self):
        for options in ({}, {"sweep": "faces"}, {"rule": "reject_at_target"}, {"touch": "stop"}):
            for radius in (0.0,) if "touch" in options else (0.0, 0.125):
                some, every = self.body(radius=radius), self.body(radius=radius)
                targets = self.points[[4, 1]] + [[0.0, 0.5, 7.0], [0.0, 0.5, 0.0]]
                contacts = some.step(targets, rows=[4, 1], **options)
                whole = self.points.copy()
                whole[[4, 1]] = targets
                same = every.step(whole, **options)
                self.assertEqual(set(contacts["vertex"]), {4})
                self.assertTrue((some.positions == every.positions).all())
                self.assertEqual(contacts.tobytes(), same.tobytes())
                still = [0, 2, 3, 5]
                self.assertTrue((some.positions[still] == self.points[still]).all())
                some.validate()

    def test_what_stands_at_a_wall_is_no_contact(self):
        self.points[0] = [0.0, 1.0, 1.0]  # it touches a wall
        body = self.body()
        self.assertIn(0, body.step(self.points, touch="stop", rule="reject_at_target")["vertex"])
        contacts = body.step([[2.0, 1.5, 1.5]], rows=[5], touch="stop", rule="reject_at_target")
        self.assertEqual(len(contacts), 0)
        blocked = body.step([[9.0, 1.5, 1.5]], rows=[5], touch="stop", rule="reject_at_target", report="blocked")
        self.assertEqual(blocked["vertex"].tolist(), [5])

    def test_refusals(self):
        body = self.body()
        mask = numpy.zeros(6, bool)
        mask[2] = True
        body.step(self.points[mask] + 0.125, rows=mask)
        self.assertEqual(body.positions[2].tolist(), (self.points[2] + 0.125).tolist())
        for error, message, targets, rows in (
            (IndexError, r"rows\[0\] is 6: there are 6 vertices", self.points[:1], [6]),
            (ValueError, r"rows\[1\] is 2, as rows\[0\] is", self.points[:2], [2, 2]),
            (ValueError, r"targets has shape \(6, 3\): \(1, 3\), a row for each of rows,", self.points, mask),
            (ValueError, "the target of vertex 3 is not finite", [[0, 0, numpy.nan]], [3]),
        ):
            with self.assertRaisesRegex(error, message):
                body.step(targets, rows=rows)


class Points(unittest.TestCase):
    def test_reshape_takes_a_mask(self):
        one, other = (cellwalk.Environment.generate("hexes", cells=2, simplicial=True) for _ in range(2))
        floor = one.points[:, 2] == 0
        targets = one.points[floor] + [0.0, 0.0, 0.125]
        moves = one.reshape(floor, targets)
        self.assertEqual(moves.point.tolist(), numpy.flatnonzero(floor).tolist())
        other.reshape(numpy.flatnonzero(floor), targets)
        self.assertTrue((one.points == other.points).all())
        self.assertEqual(one.points[floor, 2].max(), 0.125)


if __name__ == "__main__":
    unittest.main()
