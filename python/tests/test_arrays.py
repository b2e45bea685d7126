# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arrays are read where they lie, or refused; results are views or new arrays that live as long as they are held."""

import gc
import threading
import unittest

import numpy

import cellwalk


class Refusals(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("hexes", cells=2)

    def refused(self, argument, *parts):
        with self.assertRaises(TypeError) as caught:
            self.environment.locate(argument)
        for part in ("points must be a C-contiguous float64 array of shape (N, 3)", *parts):
            self.assertIn(part, str(caught.exception))

    def test_other_types_shapes_and_layouts(self):
        self.refused(numpy.zeros((4, 3), numpy.float32), "float32 (4, 3)")
        self.refused(numpy.zeros((4, 3), ">f8"), ">f8 (4, 3)")
        self.refused(numpy.zeros((4, 2)), "float64 (4, 2)")
        self.refused(numpy.zeros(3), "float64 (3,)")
        self.refused(numpy.zeros((4, 6))[:, ::2], "not C-contiguous")
        self.refused(numpy.asfortranarray(numpy.zeros((4, 3))), "not C-contiguous")
        self.refused([[0.5, 0.5, 0.5]], "and is list")
        self.refused(None, "and is NoneType")
        misaligned = numpy.frombuffer(bytearray(8 * 6 + 1), dtype=numpy.float64, offset=1, count=6).reshape(2, 3)
        self.assertFalse(misaligned.flags.aligned)
        self.refused(misaligned)

    def test_what_the_message_advises_works(self):
        points = numpy.ascontiguousarray([[0.5, 0.5, 0.5]], dtype=numpy.float64)
        self.assertEqual(self.environment.locate(points).status[0], cellwalk.Place.FREE)

    def test_a_plane_takes_two_columns(self):
        plane = cellwalk.Environment.generate("squares", cells=2)
        self.assertEqual(plane.locate(numpy.array([[0.5, 0.5]])).cell[0], 0)
        with self.assertRaisesRegex(TypeError, r"shape \(N, 2\)"):
            plane.locate(numpy.zeros((1, 3)))

    def test_lengths_must_agree(self):
        with self.assertRaisesRegex(ValueError, "targets has 2 rows, and starts has 1"):
            self.environment.walk(numpy.zeros((1, 3)), numpy.zeros((2, 3)))

    def test_empty_batches_are_batches(self):
        nothing = numpy.zeros((0, 3))
        self.assertEqual(len(self.environment.locate(nothing)), 0)
        self.assertEqual(len(self.environment.walk(nothing, nothing).contacts), 0)

    def test_words_and_threads(self):
        points = numpy.full((1, 3), 0.5)
        with self.assertRaisesRegex(cellwalk.UsageError, "touch takes pass, stop, not never"):
            self.environment.walk(points, points, touch="never")
        with self.assertRaisesRegex(cellwalk.UsageError, "threads takes a number from 0"):
            self.environment.walk(points, points, threads=-1)
        with self.assertRaisesRegex(cellwalk.UsageError, "tolerance"):
            self.environment.sweep(points, points, points, tolerance=0.0)


class Lifetimes(unittest.TestCase):
    def test_views_show_the_memory_and_keep_it(self):
        environment = cellwalk.Environment.generate("hexes", cells=4)
        particles = cellwalk.Particles(environment, numpy.full((3, 3), 0.5))
        positions = particles.positions
        self.assertFalse(positions.flags.owndata)
        self.assertFalse(positions.flags.writeable)
        with self.assertRaises(ValueError):
            positions[0, 0] = 9.0
        particles.move(numpy.full((3, 3), 2.5))
        self.assertTrue((positions == 2.5).all())  # no copy: the view moved along
        del particles, environment
        gc.collect()
        self.assertTrue((positions == 2.5).all())

    def test_targets_may_be_the_own_positions_moved(self):
        environment = cellwalk.Environment.generate("hexes", cells=4)
        particles = cellwalk.Particles(environment, numpy.full((3, 3), 0.5))
        self.assertTrue((particles.move(particles.positions + 1.0).status == cellwalk.Status.FREE).all())

    def test_results_outlive_everything(self):
        points = numpy.array([[0.5, 0.5, 0.5]])
        motions = cellwalk.Environment.generate("hexes", cells=2).walk(points, points + 9)
        gc.collect()
        self.assertEqual(motions.contacts["normal"].tolist()[0].count(-1.0), 1)
        self.assertEqual(motions.cell.shape, (1,))

    def test_the_interpreter_runs_meanwhile(self):
        environment = cellwalk.Environment.generate("tets", cells=12, jitter=0.1)
        rng = numpy.random.default_rng(3)
        points = rng.uniform(0, 12, (100_000, 3))
        ticks, done = [0], threading.Event()

        def count():
            while not done.is_set():
                ticks[0] += 1

        counting = threading.Thread(target=count)
        counting.start()
        before = ticks[0]
        environment.walk(points, points[::-1].copy(), threads=1)
        during = ticks[0] - before
        done.set()
        counting.join()
        # With the lock held the other thread would get no turn between the two readings but at their edges.
        self.assertGreater(during, 1000)

    def test_threads_that_move_the_same_particles_take_turns(self):
        environment = cellwalk.Environment.generate("tets", cells=4, jitter=0.1)
        points = numpy.random.default_rng(4).uniform(1, 3, (20_000, 3))
        particles = cellwalk.Particles(environment, points)
        moves = [threading.Thread(target=lambda k=k: particles.move(points + k / 16)) for k in range(6)]
        for move in moves:
            move.start()
        for move in moves:
            move.join()
        self.assertEqual(sum((particles.positions == points + k / 16).all() for k in range(6)), 1)
        self.assertTrue((environment.locate(particles.positions.copy()).status == cellwalk.Place.FREE).all())


if __name__ == "__main__":
    unittest.main()
