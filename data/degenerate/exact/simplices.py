# SPDX-License-Identifier: LGPL-3.0-or-later
"""What two closed simplices of at most three points have in common: the intersections of the spaces that their faces span."""

from exact.vectors import cross, dot, sign, sub

FACES = {1: [(0,)], 2: [(0,), (1,), (0, 1)], 3: [(0,), (1,), (2,), (0, 1), (1, 2), (2, 0), (0, 1, 2)]}


def solve(columns, right):
    """The solution of a linear system of three equations, if there is exactly one."""
    rows = [[c[i] for c in columns] + [right[i]] for i in range(3)]
    unknowns, done = len(columns), 0
    for k in range(unknowns):
        pivot = next((r for r in range(done, 3) if rows[r][k] != 0), None)
        if pivot is None:
            return None
        rows[done], rows[pivot] = rows[pivot], rows[done]
        top = rows[done]
        for r in range(3):
            if r != done and rows[r][k] != 0:
                factor = rows[r][k] / top[k]
                rows[r] = [x - factor * y for x, y in zip(rows[r], top)]
        done += 1
    if any(row[unknowns] != 0 for row in rows[done:]):
        return None
    return [rows[k][unknowns] / rows[k][k] for k in range(unknowns)]


def boxes_apart(first, second):
    return any(
        max(p[i] for p in first) < min(p[i] for p in second) or max(p[i] for p in second) < min(p[i] for p in first)
        for i in range(3)
    )


def is_beside(points, triangle):
    """True if all points lie strictly on one side of the plane of a triangle."""
    n = cross(sub(triangle[1], triangle[0]), sub(triangle[2], triangle[0]))
    sides = {sign(dot(n, sub(p, triangle[0]))) for p in points}
    return sides == {1} or sides == {-1}


def are_apart(points, simplex):
    """True proves that the hull of points does not meet a simplex; False proves nothing."""
    return boxes_apart(points, simplex) or (len(simplex) == 3 and is_beside(points, simplex))


def common_points(first, second):
    """Points of the intersection, all its corners among them."""
    found = set()
    if are_apart(first, second):
        return found
    for f in FACES[len(first)]:
        o = first[f[0]]
        u = [sub(first[i], o) for i in f[1:]]
        for g in FACES[len(second)]:
            c = second[g[0]]
            v = [sub(second[i], c) for i in g[1:]]
            x = solve(u + [tuple(-y for y in w) for w in v], sub(c, o))
            if x is None:
                continue
            of_f, of_g = x[: len(u)], x[len(u) :]
            if min(of_f, default=0) < 0 or min(of_g, default=0) < 0 or sum(of_f) > 1 or sum(of_g) > 1:
                continue
            point = o
            for share, w in zip(of_f, u):
                point = tuple(a + share * b for a, b in zip(point, w))
            found.add(point)
    return found


def meets(first, second):
    return bool(common_points(first, second))
