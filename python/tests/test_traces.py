# SPDX-License-Identifier: LGPL-3.0-or-later
"""Traces and tallies: the same ends as walks and moves, lengths that sum up to those of motions, the same bytes on any number of threads."""

import pathlib
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk import Status
from edit_worlds import plane

SIZE = 6


def motions(seed, count=20_000):
    """Half of them from and to eighths, where facets, edges and vertices are."""
    rng = numpy.random.default_rng(seed)
    starts, ends = rng.uniform(0, SIZE, (count, 3)), rng.uniform(-1, SIZE + 1, (count, 3))
    starts[::2], ends[::2] = rng.integers(0, 8 * SIZE + 1, (count // 2, 3)) / 8, rng.integers(-8, 8 * SIZE + 9, (count // 2, 3)) / 8
    return starts, ends


def sums(traces):
    """Of the lengths of each row."""
    return numpy.array([traces.lengths[a:b].sum() for a, b in zip(traces.offsets[:-1], traces.offsets[1:])])


def same(one, other):
    return all(getattr(one, name).tobytes() == getattr(other, name).tobytes()
               for name in ("offsets", "cells", "lengths", "surface_offsets", "surfaces", "forward", "heading", "wall", "status", "cell"))


class InTetrahedra(unittest.TestCase):
    def setUp(self):
        self.environment = cellwalk.Environment.generate("tets", cells=SIZE)
        self.starts, self.ends = motions(3)
        self.traces = self.environment.trace(self.starts, self.ends)
        self.row = numpy.repeat(numpy.arange(len(self.starts)), numpy.diff(self.traces.offsets))

    def test_shapes_and_types(self):
        traces, n = self.traces, len(self.starts)
        self.assertEqual(len(traces), n)
        for name, dtype, size in (("offsets", "int64", n + 1), ("cells", "int32", traces.offsets[-1]), ("lengths", "float64", traces.offsets[-1]),
                                  ("surface_offsets", "int64", n + 1), ("surfaces", "int32", traces.surface_offsets[-1]),
                                  ("forward", "bool", traces.surface_offsets[-1]), ("heading", "float64", (n, 3)), ("wall", "int32", n), ("status", "uint8", n), ("cell", "int32", n)):
            self.assertEqual((getattr(traces, name).dtype, getattr(traces, name).shape), (numpy.dtype(dtype), numpy.empty(size).shape), name)
        self.assertEqual(repr(traces), f"<cellwalk.Traces of {n} rows, {traces.offsets[-1]} pieces, {traces.surface_offsets[-1]} crossings>")
        self.assertGreater(traces.offsets[-1], 5 * n)
        empty = self.environment.trace(numpy.empty((0, 3)), numpy.empty((0, 3)))
        self.assertEqual((len(empty), empty.offsets.tolist(), empty.cells.shape), (0, [0], (0,)))

    def test_ends_are_those_of_walks(self):
        walks = self.environment.walk(self.starts, self.ends)
        self.assertTrue((self.traces.status == walks.status).all())
        self.assertTrue((self.traces.cell == walks.cell).all())
        facets = self.environment.facets()
        blocked = walks.contacts["row"]
        self.assertGreater(len(blocked), 1000)
        self.assertTrue((self.traces.wall[blocked] == self.environment.facet_rows(walks.contacts)).all())
        self.assertTrue(facets["wall"][self.traces.wall[blocked]].all())
        self.assertTrue((numpy.delete(self.traces.wall, blocked) == -1).all())

    def test_lengths_sum_up(self):
        times = self.environment.walk(self.starts, self.ends).time
        expected = times * numpy.linalg.norm(self.ends - self.starts, axis=1)
        numpy.testing.assert_allclose(sums(self.traces), expected, rtol=1e-13, atol=1e-14)
        self.assertTrue((self.traces.lengths >= 0).all())

    def test_pieces_lie_in_their_cells(self):
        """The middle of each piece lies in the box of its cell, and in the cell by location where it lies in one only."""
        after = numpy.cumsum(self.traces.lengths)
        after -= numpy.concatenate([[0], after])[self.traces.offsets[:-1]][self.row]
        share = (after - self.traces.lengths / 2) / numpy.linalg.norm(self.ends - self.starts, axis=1)[self.row]
        middle = self.starts[self.row] + share[:, None] * (self.ends - self.starts)[self.row]
        corners = self.environment.points[self.environment.cells()["points"][self.traces.cells]]
        self.assertTrue((middle >= corners.min(axis=1) - 1e-9).all() and (middle <= corners.max(axis=1) + 1e-9).all())
        located = self.environment.locate(middle)
        clear = (located.dimension == 3) & (self.traces.lengths > 1e-6)
        self.assertGreater(numpy.count_nonzero(clear), len(clear) // 2)
        self.assertGreater(numpy.mean(located.cell[clear] == self.traces.cells[clear]), 0.999)

    def test_surfaces_lead_from_cell_to_cell(self):
        """The facets that a row crosses lead from the cell of its start to that of its end, whatever it passes."""
        facets = self.environment.facets()
        crossed = facets[self.traces.surfaces]
        self.assertFalse(crossed["wall"].any())
        left = numpy.where(self.traces.forward, crossed["cell"], crossed["neighbour"])
        entered = numpy.where(self.traces.forward, crossed["neighbour"], crossed["cell"])
        begin, end = self.traces.surface_offsets[:-1], self.traces.surface_offsets[1:]
        inner = numpy.ones(len(left), bool)
        inner[begin[begin < end]] = False
        self.assertTrue((left[inner] == entered[:-1][inner[1:]]).all())
        crossing = begin < end
        self.assertTrue((entered[end[crossing] - 1] == self.traces.cell[crossing]).all())
        first = self.traces.cells[self.traces.offsets[:-1][crossing & (numpy.diff(self.traces.offsets) > 0)]]
        self.assertGreater(numpy.mean(first == left[begin[crossing & (numpy.diff(self.traces.offsets) > 0)]]), 0.5)

    def test_threads(self):
        for threads in (1, 2, 3):
            self.assertTrue(same(self.traces, self.environment.trace(self.starts, self.ends, threads=threads)))
        halves = [self.environment.trace(self.starts[part], self.ends[part]) for part in (slice(0, 9999), slice(9999, None))]
        self.assertEqual(numpy.concatenate([half.lengths for half in halves]).tobytes(), self.traces.lengths.tobytes())

    def test_particles_move(self):
        one, other = (cellwalk.Particles(self.environment, self.starts) for _ in range(2))
        for seed in (4, 5):
            targets = motions(seed)[1]
            traces, moved = one.trace(targets, threads=2), other.move(targets)
            self.assertTrue((traces.status == moved.status).all())
            self.assertTrue((traces.cell == moved.cell).all())
            self.assertEqual(one.positions.tobytes(), other.positions.tobytes())
            self.assertTrue((one.cells == other.cells).all())
            self.assertGreater(numpy.count_nonzero(traces.status == Status.CONTACT), 1000)

    def test_tally_is_the_sum_of_traces(self):
        rng = numpy.random.default_rng(6)
        weights = rng.uniform(-1, 3, len(self.starts))
        for given, values in ((None, self.traces.lengths), (weights, weights[self.row] * self.traces.lengths)):
            expected = numpy.bincount(self.traces.cells, values, self.environment.cell_count)
            made = self.environment.tally(self.starts, self.ends, weights=given)
            self.assertEqual((made.dtype, made.shape), (numpy.dtype("float64"), (self.environment.cell_count,)))
            numpy.testing.assert_allclose(made, expected, rtol=1e-11, atol=1e-12)
            for threads in (1, 2, 3):
                again = self.environment.tally(self.starts, self.ends, weights=given, threads=threads)
                self.assertEqual(again.tobytes(), made.tobytes())
            order = rng.permutation(len(self.starts))
            shuffled = self.environment.tally(self.starts[order], self.ends[order], weights=None if given is None else given[order])
            self.assertEqual(shuffled.tobytes(), made.tobytes())
            particles = cellwalk.Particles(self.environment, self.starts)
            numpy.testing.assert_array_equal(particles.tally(self.ends, weights=given), made)
            moved = cellwalk.Particles(self.environment, self.starts)
            moved.move(self.ends)
            self.assertEqual(particles.positions.tobytes(), moved.positions.tobytes())

    def test_tally_adds_to_an_array(self):
        start = numpy.arange(float(self.environment.cell_count))
        out = start.copy()
        self.assertIs(self.environment.tally(self.starts, self.ends, out=out), out)
        numpy.testing.assert_array_equal(out, start + self.environment.tally(self.starts, self.ends))

    def test_small_values_among_large_ones(self):
        """Far targets and weights of 0 do not make sums coarse."""
        starts, ends = numpy.full((2, 3), 0.4), numpy.array([[0.4, 0.4, 1e300], [0.4, 0.4, 0.4 + 1e-9]])
        made = self.environment.tally(starts, ends, weights=[0, 1])
        self.assertEqual(made.sum(), 0.4 + 1e-9 - 0.4)
        self.assertEqual(self.environment.tally(starts, ends, weights=[0, 0]).any(), False)
        self.assertEqual(self.environment.tally(starts[:0], ends[:0]).any(), False)


class Rows(unittest.TestCase):
    """Some particles are traced as if they were alone, and the others stand still."""

    def setUp(self):
        self.environment = cellwalk.Environment.generate("tets", cells=SIZE)
        self.starts, self.ends = motions(8, 12_000)
        self.rows = numpy.random.default_rng(9).permutation(len(self.starts))[:9_000][::2]

    def particles(self, rows=slice(None)):
        return cellwalk.Particles(self.environment, self.starts[rows])

    def test_traces_are_those_of_the_subset(self):
        rows, mask = self.rows, numpy.zeros(len(self.starts), bool)
        mask[rows] = True
        self.assertFalse(rows.flags.contiguous)
        for name, given, picked in (("strided", rows, rows), ("a list of few", rows[:3].tolist(), rows[:3]), ("a mask", mask, numpy.flatnonzero(mask))):
            for reflect in ((), [self.environment.facets()[self.environment.facets()["wall"]]]):
                with self.subTest(rows=name, reflects=bool(reflect)):
                    some, alone = self.particles(), self.particles(picked)
                    traces = some.trace(self.ends[picked], rows=given, reflect=reflect, threads=2)
                    self.assertTrue(same(traces, alone.trace(self.ends[picked], reflect=reflect)))
                    self.assertEqual(some.positions[picked].tobytes(), alone.positions.tobytes())
                    self.assertTrue((some.cells[picked] == alone.cells).all())
                    still = numpy.setdiff1d(numpy.arange(len(self.starts)), picked)
                    self.assertTrue((some.positions[still] == self.starts[still]).all())

    def test_tallies_are_those_of_the_subset(self):
        weights = numpy.random.default_rng(10).uniform(-1, 3, len(self.rows))
        for given in (None, weights):
            some, alone = self.particles(), self.particles(self.rows)
            made = some.tally(self.ends[self.rows], rows=self.rows, weights=given)
            self.assertEqual(made.tobytes(), alone.tally(self.ends[self.rows], weights=given).tobytes())
            self.assertEqual(some.positions[self.rows].tobytes(), alone.positions.tobytes())
        with self.assertRaisesRegex(ValueError, "weights has 2 values, and there are 1 motions"):
            some.tally(self.ends[:1], rows=[0], weights=weights[:2])

    def test_none_and_all(self):
        particles = self.particles()
        for none in ([], numpy.zeros(len(self.starts), bool)):
            self.assertEqual((len(particles.trace(numpy.empty((0, 3)), rows=none)), particles.tally(numpy.empty((0, 3)), rows=none).any()), (0, False))
        self.assertTrue((particles.positions == self.starts).all())
        traces = particles.trace(self.ends, rows=numpy.arange(len(self.starts), dtype=numpy.uint16))
        self.assertTrue(same(traces, self.particles().trace(self.ends)))

    def test_refusals_are_those_of_moves(self):
        particles, n = self.particles(), len(self.starts)
        for targets, rows in ((2, [0, n]), (2, [-1, 0]), (2, [3, 3]), (2, numpy.ones(n - 1, bool)), (2, [[0, 1]]), (2, [0.0, 1.0]), (2, slice(2)), (2, [0, 1, 2]), (0, [1]), (1, [])):
            with self.assertRaises((TypeError, ValueError, IndexError)) as moved:
                particles.move(self.ends[:targets], rows=rows)
            for call in (particles.trace, particles.tally):
                with self.assertRaises(type(moved.exception)) as refused:
                    call(self.ends[:targets], rows=rows)
                self.assertEqual(str(refused.exception), str(moved.exception))
        self.assertTrue((particles.positions == self.starts).all())


class ByHand(unittest.TestCase):
    def test_a_row_through_a_grid(self):
        traces = plane().trace([[0.5, 0.5], [0.5, 0.5]] @ numpy.eye(2), numpy.array([[2.5, 0.5], [0.5, -1.0]]))
        self.assertEqual(traces.cells.tolist(), [0, 1, 2, 0])
        self.assertEqual(traces.lengths.tolist(), [0.5, 1, 0.5, 0.5])
        self.assertEqual(traces.offsets.tolist(), [0, 3, 4])
        facets = plane().facets()
        self.assertEqual(facets["mean"][traces.surfaces].tolist(), [[1, 0.5], [2, 0.5]])
        self.assertEqual(traces.forward.tolist(), [True, True])
        self.assertEqual(traces.wall[0], -1)
        self.assertEqual(facets["mean"][traces.wall[1]].tolist(), [0.5, 0])
        self.assertEqual(traces.status.tolist(), [Status.FREE, Status.CONTACT])

    def test_along_facets_and_through_vertices(self):
        """Along a line of the grid each unit belongs to one of two cells; a diagonal passes vertices only."""
        environment = plane()  # 4 x 3 squares
        traces = environment.trace(numpy.array([[0.0, 1.0], [0.0, 0.0], [3.0, 3.0]]), numpy.array([[4.0, 1.0], [3.0, 3.0], [0.0, 0.0]]))
        pieces = [traces.cells[a:b].tolist() for a, b in zip(traces.offsets[:-1], traces.offsets[1:])]
        self.assertEqual([cell % 4 for cell in pieces[0]], [0, 1, 2, 3])
        self.assertEqual(pieces[1:], [[0, 5, 10], [10, 5, 0]])
        self.assertEqual(traces.lengths.tolist(), [1.0] * 4 + [numpy.sqrt(2)] * 6)
        # Two facets at each vertex, which lead round it.
        self.assertEqual(numpy.diff(traces.surface_offsets)[1:].tolist(), [4, 4])

    def test_forward_and_back(self):
        traces = plane().trace(numpy.array([[0.5, 0.5], [3.5, 0.5]]), numpy.array([[3.5, 0.5], [0.5, 0.5]]))
        self.assertEqual(traces.surfaces[:3].tolist(), traces.surfaces[:2:-1].tolist())
        self.assertEqual(traces.forward.tolist(), [True] * 3 + [False] * 3)

    def test_groups_join_surfaces(self):
        """The net number of crossings of a group is that of motions that change sides."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "two.ovm")
            path.write_text("OVM ASCII\nVertices\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nEdges\n5\n0 1\n1 2\n2 0\n2 3\n3 0\nFaces\n2\n3 0 2 4\n3 5 6 8\n"
                            "Polyhedra\n0\nEProp bool \"group valve\"\n0 0 1 0 0\n")
            environment = cellwalk.Environment.load(path)
        starts, ends = numpy.random.default_rng(1).uniform(0, 1, (2, 1000, 2))
        traces = environment.trace(starts, ends)
        valve = environment.facet_rows(environment.select(group="valve").facets)
        crossed = numpy.isin(traces.surfaces, valve)
        self.assertEqual(numpy.count_nonzero(crossed), numpy.count_nonzero((starts[:, 0] > starts[:, 1]) != (ends[:, 0] > ends[:, 1])))
        self.assertTrue((traces.surfaces[crossed] == valve[0]).all())

    def test_a_membrane(self):
        """A start on a membrane belongs to the side to which the motion leads, as with walk(); a particle keeps its side."""
        environment = plane()
        facets = environment.facets()
        with environment.editing() as edits:
            self.assertTrue(edits.close(facets[facets["mean"][:, 0] == 2]).made.all())
        starts, ends = numpy.array([[2.0, 0.5], [2.0, 0.5]]), numpy.array([[3.0, 0.5], [1.0, 0.5]])
        traces = environment.trace(starts, ends)
        self.assertEqual((traces.status.tolist(), traces.lengths.tolist(), traces.cells.tolist()), ([0, 0], [1.0, 1.0], [2, 1]))
        stays = cellwalk.Particles(environment, numpy.array([[1.5, 0.5]])).trace(numpy.array([[2.5, 0.5]]))
        self.assertEqual((stays.status.tolist(), stays.lengths.tolist()), ([Status.CONTACT], [0.5]))
        self.assertEqual(facets["mean"][stays.wall[0]].tolist(), [2, 0.5])

    def test_rows_that_are_not_made(self):
        environment = plane()
        starts = numpy.array([[9.0, 9.0], [0.5, 0.5], [numpy.nan, 0.5], [0.5, 0.5]])
        ends = numpy.array([[0.5, 0.5], [numpy.inf, 0.5], [0.5, 0.5], [1.5, 0.5]])
        walks = environment.walk(starts, ends)
        traces = environment.trace(starts, ends)
        self.assertEqual(traces.status.tolist(), [Status.OUTSIDE, Status.INVALID, Status.INVALID, Status.FREE])
        self.assertEqual(traces.status.tolist(), walks.status.tolist())
        self.assertEqual((traces.offsets.tolist(), traces.cell.tolist(), traces.wall.tolist()), ([0, 0, 0, 0, 2], [-1, -1, -1, 1], [-1] * 4))
        particles = cellwalk.Particles(environment, starts)
        moved = particles.trace(ends)
        self.assertEqual(moved.status.tolist(), [Status.OUTSIDE, Status.INVALID, Status.OUTSIDE, Status.FREE])
        self.assertEqual(particles.positions[[1, 3]].tolist(), [[0.5, 0.5], [1.5, 0.5]])
        self.assertEqual(environment.tally(starts, ends).sum(), 1)

    def test_after_edits(self):
        """The table of planes follows edits and walls that move."""
        environment = cellwalk.Environment.generate("hexes", cells=(2, 1, 1), simplicial=True)
        starts, ends = numpy.array([[0.25, 0.5, 0.375]]), numpy.array([[1.75, 0.5, 0.375]])
        self.assertAlmostEqual(environment.trace(starts, ends).lengths.sum(), 1.5, delta=1e-15)
        facets = environment.facets()
        with environment.editing() as edits:
            self.assertTrue(edits.close(facets[facets["mean"][:, 0] == 1]).made.all())
        self.assertAlmostEqual(environment.trace(starts, ends).lengths.sum(), 0.75, delta=1e-15)
        inserted = environment.cells()["mean"][0].tolist()
        with environment.editing() as edits:
            self.assertTrue(edits.insert_point(0, inserted))
        traces = environment.trace(starts, ends)
        self.assertEqual(environment.facets()["wall"][traces.wall].tolist(), [True])
        self.assertAlmostEqual(traces.lengths.sum(), 0.75, delta=1e-15)
        self.assertEqual(len(environment.tally(starts, ends)), environment.cell_count)
        middle = numpy.flatnonzero(environment.points[:, 0] == 1)
        targets = environment.points[middle]
        targets[:, 0] = 1.125
        self.assertTrue((environment.reshape(middle, targets).end == cellwalk.MoveEnd.REACHED).all())
        self.assertAlmostEqual(environment.trace(starts, ends).lengths.sum(), 0.875, delta=1e-15)


class Refusals(unittest.TestCase):
    def setUp(self):
        self.environment = plane()
        self.points = numpy.array([[0.5, 0.5], [1.5, 0.5]])

    def test_rows(self):
        for call in (self.environment.trace, self.environment.tally):
            with self.assertRaises((ValueError, TypeError)):
                call(self.points, self.points[:1])
            with self.assertRaises((ValueError, TypeError)):
                call(numpy.zeros((2, 3)), numpy.zeros((2, 3)))
            with self.assertRaisesRegex(cellwalk.UsageError, "threads takes"):
                call(self.points, self.points, threads=-1)
        particles = cellwalk.Particles(self.environment, self.points)
        for call in (particles.trace, particles.tally):
            with self.assertRaises(ValueError):
                call(self.points[:1])

    def test_tallies(self):
        tally = lambda **given: self.environment.tally(self.points, self.points, **given)
        for error, message, given in ((ValueError, "weights has 1 values, and there are 2 motions", {"weights": [1.0]}),
                                      (ValueError, r"weights\[1\] must be a finite number, and is nan", {"weights": [1.0, numpy.nan]}),
                                      (TypeError, "weights must be real numbers", {"weights": "ab"}),
                                      (TypeError, "weights must be real numbers", {"weights": [[1.0, 1.0]]}),
                                      (TypeError, "out must be a writeable", {"out": [0.0] * 12}),
                                      (TypeError, "out must be a writeable", {"out": numpy.zeros(12, numpy.float32)}),
                                      (TypeError, "out must be a writeable", {"out": numpy.zeros(24)[::2]}),
                                      (TypeError, "out must be a writeable", {"out": numpy.zeros((12, 1))}),
                                      (ValueError, "out has 11 values, and cells have numbers below 12", {"out": numpy.zeros(11)})):
            with self.assertRaisesRegex(error, message):
                tally(**given)
        fixed = numpy.zeros(12)
        fixed.setflags(write=False)
        with self.assertRaisesRegex(TypeError, "out must be a writeable"):
            tally(out=fixed)
        with self.assertRaisesRegex(cellwalk.InputError, "weights are too large"):
            self.environment.tally(self.points, self.points + 1, weights=[1e308, -1.7e308])

    def test_particles_that_were_not_listed(self):
        particles = cellwalk.Particles(self.environment, self.points)
        with self.environment.editing() as edits:
            edits.close(self.environment.facets()[1:2])
        for call in (particles.trace, particles.tally):
            with self.assertRaisesRegex(cellwalk.UsageError, "locate_again"):
                call(self.points)
        particles.locate_again()
        self.assertEqual(len(particles.trace(self.points)), 2)

    def test_facets_without_rows(self):
        with self.assertRaisesRegex(ValueError, r"facets\[0\]: there is no cell 99"):
            self.environment.facet_rows([[99, 0]])
        self.assertEqual(self.environment.facet_rows(self.environment.facets()).tolist(), list(range(31)))


if __name__ == "__main__":
    unittest.main()
