# SPDX-License-Identifier: LGPL-3.0-or-later
"""A rope in a mesh of a surface, its contacts, and a picture: docs/start.md."""
## [short]
import cellwalk
import numpy

torus = cellwalk.Environment.import_mesh("torus.off")
path = numpy.array([[0, -1, 0], [0.9, -0.4, 0], [0.9, 0.4, 0], [0, 1, 0]])
rope = cellwalk.Body.rope(torus, path, spacing=0.1)
for step in range(1, 9):
    targets = rope.positions + [0.1, 0, 0]  # here a solver of your own says where to go
    contacts = rope.step(targets)  # the rope stops at walls and slides along them
    for first in contacts[:1]:
        print(f"step {step}: vertex {first['vertex']} is free until {first['time']:.2f}")
cellwalk.draw(torus, [rope], contacts, file="rope.png")
## [short]
