# SPDX-License-Identifier: LGPL-3.0-or-later
"""Particles that bounce, and go on from corresponding walls: against motions folded by NumPy."""

import pathlib
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk import Status
from test_traces import SIZE, same, sums


def folded(x, size, reflects):
    """Where motions without walls are in [0, size]: back and forth, or round and round."""
    rest = numpy.mod(x, 2 * size if reflects else size)
    return numpy.where(rest > size, 2 * size - rest, rest)


class Bouncing(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("tets", cells=SIZE)
        rng = numpy.random.default_rng(8)
        self.starts, self.ends = rng.uniform(0, SIZE, (10_000, 3)), rng.uniform(-3 * SIZE, 4 * SIZE, (10_000, 3))
        self.starts[::2], self.ends[::2] = self.starts[::2].round(1), self.ends[::2].round(1)
        facets = self.environment.facets()
        self.walls = facets[facets["wall"]]
        self.sides = [[self.walls[self.walls["mean"][:, axis] == end] for end in (0, SIZE)] for axis in range(3)]

    def check(self, options, reflects):
        """`reflects`: of each axis."""
        one, other = (cellwalk.Particles(self.environment, self.starts) for _ in range(2))
        traces = one.trace(self.ends, **options)
        self.assertTrue((traces.status == Status.FREE).all())
        signs = numpy.stack([numpy.floor(self.ends[:, axis] / SIZE) % 2 * -2 + 1 if reflects[axis] else numpy.ones(len(self.ends)) for axis in range(3)], axis=1)
        inner = (self.ends % SIZE != 0).all(axis=1)
        numpy.testing.assert_allclose(traces.heading[inner], (signs * (self.ends - self.starts))[inner], atol=1e-12)
        expected = numpy.stack([folded(self.ends[:, axis], SIZE, reflects[axis]) for axis in range(3)], axis=1)
        off = abs(one.positions - expected)
        # At a joined wall a motion may end on either.
        off = numpy.where(reflects, off, numpy.minimum(off, abs(SIZE - off)))
        self.assertLess(off.max(), 1e-12)
        located = self.environment.locate(numpy.ascontiguousarray(one.positions))
        self.assertTrue((located.status == cellwalk.Place.FREE).all())
        self.assertTrue((traces.cell == one.cells).all())
        numpy.testing.assert_allclose(sums(traces), numpy.linalg.norm(self.ends - self.starts, axis=1), rtol=1e-12)
        self.assertGreater(numpy.count_nonzero(self.environment.facets()["wall"][traces.surfaces]), 3 * len(self.starts))
        self.assertTrue(same(traces, other.trace(self.ends, threads=1, **options)))
        self.assertEqual(one.positions.tobytes(), other.positions.tobytes())
        made = [cellwalk.Particles(self.environment, self.starts).tally(self.ends, threads=threads, **options) for threads in (1, 2)]
        self.assertEqual(made[0].tobytes(), made[1].tobytes())
        numpy.testing.assert_allclose(made[0], numpy.bincount(traces.cells, traces.lengths, self.environment.cell_count), rtol=1e-11)

    def test_mirrors(self):
        self.check({"reflect": [self.walls]}, [True] * 3)

    def test_a_torus(self):
        self.check({"periodic": self.sides}, [False] * 3)

    def test_both(self):
        self.check({"reflect": self.sides[0] + self.sides[2], "periodic": [self.sides[1]]}, [True, False, True])

    def test_most_bounces(self):
        particles = cellwalk.Particles(self.environment, self.starts)
        traces = particles.trace(self.ends, reflect=[self.walls], most_bounces=1)
        bounces = numpy.add.reduceat(numpy.append(self.environment.facets()["wall"][traces.surfaces], False), traces.surface_offsets[:-1])
        bounces[numpy.diff(traces.surface_offsets) == 0] = 0
        self.assertEqual(bounces.max(), 1)
        blocked = traces.status == Status.CONTACT
        self.assertTrue((traces.wall[blocked] >= 0).all() and blocked.any() and not blocked.all())
        self.assertTrue((particles.positions[blocked] == self.starts[blocked]).all())


class BouncingGroups(unittest.TestCase):
    """Names of groups, and what is refused."""

    def setUp(self):
        # Two unit squares side by side, and groups of their outer edges.
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "channel.ovm")
            path.write_text("OVM ASCII\nVertices\n6\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\nEdges\n7\n0 1\n1 2\n2 5\n5 4\n4 3\n3 0\n1 4\n"
                            "Faces\n2\n4 0 12 8 10\n4 2 4 6 13\nPolyhedra\n0\n"
                            "EProp bool \"group left\"\n0 0 0 0 0 1 0\nEProp bool \"group right\"\n0 0 1 0 0 0 0\n"
                            "EProp bool \"group plates\"\n1 1 0 1 1 0 0\nEProp bool \"group floor\"\n1 1 0 0 0 0 0\n"
                            "EProp bool \"group gate\"\n0 0 0 0 0 0 1\nFProp bool \"group cell\"\n1 0\n")
            self.environment = cellwalk.Environment.load(path)

    def test_a_channel(self):
        particles = cellwalk.Particles(self.environment, numpy.array([[0.5, 0.5]]))
        traces = particles.trace(numpy.array([[4.75, 2.75]]), reflect=["plates"], periodic=[("left", "right")])
        self.assertEqual(traces.status.tolist(), [Status.FREE])
        numpy.testing.assert_allclose(particles.positions, [[0.75, 0.75]], atol=1e-14)
        self.assertAlmostEqual(traces.lengths.sum(), numpy.hypot(4.25, 2.25), delta=1e-14)
        rows = {name: self.environment.facet_rows(self.environment.select(group=name).facets) for name in ("left", "right", "plates", "gate")}
        self.assertEqual([numpy.count_nonzero(numpy.isin(traces.surfaces, rows[name])) for name in ("left", "right", "plates", "gate")],
                         [0, 2, 2, 2])

    def test_refusals(self):
        particles = cellwalk.Particles(self.environment, numpy.array([[0.5, 0.5]]))
        targets = numpy.array([[0.75, 0.5]])
        for error, message, options in (
                (cellwalk.InputError, r'reflect\[1\]: there is no group "roof": the environment has cell, floor,', {"reflect": ["floor", "roof"]}),
                (cellwalk.InputError, r"periodic\[0\]: the two groups do not correspond: their extents are \(0, 1\) and \(2, 0\)",
                 {"periodic": [("left", "floor")]}),
                (cellwalk.InputError, r"periodic\[0\]: the two groups do not correspond: facet \d of cell 0, translated by", {"periodic": [("left", "left")]}),
                (cellwalk.InputError, r"reflect\[1\]: facet \d of cell 0 is in two groups", {"reflect": ["floor", "plates"]}),
                (cellwalk.InputError, r"periodic\[0\]: facet \d of cell 1 is in two groups", {"reflect": ["right"], "periodic": [("left", "right")]}),
                (cellwalk.InputError, r"periodic\[0\]: facet \d of cell 0 is open", {"periodic": [("gate", "left")]}),
                (cellwalk.InputError, r"periodic\[0\]: there is no wall", {"periodic": [("cell", "left")]}),
                (TypeError, "reflect must be a list of groups", {"reflect": "plates"}),
                (TypeError, "periodic must be a list of pairs of groups", {"periodic": ["left", "right"]}),
                (TypeError, "periodic must be a list of pairs of groups", {"periodic": [("left",)]}),
                (TypeError, "reflect must be integers", {"reflect": [1.5]}),
                (cellwalk.UsageError, "most_bounces takes a number from 0, not -1", {"reflect": ["plates"], "most_bounces": -1})):
            for call in (particles.trace, particles.tally):
                with self.assertRaisesRegex(error, message):
                    call(targets, **options)
        self.assertEqual(particles.positions.tolist(), [[0.5, 0.5]])


if __name__ == "__main__":
    unittest.main()
