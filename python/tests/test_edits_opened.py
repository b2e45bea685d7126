# SPDX-License-Identifier: LGPL-3.0-or-later
"""Who may use an environment while it is open for edits, and what holds after it."""

import gc
import pathlib
import tempfile
import threading
import unittest

import numpy

import cellwalk
from cellwalk import Place, Status
from edit_worlds import room, thread, walls_inside


class Opening(unittest.TestCase):
    """A room with a body, particles, and a wall to be made."""

    def setUp(self):
        self.environment = room()
        self.body = thread(self.environment, [0.4, 0.5, 0.6], [0.6, 0.5, 0.6])
        self.particles = cellwalk.Particles(self.environment, numpy.array([[1.3, 0.7, 0.5]]))
        self.facet = self.environment.select(box=((1, 0, 0), (1, 2, 2))).facets

    def test_this_thread_may_look_only(self):
        points = numpy.array([[0.5, 0.5, 0.5]])
        other = room()
        with self.environment.editing(bodies=[self.body], particles=[self.particles]):
            for use in (lambda: self.environment.locate(points), lambda: self.environment.walk(points, points),
                        lambda: self.environment.sweep(points, points, points), lambda: self.environment.certificate,
                        lambda: self.environment.save("/nowhere.ovm"), lambda: self.environment.reshape([0], points),
                        lambda: self.environment.freeze(), lambda: cellwalk.Particles(self.environment, points),
                        lambda: cellwalk.Body(self.environment, points), lambda: self.particles.cells,
                        lambda: self.particles.move(self.particles.positions.copy()), lambda: self.particles.locate_again(),
                        lambda: self.body.step(self.body.positions.copy()), lambda: self.body.validate(),
                        lambda: self.body.move_vertex(0, [0.4, 0.4, 0.4]), lambda: self.body.register_again(),
                        lambda: self.body.counts, lambda: self.environment.editing().__enter__()):
                with self.assertRaisesRegex(cellwalk.UsageError, "open for edits: leave the with statement"):
                    use()
            self.assertEqual((self.environment.cell_count, len(self.environment.cells())), (48, 48))
            self.assertEqual((len(self.environment.points), self.environment.dimension), (27, 3))
            self.assertIn("48 cells", repr(self.environment))
            self.assertEqual(len(self.body.positions), 2)
            self.assertEqual(other.locate(points).status[0], Place.FREE, "another environment is not open")
        self.assertEqual(self.environment.locate(points).status[0], Place.FREE)

    def test_other_threads_wait(self):
        points = numpy.array([[0.5, 0.5, 0.5], [1.5, 1.5, 1.5]])
        said, asked = [], threading.Event()

        def ask():
            asked.set()
            said.append(self.environment.walk(points[:1], points[1:]).status[0])
            said.append(len(self.environment.facets()))
            said.append(self.body.counts["vertices"] if "vertices" in self.body.counts else 0)

        def step():
            self.body.step(self.body.positions + 0.01)
            said.append("stepped")

        with self.environment.editing(bodies=[self.body], particles=[self.particles]) as edits:
            threads = [threading.Thread(target=f) for f in (ask, step, lambda: said.append(self.environment.facets()["wall"].sum()))]
            for t in threads:
                t.start()
            asked.wait()
            threads[0].join(timeout=0.2)
            self.assertEqual(said, [])
            self.assertTrue(edits.close(self.facet).made.all())
            with self.assertRaisesRegex(cellwalk.UsageError, "open for edits"):
                self.body.counts  # which the other thread holds while it waits
        for t in threads:
            t.join(timeout=30)
            self.assertFalse(t.is_alive())
        self.assertIn("stepped", said)
        self.assertIn(Status.CONTACT, said, "it saw the wall")

    def test_edits_are_of_one_thread(self):
        failed = []

        def use(edits):
            for call in (lambda: edits.close(self.facet), lambda: edits.__exit__(None, None, None), lambda: edits.counts):
                try:
                    call()
                except cellwalk.UsageError as error:
                    failed.append(str(error))

        with self.environment.editing() as edits:
            other = threading.Thread(target=use, args=(edits,))
            other.start()
            other.join()
            self.assertEqual(failed, ["another thread opened these edits: make them there"] * 3)
            self.assertTrue(edits.close(self.facet).made.all())

    def test_before_and_after_the_statement(self):
        edits = self.environment.editing()
        with self.assertRaisesRegex(cellwalk.UsageError, "edits are made in a with statement"):
            edits.close(self.facet)
        self.environment.certificate  # not open yet
        with edits:
            pass
        with self.assertRaisesRegex(cellwalk.UsageError, "edits are made in a with statement"):
            edits.close(self.facet)
        with self.assertRaisesRegex(cellwalk.UsageError, "were opened before: call editing"):
            edits.__enter__()

    def test_what_is_dropped_is_closed(self):
        """Also in another thread than the one that opened it."""
        held = [self.environment.editing(bodies=[self.body]).__enter__()]
        held[0].close(self.facet)
        dropping = threading.Thread(target=lambda: (held.clear(), gc.collect()))
        dropping.start()
        dropping.join(timeout=30)
        self.assertFalse(dropping.is_alive())
        self.assertEqual(walls_inside(self.environment), len(self.facet))
        self.environment.certificate
        self.body.validate()

    def test_an_exception_keeps_what_was_made(self):
        with self.assertRaises(ZeroDivisionError):
            with self.environment.editing(bodies=[self.body], particles=[self.particles]) as edits:
                edits.close(self.facet)
                1 / 0
        self.assertEqual(self.environment.certificate["membranes"], len(self.facet))
        self.body.validate()
        self.assertEqual(self.particles.move(self.particles.positions + 0.01).status.tolist(), [Status.FREE])

    def test_what_is_not_listed(self):
        with self.environment.editing() as edits:
            pass
        self.body.validate()
        self.particles.move(self.particles.positions.copy())
        with self.environment.editing(bodies=[self.body]) as edits:
            self.assertTrue(edits.close(self.facet).made.all())
        self.body.validate()
        with self.assertRaisesRegex(cellwalk.UsageError, "Particles.locate_again"):
            self.particles.move(self.particles.positions.copy())
        with self.assertRaisesRegex(cellwalk.UsageError, "Particles.locate_again"):
            self.environment.editing(particles=[self.particles]).__enter__()
        self.particles.locate_again()
        with self.environment.editing(particles=[self.particles]) as edits:
            edits.open(self.facet)
        with self.assertRaisesRegex(cellwalk.UsageError, r"register_again\(\)"):
            self.body.validate()
        self.body.register_again()
        with self.assertRaisesRegex(cellwalk.UsageError, "lies in another environment: list it where that changes"):
            room().editing(bodies=[self.body])

    def test_maps_come_and_go(self):
        """Environments are made without their maps, and get them when they are edited."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "room.ovm"
            for round in range(3):
                self.environment.freeze()
                with self.environment.editing(bodies=[self.body], particles=[self.particles]) as edits:
                    (edits.open if round % 2 else edits.close)(self.facet)
                self.environment.save(path)
                read = cellwalk.Environment.load(path)
                self.assertEqual(walls_inside(read), len(self.facet) * (round % 2 == 0))
                self.assertEqual(read.certificate, self.environment.certificate)

    def test_views_of_points_follow(self):
        view = self.environment.points
        moved = numpy.array([[1.0, 1.0, 1.25]])
        self.environment.reshape([13], moved, bodies=[self.body], particles=[self.particles])
        self.assertEqual(view[13].tolist(), [1, 1, 1.25])
        with self.environment.editing(bodies=[self.body], particles=[self.particles]) as edits:
            report = edits.relax(numpy.arange(27), good_enough=0.99, flip=False, split=False, collapse=False)
            self.assertGreater(report.smoothed, 0)
        self.assertNotEqual(view[13].tolist(), [1, 1, 1.25], "it follows where nobody asks again")
        with self.environment.editing(bodies=[self.body], particles=[self.particles]) as edits:
            now = self.environment.points
            self.assertTrue((now == view).all())
        self.assertNotEqual(view[13].tolist(), [1, 1, 1.25])
        self.assertTrue((self.environment.points == view).all())
        self.environment.reshape([13], moved, bodies=[self.body], particles=[self.particles])
        self.assertEqual(view[13].tolist(), [1, 1, 1.25])
        with self.environment.editing(bodies=[self.body], particles=[self.particles]) as edits:
            added = [edits.insert_point(row, row["mean"]).point for row in self.environment.cells()]
        self.assertEqual((len(view), len(self.environment.points)), (27, 27 + len(added)))
        self.assertEqual(view[13].tolist(), [1, 1, 1.25])
        again = self.environment.points
        self.environment.reshape([13], numpy.array([[1.0, 1.0, 1.125]]), bodies=[self.body], particles=[self.particles])
        self.assertEqual((again[13, 2], view[13, 2]), (1.125, 1.25))
        del self.environment
        gc.collect()
        self.assertEqual((again[13, 2], view[13, 2]), (1.125, 1.25))

if __name__ == "__main__":
    unittest.main()
