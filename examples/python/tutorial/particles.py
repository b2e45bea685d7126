# SPDX-License-Identifier: LGPL-3.0-or-later
"""Particles that bounce, in batches."""

## [start]
import cellwalk
import numpy

ring = cellwalk.Environment.load("ring.ovm")
rng = numpy.random.default_rng(2)
points = rng.uniform([-1.4, -1.4, -0.4], [1.4, 1.4, 0.4], size=(3000, 3))
points = points[ring.locate(points).status == cellwalk.Place.FREE][:1000]
particles = cellwalk.Particles(ring, points)  # each remembers its cell from now on
velocities = rng.uniform(-1, 1, size=points.shape)
## [start]

## [bounce]
bounces = 0
for step in range(500):
    motions = particles.move(particles.positions + 0.01 * velocities, at_contact="stop")
    row, normal = motions.contacts["row"], motions.contacts["normal"]
    velocities[row] -= 2 * (velocities[row] * normal).sum(axis=1, keepdims=True) * normal
    bounces += len(row)
print(f"{len(particles)} particles, {bounces} bounces")
print("escaped:", numpy.count_nonzero(ring.locate(particles.positions).status != cellwalk.Place.FREE))
## [bounce]
