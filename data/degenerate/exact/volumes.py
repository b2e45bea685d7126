# SPDX-License-Identifier: LGPL-3.0-or-later
"""What sweeps a tetrahedron (2D: a triangle): a face that moves, and a wall that follows a vertex. A wall that has an inner point of a
tetrahedron in common with a face lies on both sides of it there, and blocks it, whatever else is near.
"""

from exact.sides import Sides
from exact.simplices import are_apart, meets
from exact.sweeps import places_met, sweep_truth
from exact.touches import critical_times
from exact.vectors import at, cross, dot, sign, sub


def volume(points):
    """Of four points in space, or of three in the plane."""
    n = cross(sub(points[1], points[0]), sub(points[2], points[0]))
    return n[2] if len(points) == 3 else dot(n, sub(points[3], points[0]))


def hit_time(simplex, still):
    """The infimum of the times at which inner points of what a simplex sweeps lie in what stands still; None if there are none.

    The first two corners are the start and the end of the corner that moves: a point with their weights x and y is met at y / (x + y).
    """
    whole = volume(simplex)
    if whole == 0 or are_apart(simplex, still):
        return None

    def weights(x):
        return [volume(simplex[:k] + [x] + simplex[k + 1 :]) / whole for k in range(len(simplex))]

    corners = [weights(x) for x in still]
    for k in range(len(simplex)):
        kept = []
        for u, v in zip(corners, corners[1:] + corners[:1]):
            if u[k] >= 0:
                kept.append(u)
            if u[k] * v[k] < 0:
                kept.append(at(u, v, u[k] / (u[k] - v[k])))
        corners = kept
    if not corners or any(sum(x[k] for x in corners) <= 0 for k in range(len(simplex))):
        return None
    return min(x[1] / (x[0] + x[1]) for x in corners if x[0] + x[1] > 0)


def earliest(times):
    return min((t for t in times if t is not None), default=None)


def face_hit(world, shape, vertex, target):
    """The first time at which a wall comes through a face; None if none does, or if the face moves in its plane."""
    still = [p for i, p in enumerate(shape) if i != vertex]
    return earliest(hit_time([shape[vertex], target] + still, wall) for wall in world.walls)


def face_truth(world, shape, vertex, target):
    """Whether the walls alone determine if a face is blocked that starts off all walls, and when.

    They do unless it moves in its plane. There it is free as long as its edges are, if no wall lies in that plane.
    """
    a, (q, r) = shape[vertex], [p for i, p in enumerate(shape) if i != vertex]
    if volume([a, target, q, r]) != 0:
        return True, face_hit(world, shape, vertex, target)
    swept = [[a, q, r], [target, q, r], [a, target, q], [a, target, r]]
    n = cross(sub(q, a), sub(r, a))
    for wall in world.walls:
        if all(dot(n, sub(x, a)) == 0 for x in wall) and any(meets(part, wall) for part in swept):
            return False, None
    crossings = []
    for end in (q, r):
        is_known, crossing = sweep_truth(world, [[a, end]], [{"vertex": 0, "to": target}], None)
        if not is_known:
            return False, None
        crossings.append(crossing and crossing[1])
    return True, earliest(crossings)


def pierces(edge, wall):
    """True if the ends of an edge lie strictly on both sides of a wall, and it passes the wall strictly within."""
    if len(wall) == 2:
        return volume(wall + edge[:1]) * volume(wall + edge[1:]) < 0 and volume(edge + wall[:1]) * volume(edge + wall[1:]) < 0
    turns = {sign(volume(edge + [wall[i], wall[(i + 1) % 3]])) for i in range(3)}
    return volume(wall + edge[:1]) * volume(wall + edge[1:]) < 0 and turns in ({1}, {-1})


def wall_hit(world, shape, vertex, target):
    """A time at which a wall that follows a vertex passes through an edge, or from which on it is pierced by it; None if there is none.

    The edge is blocked at that time, or before.
    """
    times = []
    for wall, i in world.walls_at(vertex):
        if are_apart(wall + [target], shape):
            continue
        times.append(hit_time([wall[i], target] + wall[:i] + wall[i + 1 :], shape))
        critical = critical_times((wall[i], target), wall[:i] + wall[i + 1 :] + shape)
        for t, after in zip(critical, critical[1:]):
            if pierces(shape, wall[:i] + [at(wall[i], target, (t + after) / 2)] + wall[i + 1 :]):
                times.append(t)
                break
    return earliest(times)


def moving_wall_truth(world, shape, vertex, target):
    """Whether the walls alone determine if one that follows a vertex is blocked by an edge that starts off all walls, and when.

    They do where a wall passes through the edge, or is pierced by it, and while each point of the edge meets walls at single times only:
    it moves against them along the line of the vertex, backwards, as cells follow affinely, and must leave them in the component of its
    small ball from which it came.
    """
    start = world.points[vertex]
    d, back = sub(target, start), sub(start, target)
    walls = [(wall, i) for wall, i in world.walls_at(vertex) if not are_apart(wall + [target], shape)]
    if d == (0, 0, 0) or not walls:
        return True, None
    hit = wall_hit(world, shape, vertex, target)

    def points_at(t):
        """Of each point met, whether it is blocked, and whether it meets walls at that time only."""
        place = at(start, target, t)
        places = places_met(shape, [wall[:i] + [place] + wall[i + 1 :] for wall, i in walls])
        now = world.moved(vertex, place) if places else world
        for y in places:
            sides = Sides(now, y)
            came = sides.side_of(sides.with_direction(d)[0])
            yield came not in map(sides.side_of, sides.with_direction(back)), not (sides.is_on_wall(d) or sides.is_on_wall(back))

    times = sorted({t for wall, i in walls for t in critical_times((start, target), wall[:i] + wall[i + 1 :] + shape)})
    for t, after in zip(times, times[1:]):
        if hit is not None and hit <= t:
            return True, hit
        if any(is_blocked for is_blocked, _ in points_at(t)):
            return True, t
        met = list(points_at((t + after) / 2))
        if any(is_single and is_blocked for is_blocked, is_single in met):
            return True, t
        if not all(is_single for _, is_single in met):
            return False, None
    return True, None
