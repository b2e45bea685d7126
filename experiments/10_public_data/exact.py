# SPDX-License-Identifier: LGPL-3.0-or-later
"""Signs of determinants of doubles, and triangles that cross: by bounds where these decide, otherwise in integers."""

import numpy

BOUND = 1e-14  # of rounding, relative to the sum of the absolute products of a determinant of differences: 7.8e-16 is proved
TINY = 1e-200  # below which products may have underflowed


def integers(points):
    """The points as integers, each multiplied by the same power of two."""
    ratios = [[float(x).as_integer_ratio() for x in p] for p in points]
    scale = max((d for p in ratios for _, d in p), default=1)
    return [tuple(n * (scale // d) for n, d in p) for p in ratios]


def volume_sign(a, b, c, d):
    """The sign of the volume of a tetrahedron of integers."""
    u, v, w = ([x - y for x, y in zip(p, d)] for p in (a, b, c))
    det = (u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) + u[2] * (v[0] * w[1] - v[1] * w[0]))
    return (det < 0) - (det > 0)  # positive if d lies above the triangle a, b, c, seen counterclockwise


def volume_signs(points, quads):
    """The signs of the volumes of tetrahedra, and how many needed integers."""
    quads = numpy.asarray(quads, dtype=numpy.int64).reshape(-1, 4)
    a, b, c, d = (points[quads[:, i]] for i in range(4))
    u, v, w = a - d, b - d, c - d
    products = [(i, v[:, j] * w[:, k], v[:, k] * w[:, j]) for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))]
    det = sum(u[:, i] * (p - q) for i, p, q in products)
    size = sum(numpy.abs(u[:, i]) * (numpy.abs(p) + numpy.abs(q)) for i, p, q in products)
    signs = -numpy.sign(det).astype(numpy.int64)
    unsure = numpy.flatnonzero((numpy.abs(det) <= BOUND * size) | (size < TINY))
    for row in unsure:
        signs[row] = volume_sign(*integers(points[quads[row]]))
    return signs, len(unsure)


def area_sign(a, b, c, i, j):
    det = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i])
    return (det > 0) - (det < 0)


def plain_axes(triangle):
    """Two axes onto which a triangle of integers projects without becoming flat; None if it is flat itself."""
    return next(((i, j) for i, j in ((0, 1), (1, 2), (2, 0)) if area_sign(*triangle, i, j) != 0), None)


def between(p, a, b):
    return all(min(x, y) <= z <= max(x, y) for x, y, z in zip(a, b, p))


def segments_meet(p, q, a, b, i, j):
    """Closed segments of one plane, looked at along an axis."""
    one, two = area_sign(p, q, a, i, j), area_sign(p, q, b, i, j)
    three, four = area_sign(a, b, p, i, j), area_sign(a, b, q, i, j)
    if one * two < 0 and three * four < 0:
        return True
    return any(s == 0 and between(x, *ends) for s, x, ends in ((one, a, (p, q)), (two, b, (p, q)), (three, p, (a, b)), (four, q, (a, b))))


def segment_meets(p, q, triangle):
    """Whether a closed segment and a closed triangle of integers, which is not flat, have a point in common."""
    one, two = volume_sign(*triangle, p), volume_sign(*triangle, q)
    if one * two > 0:
        return False
    sides = [(triangle[k], triangle[(k + 1) % 3]) for k in range(3)]
    if one == 0 and two == 0:
        i, j = plain_axes(triangle)
        turns = {area_sign(a, b, p, i, j) for a, b in sides}
        return not {1, -1} <= turns or any(segments_meet(p, q, a, b, i, j) for a, b in sides)
    turns = {volume_sign(p, q, a, b) for a, b in sides}
    return not {1, -1} <= turns


def cross(points, first, second):
    """Whether two triangles have more in common than corners and sides that they share."""
    shared = [v for v in first if v in second]
    corners = dict(zip((*first, *second), integers([points[v] for v in (*first, *second)])))
    one, two = [corners[v] for v in first], [corners[v] for v in second]
    if len(shared) == 3:
        return False  # the same triangle: counted as a double
    if len(shared) == 2:
        [a], [b] = ([v for v in t if v not in shared] for t in (first, second))
        if volume_sign(*one, corners[b]) != 0:
            return False
        i, j = plain_axes(one)
        u, v = (corners[s] for s in shared)
        return area_sign(u, v, corners[a], i, j) == area_sign(u, v, corners[b], i, j)
    for t, other in ((first, two), (second, one)):
        for k in range(3):
            p, q = t[k], t[(k + 1) % 3]
            if p not in shared and q not in shared and segment_meets(corners[p], corners[q], other):
                return True
    return False


def near_pairs(points, triangles):
    """Pairs of triangles whose boxes meet, as two arrays."""
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    order = numpy.argsort(low[:, 0], kind="stable")
    low, high = low[order], high[order]
    ends = numpy.searchsorted(low[:, 0], high[:, 0], side="right")
    ones, others = [], []
    for i, end in enumerate(ends):
        meets = ((low[i + 1:end, 1:] <= high[i, 1:]) & (high[i + 1:end, 1:] >= low[i, 1:])).all(axis=1)
        found = numpy.flatnonzero(meets) + i + 1
        ones.append(numpy.full(len(found), i))
        others.append(found)
    return order[numpy.concatenate(ones or [[]]).astype(int)], order[numpy.concatenate(others or [[]]).astype(int)]


def surely_apart(points, first, second):
    """For pairs of triangles: True where the corners of the second that the first lacks lie on one side of its plane."""
    apart = numpy.ones(len(first), dtype=bool)
    seen = numpy.zeros(len(first), dtype=numpy.int64)
    for k in range(3):
        corner = second[:, k]
        is_own = (corner[:, None] == first).any(axis=1)
        signs, _ = volume_signs(points, numpy.column_stack([first, corner]))
        signs[is_own] = 0
        apart &= is_own | ((signs != 0) & ((seen == 0) | (seen == signs)))
        seen = numpy.where(signs != 0, signs, seen)
    return apart & (seen != 0)


def crossing_pairs(points, triangles):
    """The pairs of triangles, none of them flat, that cross or overlap, as rows of two numbers."""
    one, other = near_pairs(points, triangles)
    for _ in range(2):
        left = ~surely_apart(points, triangles[one], triangles[other])
        one, other = other[left], one[left]
    return [(int(i), int(j)) for i, j in zip(one, other) if cross(points, tuple(map(int, triangles[i])), tuple(map(int, triangles[j])))]
