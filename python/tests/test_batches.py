# SPDX-License-Identifier: LGPL-3.0-or-later
"""Batches of points and edges: right by arithmetic that is known, the same for any number of threads, and the same as one by one."""

import unittest

import numpy

import cellwalk
from cellwalk import Feature, Place, Status


def box_time(starts, targets, size):
    """When motions leave the box [0, size]^3: by numpy alone."""
    with numpy.errstate(divide="ignore", invalid="ignore"):
        motion = targets - starts
        times = numpy.where(motion > 0, (size - starts) / motion, numpy.where(motion < 0, -starts / motion, numpy.inf))
    return times.min(axis=1)


class InABox(unittest.TestCase):
    """A grid without inner walls is a box: where motions end is known."""

    size = 8

    def setUp(self):
        self.environment = cellwalk.Environment.generate("tets", cells=self.size)
        rng = numpy.random.default_rng(11)
        # Eighths: many points lie on facets, edges and vertices.
        self.starts = rng.integers(0, 8 * self.size + 1, (20_000, 3)) / 8
        self.targets = rng.integers(-16, 8 * self.size + 17, (20_000, 3)) / 8

    def check(self, motions):
        inside = ((self.targets >= 0) & (self.targets <= self.size)).all(axis=1)
        self.assertGreater(numpy.count_nonzero(inside), 5000)
        self.assertGreater(numpy.count_nonzero(~inside), 5000)
        self.assertTrue((motions.status == numpy.where(inside, Status.FREE, Status.CONTACT)).all())
        self.assertTrue((motions.time[inside] == 1).all())
        self.assertTrue(numpy.array_equal(motions.contacts["row"], numpy.nonzero(~inside)[0]))
        expected = box_time(self.starts, self.targets, self.size)[~inside]
        numpy.testing.assert_allclose(motions.contacts["time"], expected, rtol=1e-14, atol=1e-300)
        numpy.testing.assert_allclose(motions.time[~inside], expected, rtol=1e-14, atol=1e-300)
        lengths = numpy.linalg.norm(motions.contacts["normal"], axis=1)
        numpy.testing.assert_allclose(lengths, 1, rtol=1e-14)
        for kind, least in ((Feature.VERTEX, 5), (Feature.EDGE, 200), (Feature.FACET, 5000)):
            self.assertGreater(numpy.count_nonzero(motions.contacts["kind"] == kind), least)

    def test_walk(self):
        self.check(self.environment.walk(self.starts, self.targets))

    def test_walk_with_a_radius(self):
        """A point of radius r is one without in a box that is smaller by r on each side."""
        for radius in (0.5, numpy.where(numpy.arange(len(self.starts)) % 2 == 0, 0.25, 1.5)):
            motions = self.environment.walk(self.starts, self.targets, radius=radius)
            r = numpy.broadcast_to(radius, len(self.starts))[:, None]
            close = ((self.starts < r) | (self.starts > self.size - r)).any(axis=1)
            free = ~close & ((self.targets >= r) & (self.targets <= self.size - r)).all(axis=1)
            blocked = ~close & ~free
            self.assertGreater(min(numpy.count_nonzero(some) for some in (close, free, blocked)), 1000)
            expected = numpy.select([close, free], [Status.CLOSE, Status.FREE], Status.CONTACT)
            self.assertTrue((motions.status == expected).all())
            self.assertTrue(numpy.isnan(motions.time[close]).all())
            self.assertTrue((motions.time[free] == 1).all())
            times = box_time(self.starts - r, self.targets - r, self.size - 2 * r)
            numpy.testing.assert_allclose(motions.time[blocked], times[blocked], rtol=1e-14, atol=1e-300)
            stops = motions.contacts[~numpy.isnan(motions.contacts["time"])]
            at = self.starts[stops["row"]] + stops["time"][:, None] * (self.targets - self.starts)[stops["row"]]
            numpy.testing.assert_allclose(stops["point"] + r[stops["row"]] * stops["normal"], at, atol=1e-13)

    def test_a_radius_is_checked(self):
        some = self.starts[:3]
        for radius, error in ((-1, ValueError), (numpy.nan, ValueError), (numpy.array([0.0, 1.0]), ValueError),
                              (numpy.array([0, 1j, 2]), TypeError), ("1", TypeError), (numpy.array([0.0, -1, 0]), ValueError)):
            with self.assertRaises(error):
                self.environment.walk(some, some, radius=radius)
        with self.assertRaisesRegex(cellwalk.UsageError, "kernel"):
            self.environment.walk(some, some, radius=1, kernel="double")
        with self.assertRaisesRegex(cellwalk.UsageError, "touch stop"):
            self.environment.walk(some, some, radius=1, touch="stop")

    def test_particles(self):
        particles = cellwalk.Particles(self.environment, self.starts)
        motions = particles.move(self.targets)
        self.check(motions)
        arrived = motions.status == Status.FREE
        self.assertTrue((particles.positions[arrived] == self.targets[arrived]).all())
        self.assertTrue((particles.positions[~arrived] == self.starts[~arrived]).all())
        self.assertTrue((particles.cells[arrived] == motions.cell[arrived]).all())

    def test_particles_that_stop_at_the_wall(self):
        particles = cellwalk.Particles(self.environment, self.starts)
        motions = particles.move(self.targets, at_contact="stop")
        self.check(motions)
        rows = motions.contacts["row"]
        off = numpy.abs(particles.positions[rows] - motions.contacts["point"]).max(axis=1)
        # Nearly all stop at a rounding of the contact; the others a little before it, on their way.
        self.assertLess(numpy.quantile(off, 0.99), 1e-9)
        self.assertLess(off.max(), 1e-4)
        self.assertTrue((self.environment.locate(particles.positions.copy()).status == Place.FREE).all())

    def test_threads_do_not_matter(self):
        one = self.environment.walk(self.starts, self.targets, threads=1)
        two = self.environment.walk(self.starts, self.targets, threads=2)
        for name in ("status", "time", "cell", "cells", "contacts"):
            self.assertEqual(getattr(one, name).tobytes(), getattr(two, name).tobytes(), name)
        self.assertEqual(one.counts, two.counts)

    def test_kernels_that_round_are_for_experiments(self):
        rounded = self.environment.walk(self.starts, self.targets, kernel="double")
        exact = self.environment.walk(self.starts, self.targets)
        agreeing = numpy.count_nonzero(rounded.status == exact.status)
        self.assertGreater(agreeing, 0.9 * len(exact))
        with self.assertRaisesRegex(cellwalk.UsageError, 'needs kernel="exact"'):
            self.environment.walk(self.starts, self.targets, kernel="double", touch="stop")


class Rows(unittest.TestCase):
    def test_every_status(self):
        environment = cellwalk.Environment.generate("hexes", cells=2)
        starts = numpy.array([[0.5, 0.5, 0.5]] * 3 + [[9.0, 0.5, 0.5]])
        targets = numpy.array([[1.5, 0.5, 0.5], [2.5, 0.5, 0.5], [numpy.nan, 0.5, 0.5], [0.5, 0.5, 0.5]])
        expected = [Status.FREE, Status.CONTACT, Status.INVALID, Status.OUTSIDE]
        for motions in (environment.walk(starts, targets), cellwalk.Particles(environment, starts).move(targets)):
            self.assertEqual(motions.status.tolist(), expected)
            motions.contacts["row"] += 10**6  # the caller's to change; what is made when it is asked for does not read it
            self.assertEqual(motions.time[:2].tolist(), [1, 0.75])
            self.assertTrue(numpy.isnan(motions.time[2:]).all())
            self.assertEqual(motions.cell.tolist(), [1, 1, -1, -1])
            self.assertEqual(motions.cells.tolist(), [2, 2, 0, 0])

    def test_names_are_those_of_the_library(self):
        from cellwalk import _cellwalk

        self.assertEqual(_cellwalk.status_names, tuple(status.name.lower() for status in Status))

    def test_places(self):
        environment = cellwalk.Environment.generate("hexes", cells=4, solid=0.05, seed=3)
        centres = numpy.stack(numpy.meshgrid(*[numpy.arange(4) + 0.5] * 3, indexing="ij"), -1).reshape(-1, 3)
        found = environment.locate(numpy.ascontiguousarray(centres))
        solid = numpy.count_nonzero(found.status == Place.SOLID)
        self.assertEqual(solid, environment.certificate["solid_cells"])
        self.assertGreater(solid, 0)
        self.assertTrue((found.cell[found.status == Place.SOLID] == -1).all())
        corner = environment.locate(numpy.array([[0.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [numpy.inf, 0, 0]]))
        self.assertEqual(corner.dimension[0], 0)
        self.assertEqual(corner.status.tolist(), [Place.FREE, Place.OUTSIDE, Place.OUTSIDE])


class Edges(unittest.TestCase):
    """A solid cell in the middle of the plane: an edge that swings round it is blocked by its corner."""

    def setUp(self):
        points = numpy.array([[x, y] for y in range(4) for x in range(4)], dtype=float)
        cells = [[x + 4 * y, x + 1 + 4 * y, x + 5 + 4 * y, x + 4 + 4 * y] for y in range(3) for x in range(3)]
        del cells[4]
        self.environment = cellwalk.Environment.from_arrays(points, numpy.array(cells))
        # q stands left of the hole, p swings from below to above on its right, and back at its left.
        self.p = numpy.array([[2.5, 0.5], [0.5, 0.5], [2.0, 0.5]])
        self.t = numpy.array([[2.5, 2.5], [0.5, 2.5], [2.0, 0.875]])
        self.q = numpy.array([[0.5, 0.5], [0.25, 0.5], [0.5, 1.0]])

    def test_what_the_sweep_finds(self):
        for sweep in ("triangle", "faces"):
            motions = self.environment.sweep(self.p, self.t, self.q, sweep=sweep)
            self.assertEqual(motions.status.tolist(), [Status.CONTACT, Status.FREE, Status.FREE])
            contact = motions.contacts[0]
            # The line from (0.5, 0.5) through the corner (2, 1) passes x = 2.5 at y = 0.5 + 2/3.
            self.assertAlmostEqual(contact["time"], 1 / 3, delta=1e-15)
            self.assertEqual((contact["body"], contact["kind"]), (Feature.EDGE, Feature.VERTEX))
            self.assertEqual(contact["point"].round(12).tolist(), [2.0, 1.0])

    def test_searches_and_touch(self):
        exact = self.environment.sweep(self.p, self.t, self.q).contacts["time"][0]
        halved = self.environment.sweep(self.p, self.t, self.q, search="dichotomic", tolerance=2.0**-10)
        self.assertLessEqual(halved.contacts["time"][0], exact)
        self.assertGreater(halved.contacts["time"][0], exact - 2.0**-10)
        all_walls = self.environment.sweep(self.p, self.t, self.q, search="exhaustive")
        self.assertEqual(all_walls.contacts["time"][0], exact)
        of_all = self.environment.sweep(self.p, self.t, self.q, search="exhaustive", search_limit="none")
        self.assertEqual(of_all.contacts["time"][0], exact)
        segment = self.environment.sweep(self.p, self.t, self.q, search="dichotomic_segment", tolerance=2.0**-10)
        self.assertGreater(segment.contacts["time"][0], exact - 2.0**-10)
        touching = self.environment.sweep(self.p[2:], numpy.array([[1.5, 1.0]]), self.q[2:], touch="stop")
        self.assertEqual(touching.status.tolist(), [Status.CONTACT])

    def test_three_segments_sees_only_the_ends(self):
        p, t, q = numpy.array([[2.5, 0.25]]), numpy.array([[2.5, 2.75]]), numpy.array([[0.25, 0.25]])
        whole = self.environment.sweep(p, t, q)
        segments = self.environment.sweep(p, t, q, sweep="three_segments")
        self.assertEqual((whole.status[0], segments.status[0]), (Status.CONTACT, Status.CONTACT))


if __name__ == "__main__":
    unittest.main()
