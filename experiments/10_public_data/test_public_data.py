#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the audit on meshes whose faults are known, and compares its table with that in expected/; tries the judge by hand.

usage: test_public_data.py BUILD_DIR [--update]     --update writes expected/ anew
"""

import random
import sys
import unittest
from fractions import Fraction
from pathlib import Path

import numpy

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import end_states  # noqa: E402
import exact  # noqa: E402
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402

FAULTS = {
    "whole.off": "",
    "open.off": "border edges 4",
    "doubled.off": "doubled 1",
    "turned.off": "edges of opposite facets 3",
    "flat.off": "flat 1",
    "at_an_edge.off": "edges of three and more 1",
    "tetrahedra.msh": "",
    "inverted.msh": "inverted 1",
    "flat.msh": "flat 1",
    "twisted.msh": "facets that are not planar 1",
    "three_at_a_facet.msh": "facets of three and more cells 1",
    "elem_cube.dat": "",
}


class PublicData(quick_case.QuickCase):
    experiment = HERE
    expected = ["audit.csv", "end_states.csv"]

    def test_faults_are_those_that_were_made(self):
        faults = {r["name"]: r["faults"] for r in read_rows(self.out / "audit.csv")}
        self.assertEqual(FAULTS, {name: faults[name] for name in FAULTS})
        for name in ("crossing.off", "overlapping.off", "folded.off"):
            self.assertRegex(faults[name], r"^crossing pairs [1-9]\d*$")

    def test_an_end_state_is_judged_where_its_scene_has_it(self):
        [row] = read_rows(self.out / "end_states.csv")
        found = {key: row[key] for key in ("edges", "meet_surface", "nearest", "nearer_than_radius", "free", "contact", "outside")}
        self.assertEqual({"edges": "8", "meet_surface": "1", "nearest": "0.00000", "nearer_than_radius": "4", "free": "3", "contact": "1",
                          "outside": "4"}, found)

    def test_states_that_are_none_are_refused_by_name(self):
        file = self.out / "broken.reference"
        for text in ("", "T= 0\n", "X= 1 2 3 4\n", "X= 1 1 1 nan 1 1\n", "X= 1 2 3 1 2 3\n", "X= a b c\n", "X= 1 2 3 4 5 6\nT= 1\n"):
            file.write_text(text)
            with self.assertRaisesRegex(SystemExit, "broken.reference: "):
                end_states.read_state(file)


class Crossings(unittest.TestCase):
    """Triangles of small integers against a plain test in fractions: some point of both, off what they share."""

    @staticmethod
    def meet_by_fractions(one, two):
        """Whether closed triangles meet, by the ends of what each of them has in common with the sides of the other."""
        def minus(p, q):
            return [x - y for x, y in zip(p, q)]

        def cross(u, v):
            return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]

        def dot(u, v):
            return sum(x * y for x, y in zip(u, v))

        def clip(p, q, triangle):
            """The parameters of a segment inside a triangle."""
            n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))
            low, high = Fraction(0), Fraction(1)
            planes = [(n, triangle[0]), ([-x for x in n], triangle[0])]
            planes += [(cross(n, minus(triangle[(k + 1) % 3], triangle[k])), triangle[k]) for k in range(3)]
            for m, o in planes:
                first, change = Fraction(dot(m, minus(p, o))), dot(m, minus(q, p))
                if change == 0:
                    if first < 0:
                        return None
                elif change > 0:
                    low = max(low, -first / change)
                else:
                    high = min(high, -first / change)
            return (low, high) if low <= high else None

        return any(clip(t[k], t[(k + 1) % 3], other) for t, other in ((one, two), (two, one)) for k in range(3))

    def test_all_pairs_of_random_triangles_are_found(self):
        numbers = random.Random(1)
        crossing = 0
        for size in (2, 3, 6):
            for _ in range(60):
                points = numpy.array([[numbers.randrange(size + 1) for _ in range(3)] for _ in range(24)], dtype=float)
                points = numpy.unique(points, axis=0)
                triangles = [t for t in (numbers.sample(range(len(points)), 3) for _ in range(8))
                             if exact.plain_axes(exact.integers(points[t])) is not None]
                found = {frozenset(p) for p in exact.crossing_pairs(points, numpy.array(triangles))}
                for i, one in enumerate(triangles):
                    for j in range(i):
                        if set(one) & set(triangles[j]):
                            continue
                        meets = self.meet_by_fractions(*(exact.integers(points[t]) for t in (one, triangles[j])))
                        self.assertEqual(meets, frozenset((i, j)) in found, (points[one], points[triangles[j]]))
                        crossing += meets
        self.assertGreater(crossing, 500)

    def test_what_only_shares_corners_and_edges_does_not_cross(self):
        points = numpy.array([(0, 0, 0), (2, 0, 0), (0, 2, 0), (2, 2, 0), (0, -2, 1), (-1, -1, 0), (1, 1, 0), (1, 1, 2)], dtype=float)
        for triangles, count in (([(0, 1, 2), (1, 3, 2)], 0), ([(0, 1, 2), (0, 1, 4)], 0), ([(0, 1, 2), (0, 5, 4)], 0),
                                 ([(0, 1, 2), (0, 1, 3)], 1), ([(0, 1, 2), (0, 3, 7)], 1), ([(0, 1, 2), (5, 6, 7)], 1)):
            self.assertEqual(count, len(exact.crossing_pairs(points, numpy.array(triangles))), triangles)

    def test_signs_that_rounding_hides_are_exact(self):
        points = numpy.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0.3, 0.3, 5e-324), (0.1, 0.7, 0.0), (1e16, 1e16, 1.0), (1e16 + 2, 1e16, 1.0)])
        signs, by_integers = exact.volume_signs(points, [(0, 1, 2, 3), (0, 2, 1, 3), (0, 1, 2, 4), (0, 5, 6, 1), (0, 1, 2, 5)])
        self.assertEqual([1, -1, 0], signs[:3].tolist())
        self.assertEqual(1, signs[4])
        self.assertEqual(exact.volume_sign(*exact.integers(points[[0, 5, 6, 1]])), signs[3])
        self.assertGreaterEqual(by_integers, 3)


if __name__ == "__main__":
    quick_case.main(PublicData)
