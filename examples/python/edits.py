# SPDX-License-Identifier: LGPL-3.0-or-later
"""Two chambers with a valve between them, which shuts when nothing lies in it; and a passage that is cut into solid cells."""

## [valve]
import cellwalk
import numpy

environment = cellwalk.Environment.generate("hexes", cells=(8, 4, 4), simplicial=True)
valve = environment.select(box=((4, 0, 0), (4, 4, 4)))  # facets and cells by place
points = [3.0, 1.3, 1.6] + numpy.arange(9.0)[:, None] * [0.25, 0.0, 0.0]
thread = cellwalk.Body(environment, points, edges=numpy.array([[i, i + 1] for i in range(8)]))
while True:
    # All that lies in the environment is listed, as with reshape().
    with environment.editing(bodies=[thread]) as edits:
        changes = edits.close(valve.facets)
    open_facets = numpy.count_nonzero(~changes.made)
    print(f"{open_facets} of {len(changes)} facets stay open, held by {len(changes.held_by)} vertices and edges")
    if open_facets == 0:
        break
    thread.step(thread.positions - [0.5, 0.0, 0.0])
thread.validate()  # no wall went through the thread, by exact predicates
## [valve]

## [tissue]
cells = environment.cells()  # numbers, means, points, and whether they are solid
with environment.editing(bodies=[thread]) as edits:
    filled = edits.fill(cells[cells["mean"][:, 0] > 5])
    blade = numpy.array([[6.3, -1.0, 4.5], [6.3, 5.0, 4.5], [6.3, 5.0, 1.2], [6.3, -1.0, 1.2]])
    report = edits.cut(blade, opening=0.1)
    # Cells are replaced by others over the same region; what lies in them does not forbid it.
    corner = environment.points[cells["points"][0, 0]]
    inserted = edits.insert_point(cells[0], 0.9 * corner + 0.1 * cells["mean"][0])
    better = edits.relax([inserted.point], good_enough=0.2)
print(f"{numpy.count_nonzero(filled.made)} cells filled; a cut of {report.facets} facets, {report.opened} points parted")
print(f"point {inserted.point} in {len(inserted.cells)} cells; {better.operations} operations, least quality {better.least_before:.2f}, then {better.least_after:.2f}")
assert environment.certificate["cells"] == environment.cell_count  # certified again
## [tissue]
