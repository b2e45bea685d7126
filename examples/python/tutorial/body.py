# SPDX-License-Identifier: LGPL-3.0-or-later
"""A chain is pulled through the ring by its head; the walls lead it round."""

## [chain]
import cellwalk
import numpy

ring = cellwalk.Environment.load("ring.ovm")
spacing, count = 0.06, 20
points = numpy.array([[1.0, 0.6 - spacing * i, 0.0] for i in range(count)])
chain = cellwalk.Body(ring, points, edges=numpy.array([[i, i + 1] for i in range(count - 1)]))
## [chain]

## [pull]
def unit(v):
    return v / numpy.sqrt((v * v).sum())


def targets(positions, advance):
    """The head goes straight on; each other vertex follows the one before it."""
    goal = positions.copy()
    goal[0] += advance * unit(positions[0] - positions[1])
    for i in range(1, count):
        goal[i] = goal[i - 1] + spacing * unit(goal[i] - goal[i - 1])
    return goal


contacts, turned, before = 0, 0.0, numpy.arctan2(0.6, 1.0)
for step in range(700):
    contacts += len(chain.step(targets(chain.positions, 0.02)))
    now = numpy.arctan2(chain.positions[0, 1], chain.positions[0, 0])
    turned += (now - before + numpy.pi) % (2 * numpy.pi) - numpy.pi
    before = now
chain.validate()  # by exact predicates: no wall crosses a vertex or an edge
print(f"{contacts} contacts; the head went round by {turned / (2 * numpy.pi):.2f} turns")
## [pull]

## [counts]
counts = chain.counts
print(f"{counts['moves']} moves of vertices, {counts['in_region'] / counts['moves']:.0%} of them without a test")
## [counts]
