# SPDX-License-Identifier: LGPL-3.0-or-later
"""Environments and particles as pickles: the same answers in another process, damaged ones refused."""

import copy
import multiprocessing
import pickle
import tempfile
import unittest
from pathlib import Path

import numpy

import cellwalk


def world(seed=1):
    return cellwalk.Environment.generate("hexes", cells=[6, 6, 6], solid=0.1, seed=seed)


def motions(count, size, seed=0):
    random = numpy.random.default_rng(seed)
    starts = random.uniform(0, size, (count, 3))
    return starts, starts + random.normal(0, 0.5, (count, 3))


def rows(answers):
    """All that answers say, as bytes."""
    return [numpy.asarray(getattr(answers, name)).tobytes() for name in ("status", "cell", "cells")] + [answers.contacts.tobytes()]


def answer(environment, starts, targets):
    return rows(environment.walk(starts, targets))


def move(particles, targets):
    return rows(particles.move(targets, at_contact="stop"))


class Environments(unittest.TestCase):
    def test_answers_are_the_same(self):
        environment = world()
        starts, targets = motions(2000, 6)
        known = answer(environment, starts, targets)
        for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1):
            other = pickle.loads(pickle.dumps(environment, protocol))
            self.assertEqual(answer(other, starts, targets), known)
        self.assertEqual(other.certificate, environment.certificate)
        self.assertEqual(other.report, environment.report)
        self.assertEqual(answer(copy.deepcopy(environment), starts, targets), known)

    def test_planes_too(self):
        environment = cellwalk.Environment.generate("room2d")
        starts = numpy.random.default_rng(2).uniform(0, 4, (500, 2))
        known = answer(environment, starts, starts[::-1].copy())
        other = pickle.loads(pickle.dumps(environment))
        self.assertEqual(other.dimension, 2)
        self.assertEqual(answer(other, starts, starts[::-1].copy()), known)

    def test_what_edits_made_is_kept(self):
        environment = world()
        with environment.editing() as edits:
            self.assertTrue(edits.excavate(environment.select(box=((0, 0, 0), (3, 3, 3))).cells).made.any())
        other = pickle.loads(pickle.dumps(environment))
        self.assertEqual(other.certificate, environment.certificate)
        self.assertEqual(pickle.dumps(other), pickle.dumps(environment))
        self.assertNotEqual(other.certificate, world().certificate)

    def test_other_processes(self):
        environment = world()
        starts, targets = motions(3000, 6, seed=4)
        known = answer(environment, starts, targets)
        with multiprocessing.get_context("spawn").Pool(2) as pool:
            parts = pool.starmap(answer, [(environment, starts, targets)] * 3)
        self.assertEqual(parts, [known] * 3)

    def test_files(self):
        environment = world()
        starts, targets = motions(2000, 6)
        with tempfile.TemporaryDirectory() as folder:
            compiled, text = Path(folder) / "world.cellwalk", Path(folder) / "world.ovm"
            environment.save(compiled)
            environment.save(text)
            self.assertEqual(compiled.read_bytes()[:8], b"CELLWALK")
            opened = cellwalk.Environment.load(compiled)
            self.assertEqual(answer(opened, starts, targets), answer(environment, starts, targets))
            read = cellwalk.Environment.load(text)  # in which facets may have other numbers
            self.assertEqual(rows(opened.walk(starts, targets))[:3], rows(read.walk(starts, targets))[:3])
            self.assertEqual(opened.certificate, environment.certificate)

    def test_damage_is_refused(self):
        bytes_of, report = world().__getstate__()
        broken = bytearray(bytes_of)
        broken[-9] ^= 1
        for state, why in (((bytes(broken), report), "a checksum differs"), ((bytes_of[:-1], report), "it is cut short"),
                           ((b"nothing", report), "no compiled environment")):
            with self.assertRaisesRegex(cellwalk.InputError, why):
                cellwalk.Environment.__new__(cellwalk.Environment).__setstate__(state)
        with self.assertRaisesRegex(ValueError, "another version"):
            cellwalk.Environment.__new__(cellwalk.Environment).__setstate__((bytes_of,))


class Particles(unittest.TestCase):
    def setUp(self):
        self.environment = world(seed=5)
        self.points, self.targets = motions(1000, 6, seed=6)
        self.particles = cellwalk.Particles(self.environment, self.points)

    def test_they_go_on_as_they_would(self):
        move(self.particles, self.targets)  # some stop at walls
        other = pickle.loads(pickle.dumps(self.particles))
        numpy.testing.assert_array_equal(other.positions, self.particles.positions)
        numpy.testing.assert_array_equal(other.cells, self.particles.cells)
        self.assertLess(other.cells.min(), 0, "some are outside")
        for _ in range(3):
            targets = self.particles.positions + numpy.random.default_rng(1).normal(0, 0.5, (1000, 3))
            self.assertEqual(move(other, targets), move(self.particles, targets))
            numpy.testing.assert_array_equal(other.positions, self.particles.positions)

    def test_the_environment_is_shared_as_before(self):
        more = cellwalk.Particles(self.environment, self.points[:10])
        environment, first, second = pickle.loads(pickle.dumps((self.environment, self.particles, more)))
        alone = pickle.dumps(self.environment)
        self.assertLess(len(pickle.dumps((self.environment, self.particles, more))), 2 * len(alone), "it is written once")
        self.assertIs(first.__getstate__()[0], environment)
        self.assertIs(second.__getstate__()[0], environment)

    def test_those_that_must_be_located_again_still_must(self):
        with self.environment.editing() as edits:
            self.assertTrue(edits.excavate(self.environment.select(box=((0, 0, 0), (3, 3, 3))).cells).made.any())
        other = pickle.loads(pickle.dumps(self.particles))
        with self.assertRaisesRegex(cellwalk.UsageError, "locate_again"):
            other.move(self.targets)
        other.locate_again()
        self.particles.locate_again()
        self.assertEqual(move(other, self.targets), move(self.particles, self.targets))

    def test_damage_is_refused(self):
        environment, positions, cells, places, epoch = self.particles.__getstate__()
        inside = int(numpy.argmax(cells >= 0))
        moved = positions.copy()
        moved[inside] += 7
        far = cells.copy()
        far[inside] = 10**9
        aimed = places.copy()
        aimed[inside] = 6
        for state in ((environment, moved, cells, places, epoch), (environment, positions, far, places, epoch),
                      (environment, positions, cells, aimed, epoch), (environment, positions, cells[1:], places, epoch),
                      (environment, positions, cells, places[1:], epoch), (environment, positions, cells, epoch),
                      (None, positions, cells, places, epoch)):
            with self.assertRaises(ValueError):
                cellwalk.Particles.__new__(cellwalk.Particles).__setstate__(state)


class Bodies(unittest.TestCase):
    def setUp(self):
        self.environment = world(seed=5)
        rng = numpy.random.default_rng(3)
        points = numpy.array([[2.5, 2.5, 2.5]]) + 0.4 * rng.uniform(-1, 1, (4, 3))
        self.body = cellwalk.Body(self.environment, points, faces=numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]))
        self.step(self.body, 1)

    def step(self, body, seed):
        """A throw far enough to meet walls; what came of it, as bytes."""
        targets = body.positions + numpy.random.default_rng(seed).normal(0, 1.5, (4, 3))
        contacts = body.step(targets, sweep="faces")
        body.validate()
        return [contacts.tobytes(), body.positions.tobytes()]

    def test_they_go_on_as_they_would(self):
        other = pickle.loads(pickle.dumps(self.body))
        numpy.testing.assert_array_equal(other.positions, self.body.positions)
        numpy.testing.assert_array_equal(other.edges, self.body.edges)
        numpy.testing.assert_array_equal(other.faces, self.body.faces)
        met = 0
        for seed in range(2, 12):
            expected = self.step(self.body, seed)
            self.assertEqual(self.step(other, seed), expected)
            met += len(expected[0]) > 0
        self.assertGreater(met, 3, "walls are met")

    def test_they_share_their_environment(self):
        environment, body, more = pickle.loads(pickle.dumps((self.environment, self.body, self.body)))
        self.assertIs(body, more)
        self.assertIs(body.__getstate__()[0], environment)

    def test_those_that_must_be_registered_again_are_not_pickled(self):
        with self.environment.editing() as edits:
            self.assertTrue(edits.excavate(self.environment.select(box=((0, 0, 0), (3, 3, 3))).cells).made.any())
        with self.assertRaisesRegex(cellwalk.UsageError, "register_again"):
            pickle.dumps(self.body)
        self.body.register_again()
        self.assertEqual(self.step(pickle.loads(pickle.dumps(self.body)), 4), self.step(self.body, 4))

    def test_damage_is_refused(self):
        environment, bytes_of = self.body.__getstate__()
        broken = bytearray(bytes_of)
        broken[len(broken) // 2] ^= 1
        for damaged in (bytes(broken), bytes_of[:-1], b"nothing"):
            with self.assertRaises(cellwalk.InputError):
                cellwalk.Body.__new__(cellwalk.Body).__setstate__((environment, damaged))
        with self.assertRaises(cellwalk.InputError):
            cellwalk.Body.__new__(cellwalk.Body).__setstate__((cellwalk.Environment.generate("tets", cells=[6, 6, 6]), bytes_of))
        with self.assertRaisesRegex(ValueError, "damaged"):
            cellwalk.Body.__new__(cellwalk.Body).__setstate__((None, bytes_of))


if __name__ == "__main__":
    unittest.main()
