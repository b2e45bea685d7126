#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes a torus about the z axis as OFF, of quadrangles: the body data/torus.off is `make_torus.py 16 8 1 0.35`.

usage: make_torus.py AROUND ACROSS RADIUS THICKNESS
"""

import math
import sys


def torus(around, across, radius, thickness):
    """Points and faces; points are rounded to 12 digits, so that every machine writes the same."""
    points, faces = [], []
    for i in range(around):
        for j in range(across):
            a, b = 2 * math.pi * i / around, 2 * math.pi * j / across
            r = radius + thickness * math.cos(b)
            points.append((r * math.cos(a), r * math.sin(a), thickness * math.sin(b)))
            k, n = (i + 1) % around, (j + 1) % across
            faces.append((i * across + j, k * across + j, k * across + n, i * across + n))
    return points, faces


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    points, faces = torus(int(sys.argv[1]), int(sys.argv[2]), float(sys.argv[3]), float(sys.argv[4]))
    print("OFF")
    print(len(points), len(faces), 0)
    for p in points:
        print(*(f"{round(c, 12) + 0.0:.12g}" for c in p))
    for f in faces:
        print(len(f), *f)


if __name__ == "__main__":
    main()
