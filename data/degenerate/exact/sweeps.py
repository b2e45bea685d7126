# SPDX-License-Identifier: LGPL-3.0-or-later
"""Walls that pass through the triangle that an edge sweeps."""

from fractions import Fraction

from exact.sides import Sides
from exact.simplices import are_apart, common_points, meets, solve
from exact.touches import critical_times
from exact.vectors import at, cross, dot, sub, vec


def strictly_inside(x, triangle):
    a, b, c = triangle
    n = cross(sub(b, a), sub(c, a))
    return all(
        dot(n, cross(sub(q, p), sub(x, p))) > 0 for p, q in ((a, b), (b, c), (c, a))
    )


def pierced_at(a, b, q, wall):
    """The infimum of the times at which inner points of a wall pass the edge within, and not in its plane; None if they do not."""
    triangle = [a, b, q]
    n = cross(sub(b, a), sub(q, a))
    if n == (0, 0, 0):
        return None
    if len(wall) == 3 and all(dot(n, sub(x, a)) == 0 for x in wall):
        return None
    points = list(common_points(triangle, wall))
    if len(points) < 2:
        return None
    x = max(points)
    y = min(points)
    middle = at(x, y, Fraction(1, 2))
    if not strictly_inside(middle, triangle) or (len(wall) == 3 and not strictly_inside(middle, wall)):
        return None
    times = []
    for p in (x, y):
        if p != q:  # the line from q through p meets ab at the share t
            of_b, of_q = solve([sub(b, a), sub(q, a)], sub(p, a))
            times.append(of_b / (1 - of_q))
    return min(times)


def touching_times(world, shape, vertex, target):
    """When an object meets walls: its times, ascending, each with whether it goes on to meet one of them."""
    times = {}
    rest = [p for i, p in enumerate(shape) if i != vertex]
    for wall in world.walls:
        if are_apart(shape + [target], wall):
            continue

        def meets_at(t):
            moved = list(shape)
            moved[vertex] = at(shape[vertex], target, t)
            return meets(moved, wall)

        critical = critical_times((shape[vertex], target), rest + list(wall))
        for t, after in zip(critical, critical[1:] + [None]):
            goes_on = after is not None and meets_at((t + after) / 2)
            if goes_on or meets_at(t):
                times[t] = times.get(t, False) or goes_on
    return sorted(times.items())


def places_met(edge, walls):
    """The corners of what an edge has in common with each wall, and points between them."""
    corners = {x for wall in walls for x in common_points(edge, wall)}
    return corners | {at(x, y, Fraction(1, 2)) for x in corners for y in corners}


def sweep_truth(world, shapes, moves, side):
    """Whether the walls alone determine if an edge is blocked, and where: None, or (move, time).

    They do where the edge meets walls at single times only: there each point of it must leave on the side from which it came. If it goes
    on to meet a wall, they do if a point of it can go on on no side.
    """
    come_from = {}  # the directions from which points of the edge came to where they are, off the walls
    for m, move in enumerate(moves):
        vertex, target = move["vertex"], vec(move["to"])
        p, q = shapes[m][vertex], shapes[m][1 - vertex]
        d = sub(target, p)
        if d == (0, 0, 0):
            continue
        in_line = cross(d, sub(q, p)) == (0, 0, 0)
        for t, goes_on in touching_times(world, shapes[m], vertex, target):
            now = at(p, target, t)
            leaves, decided = {}, True
            for y in places_met([now, q], world.walls):
                if y == q or (in_line and y != now):
                    decided = False
                    continue
                k = max(range(3), key=lambda i: abs(now[i] - q[i]))
                share = (y[k] - q[k]) / (now[k] - q[k])
                onward = tuple(share * c for c in d)
                came = tuple(-c for c in onward)
                if t == 0:
                    if m == 0:
                        came = tuple(share * c for c in sub(side[vertex], p))
                    else:
                        came = come_from.get(y)
                if came is None or came == (0, 0, 0):
                    decided = False
                    continue
                leaves[y] = came
                if t == 1:
                    continue
                sides = Sides(world, y)
                before = sides.side_of(sides.with_direction(came)[0])
                after = {sides.side_of(c) for c in sides.with_direction(onward)}
                if before not in after:
                    return True, (m, t)
            if t == 1:
                come_from = leaves
            if goes_on or not decided:
                return False, None
    return True, None
