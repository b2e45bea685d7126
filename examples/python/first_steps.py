# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cellwalk from Python: an environment, particles in batches, edges, and a body that falls."""

## [environment]
## [short]
import cellwalk
import numpy

environment = cellwalk.Environment.generate("hexes", cells=(8, 8, 8))  # or .import_mesh("torus.off")
print(environment)
## [environment]

## [particles]
rng = numpy.random.default_rng(1)
low, high = environment.points.min(axis=0), environment.points.max(axis=0)
starts = rng.uniform(low, high, size=(10_000, 3))

particles = cellwalk.Particles(environment, starts)  # located once; each remembers its cell
motions = particles.move(particles.positions + (high - low) * 0.25)
print("in free space:", numpy.count_nonzero(motions.status != cellwalk.Status.OUTSIDE))
print("stopped by walls:", len(motions.contacts))
first = motions.contacts[0]
print(f"row {first['row']}: time {first['time']:.4f}, normal {first['normal']}")
## [short]
## [particles]

## [sweep]
middle = (low + high) / 2
p = numpy.array([middle, middle])
targets = numpy.array([middle + (high - low) * 0.125, middle + (high - low)])
q = numpy.array([middle - (high - low) * 0.125] * 2)
edges = environment.sweep(p, targets, q)
print("edges:", [cellwalk.Status(status).name for status in edges.status], edges.time)
## [sweep]

## [body]
points = middle + numpy.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
faces = numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
body = cellwalk.Body(environment, points, faces=faces)
velocity = 0.0
for step in range(40):
    velocity -= 0.01
    contacts = body.step(body.positions + [0.0, 0.0, velocity], sweep="faces")
    if len(contacts):
        break
body.validate()  # exact: no wall crosses a vertex, an edge or a face
print(f"step {step}: vertex {contacts['vertex'][0]} meets the wall z = {contacts['point'][0, 2]:g}")
print("lowest vertex:", body.positions[:, 2].min())
## [body]

## [stay]
blocked = body.step(body.positions - [0.0, 0.0, 0.25], rule="reject_at_target", report="blocked")
print("stay:", blocked["vertex"][blocked["stays"]], "z of the others:", numpy.delete(body.positions[:, 2], blocked["vertex"]))
## [stay]
