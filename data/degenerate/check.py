#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the corpus of degenerate motions, or somebody's answers to it. Needs the standard library only; docs/corpus.md has the format.

usage: check.py [--in DIR]                  verifies the answers of the corpus in rational arithmetic, from the walls alone
       check.py [--in DIR] --answers FILE   compares the answers of a library: a table id,answer,move,time with a header, where answer is
                                            `free` or `contact`, move counts from 0 (may be left out if there is one), and time is a number
                                            or a fraction p/q of the move (may be left out)

With --answers:
  --definition any|touch|crossing   what counts: `touch`, the first time at which the object meets a closed wall off its start; `crossing`,
                                    the first at which a wall blocks it; `any`, the default, takes either, and a contact at 0 of what
                                    starts on a wall
  --tolerance X                     of times, as a share of the move; 1e-9
  --strict                          exit 1 for every difference, not only for missed contacts and late times

Exit code 0: verified, or nothing missed; 1: otherwise; 2: files that cannot be read.
"""

import argparse
import csv
import json
import sys
from collections import Counter, defaultdict
from fractions import Fraction
from pathlib import Path

KINDS = ["walks", "sweeps", "faces", "moving_walls"]


def read_corpus(folder):
    with open(folder / "worlds.jsonl", encoding="utf-8") as lines:
        worlds = {w["name"]: w for w in map(json.loads, lines)}
    cases = []
    for kind in KINDS:
        with open(folder / f"{kind}.jsonl", encoding="utf-8") as lines:
            cases += map(json.loads, lines)
    return worlds, cases


# Answers of a library.


def legal_answers(case, definition):
    """All answers that a definition allows: None for free, or (move, time)."""
    answers = set()
    if definition in ("touch", "any"):
        touch = case["touch"]
        answers.add((touch["move"], Fraction(touch["time"])) if touch else None)
    if definition in ("crossing", "any"):
        answers |= {(c["move"], Fraction(c["time"])) for c in case["crossings"]}
        if case["crossing"] != "yes":
            answers.add(None)
    if definition == "any" and case["at_start"]:
        answers.add((0, Fraction(0)))
    return answers


def judge_answer(case, row, definition, tolerance):
    legal = legal_answers(case, definition)
    contacts = [a for a in legal if a is not None]
    if row is None:
        return "unanswered"
    if row["answer"] == "free":
        return "right" if None in legal else "missed"
    if not contacts:
        return "false"
    if not row.get("time"):
        return "right"
    move = int(row.get("move") or 0)
    at = move + Fraction(row["time"])
    if any(m == move and abs(m + t - at) <= tolerance for m, t in contacts):
        return "right"
    # At the end of a move is at the start of the next one.
    if any(abs(m + t - at) <= tolerance for m, t in contacts):
        return "right"
    return "late" if None not in legal and all(m + t < at for m, t in contacts) else "early"


def compare(cases, table, definition, tolerance, strict):
    with open(table, newline="", encoding="utf-8") as lines:
        rows = {row["id"]: row for row in csv.DictReader(lines)}
    unknown = rows.keys() - {c["id"] for c in cases}
    if unknown:
        sys.exit(f"check.py: {table}: {sorted(unknown)[0]} is no case")
    verdicts = ["right", "missed", "late", "false", "early", "unanswered"]
    counts, examples = defaultdict(Counter), defaultdict(list)
    for case in cases:
        try:
            verdict = judge_answer(case, rows.get(case["id"]), definition, tolerance)
        except ValueError as error:
            print(f"check.py: {table}: {case['id']}: {error}", file=sys.stderr)
            sys.exit(2)
        kind = f"{case['kind']} {len(case['points'][0])}D"
        counts[kind, case["degeneracy"] + (" +-ulp" if case["near"] else "")][verdict] += 1
        examples[verdict].append(case["id"])
    print(f"{'kind':<16} {'degeneracy':<28} {'cases':>6} " + " ".join(f"{v:>10}" for v in verdicts))
    total = Counter()
    for (kind, name), count in sorted(counts.items()):
        print(f"{kind:<16} {name:<28} {sum(count.values()):>6} " + " ".join(f"{count[v]:>10}" for v in verdicts))
        total += count
    print(f"{'all':<16} {'':<28} {sum(total.values()):>6} " + " ".join(f"{total[v]:>10}" for v in verdicts))
    for verdict in verdicts[1:]:
        if examples[verdict]:
            print(f"{verdict}: {' '.join(examples[verdict][:8])}{' ...' if len(examples[verdict]) > 8 else ''}")
    bad = total["missed"] + total["late"]
    if strict:
        bad = sum(total.values()) - total["right"]
    return 1 if bad else 0


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
    def __init__(self, record):
        self.record = record
        self.points = [vec(p) for p in record["vertices"]]
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
            edge = [now, q]
            cuts = {x for wall in world.walls for x in common_points(edge, wall)}
            cuts |= {at(x, y, Fraction(1, 2)) for x in cuts for y in cuts}
            leaves, decided = {}, True
            for y in cuts:
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


class Checker:
    def __init__(self, worlds):
        self.worlds = {name: World(record) for name, record in worlds.items()}
        self.determined = Counter()

    def faults(self, case):
        """Yields what is wrong with a case."""
        world = self.worlds[case["world"]]
        shape = [vec(p) for p in case["points"]]
        if case["at_start"] != bool(world.met(shape)):
            yield "at_start is wrong"
        if case["at_start"] != (case["side"] is not None):
            yield "only what starts on a wall has a side"
        if case["side"] is not None:
            yield from self.side_faults(world, case, shape)
        yield from self.order_faults(case)
        shapes = [shape]
        for move in case["moves"]:
            moved = list(shapes[-1])
            moved[move["vertex"]] = vec(move["to"])
            shapes.append(moved)
        yield from self.touch_faults(world, case, shapes)
        for m in case["crossings"] + ([case["touch"]] if case["touch"] else []):
            yield from self.meeting_faults(world, case, shapes, m)
        if len(shape) == 1:
            yield from self.walk_faults(world, case, shape)
        else:
            yield from self.sweep_faults(world, case, shapes)
        yield from self.convention_faults(case)

    def side_faults(self, world, case, shape):
        side = [vec(p) for p in case["side"]]
        if world.met(side):
            yield "the side touches a wall"
        now = list(shape)
        for i, p in enumerate(side):
            if first_touch(world, now, i, p) is not None:
                yield "the way to the side touches a wall"
            now[i] = p

    def order_faults(self, case):
        times = [(c["move"], Fraction(c["time"])) for c in case["crossings"]]
        if times != sorted(set(times)) or any(not 0 <= t <= 1 for _, t in times):
            yield "times of crossings are not in order"
        if (case["crossing"] == "no") != (not times) or case["crossing"] not in ("no", "yes", "either"):
            yield "crossing and its times disagree"

    def touch_faults(self, world, case, shapes):
        expected = None
        for m, move in enumerate(case["moves"]):
            t = first_touch(world, shapes[m], move["vertex"], vec(move["to"]))
            times = [Fraction(c["time"]) for c in case["crossings"] if c["move"] == m] + ([t] if t is not None else [])
            if times:
                expected = (m, min(times))
                break
        stated = (case["touch"]["move"], Fraction(case["touch"]["time"])) if case["touch"] else None
        if stated != expected:
            yield f"touch is {stated}, not {expected}"

    def meeting_faults(self, world, case, shapes, m):
        t = Fraction(m["time"])
        if float(t) != m["rounded"] or str(t) != m["time"]:
            yield f"{m['time']} is not reduced, or not {m['rounded']}"
        move = case["moves"][m["move"]]
        shape = list(shapes[m["move"]])
        shape[move["vertex"]] = at(shape[move["vertex"]], vec(move["to"]), t)
        met = world.met(shape)
        if met != m["walls"]:
            yield f"the walls met at {m['time']} are {met}"
        if m["feature"] != world.lowest_feature(shape):
            yield f"the feature met at {m['time']} is not a {m['feature']}"
        if sorted({world.kinds[w] for w in met}) != m["wall_kinds"]:
            yield f"the kinds of walls met at {m['time']} are wrong"

    def walk_faults(self, world, case, shape):
        side = vec(case["side"][0]) if case["side"] else None
        arrives, blocked = walk_truth(world, shape[0], vec(case["moves"][0]["to"]), side)
        crossing = "no" if not blocked else "either" if arrives else "yes"
        if case["crossing"] != crossing:
            yield f"crossing is {crossing}"
        if [Fraction(c["time"]) for c in case["crossings"]] != blocked:
            yield f"times of crossings are {' '.join(map(str, blocked))}"
        self.determined["walk", True] += 1

    def sweep_faults(self, world, case, shapes):
        """What the walls alone say of a crossing: all, or where a wall passes through the edge, and that something is touched before."""
        times = [(c["move"], Fraction(c["time"])) for c in case["crossings"]]
        for m, move in enumerate(case["moves"]):
            a, b, q = shapes[m][move["vertex"]], vec(move["to"]), shapes[m][1 - move["vertex"]]
            passed = [t for t in (pierced_at(a, b, q, wall) for wall in world.walls) if t is not None]
            if passed:
                first = (m, min(passed))
                if case["crossing"] != "yes" or times[-1] > first:
                    yield f"a wall passes through the edge at {first}"
                break
        touch = (case["touch"]["move"], Fraction(case["touch"]["time"])) if case["touch"] else None
        if times and not case["at_start"] and (touch is None or times[0] < touch):
            yield "a crossing before a touch"
        side = [vec(p) for p in case["side"]] if case["side"] else None
        is_known, crossing = sweep_truth(world, shapes, case["moves"], side)
        if is_known and times != ([] if crossing is None else [crossing]):
            yield f"crossing is {crossing}"
        self.determined["sweep", is_known] += 1

    def convention_faults(self, case):
        touch = (case["touch"]["move"], case["touch"]["time"]) if case["touch"] else None
        crossings = [(c["move"], c["time"]) for c in case["crossings"]]
        same = crossings == ([touch] if touch else [])
        convention = "start" if case["at_start"] else "choice" if case["crossing"] == "either" else "none" if same else "touch"
        if case["convention"] != convention:
            yield f"convention is {convention}"


def verify(worlds, cases):
    checker = Checker(worlds)
    wrong = 0
    ids = set()
    for case in cases:
        try:
            faults = list(checker.faults(case))
        except (KeyError, IndexError, TypeError, ValueError, ZeroDivisionError) as error:
            faults = [f"cannot be read: {error!r}"]
        if case["id"] in ids:
            faults.append("its name is not its own")
        ids.add(case["id"])
        for fault in faults[:3]:
            print(f"{case['id']}: {fault}")
        wrong += bool(faults)
    for kind in sorted({kind for kind, _ in checker.determined}):
        yes, no = checker.determined[kind, True], checker.determined[kind, False]
        print(f"{kind}: {yes + no} cases; the walls alone determine the crossing of {yes}, and bound that of {no}")
    print(f"{len(cases)} cases, {wrong} wrong")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1])
    parser.add_argument("--in", dest="folder", type=Path, default=Path(__file__).resolve().parent)
    parser.add_argument("--answers", type=Path)
    parser.add_argument("--definition", choices=["any", "touch", "crossing"], default="any")
    parser.add_argument("--tolerance", type=Fraction, default=Fraction(1, 10**9))
    parser.add_argument("--strict", action="store_true")
    options = parser.parse_args()
    try:
        worlds, cases = read_corpus(options.folder)
        if options.answers:
            return compare(cases, options.answers, options.definition, options.tolerance, options.strict)
    except (OSError, KeyError, json.JSONDecodeError) as error:
        print(f"check.py: {error!r}", file=sys.stderr)
        return 2
    return verify(worlds, cases)


if __name__ == "__main__":
    sys.exit(main())
