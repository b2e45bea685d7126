# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cells from blocks of a mesh generator, arrays for other programs, and particles that move by rows."""

## [from]
import cellwalk
import numpy

points = numpy.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2], [1, 1, 3]])
blocks = [("hexahedron", [[0, 1, 2, 3, 4, 5, 6, 7]]), ("pyramid", [[4, 5, 6, 7, 8]])]  # such as the cells of a meshio.Mesh
hut = cellwalk.Environment.from_arrays(points, blocks, walls=[[4, 5, 6, 7]])  # the ceiling is a wall, too
print(hut)
## [from]

## [rows]
particles = cellwalk.Particles(hut, [[1, 1, 0.5], [1, 1, 1.5], [1, 1, 2.5]])
below = particles.positions[:, 2] < 2  # a mask; numbers of particles will do as well
motions = particles.move(particles.positions[below] + [0, 0, 1], rows=below)
for status, time in zip(motions.status.tolist(), motions.time.tolist()):
    print(cellwalk.Status(status).name, time)
## [rows]

## [to]
arrays = hut.to_arrays()
print([(name, len(corners)) for name, corners in arrays.blocks])  # meshio.Mesh(arrays.points, arrays.blocks)
print(arrays.celltypes, arrays.cells)  # pyvista.UnstructuredGrid(arrays.cells, arrays.celltypes, arrays.points)
again = cellwalk.Environment.from_arrays(arrays.points, arrays.cells, arrays.celltypes, walls=arrays.walls, solid=arrays.solid)
assert again.certificate == hut.certificate
## [to]
