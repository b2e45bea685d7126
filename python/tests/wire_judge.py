# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges whether a wire keeps its radius from all walls, and passes through none, without a question to the library.

For any n, two hulls are at least r apart if min n.b - max n.a >= r |n| over their corners a and b (Cauchy and Schwarz). Directions are
tried in doubles with a margin, then in long doubles, at last in integers, which hold doubles exactly. The list of directions is that of
all pairs of features of the hulls, so that none of them fails unless the hulls are too near.
"""

import functools
import itertools

import numpy

# Coordinates are below 2^6, directions are scaled to 1: errors of gaps stay below some hundred units in the last place.
MARGINS = {numpy.float64: 1e-9, numpy.longdouble: 2e-17 if numpy.finfo(numpy.longdouble).nmant >= 63 else numpy.inf}
LARGEST = 64.0


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return numpy.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def directions(a, b):
    """(3, directions, M) of hulls with corners (3, A, M) and (3, B, M); numbers may be of any type."""
    rows_a, rows_b = (numpy.array(list(itertools.combinations(range(x.shape[1]), 2))).T for x in (a, b))
    edges_a, edges_b = a[:, rows_a[0]] - a[:, rows_a[1]], b[:, rows_b[0]] - b[:, rows_b[1]]

    def flat(x):
        return x.reshape(3, -1, a.shape[2])

    between = flat(a[:, :, None] - b[:, None])
    found = [between, flat(cross(edges_a[:, :, None], edges_b[:, None]))]
    for edges in (edges_a, edges_b):
        u, e = between[:, :, None], edges[:, None]
        found.append(flat(dot(e, e) * u - dot(u, e) * e))  # the parts of differences across edges
        if edges.shape[1] > 1:
            found.append(cross(edges[:, :1], edges[:, 1:2]))
    return numpy.concatenate(found, axis=1)


def gaps(n, a, b):
    """Along the directions or against them."""
    on_a, on_b = ([dot(n, x[:, k, None]) for k in range(x.shape[1])] for x in (a, b))
    low_a, high_a, low_b, high_b = (functools.reduce(way, on) for on in (on_a, on_b) for way in (numpy.minimum, numpy.maximum))
    return numpy.maximum(low_b - high_a, low_a - high_b)


def apart(a, b, radius, kind):
    """Which hulls are certainly farther apart than the radius."""
    a, b = a.astype(kind), b.astype(kind)
    a, b = a - b[:, :1], b - b[:, :1]
    n = directions(a, b)
    with numpy.errstate(invalid="ignore", divide="ignore"):
        return numpy.fmax.reduce(gaps(n / numpy.sqrt(dot(n, n)), a, b)) > kind(radius) + kind(MARGINS[kind])


def apart_exactly(a, b, radius):
    """Whether the hulls of points (N, 3) are at least as far apart as the radius, or farther than 0, in integers: numbers times a power of 2."""
    numbers = [x.as_integer_ratio() for x in (*a.ravel().tolist(), *b.ravel().tolist(), float(radius))]
    scale = max(denominator for _, denominator in numbers)
    whole = [numerator * (scale // denominator) for numerator, denominator in numbers]
    points, r = numpy.array(whole[:-1], dtype=object).reshape(-1, 3).T[:, :, None], whole[-1]
    a, b = points[:, : len(a)], points[:, len(a) :]
    n = directions(a, b)
    return any(g > 0 and g * g >= r * r * square for g, square in zip(gaps(n, a, b)[:, 0], dot(n, n)[:, 0]))


class Judge:
    """Of wires of a radius in an environment. steps, pairs, exact: how much has been judged."""

    def __init__(self, environment, radius, spacing):
        facets, points = environment.facets(), environment.points
        assert numpy.abs(points).max() < LARGEST
        corners = facets["points"][facets["wall"]]
        fans = [corners[:, [0, k, k + 1]][corners[:, k + 1] >= 0] for k in range(1, corners.shape[1] - 1)]
        self.walls, self.radius = points[numpy.concatenate(fans)], radius
        self.wall_low, self.wall_high = self.walls.min(axis=1), self.walls.max(axis=1)
        self.half = 1.5 * spacing  # of the boxes of edges and of what they sweep, at most
        reach, self.side = radius + self.half + 1e-6, 1.5 * spacing
        self.low = points.min(axis=0) - 2 * reach
        self.counts = ((points.max(axis=0) + 2 * reach - self.low) / self.side).astype(int) + 1
        lists = {}
        for number, wall in enumerate(self.walls):
            first, last = (((wall.min(axis=0) - reach - self.low) / self.side).astype(int),
                           ((wall.max(axis=0) + reach - self.low) / self.side).astype(int))
            for key in itertools.product(*(range(i, j + 1) for i, j in zip(first, last))):
                lists.setdefault(self.key(numpy.array(key)), []).append(number)
        self.sizes = numpy.zeros(int(self.counts.prod()), dtype=int)
        for key, found in lists.items():
            self.sizes[key] = len(found)
        self.starts = numpy.concatenate([[0], numpy.cumsum(self.sizes)])
        self.listed = numpy.concatenate([lists[key] for key in sorted(lists)])
        self.steps = self.pairs = self.exact = self.swept = 0

    def key(self, cell):
        return (cell[..., 0] * self.counts[1] + cell[..., 1]) * self.counts[2] + cell[..., 2]

    def near(self, hulls):
        """Rows of hulls (N, A, 3) and of walls that may be nearer than the radius: their boxes are."""
        corners = [hulls[:, k] for k in range(hulls.shape[1])]
        low, high = functools.reduce(numpy.minimum, corners), functools.reduce(numpy.maximum, corners)
        assert ((high - low) / 2).max() <= self.half
        key = self.key((((low + high) / 2 - self.low) / self.side).astype(int))
        size = self.sizes[key]
        hull = numpy.repeat(numpy.arange(len(hulls)), size)
        wall = self.listed[numpy.arange(size.sum()) - numpy.repeat(numpy.cumsum(size) - size - self.starts[key], size)]
        low, high = low - self.radius - 1e-9, high + self.radius + 1e-9
        boxes = ((self.wall_low[wall] <= high[hull]) & (self.wall_high[wall] >= low[hull])).all(axis=1)
        return hull[boxes], wall[boxes]

    def too_near(self, hulls, radius):
        """The hulls that are nearer to a wall than the radius, or, for 0, meet one."""
        hull, wall = self.near(hulls)
        self.pairs += len(hull)
        for kind in (numpy.float64, numpy.longdouble):
            if len(hull) == 0:
                return []
            left = ~apart(hulls[hull].transpose(2, 1, 0), self.walls[wall].transpose(2, 1, 0), radius, kind)
            hull, wall = hull[left], wall[left]
        self.exact += len(hull)
        return [h for h, w in zip(hull.tolist(), wall.tolist()) if not apart_exactly(hulls[h], self.walls[w], radius)]

    def violations(self, before, after):
        """Of a step of a wire, from positions (N, 3) to others, or of its start: rows of vertices whose next edges are too near to a wall,
        and of those that may have passed through one."""
        self.steps += 1
        too_near = self.too_near(numpy.stack([after[:-1], after[1:]], axis=1), self.radius)
        if before is None:
            return too_near, []
        # Vertices move in their order, and nothing is nearer than the radius at rest: shorter ways pass through no wall.
        way = (after - before).T
        far = numpy.flatnonzero(dot(way, way) > (self.radius - 1e-9) ** 2)
        self.swept += len(far)
        triangles, owners = [], []
        for i in far.tolist():
            for q in [after[i - 1]] * (i > 0) + [before[i + 1]] * (i + 1 < len(after)):
                triangles.append([before[i], after[i], q])
                owners.append(i)
        return too_near, [owners[t] for t in self.too_near(numpy.array(triangles), 0.0)] if triangles else []
