# SPDX-License-Identifier: LGPL-3.0-or-later
"""When objects and walls meet, and where walls block them, in rational arithmetic, from the walls alone: for check.py."""

from collections import Counter
from fractions import Fraction

# Vectors of fractions or integers. Points in the plane get a third coordinate of 0.


def vec(p):
    return tuple(Fraction(x) for x in p) + (Fraction(0),) * (3 - len(p))


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def at(a, b, t):
    return tuple(x + t * (y - x) for x, y in zip(a, b))


def sign(x):
    return (x > 0) - (x < 0)


def integral(v):
    """The same direction in coprime integers."""
    denominator = 1
    for x in v:
        denominator = denominator * x.denominator // gcd(denominator, x.denominator)
    numbers = [int(x * denominator) for x in v]
    common = gcd(gcd(numbers[0], numbers[1]), numbers[2])
    return tuple(x // common for x in numbers) if common else tuple(numbers)


def gcd(a, b):
    while b:
        a, b = b, a % b
    return abs(a)


# What two closed simplices of at most three points have in common: the intersections of the spaces that their faces span.

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


# Walls and their features.


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


# When an object whose one vertex moves meets a wall: at a root of a determinant of its points and those of the wall.


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


# The sides of walls at a point: components of a small ball around it without the walls. The planes of the walls, and those through their
# sides, cut the ball into cells, which are held by their signs; cells are joined across pieces of planes that no wall covers.


class Sides:
    AXES = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]

    def __init__(self, world, x):
        self.walls = []  # (normal, inward normals of the sides on which x lies)
        planes = {}
        for normal, sides in world.planes:
            corner = sides[0][1]
            if dot(normal, sub(x, corner)) != 0 or any(dot(m, sub(x, v)) < 0 for m, v in sides):
                continue
            rims = [m for m, v in sides if dot(m, sub(x, v)) == 0]
            self.walls.append((normal, rims))
            for n in [normal] + rims:
                planes[max(n, tuple(-c for c in n))] = None
        for n in self.AXES:
            planes[n] = None
        self.planes = list(planes)
        self.parent = {}
        if self.walls:
            self.join()

    def signs(self, *directions):
        """Of a direction, and where it is 0 of the next one."""
        return tuple(next((s for s in (sign(dot(n, d)) for d in directions) if s), 0) for n in self.planes)

    def root(self, cell):
        while self.parent[cell] != cell:
            cell = self.parent[cell]
        return cell

    def covered(self, v, r):
        def weakly_inside(m):
            return next((s for s in (sign(dot(m, v)), sign(dot(m, r))) if s), 0) >= 0

        return any(dot(n, v) == 0 and dot(n, r) == 0 and all(map(weakly_inside, rims)) for n, rims in self.walls)

    def join(self):
        corners = set()
        for i, n in enumerate(self.planes):
            for m in self.planes[:i]:
                v = integral([Fraction(c) for c in cross(n, m)])
                corners |= {v, tuple(-c for c in v)}
        for v in corners:
            rays = []
            for n in self.planes:
                if dot(n, v) == 0:
                    w = integral([Fraction(c) for c in cross(n, v)])
                    rays += [w, tuple(-c for c in w)]
            rays = self.around(v, rays)
            cells = []
            for r, s in zip(rays, rays[1:] + rays[:1]):
                cell = self.signs(v, tuple(a + b for a, b in zip(r, s)))
                cells.append(cell)
                self.parent.setdefault(cell, cell)
            for k, r in enumerate(rays):
                if not self.covered(v, r):
                    one, other = self.root(cells[k - 1]), self.root(cells[k])
                    self.parent[one] = other

    @staticmethod
    def around(v, rays):
        x = rays[0]
        y = cross(v, x)

        def half(r):
            a, b = dot(r, x), dot(r, y)
            return 0 if b > 0 or (b == 0 and a > 0) else 1

        # Within half a turn, by the slope a / b in multiples of the lengths of x and y.
        def slope(r):
            a, b = dot(r, x), dot(r, y)
            return (half(r), Fraction(-a, b) if b else Fraction(-(10**18) ** 9))

        return sorted(rays, key=slope)

    def cells(self):
        return self.parent if self.walls else {(): ()}

    def side_of(self, cell):
        return self.root(cell) if self.walls else ()

    def with_direction(self, d):
        """The cells whose closure holds a direction."""
        if not self.walls:
            return [()]
        of_d = [sign(dot(n, d)) for n in self.planes]
        return [c for c in self.parent if all(s * t >= 0 for s, t in zip(c, of_d))]

    def is_on_wall(self, d):
        return any(dot(n, d) == 0 and all(dot(m, d) >= 0 for m in rims) for n, rims in self.walls)

    def shifted(self, other, cell, d):
        """The side, at a point a little further in direction d, whose sides are `other`, of a cell that holds d."""
        if not other.walls:
            return ()
        mine = dict(zip(self.planes, cell))
        signs = tuple(sign(dot(n, d)) or mine[n] for n in other.planes)
        return other.root(signs)


def walk_truth(world, a, b, side):
    """Whether a point can come from a to b, and the times at which it may be blocked."""
    d = sub(b, a)
    if d == (0, 0, 0):
        return True, []
    back = tuple(-x for x in d)
    events = {Fraction(0), Fraction(1)}
    for normal, sides in world.planes:
        height, slope = dot(normal, sub(a, sides[0][1])), dot(normal, d)
        low, high = Fraction(0), Fraction(1)
        if slope != 0:
            low = high = -height / slope
            if not 0 <= low <= 1:
                continue
        elif height != 0:
            continue
        for m, v in sides:
            first, change = dot(m, sub(a, v)), dot(m, d)
            if change == 0:
                if first < 0:
                    low, high = Fraction(1), Fraction(0)
            elif change > 0:
                low = max(low, -first / change)
            else:
                high = min(high, -first / change)
        if low <= high:
            events |= {low, high}
    events = sorted(events)
    here = Sides(world, a)
    if side is None:
        states = {here.side_of(c) for c in here.cells()}
        if len(states) != 1:
            raise ValueError("starts on a wall, and has no side")
    else:
        states = {here.side_of(here.with_direction(sub(side, a))[0])}
    blocked = []
    for t, after in zip(events, events[1:]):
        onward = [c for c in here.with_direction(d) if here.side_of(c) in states]
        if states - {here.side_of(c) for c in onward}:
            blocked.append(t)
        middle = Sides(world, at(a, b, (t + after) / 2))
        between = {here.shifted(middle, c, d) for c in onward}
        here = Sides(world, at(a, b, after))
        states = {here.side_of(c) for c in here.with_direction(back) if here.shifted(middle, c, back) in between}
        if not states:
            break
    return bool(states), blocked


# Walls that pass through the triangle that an edge sweeps.


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


# What sweeps a tetrahedron (2D: a triangle): a face that moves, and a wall that follows a vertex. A wall that has an inner point of a
# tetrahedron in common with a face lies on both sides of it there, and blocks it, whatever else is near.


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
