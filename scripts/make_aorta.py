#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes the surface of an aortic arch as OFF, in millimetres, with the faults that such files have: `make_aorta.py` wrote data/aorta.off.

usage: make_aorta.py > OUT.off

A smooth union of round tubes is cut into triangles by surface nets, which are then evened out on the surface. All six ends are open, some facets
are missing and some turned, and one branch is a mesh of its own that only reaches into the arch. Needs the package python3-numpy.
"""

import sys

import numpy

GRID = 2.7            # mm between the points of the grid of surface nets, about the length of edges
BLEND = 7.0           # mm, over which tubes pass into each other
SMOOTHINGS = 30
SAMPLE = 0.7          # mm between the balls of which a tube is the union
TURNED, MISSING = 5.5, 3.0  # mm from their middles, facets are turned and missing

# Centre lines with radii. The first and the last point of each lie beyond the surface: there it is cut off, or inside another tube.
ARCH = [(-29, -17, -58, 14.6), (-30, -17, -43, 15.2), (-31, -17, -27, 17.2), (-30, -16, -8, 15.0), (-27, -13, 12, 14.8), (-17, -7, 32, 14.2),
        (1, 3, 42, 13.3), (19, 14, 35, 12.4), (29, 21, 14, 11.8), (31, 23, -10, 11.2), (28, 22, -38, 10.6), (25, 20, -64, 10.2), (24, 19, -80, 10.0)]
INNOMINATE = [(-12, -4, 34, 8.0), (-15, -6, 52, 7.2), (-21, -8, 66, 6.8), (-24, -9, 78, 5.6), (-22, -9, 94, 5.1), (-20, -9, 112, 4.9)]
RIGHT_SUBCLAVIAN = [(-20, -8, 64, 6.0), (-31, -10, 74, 5.6), (-45, -12, 79, 5.2), (-62, -13, 80, 5.0)]
LEFT_CAROTID = [(2, 3, 42, 6.0), (2, 2, 62, 5.4), (4, 0, 82, 5.1), (6, -2, 98, 4.9), (7, -3, 112, 4.9)]
LEFT_SUBCLAVIAN = [(17, 13, 35, 5.6), (21, 16, 56, 5.6), (27, 17, 71, 5.4), (40, 16, 80, 5.2), (58, 14, 83, 5.0)]
TUBES = [ARCH, INNOMINATE, RIGHT_SUBCLAVIAN, LEFT_CAROTID]
# Where ends are cut off: points, and directions outwards.
ENDS = [((-30, -17, -50), (0, 0, -1)), ((24.5, 19.5, -72), (0, 0, -1)), ((-21, -9, 102), (0, 0, 1)), ((-53, -12.5, 79.5), (-1, 0, 0)),
        ((6.3, -2.3, 102), (0, 0, 1))]
AROUND = 14           # points around the branch that is a mesh of its own
BRANCH = (0.08, 0.87)  # its part of its line


def spline(points, count):
    """Points of a Catmull-Rom spline, `count` between two points."""
    p = numpy.array([points[0], *points, points[-1]], float)
    t = numpy.linspace(0, 1, count, endpoint=False)[:, None]
    pieces = [0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)
              for a, b, c, d in zip(p, p[1:], p[2:], p[3:])]
    return numpy.vstack([*pieces, p[-1:]])


def balls(points):
    steps = numpy.linalg.norm(numpy.diff(numpy.array(points, float)[:, :3], axis=0), axis=1).max()
    return spline(points, int(numpy.ceil(steps / SAMPLE)))


BALLS = [balls(tube) for tube in TUBES]


def distance(x):
    """About the distance of points from the surface, negative inside."""
    result = numpy.full(len(x), numpy.inf)
    for tube in BALLS:
        d = numpy.concatenate([(numpy.sqrt(((part[:, None] - tube[None, :, :3])**2).sum(axis=2)) - tube[:, 3]).min(axis=1)
                               for part in numpy.array_split(x, len(x) // 4096 + 1)])
        if numpy.isinf(result).all():
            result = d
        else:  # the smooth minimum of two
            share = numpy.maximum(BLEND - abs(result - d), 0) / BLEND
            result = numpy.minimum(result, d) - share**3 * BLEND / 6
    return result


def gradient(x):
    e = 0.05
    return numpy.stack([distance(x + e * axis) - distance(x - e * axis) for axis in numpy.eye(3)], axis=1) / (2 * e)


def on_surface(x, rounds=2):
    for _ in range(rounds):
        g = gradient(x)
        x = x - (distance(x) / (g * g).sum(axis=1))[:, None] * g
    return x


def surface_nets(low, shape):
    """Points and triangles, outwards."""
    nodes = numpy.stack(numpy.meshgrid(*[numpy.arange(n) for n in shape], indexing="ij"), axis=-1)
    value = distance((low + GRID * nodes).reshape(-1, 3)).reshape(shape)
    number, points, sums = {}, [], {}
    edges = []
    for axis in range(3):
        ahead = numpy.eye(3, dtype=int)[axis]
        a = value[tuple(slice(0, n - k) for n, k in zip(shape, ahead))]
        b = value[tuple(slice(k, n) for n, k in zip(shape, ahead))]
        for i in numpy.argwhere((a < 0) != (b < 0)):
            p, q = value[tuple(i)], value[tuple(i + ahead)]
            edges.append((axis, i, p < 0))
            at = i + ahead * (p / (p - q))
            u, v = numpy.eye(3, dtype=int)[(axis + 1) % 3], numpy.eye(3, dtype=int)[(axis + 2) % 3]
            for cell in (i, i - u, i - u - v, i - v):
                total, count = sums.get(tuple(cell), (0, 0))
                sums[tuple(cell)] = (total + at, count + 1)
    for cell, (total, count) in sums.items():
        number[cell] = len(points)
        points.append(low + GRID * total / count)
    points, triangles = numpy.array(points), []
    for axis, i, is_inside in edges:
        u, v = numpy.eye(3, dtype=int)[(axis + 1) % 3], numpy.eye(3, dtype=int)[(axis + 2) % 3]
        quad = [number[tuple(c)] for c in (i, i - u, i - u - v, i - v)]
        if not is_inside:
            quad.reverse()
        if numpy.linalg.norm(points[quad[0]] - points[quad[2]]) > numpy.linalg.norm(points[quad[1]] - points[quad[3]]):
            quad = quad[1:] + quad[:1]
        triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
    return points, numpy.array(triangles)


def used(points, triangles):
    """Without points that no triangle has."""
    kept, numbers = numpy.unique(triangles, return_inverse=True)
    return points[kept], numbers.reshape(-1, 3)


def neighbours(triangles):
    """Pairs of points, each way, and whether an edge has one triangle only."""
    pairs = numpy.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, counts = numpy.unique(pairs, axis=0, return_counts=True)
    return edges, counts == 1


def evened(points, triangles):
    """Points in the middle of their neighbours, along the surface; those of ends stay in their planes."""
    edges, is_border = neighbours(triangles)
    borders = numpy.zeros(len(points), bool)
    borders[edges[is_border]] = True
    places, outward = (numpy.array(part, float) for part in zip(*ENDS))
    end = abs(((points[:, None] - places) * outward).sum(axis=2)) + 0.1 * numpy.linalg.norm(points[:, None] - places, axis=2)
    end = end.argmin(axis=1)
    for _ in range(SMOOTHINGS):
        mean, count = numpy.zeros_like(points), numpy.zeros(len(points))
        both = numpy.vstack([edges, edges[:, ::-1]])
        ok = ~borders[both[:, 0]] | numpy.concatenate([is_border, is_border])
        numpy.add.at(mean, both[ok, 0], points[both[ok, 1]])
        numpy.add.at(count, both[ok, 0], 1)
        points = on_surface(0.4 * points + 0.6 * mean / count[:, None], 1)
        for _ in range(2):
            n = outward[end[borders]]
            points[borders] -= ((points[borders] - places[end[borders]]) * n).sum(axis=1)[:, None] * n
            points[borders] = on_surface(points[borders], 1)
        n = outward[end[borders]]
        points[borders] -= ((points[borders] - places[end[borders]]) * n).sum(axis=1)[:, None] * n
    return points


def branch():
    """A tube of its own, open at both ends."""
    line = spline(LEFT_SUBCLAVIAN, 9)
    line = line[int(BRANCH[0] * len(line)):int(BRANCH[1] * len(line))]
    along = numpy.gradient(line[:, :3], axis=0)
    along /= numpy.linalg.norm(along, axis=1)[:, None]
    up = numpy.cross(along[0], [0, 1, 0])
    points, triangles = [], []
    for j, (x, t) in enumerate(zip(line, along)):
        up = up - up.dot(t) * t
        up /= numpy.linalg.norm(up)
        angles = 2 * numpy.pi * (numpy.arange(AROUND) + 0.5 * (j % 2)) / AROUND
        points.append(x[:3] + x[3] * (numpy.cos(angles)[:, None] * up + numpy.sin(angles)[:, None] * numpy.cross(t, up)))
        if j == 0:
            continue
        for i in range(AROUND):
            a, b, c, d = (j - 1) * AROUND + i, (j - 1) * AROUND + (i + 1) % AROUND, j * AROUND + i, j * AROUND + (i + 1) % AROUND
            triangles += [(a, b, c), (b, d, c)] if j % 2 else [(a, b, d), (a, d, c)]
    return numpy.vstack(points), numpy.array(triangles)


def main():
    if len(sys.argv) != 1:
        sys.exit(__doc__)
    low, high = numpy.array([-66.0, -42, -70]), numpy.array([52.0, 44, 116])
    points, triangles = surface_nets(low, tuple(((high - low) / GRID).astype(int)))
    for place, outward in ENDS:
        place, outward = numpy.array(place, float), numpy.array(outward, float)
        x = points - place
        beyond = (x.dot(outward) > 0.3 * GRID) & (numpy.linalg.norm(x, axis=1) < 45)
        triangles = triangles[~beyond[triangles].any(axis=1)]
    points, triangles = used(points, triangles)
    points = evened(points, triangles)
    middle = points[triangles].mean(axis=1)
    near = lambda place, radius: numpy.linalg.norm(middle - on_surface(numpy.array([place], float))[0], axis=1) < radius
    turned = near((34, 12, -28), TURNED)
    triangles[turned] = triangles[turned][:, ::-1]
    triangles = triangles[~near((-26, -30, 2), MISSING)]
    points, triangles = used(points, triangles)
    more, others = branch()
    triangles = numpy.vstack([triangles, others + len(points)])
    points = numpy.vstack([points, more])
    print(f"OFF\n{len(points)} {len(triangles)} 0")
    for p in points:
        print(*(f"{c + 0.0:.2f}" for c in p.round(2)))
    for t in triangles:
        print(3, *t)


if __name__ == "__main__":
    main()
