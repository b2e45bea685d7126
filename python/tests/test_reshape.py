# SPDX-License-Identifier: LGPL-3.0-or-later
"""Walls that move among bodies and particles: by hand, what the environment says afterwards, and what is refused."""

import gc
import pathlib
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk import Feature, MoveEnd, Place, Status

ALL = ("stop", "hold", "push", "test")


def plane(**options):
    """A square of side 2, as triangles; point x + 3 y lies in (x, y)."""
    return cellwalk.Environment.generate("squares", cells=(2, 2), simplicial=True, **options)


def room(cells=(4, 2, 2), **options):
    return cellwalk.Environment.generate("hexes", cells=cells, simplicial=True, **options)


def thread():
    """A body above the floor of room()."""
    steps = numpy.arange(13.0)[:, None]
    return [0.45, 0.9, 0.125] + steps * [0.25, 0.01, 0.0], numpy.array([[i, i + 1] for i in range(12)])


def floor_of(environment):
    return numpy.flatnonzero(environment.points[:, 2] == 0)


def at_height(environment, points, height):
    targets = environment.points[points]
    targets[:, 2] = height
    return targets


class ByHand(unittest.TestCase):
    """The middle of the lower side of a square goes up, to where a particle or an edge is in its way."""

    def setUp(self):
        self.environment = plane()
        self.target = numpy.array([[1.0, 0.75]])

    def check_contact(self, contact, body, number, normals):
        self.assertEqual(contact["time"], 2 / 3)
        self.assertEqual(contact["point"].tolist(), [1, 0.5])
        self.assertIn(contact["normal"].round(12).tolist(), numpy.round(normals, 12).tolist())
        self.assertEqual((contact["row"], contact["kind"]), (0, Feature.VERTEX))
        self.assertEqual(contact["corners"][0], 1)
        self.assertIn(contact["corners"][1], (0, 2))
        self.assertEqual(contact["weights"].tolist(), [1, 0])
        self.assertEqual((contact["owner"], contact["body"], contact["feature"]), (1, body, number))

    def test_a_particle_in_each_way(self):
        for at_contact in ALL:
            environment = plane()
            # In no cell; elsewhere; in the way.
            points = numpy.array([[9.0, 9.0], [0.5, 1.75], [1.0, 0.5]])
            far = cellwalk.Particles(environment, numpy.array([[1.5, 1.5]]))
            particles = cellwalk.Particles(environment, points)
            moves = environment.reshape([1], self.target, particles=[far, particles], at_contact=at_contact)
            self.assertEqual(moves.point.tolist(), [1])
            self.assertEqual((len(moves), moves.position.shape), (1, (1, 2)))
            hit = moves.hits[0]
            self.check_contact(hit, Feature.VERTEX, 2, numpy.array([[-1, 2], [1, 2]]) / numpy.sqrt(5))
            self.assertTrue(hit["is_particle"])
            self.assertEqual(hit["resident_weights"].tolist(), [1, 0, 0])
            height = environment.points[1, 1]
            if at_contact == "push":
                self.assertEqual((moves.end[0], moves.time[0], height), (MoveEnd.REACHED, 1, 0.75))
                self.assertTrue((particles.positions[:2] == points[:2]).all())
                self.assertGreater(particles.positions[2, 1], points[2, 1])
                self.assertEqual(len(moves.contacts), 0)
                self.assertEqual(environment.locate(particles.positions[1:].copy()).status.tolist(), [Place.FREE] * 2)
            else:
                self.assertEqual(moves.end[0], MoveEnd.CONTACT)
                self.assertGreaterEqual(moves.cell[0], 0)
                self.assertTrue((particles.positions == points).all())
                self.assertEqual(moves.contacts["row"].tolist(), [0])
                self.assertEqual(height, moves.position[0, 1])
                if at_contact == "stop":
                    self.assertTrue(0.5 - 1e-9 < height <= 0.5)
                else:
                    self.assertEqual((moves.time[0], height), (2 / 3, 0))
            self.assertEqual(moves.rounds == 0, at_contact == "test")
            up = particles.positions + [0, 0.125]
            self.assertEqual(particles.move(up).status.tolist(), [Status.OUTSIDE, Status.FREE, Status.FREE])
            self.assertEqual(particles.cells[0], -1)

    def test_an_edge(self):
        bodies = [cellwalk.Body(self.environment, numpy.array(p), numpy.array([[0, 1]]))
                  for p in ([[0.5, 1.5], [0.5, 1.75]], [[0.75, 0.5], [1.25, 0.5]])]
        moves = self.environment.reshape([1], self.target, bodies=bodies, at_contact="hold")
        self.check_contact(moves.contacts[0], Feature.EDGE, 0, [[0, 1]])
        self.assertFalse(moves.contacts["is_particle"][0])
        self.assertEqual(moves.contacts["resident_weights"].tolist(), [[0.5, 0.5, 0]])
        moves = self.environment.reshape([1], self.target, bodies=bodies, at_contact="push")
        self.assertEqual(moves.end.tolist(), [MoveEnd.REACHED])
        self.assertTrue((bodies[1].positions[:, 1] > 0.5).all())
        for body in bodies:
            body.validate()
            body.step(body.positions + [0, 0.0625])

    def test_what_the_environment_forbids(self):
        ends = self.environment.reshape([4, 1], numpy.array([[1.0, 3.0], [1.0, -0.5]]), at_contact="hold", most_rounds=1)
        self.assertEqual(ends.end.tolist(), [MoveEnd.CELL, MoveEnd.REACHED])
        self.assertTrue(0 < ends.time[0] <= 1 and ends.cell[0] >= 0)
        self.assertEqual(len(ends.hits), 0)
        # A cell that would be flat: half of the way there in each round, and the row says where the point is.
        self.assertEqual(ends.position[0].tolist(), self.environment.points[4].tolist())
        self.assertGreater(ends.position[0, 1], 1)
        more = self.environment.reshape([4], numpy.array([[1.0, 3.0]]), most_rounds=3)
        self.assertEqual(more.rounds, 3)
        self.assertGreater(more.position[0, 1], ends.position[0, 1])

    def test_order_is_as_given(self):
        """Two neighbours that swap heights: the one that comes first finds the other one where it was."""
        heights = {}
        for points in ([1, 4], [4, 1]):
            environment = plane()
            targets = numpy.array([[1.0, 1.25], [1.0, 1.5]] if points[0] == 1 else [[1.0, 1.5], [1.0, 1.25]])
            moves = environment.reshape(points, targets, at_contact="hold", most_rounds=1)
            self.assertEqual(moves.point.tolist(), points)
            self.assertTrue((moves.position == environment.points[points]).all())
            heights[points[0]] = environment.points[1, 1]
        self.assertEqual(heights[4], 1.25)
        self.assertLess(heights[1], 1)


class Environments(unittest.TestCase):
    """What an environment says of itself, before and after its walls moved."""

    def test_views_questions_certificates_and_files(self):
        environment = room()
        view, before = environment.points, environment.points.copy()
        floor = floor_of(environment)
        below, above = numpy.array([[1.3, 0.7, 0.125]]), numpy.array([[1.3, 0.7, 0.5]])
        self.assertEqual(environment.locate(below).status[0], Place.FREE)
        self.assertEqual((environment.certificate["volume"], environment.cell_count), (16, 96))
        report = environment.report
        for at_contact in ALL:
            moves = environment.reshape(floor, at_height(environment, floor, 0.25), at_contact=at_contact)
            self.assertTrue((moves.end == MoveEnd.REACHED).all())
            self.assertTrue((moves.position[:, 2] == 0.25).all())
            if at_contact == "test":
                break
            self.assertFalse(numpy.array_equal(view, before))
            self.assertEqual(environment.locate(below).status[0], Place.OUTSIDE)
            walk = environment.walk(above, below)
            self.assertEqual((walk.status[0], walk.contacts["point"][0, 2]), (Status.CONTACT, 0.25))
            sweep = environment.sweep(above, below, above + 0.125)
            self.assertEqual((sweep.status[0], sweep.contacts["point"][0, 2]), (Status.CONTACT, 0.25))
            certificate = environment.certificate
            self.assertEqual((certificate["volume"], certificate["cells"], certificate["walls"]), (14, 96, 80))
            self.assertEqual(environment.report, report)
            with tempfile.TemporaryDirectory() as folder:
                path = pathlib.Path(folder) / "moved.ovm"
                environment.save(path)
                read = cellwalk.Environment.load(path)
            self.assertEqual(read.points.tobytes(), environment.points.tobytes())
            self.assertEqual(read.certificate, certificate)
            self.assertEqual(cellwalk.Particles(environment, below).cells.tolist(), [-1])
            with self.assertRaises(cellwalk.OutsideError):
                cellwalk.Body(environment, *thread())
            environment.reshape(floor, at_height(environment, floor, 0.0))
            self.assertTrue(numpy.array_equal(view, before))
        self.assertTrue(numpy.array_equal(view, before), "ask moves nothing")
        self.assertEqual(environment.locate(below).status[0], Place.FREE)
        self.assertEqual(environment.certificate["volume"], 16)
        self.assertEqual(repr(environment), "<cellwalk.Environment, 3D, 96 cells, 80 walls>")
        del environment
        gc.collect()
        self.assertTrue(numpy.array_equal(view, before))

    def test_targets_may_be_the_points_themselves(self):
        environment = room()
        moves = environment.reshape(numpy.arange(len(environment.points)), environment.points)
        self.assertTrue((moves.end == MoveEnd.REACHED).all())

    def test_simplicial(self):
        for made in (plane(), room(), cellwalk.Environment.from_arrays(*CUBE, simplicial=True)):
            corners = made.dimension + 1
            moves = made.reshape(numpy.arange(corners), made.points[:corners] * 0.5 + 0.25, at_contact="test")
            self.assertEqual(len(moves), corners)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "cube.ovm"
            cellwalk.Environment.from_arrays(*CUBE).save(path)
            self.assertEqual(cellwalk.Environment.import_mesh(path).cell_count, 1)
            split = cellwalk.Environment.import_mesh(path, simplicial=True)
        self.assertGreaterEqual(split.cell_count, 5)
        self.assertEqual(split.certificate["volume"], 1)
        for make in (lambda **o: cellwalk.Environment.from_arrays(*CUBE, **o), lambda **o: cellwalk.Environment.import_mesh(path, **o)):
            with self.assertRaisesRegex(cellwalk.UsageError, "simplicial=True splits cells"):
                make(simplicial=True, split=False)


CUBE = (numpy.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float),
        numpy.array([[0, 1, 3, 2, 4, 5, 7, 6]]))


class Listing(unittest.TestCase):
    """What is listed goes on; what is not says so instead of missing a wall."""

    def setUp(self):
        self.environment = room()
        self.body = cellwalk.Body(self.environment, *thread())
        self.particles = cellwalk.Particles(self.environment, numpy.array([[1.3, 0.7, 0.5], [1.3, 0.7, 0.125]]))
        self.floor = floor_of(self.environment)

    def raise_floor(self, height=0.25, **options):
        return self.environment.reshape(self.floor, at_height(self.environment, self.floor, height), **options)

    def test_what_is_not_listed(self):
        self.raise_floor(bodies=[self.body], at_contact="push")
        self.body.validate()
        with self.assertRaisesRegex(cellwalk.UsageError, "Particles.locate_again"):
            self.particles.move(self.particles.positions + 0.125)
        with self.assertRaisesRegex(cellwalk.UsageError, "Particles.locate_again"):
            self.raise_floor(0, bodies=[self.body], particles=[self.particles])
        self.assertEqual(self.environment.points[self.floor[0], 2], 0.25, "nothing moved")
        self.particles.locate_again()
        self.assertEqual((self.particles.cells >= 0).tolist(), [True, False])
        self.assertEqual(self.particles.move(self.particles.positions + 0.125).status.tolist(), [Status.FREE, Status.OUTSIDE])
        self.raise_floor(0, particles=[self.particles])
        for use in (lambda: self.body.step(self.body.positions + 0.0), lambda: self.body.move_vertex(0, [0.5, 0.5, 0.5]),
                    self.body.validate, lambda: self.raise_floor(0, bodies=[self.body])):
            with self.assertRaisesRegex(cellwalk.UsageError, r"register_again\(\)"):
                use()
        self.body.register_again()
        self.body.validate()
        self.particles.locate_again(threads=1)
        self.assertEqual((self.particles.cells >= 0).tolist(), [True, True])

    def test_asking_changes_nothing_for_what_is_not_listed(self):
        moves = self.raise_floor(at_contact="test", bodies=[self.body])
        self.assertIn(MoveEnd.REACHED, moves.end)
        self.assertTrue((self.particles.move(self.particles.positions + 0.125).status == Status.FREE).all())
        self.body.validate()
        self.raise_floor(at_contact="test")
        self.body.validate()
        self.body.step(self.body.positions + [0, 0, 0.125])

    def test_register_again_where_a_wall_came_to_lie(self):
        self.raise_floor()
        with self.assertRaisesRegex(cellwalk.OutsideError, "vertex"):
            self.body.register_again()
        self.raise_floor(0)
        self.body.register_again()
        self.body.step(self.body.positions + [0, 0, 0.125])
        self.body.validate()

    def test_particles_at_walls_keep_their_sides(self):
        """A wall with free space on both sides: located again, a particle in it stays on its own side."""
        points = numpy.array([[0.0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1], [1, 0], [1, 1]])
        slit = cellwalk.Environment.from_arrays(points, numpy.array([[0, 1, 4], [0, 4, 3], [6, 2, 5], [6, 5, 7]]), duplicates="keep")
        particles = cellwalk.Particles(slit, numpy.array([[0.5, 0.5], [1.5, 0.5]]))
        self.assertTrue((particles.move(numpy.array([[1.0, 0.5], [1.0, 0.5]])).status == Status.FREE).all())
        cells = particles.cells
        self.assertNotEqual(*(cells // 2).tolist())
        particles.locate_again()
        self.assertEqual((particles.cells // 2).tolist(), (cells // 2).tolist())


class Refusals(unittest.TestCase):
    def setUp(self):
        self.environment = room()
        self.before = self.environment.points.copy()
        self.body = cellwalk.Body(self.environment, *thread())
        self.particles = cellwalk.Particles(self.environment, numpy.array([[1.3, 0.7, 0.5]]))

    def refused(self, error, message, *arguments, environment=None, **options):
        with self.assertRaisesRegex(error, message):
            (environment or self.environment).reshape(*arguments, **options)
        self.assertTrue(numpy.array_equal(self.environment.points, self.before))
        self.body.validate()
        self.assertEqual(self.particles.move(self.particles.positions.copy()).status.tolist(), [Status.FREE])

    def test_arrays(self):
        to = self.before[:2] + [0, 0, -0.125]
        self.refused(TypeError, "targets must be real numbers", [0, 1], to.astype(complex))
        self.refused(ValueError, r"targets has shape \(2, 2\): \(N, 3\) is needed", [0, 1], to[:, :2])
        self.refused(TypeError, r"points must be integers \(N,\), or a boolean mask \(45,\), and is float64", numpy.zeros(2), to)
        self.refused(ValueError, r"points has shape \(2, 1\): \(N,\) is needed", numpy.zeros((2, 1), int), to)
        self.refused(ValueError, r"targets has shape \(2, 3\): \(3, 3\), a row for each of points, is needed", [0, 1, 2], to)
        self.refused(IndexError, r"points\[1\] is 45: there are 45 points, numbered from 0", [0, 45], to)
        self.refused(ValueError, r"points\[0\] is -1: there are", [-1, 0], to)
        self.refused(IndexError, r"points has shape \(3,\): a mask of the points has shape \(45,\)", numpy.ones(3, bool), to)
        self.refused(ValueError, r"points\[1\] is 7, as points\[0\] is", [7, 7], to)
        for x in (numpy.nan, numpy.inf):
            to[1, 2] = x
            self.refused(ValueError, r"targets\[1\] is not finite", [0, 1], to)
        self.assertEqual(len(self.environment.reshape(numpy.zeros(0, numpy.uint8), numpy.zeros((0, 3)),
                                                      bodies=[self.body], particles=[self.particles])), 0)

    def test_lists(self):
        empty = numpy.zeros(0, int), numpy.zeros((0, 3))
        other = room()
        self.refused(TypeError, r"bodies\[0\] is Particles: a list of Body is needed", *empty, bodies=[self.particles])
        self.refused(TypeError, r"particles\[1\] is NoneType", *empty, particles=[self.particles, None])
        self.refused(TypeError, "bodies is Body: a list of Body is needed", *empty, bodies=self.body)
        self.refused(cellwalk.UsageError, r"bodies\[1\] is bodies\[0\] again: list it once", *empty, bodies=[self.body] * 2)
        self.refused(cellwalk.UsageError, r"particles\[1\] is particles\[0\] again", *empty, particles=[self.particles] * 2)
        for listed in ({"bodies": [self.body]}, {"particles": [self.particles]}):
            self.refused(cellwalk.UsageError, "lies in another environment", *empty, environment=other, **listed)

    def test_words_and_numbers(self):
        empty = numpy.zeros(0, int), numpy.zeros((0, 3))
        self.refused(cellwalk.UsageError, "at_contact takes stop, hold, push, test, not bounce", *empty, at_contact="bounce")
        self.refused(cellwalk.UsageError, "sweep takes three_segments, triangle, faces, not all", *empty, sweep="all")
        self.refused(cellwalk.UsageError, "most_rounds takes a number from 1, not 0", *empty, most_rounds=0)
        self.refused(cellwalk.UsageError, "most_pushes takes a number from 0, not -1", *empty, most_pushes=-1)
        self.refused(cellwalk.UsageError, "most_contacts takes a number from 1, not 0", *empty, most_contacts=0)

    def test_cells_that_are_no_simplices(self):
        for kind, shape in (("hexes", "tetrahedron"), ("squares", "triangle")):
            whole = cellwalk.Environment.generate(kind, cells=2)
            with self.assertRaisesRegex(cellwalk.UsageError, rf"point 1 cannot be moved: cell 0 at it is not a {shape}; make the "
                                                             "environment with simplicial=True"):
                whole.reshape([1], whole.points[1:2] - 0.125)


if __name__ == "__main__":
    unittest.main()
