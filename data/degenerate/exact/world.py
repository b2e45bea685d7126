# SPDX-License-Identifier: LGPL-3.0-or-later
"""Walls and their features."""

from collections import Counter
from fractions import Fraction

from exact.simplices import meets
from exact.vectors import cross, integral, sub, vec


class World:
    def __init__(self, record, points=None):
        self.record = record
        self.points = points or [vec(p) for p in record["vertices"]]
        self.walls = [[self.points[v] for v in wall] for wall in record["walls"]]
        self.kinds = ["solid"] * len(self.walls)
        for kind in ("membrane", "slit"):
            for i in record[kind + "s"]:
                self.kinds[i] = kind
        self.vertices = sorted({v for wall in record["walls"] for v in wall})
        uses = Counter()
        for wall, facet in zip(record["walls"], record["facets"]):
            for i in range(len(wall) if len(wall) == 3 else 0):
                uses[facet, frozenset((wall[i], wall[(i + 1) % 3]))] += 1
        self.edges = sorted({tuple(sorted(edge)) for (_, edge), n in uses.items() if n == 1})
        self.planes = [self.plane_of(wall) for wall in self.walls]

    @staticmethod
    def plane_of(wall):
        """The normal of a wall, and (m, v) for each side: m . (x - v) >= 0 within. In the plane walls are strips along the third axis."""
        if len(wall) == 2:
            along = sub(wall[1], wall[0])
            return integral((along[1], -along[0], Fraction(0))), [
                (integral(along), wall[0]),
                (integral(sub(wall[0], wall[1])), wall[1]),
            ]
        normal = cross(sub(wall[1], wall[0]), sub(wall[2], wall[0]))
        sides = [(integral(cross(normal, sub(wall[(i + 1) % 3], wall[i]))), wall[i]) for i in range(3)]
        return integral(normal), sides

    def moved(self, vertex, place):
        """The world when one of its vertices is elsewhere."""
        points = list(self.points)
        points[vertex] = place
        return World(self.record, points)

    def walls_at(self, vertex):
        """The walls that follow a vertex, each with the number that it has among their corners."""
        return [(wall, w.index(vertex)) for wall, w in zip(self.walls, self.record["walls"]) if vertex in w]

    def met(self, shape):
        return [i for i, wall in enumerate(self.walls) if meets(shape, wall)]

    def lowest_feature(self, shape):
        if any(meets(shape, [self.points[v]]) for v in self.vertices):
            return "vertex"
        if any(meets(shape, [self.points[u], self.points[v]]) for u, v in self.edges):
            return "edge"
        return "facet"
