# SPDX-License-Identifier: LGPL-3.0-or-later
"""What is wrong with a surface or a mesh of cells: counted exactly, without a line of the library."""

from collections import Counter

import numpy
from exact import crossing_pairs, integers, plain_axes, volume_signs
from readers import FACETS


def surface_faults(points, triangles):
    """What keeps a surface from bounding a volume."""
    is_flat = [len(set(t)) < 3 or plain_axes(integers(points[list(t)])) is None for t in map(tuple, triangles.tolist())]
    kept = triangles[~numpy.array(is_flat, dtype=bool)]
    _, first = numpy.unique(numpy.sort(kept, axis=1), axis=0, return_index=True)
    single = kept[numpy.sort(first)]
    directed = Counter((int(t[k]), int(t[(k + 1) % 3])) for t in single for k in range(3))
    sides = Counter()
    for (u, v), n in directed.items():
        sides[min(u, v), max(u, v)] += n
    return {
        "points": len(points),
        "triangles": len(triangles),
        "flat": int(sum(is_flat)),
        "doubled": len(kept) - len(single),
        "border edges": sum(n == 1 for n in sides.values()),
        "edges of three and more": sum(n > 2 for n in sides.values()),
        "edges of opposite facets": sum(n == 2 and directed[e] != 1 for e, n in sides.items()),
        "crossing pairs": len(crossing_pairs(points, single)),
    }


def cell_faults(points, cells):
    """What keeps cells from being a complex of convex cells."""
    inverted = flat = 0  # inverted: against most of the others
    sides, not_planar = Counter(), set()
    for kind, rows in cells.items():
        if kind == "tetra":
            signs, _ = volume_signs(points, rows)
            inverted += int(min((signs > 0).sum(), (signs < 0).sum()))
            flat += int((signs == 0).sum())
        for facet in FACETS[kind]:
            corners = rows[:, facet]
            keys = list(map(tuple, numpy.sort(corners, axis=1).tolist()))
            sides.update(keys)
            if len(facet) == 4:
                signs, _ = volume_signs(points, corners)
                not_planar.update(keys[row] for row in numpy.flatnonzero(signs))
    return {
        "points": len(points),
        "cells": sum(len(rows) for rows in cells.values()),
        "inverted": inverted,
        "flat": flat,
        "facets that are not planar": len(not_planar),
        "facets of three and more cells": sum(n > 2 for n in sides.values()),
        "boundary facets": sum(n == 1 for n in sides.values()),
    }

