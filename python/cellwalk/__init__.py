# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cellwalk: exact and fast contact detection among walls, for points, edges and deformable bodies.

>>> import cellwalk, numpy
>>> environment = cellwalk.Environment.generate("hexes", cells=(4, 2, 2))
>>> particles = cellwalk.Particles(environment, numpy.array([[0.5, 0.5, 0.5]]))
>>> motions = particles.move(numpy.array([[5.5, 0.5, 0.5]]))
>>> motions.contacts["time"], motions.contacts["normal"]
(array([0.7]), array([[-1.,  0.,  0.]]))

Points are C-contiguous float64 arrays of shape (N, 3) or (N, 2); they are read where they lie, and anything else is a
TypeError. Batches run without the interpreter lock, on as many threads as `threads` says; results do not depend on it.
"""

from ._cellwalk import (
    Body,
    Environment,
    Locations,
    Motions,
    Particles,
    __version__,
    build_features,
)
from ._codes import Feature, Place, Status
from ._errors import Error, InputError, NotCertifiedError, OutsideError, UsageError

__all__ = [
    "Body",
    "Environment",
    "Error",
    "Feature",
    "InputError",
    "Locations",
    "Motions",
    "NotCertifiedError",
    "OutsideError",
    "Particles",
    "Place",
    "Status",
    "UsageError",
    "__version__",
    "build_features",
]
