# SPDX-License-Identifier: LGPL-3.0-or-later
"""Threads ask an environment while another one moves its walls: each answer is that of before, or that of after."""

import faulthandler
import pathlib
import tempfile
import threading
import time
import unittest

import numpy

import cellwalk
from cellwalk import MoveEnd, Place, Status

SIZE = 6
MOVES = 12
AT_MOST = 240  # seconds, for a thread that waits for ever


class Beating(unittest.TestCase):
    """The floor of a box is at 0 or at 0.5, and all questions are of places between."""

    def setUp(self):
        faulthandler.dump_traceback_later(AT_MOST, exit=True)
        self.addCleanup(faulthandler.cancel_dump_traceback_later)
        self.environment = cellwalk.Environment.generate("tets", cells=SIZE)
        self.floor = numpy.flatnonzero(self.environment.points[:, 2] == 0)
        rng = numpy.random.default_rng(1)
        self.low = rng.uniform([0.5, 0.5, 0.125], [SIZE - 0.5, SIZE - 0.5, 0.375], (4000, 3))
        self.high = self.low + [0.0, 0.0, 0.625]

    def move_floor(self, height, **listed):
        targets = self.environment.points[self.floor]
        targets[:, 2] = height
        moves = self.environment.reshape(self.floor, targets, **listed)
        self.assertTrue(listed or (moves.end == MoveEnd.REACHED).all())

    def while_walls_move(self, ask, threads=2, **listed):
        """Calls ask() in some threads until all moves are done; returns what it said."""
        said, failed, done = [], [], threading.Event()

        def asking():
            try:
                while not done.is_set():
                    said.append(ask())
            except BaseException as error:
                failed.append(error)

        askers = [threading.Thread(target=asking) for _ in range(threads)]
        for asker in askers:
            asker.start()
        try:
            for k in range(MOVES):
                before = len(said)
                self.move_floor(0.5 * (k % 2 == 0), **listed)
                # Some answers with each shape of the floor.
                until = time.monotonic() + 20
                while len(said) < before + 2 * threads and not failed and time.monotonic() < until:
                    time.sleep(0.0005)
        finally:
            done.set()
            for asker in askers:
                asker.join()
        if failed:
            raise failed[0]
        return said

    def check_both(self, said):
        """Each answer is True or False, and both occur."""
        self.assertEqual(set(said), {True, False})

    def all_or_none(self, mask):
        """True if all are, False if none is."""
        self.assertIn(numpy.count_nonzero(mask), (0, len(mask)), "an answer from the midst of a move")
        return bool(mask[0])

    def test_locate(self):
        self.check_both(self.while_walls_move(
            lambda: self.all_or_none(self.environment.locate(self.low, threads=1).status == Place.FREE)))

    def test_walk(self):
        self.check_both(self.while_walls_move(
            lambda: self.all_or_none(self.environment.walk(self.high, self.low, threads=2).status == Status.FREE)))

    def test_sweep(self):
        p, t, q = self.high[:500], self.low[:500], self.high[:500] + [0.25, 0.0, 0.0]
        self.check_both(self.while_walls_move(
            lambda: self.all_or_none(self.environment.sweep(p, t, q, threads=1).status == Status.FREE)))

    def test_new_particles(self):
        self.check_both(self.while_walls_move(
            lambda: self.all_or_none(cellwalk.Particles(self.environment, self.low, threads=1).cells >= 0)))

    def test_new_bodies(self):
        edges = numpy.array([[i, i + 1] for i in range(499)])

        def ask():
            try:
                cellwalk.Body(self.environment, self.low[:500], edges)
                return True
            except cellwalk.OutsideError:
                return False

        self.check_both(self.while_walls_move(ask))

    def test_certificates_and_files(self):
        volumes = {True: SIZE**3, False: SIZE**3 - 0.5 * SIZE**2}
        with tempfile.TemporaryDirectory() as folder:

            def ask():
                path = pathlib.Path(folder) / f"{threading.get_ident()}.ovm"
                self.environment.save(path)
                return self.all_or_none(cellwalk.Environment.load(path).points[self.floor, 2] == 0)

            self.check_both(self.while_walls_move(ask))
        of_volume = {volume: is_low for is_low, volume in volumes.items()}
        self.check_both(self.while_walls_move(lambda: of_volume[self.environment.certificate["volume"]]))

    def test_bodies_and_particles_that_move(self):
        """What is listed moves up and down in its own threads, and is pushed by the floor: nothing is missed."""
        low = numpy.array([[1.5, 1.5, 0.0625], [4.5, 1.75, 0.0625], [1.25, 4.5, 0.0625]])
        body = cellwalk.Body(self.environment, low + [0, 0, 0.75], faces=numpy.array([[0, 1, 2]]))
        high, low_points = self.high[:400], self.low[:400]
        particles = cellwalk.Particles(self.environment, high)
        ups = [0]

        def ask():
            ups[0] += 1
            body.step(low + [0, 0, 0.75 * (ups[0] % 2)], sweep="faces")
            body.validate()
            self.assertTrue((body.positions[:, 2] >= 0).all())
            particles.move(high if ups[0] % 2 else low_points)
            self.assertTrue((particles.cells >= 0).all())
            return True

        self.while_walls_move(ask, bodies=[body], particles=[particles], at_contact="push")
        body.validate()
        found = self.environment.locate(particles.positions.copy())
        self.assertTrue((found.status == Place.FREE).all())
        self.assertEqual(particles.move(particles.positions + [0.0, 0.0, -1.0]).status.tolist(), [Status.CONTACT] * 400)

    def test_askers_that_never_pause_let_walls_move(self):
        """So many that one of them always asks: who wants to move walls comes before who asks next."""
        points = numpy.tile(self.low, (8, 1))
        done = threading.Event()

        def asking():
            while not done.is_set():
                self.environment.locate(points, threads=1)

        askers = [threading.Thread(target=asking) for _ in range(8)]
        moving = threading.Thread(target=lambda: [self.move_floor(0.25 * (k % 2)) for k in range(4)])
        for thread in [*askers, moving]:
            thread.start()
        moving.join(timeout=60)
        starves = moving.is_alive()
        done.set()
        for thread in [*askers, moving]:
            thread.join()
        self.assertFalse(starves)

    def test_two_threads_that_move_walls_take_turns(self):
        other = threading.Thread(target=lambda: [self.move_floor(0.25 * k) for k in (1, 2, 1, 2)])
        other.start()
        for k in (2, 1, 2, 0):
            self.move_floor(0.25 * k)
        other.join()
        self.assertIn(self.environment.certificate["volume"], [SIZE**3 - 0.25 * k * SIZE**2 for k in (0, 2)])


if __name__ == "__main__":
    unittest.main()
