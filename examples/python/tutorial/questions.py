# SPDX-License-Identifier: LGPL-3.0-or-later
"""Questions about points, motions and edges, many at a time."""

## [load]
import cellwalk
import numpy

ring = cellwalk.Environment.load("ring.ovm")
rng = numpy.random.default_rng(1)
points = rng.uniform([-1.4, -1.4, -0.4], [1.4, 1.4, 0.4], size=(100_000, 3))
## [load]

## [locate]
inside = ring.locate(points).status == cellwalk.Place.FREE
print(f"{inside.mean():.3f} of the box is inside")
starts = points[inside]
## [locate]

## [walk]
motions = ring.walk(starts, starts + [0.5, 0.0, 0.0])
stopped = motions.status == cellwalk.Status.CONTACT
print(f"{len(starts)} motions, {stopped.sum()} stopped, on average after {motions.time[stopped].mean():.3f} of the way")
first = motions.contacts[0]
print(f"row {first['row']}: at {first['point'].round(4)}, normal {first['normal'].round(4)}")
## [walk]

## [sweep]
# Edges across the ring, which would have to pass over its hole; the other end stands still.
p = numpy.array([[0.9, 0.5, 0.0], [0.9, 0.5, 0.0]])
targets = numpy.array([[0.5, 0.9, 0.0], [0.95, 0.4, 0.0]])
q = numpy.array([[0.5, -0.9, 0.0], [0.5, -0.9, 0.0]])
edges = ring.sweep(p, targets, q)
print([cellwalk.Status(status).name for status in edges.status], edges.time)
print("blocked:", cellwalk.Feature(edges.contacts["body"][0]).name.lower())
## [sweep]
