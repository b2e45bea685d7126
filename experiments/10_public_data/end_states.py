#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges states in which simulations of catheters ended, in the vessels of their scenes, and lets Cellwalk look at them. Writes end_states.csv.

usage: end_states.py PROGRAM OUT DATA... [--sources FILE]

  PROGRAM   cellwalk
  OUT       a folder for the table, and for vessels, edges and answers, in OUT/end_states
  DATA      folders in which the files of sources.json are looked for, by their SHA-256; what is not there is left out, and said
"""

import argparse
import csv
import subprocess
import sys
import zlib
from collections import Counter
from math import cos, radians, sin
from pathlib import Path

import numpy
from audit import write_csv
from exact import integers, plain_axes, segment_meets
from readers import read_bytes, read_surface
from sources import SOURCES, index, read_sources

AXES = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}


def read_state(path):
    """The polyline of the last state in a file of SOFA's regression tests: points that follow each other in the same place are one."""
    try:
        lines = [line.split() for line in read_bytes(path).decode().splitlines()]
        numbers = numpy.array([words for words in lines if words[:1] in (["T="], ["X="])][-1][1:], dtype=float)
    except (OSError, EOFError, ValueError, IndexError, zlib.error) as error:
        sys.exit(f"end_states.py: {path}: no states of points: {error}")
    if numbers.size < 6 or numbers.size % 3 != 0 or not numpy.isfinite(numbers).all():
        sys.exit(f"end_states.py: {path}: the last state has {numbers.size} numbers; needs three for each of some points, all finite")
    points = numbers.reshape(-1, 3)
    points = points[numpy.append(True, (points[1:] != points[:-1]).any(axis=1))]
    if len(points) < 2:
        sys.exit(f"end_states.py: {path}: all points of the last state are in one place")
    return points


def placed(points, turns, scale):
    """The points of a vessel where its scene has them: turned about axes, one after the other, by degrees, and scaled."""
    points = scale * points
    for axis, degrees in turns:
        i, j = AXES[axis]
        c, s = cos(radians(degrees)), sin(radians(degrees))
        points[:, i], points[:, j] = c * points[:, i] - s * points[:, j], s * points[:, i] + c * points[:, j]
    return points


def edges_that_meet(line, points, triangles):
    """The numbers of the edges of a polyline that have a point in common with a triangle, exactly."""
    corners = points[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    found = []
    for i, (p, q) in enumerate(zip(line, line[1:])):
        near = numpy.flatnonzero((low <= numpy.maximum(p, q)).all(axis=1) & (high >= numpy.minimum(p, q)).all(axis=1))
        for t in near:
            p_, q_, *triangle = integers([p, q, *corners[t]])
            if plain_axes(triangle) is not None and segment_meets(p_, q_, triangle):
                found.append(i)
                break
    return found


def dots(u, v):
    return numpy.einsum("ij,ij->i", u, v)


def segment_distances(p, q, a, b):
    """The distances of one segment from others: by the nearest points of their lines, clamped to one after the other."""
    u, v, w = (q - p)[None], b - a, p - a
    uu, vv, uv, uw, vw = dots(u, u), dots(v, v), dots(u, v), dots(u, w), dots(v, w)
    is_skew = uu * vv - uv * uv > 1e-12 * uu * vv
    s = numpy.where(is_skew, numpy.clip((uv * vw - vv * uw) / numpy.where(is_skew, uu * vv - uv * uv, 1), 0, 1), 0)
    t = numpy.clip((uv * s + vw) / vv, 0, 1)
    s = numpy.clip((uv * t - uw) / uu, 0, 1)
    return numpy.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1)


def heights(p, a, b, c):
    """The distances of a point from triangles above which it lies, and infinity for others."""
    n = numpy.cross(b - a, c - a)
    is_above = numpy.all([dots(numpy.cross(v - u, p - u), n) >= 0 for u, v in ((a, b), (b, c), (c, a))], axis=0)
    return numpy.where(is_above, numpy.abs(dots(p - a, n)) / numpy.linalg.norm(n, axis=1), numpy.inf)


def distances(line, points, triangles):
    """The distance of each edge of a polyline from the triangles, in doubles; of edges that meet one, that of what is nearest beside it."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    is_flat = dots(*[numpy.cross(b - a, c - a)] * 2) == 0
    a, b, c = a[~is_flat], b[~is_flat], c[~is_flat]
    return [min(heights(p, a, b, c).min(), heights(q, a, b, c).min(), *(segment_distances(p, q, *side).min() for side in ((a, b), (b, c), (c, a))))
            for p, q in zip(line, line[1:])]


def write_off(path, points, triangles):
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"OFF\n{len(points)} {len(triangles)} 0\n")
        out.writelines(" ".join(repr(float(x)) for x in p) + "\n" for p in points)
        out.writelines("3 " + " ".join(map(str, t)) + "\n" for t in triangles)


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"end_states.py: {' '.join(map(str, command))}: exit code {done.returncode}\n{done.stderr}")


def answers(program, environment, line, stem, *options):
    """What `cellwalk query` says of each edge of a polyline: of the way from its one end to the other, or, with a radius, of the edge at rest."""
    is_thick = bool(options)
    table, out = Path(f"{stem}.csv"), Path(f"{stem}_answers.csv")
    with open(table, "w", newline="", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow([a + x for a in ("ptq" if is_thick else "ab") for x in "xyz"])
        for p, q in zip(line.tolist(), line[1:].tolist()):
            rows.writerow(map(repr, (*p, *p, *q) if is_thick else (*p, *q)))
    run(program, "query", environment, table, "-o", out, *options)
    with open(out, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def judged(source, line, surface, program, folder):
    """The row of a state."""
    points, triangles = placed(surface[0], source["turns"], source["scale"]), surface[1]
    stem = folder / source["name"].split(".reference")[0]
    vessel, environment = Path(f"{stem}.off"), Path(f"{stem}.ovm")
    write_off(vessel, points, triangles.tolist())
    run(program, "import", vessel, "-o", environment)
    status = Counter(row["status"] for row in answers(program, environment, line, f"{stem}_edges"))
    radius = source["radius"]
    thick = Counter(row["status"] for row in answers(program, environment, line, f"{stem}_thick", "--mode", "sweep", "--radius", repr(float(radius))))
    meeting = edges_that_meet(line, points, triangles)
    if status["free"] + status["contact"] + status["outside"] != len(line) - 1:
        sys.exit(f"end_states.py: {source['name']}: answers that are not known: {dict(status)}")
    apart = [0 if i in meeting else d for i, d in enumerate(distances(line, points, triangles))]
    return {
        "name": stem.name,
        "vessel": source["vessel"],
        "edges": len(line) - 1,
        "meet_surface": len(meeting),
        "nearest": f"{min(apart):.5f}",
        "contact_distance": source["contact_distance"],
        "radius": radius,
        "nearer_than_radius": sum(d < radius for d in apart),
        "free": status["free"],
        "contact": status["contact"],
        "outside": status["outside"],
        "close": thick["close"],
    }


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("data", type=Path, nargs="+")
    parser.add_argument("--sources", default=SOURCES)
    options = parser.parse_args()
    sources, there = read_sources(options.sources), index(*options.data)
    vessels = {source["name"]: there.get(source["sha256"]) for source in sources}
    folder = options.out / "end_states"
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    (options.out / "end_states.csv").unlink(missing_ok=True)
    for source in sources:
        if source["group"] != "end states":
            continue
        state, vessel = there.get(source["sha256"]), vessels[source["vessel"]]
        if state is None or vessel is None:
            print(f"not there: {source['name']}")
            continue
        rows.append(judged(source, read_state(state), read_surface(vessel), options.program, folder))
        print(", ".join(f"{key} {value}" for key, value in rows[-1].items()), flush=True)
    if rows:
        write_csv(options.out / "end_states.csv", rows)


if __name__ == "__main__":
    main()
