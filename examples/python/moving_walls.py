# SPDX-License-Identifier: LGPL-3.0-or-later
"""A room that beats, with a thread across it: its walls push the thread to and fro, and stop where they cannot."""

## [room]
import cellwalk
import numpy

# Walls move where all cells around them are tetrahedra.
environment = cellwalk.Environment.generate("hexes", cells=(4, 2, 2), simplicial=True)
steps = numpy.arange(13.0)[:, None]
points = [0.45, 0.9, 0.125] + steps * [0.25, 0.01, 0.0]
thread = cellwalk.Body(environment, points, edges=numpy.array([[i, i + 1] for i in range(12)]))
## [room]

## [beat]
floor = numpy.flatnonzero(environment.points[:, 2] == 0)
for step in range(1, 9):
    height = 0.25 * abs(numpy.sin(0.25 * numpy.pi * step))
    targets = environment.points[floor]  # a copy: environment.points itself changes as walls move
    targets[:, 2] = height
    # All that lies in the environment is listed; the walls push it out of their way.
    moves = environment.reshape(floor, targets, bodies=[thread], at_contact="push")
    short = numpy.count_nonzero(moves.end != cellwalk.MoveEnd.REACHED)
    lowest = thread.positions[:, 2].min()
    print(f"floor at {height:.3f}: {len(moves.hits)} contacts, {short} points short of their targets, thread from {lowest:.3f} on")
thread.validate()  # no wall went through the thread, by exact predicates
assert environment.certificate["cells"] == 96  # certified again, as walls moved
## [beat]
