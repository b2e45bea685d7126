# SPDX-License-Identifier: LGPL-3.0-or-later
"""When an object whose one vertex moves meets a wall: at a root of a determinant of its points and those of the wall."""

from fractions import Fraction

from exact.simplices import are_apart, common_points, meets
from exact.vectors import at, cross, dot, sign, sub


def determinant_functions(moving, still):
    """The values at the start and the end of determinants that hold the moving point: of four points, of three and two in projections."""
    a, b = moving
    for i, x in enumerate(still):
        for k in range(3):
            yield a[k] - x[k], b[k] - x[k]
        for j in range(i):
            y = still[j]
            n, m = cross(sub(y, x), sub(a, x)), cross(sub(y, x), sub(b, x))
            for k in range(3):
                yield n[k], m[k]
            for l in range(j):
                spat = cross(sub(y, x), sub(still[l], x))
                yield dot(spat, sub(a, x)), dot(spat, sub(b, x))


def critical_times(moving, still):
    times = {Fraction(0), Fraction(1)}
    for first, last in determinant_functions(moving, still):
        if sign(first) * sign(last) < 0:
            times.add(first / (first - last))
    return sorted(times)


def touch_of(shape, vertex, target, wall, limit):
    """The infimum, before a limit, of the times at which the wall meets a point that was not in the object at the start."""
    rest = [p for i, p in enumerate(shape) if i != vertex]
    if are_apart(shape + [target], wall):
        return None

    def new_points_at(t):
        moved = list(shape)
        moved[vertex] = at(shape[vertex], target, t)
        return any(not meets(shape, [x]) for x in common_points(moved, wall))

    times = critical_times((shape[vertex], target), rest + list(wall))
    for t, after in zip(times, times[1:] + [None]):
        if limit is not None and t >= limit:
            return None
        if t > 0 and new_points_at(t):
            return t
        if after is not None and new_points_at((t + after) / 2):
            return t
    return None


def first_touch(world, shape, vertex, target):
    """The first touch of the object or of its moving vertex, each off its own start."""
    best = None
    for wall in world.walls:
        for part, moving in [(shape, vertex)] + ([([shape[vertex]], 0)] if len(shape) > 1 else []):
            t = touch_of(part, moving, target, wall, best)
            if t is not None and (best is None or t < best):
                best = t
    return best


def first_touch_of_walls(world, shape, vertex, target):
    """The first time at which walls that follow a vertex touch an object that stands still, off all walls at the start."""
    best = None
    for wall, corner in world.walls_at(vertex):
        t = touch_of(wall, corner, target, shape, best)
        if t is not None and (best is None or t < best):
            best = t
    return best
