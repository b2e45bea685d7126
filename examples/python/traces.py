# SPDX-License-Identifier: LGPL-3.0-or-later
"""Lengths of rays in the cells of a tetrahedral mesh: traces, a track-length tally, and particles that bounce."""

## [trace]
import cellwalk
import numpy

environment = cellwalk.Environment.generate("tets", cells=(8, 8, 8))  # a cube of side 8
rng = numpy.random.default_rng(1)
directions = rng.normal(size=(20_000, 3))
directions /= numpy.linalg.norm(directions, axis=1, keepdims=True)
source = numpy.full_like(directions, 4.1)

traces = environment.trace(source, source + 3 * directions)
print(traces.offsets[:3], traces.cells[:4], traces.lengths[:4].round(4))
row = numpy.repeat(numpy.arange(len(traces)), numpy.diff(traces.offsets))  # of each piece
print("each row has the length 3:", numpy.allclose(numpy.bincount(row, traces.lengths), 3, rtol=0, atol=1e-14))
## [trace]

## [tally]
attenuation = rng.uniform(0.5, 1.5, size=len(source))  # the weight of each ray
flux = environment.tally(source, source + 3 * directions, weights=attenuation)
print(f"{numpy.count_nonzero(flux)} of {len(flux)} cells are reached; the sum is {flux.sum():.4f}, and {3 * attenuation.sum():.4f} was sent")
## [tally]

## [surfaces]
facets = environment.facets()
plane = environment.facet_rows(environment.select(box=((6, 0, 0), (6, 8, 8))).facets)  # or of a group of the file
crossed = numpy.isin(traces.surfaces, plane)
net = numpy.count_nonzero(crossed & traces.forward) - numpy.count_nonzero(crossed & ~traces.forward)
beyond = numpy.count_nonzero((source + 3 * directions)[:, 0] > 6)
print(f"{net} more crossings forward than back of the plane x = 6; {beyond} rays end beyond it")
## [surfaces]

## [bounce]
walls = facets[facets["wall"]]
left, right = (walls[walls["mean"][:, 0] == x] for x in (0, 8))
mirrors = walls[(walls["mean"][:, 0] > 0) & (walls["mean"][:, 0] < 8)]
particles = cellwalk.Particles(environment, source)
velocities = 20 * directions
for step in range(3):
    traces = particles.trace(particles.positions + velocities, reflect=[mirrors], periodic=[(left, right)])
    velocities = traces.heading  # mirrored where walls reflected
    print(f"step {step}: {facets['wall'][traces.surfaces].sum()} bounces, {len(traces.cells)} pieces, length {traces.lengths.sum():.4f}")
inside = environment.locate(numpy.ascontiguousarray(particles.positions)).status == cellwalk.Place.FREE
print("all inside:", inside.all())
## [bounce]
