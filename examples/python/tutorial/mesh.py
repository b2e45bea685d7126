# SPDX-License-Identifier: LGPL-3.0-or-later
"""Environments from a file and from arrays. usage: mesh.py SURFACE"""

## [file]
import sys

import cellwalk
import numpy

ring = cellwalk.Environment.import_mesh(sys.argv[1])  # a closed surface: tetrahedra fill its interior
print(ring)
print(f"volume {ring.certificate['free_volume']:.4f}, {ring.certificate['walls']} walls")
ring.save("ring.ovm")
## [file]

## [arrays]
# A duct that bends by a right angle as it climbs: hexahedra between four radii, ten angles and four heights.
r, angle, z = numpy.meshgrid(numpy.linspace(2, 3, 4), numpy.linspace(0, numpy.pi / 2, 10), numpy.linspace(0, 1, 4), indexing="ij")
points = numpy.stack([r * numpy.cos(angle), r * numpy.sin(angle), z + 0.3 * angle], axis=-1).reshape(-1, 3)
n = numpy.arange(len(points)).reshape(r.shape)
quad = numpy.stack([n[:-1, :-1], n[1:, :-1], n[1:, 1:], n[:-1, 1:]], axis=-1)  # at all heights
cells = numpy.concatenate([quad[:, :, :-1], quad[:, :, 1:]], axis=-1).reshape(-1, 8)  # lower and upper corners, as in VTK

duct = cellwalk.Environment.from_arrays(points, cells)
changed = duct.report["changed"]
print(f"{changed['cells_read']} cells, of which {changed['cells_split']} were split: {changed['not_planar']} have a bent facet")
print(duct)
## [arrays]

## [refused]
try:
    cellwalk.Environment.from_arrays(points, cells, split=False)
except cellwalk.NotCertifiedError as error:
    print(error)
## [refused]
