# SPDX-License-Identifier: LGPL-3.0-or-later
"""Arrays are read where they lie, or refused; results are views or new arrays that live as long as they are held."""

import gc
import threading
import unittest

import numpy

import cellwalk


class Numbers(unittest.TestCase):
    """What NumPy makes an array of is taken, in place if it lies as float64 in C order."""

    def setUp(self):
        self.environment = cellwalk.Environment.generate("hexes", cells=4)
        self.starts = numpy.random.default_rng(1).integers(0, 64, (20, 3)) / 16.0  # exact in float16, too
        self.targets = self.starts[::-1].copy()
        self.motions = self.environment.walk(self.starts, self.targets)

    def test_every_layout_and_type_gives_the_same(self):
        read_only = self.starts.copy()
        read_only.setflags(write=False)
        wide = numpy.zeros((20, 6))
        wide[:, ::2] = self.starts
        misaligned = numpy.frombuffer(bytearray(8 * 60 + 1), dtype=numpy.float64, offset=1, count=60).reshape(20, 3)
        self.assertFalse(misaligned.flags.aligned)
        misaligned[:] = self.starts
        reversed_twice = self.starts[::-1].copy()[::-1]
        self.assertFalse(reversed_twice.flags.c_contiguous)
        for starts in (read_only, wide[:, ::2], misaligned, reversed_twice, numpy.asfortranarray(self.starts), self.starts.tolist(),
                       self.starts.astype(">f8"), self.starts.astype(numpy.float32), self.starts.astype(numpy.float16),
                       [tuple(row) for row in self.starts]):
            motions = self.environment.walk(starts, self.targets)
            self.assertEqual(motions.contacts.tobytes(), self.motions.contacts.tobytes())
            self.assertTrue((motions.cell == self.motions.cell).all())
        whole = numpy.ones((2, 3), int)
        self.assertTrue((self.environment.locate(whole).cell == self.environment.locate(whole.astype(float)).cell).all())

    def test_own_views(self):
        particles = cellwalk.Particles(self.environment, self.starts)
        self.assertFalse(particles.positions.flags.c_contiguous)
        self.assertTrue((self.environment.locate(particles.positions).cell == particles.cells).all())
        self.assertTrue((particles.move(particles.positions).status == cellwalk.Status.FREE).all())
        body = cellwalk.Body(self.environment, [[1, 1, 1], [2, 1, 1], [3, 1, 1.5]], [[0, 1], [1, 2]])
        body.step(body.positions)
        body.step(body.positions[::-1])  # targets among the positions that change
        self.assertEqual(body.positions.tolist(), [[3, 1, 1.5], [2, 1, 1], [1, 1, 1]])

    def test_radii(self):
        for radius in (0.25, numpy.float32(0.25), numpy.array(0.25), [0.25] * 20, numpy.full(20, 0.25, numpy.float32), numpy.full(40, 0.25)[::2]):
            motions = self.environment.walk(self.starts, self.targets, radius=radius)
            self.assertEqual(motions.contacts.tobytes(), self.environment.walk(self.starts, self.targets, radius=numpy.full(20, 0.25)).contacts.tobytes())
        self.assertEqual(self.environment.walk(self.starts, self.targets, radius=numpy.int64(0)).contacts.tobytes(), self.motions.contacts.tobytes())

    def test_no_rows(self):
        for nothing in (numpy.zeros((0, 3)), []):
            self.assertEqual(len(self.environment.locate(nothing)), 0)
            self.assertEqual(len(self.environment.walk(nothing, nothing).contacts), 0)
            self.assertEqual(len(cellwalk.Particles(self.environment, nothing)), 0)
        self.assertEqual(len(cellwalk.Body(self.environment, [[1, 1, 1]], [], []).edges), 0)

    def test_rows_that_are_not_finite(self):
        points = [[1, 1, numpy.nan], [numpy.inf, 1, 1], [1, 1, 1]]
        self.assertEqual(self.environment.locate(points).status.tolist(), [2, 2, 0])
        self.assertEqual(self.environment.walk(points, points).status.tolist(), [3, 3, 0])

    def test_a_plane_takes_two_columns(self):
        plane = cellwalk.Environment.generate("squares", cells=2)
        self.assertEqual(plane.locate(numpy.array([[0.5, 0.5]])).cell[0], 0)
        with self.assertRaisesRegex(ValueError, r"points has shape \(1, 3\): \(N, 2\) is needed"):
            plane.locate(numpy.zeros((1, 3)))


class Refusals(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("hexes", cells=2)

    def refused(self, error, message, call):
        with self.assertRaises(error) as caught:
            call()
        self.assertEqual(str(caught.exception), message)
        self.assertIsNone(caught.exception.__context__)

    def test_shapes(self):
        locate, points = self.environment.locate, numpy.zeros((4, 3))
        for wrong, shape in ((points[:, :2], "(4, 2)"), (numpy.zeros(3), "(3,)"), (numpy.zeros((1, 4, 3)), "(1, 4, 3)"), (3.0, "()"),
                             ([1.0, 2.0], "(2,)"), (numpy.zeros((0, 2)), "(0, 2)")):
            self.refused(cellwalk.InputError, f"points has shape {shape}: (N, 3) is needed", lambda: locate(wrong))
        self.refused(ValueError, "targets has shape (2, 3): (1, 3), a row for each of starts, is needed",
                     lambda: self.environment.walk(points[:1], points[:2]))
        self.refused(ValueError, "q has shape (3, 3): (4, 3), a row for each of p, is needed",
                     lambda: self.environment.sweep(points, points, points[:3]))
        self.refused(ValueError, "radius has shape (3,): (4,), one for each of starts, is needed",
                     lambda: self.environment.walk(points, points, radius=numpy.zeros(3)))

    def test_types(self):
        locate, points = self.environment.locate, numpy.zeros((4, 3))
        for wrong, given in ((points.astype(complex), "complex128 of shape (4, 3)"), (points.astype(numpy.longdouble), "float128 of shape (4, 3)"),
                             (points.astype(object), "object of shape (4, 3)"), (points > 0, "bool of shape (4, 3)"), (None, "NoneType"),
                             ("abc", "str"), ([["0", "0", "0"]], "<U1 of shape (1, 3)"), (self.environment, "Environment")):
            self.refused(TypeError, f"points must be real numbers, as float64 holds them, and is {given}", lambda: locate(wrong))
        self.refused(TypeError, "radius must be a number, or an array of numbers, and is str",
                     lambda: self.environment.walk(points, points, radius="0.1"))
        with self.assertRaisesRegex(ValueError, "inhomogeneous"):
            locate([[0, 0, 0], [0, 0]])
        masked = numpy.ma.masked_array(points, mask=points > 1)
        self.assertEqual(len(locate(masked)), 4)
        masked[1, 2] = numpy.ma.masked
        self.refused(ValueError, "points has masked values: fill them, or take the rest", lambda: locate(masked))

    def test_words_and_threads(self):
        points = numpy.full((1, 3), 0.5)
        with self.assertRaisesRegex(cellwalk.UsageError, "touch takes pass, stop, not never"):
            self.environment.walk(points, points, touch="never")
        with self.assertRaisesRegex(cellwalk.UsageError, "threads takes a number from 0"):
            self.environment.walk(points, points, threads=-1)
        with self.assertRaisesRegex(cellwalk.UsageError, "tolerance"):
            self.environment.sweep(points, points, points, tolerance=0.0)

    def test_calls(self):
        """In the words of Python, instead of those of pybind11 with all that was given."""
        e, points = self.environment, numpy.full((1, 3), 0.5)
        body = cellwalk.Body(e, points)
        for message, call in (
            ("locate(): got an unexpected keyword argument 'thread'", lambda: e.locate(points, thread=2)),
            ("locate(): missing a required argument: 'points'", lambda: e.locate()),
            ("locate(): too many positional arguments", lambda: e.locate(points, 2)),
            ("walk(): multiple values for argument 'starts'", lambda: e.walk(points, starts=points)),
            ("locate(): threads must be int, and is float", lambda: e.locate(points, threads=1.5)),
            ("walk(): touch must be str, and is NoneType", lambda: e.walk(points, points, touch=None)),
            ("locate(): self must be Environment, and is NoneType", lambda: cellwalk.Environment.locate(None, points)),
            ("Particles(): environment must be Environment, and is int", lambda: cellwalk.Particles(3, points)),
            ("Particles(): environment must be Environment, and is NoneType", lambda: cellwalk.Particles(environment=None, points=points)),
            ("Body(): missing a required argument: 'points'", lambda: cellwalk.Body(e)),
            ("clearances(): up_to must be float, and is str", lambda: body.clearances("1")),
            ("move_vertex(): vertex is -1, which is out of range", lambda: body.move_vertex(-1, points[0])),
            ("from_arrays(): split must be bool, and is str", lambda: cellwalk.Environment.from_arrays(points, [[0]], split="no")),
            ("import_mesh(): quality must be Optional[float], and is str", lambda: cellwalk.Environment.import_mesh("a", quality="high")),
            ("draw(): missing a required argument: 'file'", lambda: cellwalk.draw(e, [body])),
            ("select(): group must be Optional[str], and is int", lambda: e.select(group=3)),
        ):
            with self.assertRaises(TypeError) as caught:
                call()
            self.assertEqual(str(caught.exception), message)
            self.assertIsNone(caught.exception.__context__)
        with self.assertRaisesRegex(TypeError, r"^import_mesh\(\): obstacles must be [Ll]ist\[object\], and is str$"):
            cellwalk.Environment.import_mesh("a", obstacles="b.off")

    def test_no_environment(self):
        for make in (lambda: cellwalk.Particles(None, numpy.zeros((1, 3))), lambda: cellwalk.Body(None, numpy.zeros((1, 3))),
                     lambda: cellwalk.Body.rope(None, numpy.zeros((2, 3)), 1.0), lambda: cellwalk.Body.read(None, "x.csv"),
                     lambda: cellwalk.draw(None, [], file="x.png"), lambda: cellwalk.Environment.locate(None, numpy.zeros((1, 3)))):
            with self.assertRaises(TypeError):
                make()

    def test_paths(self):
        for name in (3, None, ["x.ovm"]):
            for call in (self.environment.save, cellwalk.Environment.load, cellwalk.Environment.import_mesh,
                         lambda path: cellwalk.Body.read(self.environment, path), lambda path: cellwalk.draw(self.environment, [], file=path)):
                with self.assertRaisesRegex(TypeError, "expected str, bytes or os.PathLike object"):
                    call(name)

    def test_numbers_of_recipes(self):
        for wrong in ("ab", None, [[2, 2]]):
            with self.assertRaisesRegex((TypeError, ValueError), "^cells "):
                cellwalk.Environment.generate("hexes", cells=wrong)
        for wrong in ((0.5, 0.5), 3, [[1, 2]], None):
            with self.assertRaisesRegex((TypeError, ValueError), "^inside "):
                cellwalk.Environment.import_mesh("x.off", inside=wrong)


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
