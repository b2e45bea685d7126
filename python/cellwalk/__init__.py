# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cellwalk: exact and fast detection of contacts of points, edges and deformable bodies with walls.

>>> import cellwalk, numpy
>>> environment = cellwalk.Environment.generate("hexes", cells=(4, 2, 2))
>>> particles = cellwalk.Particles(environment, numpy.array([[0.5, 0.5, 0.5]]))
>>> motions = particles.move(numpy.array([[5.5, 0.5, 0.5]]))
>>> motions.contacts["time"], motions.contacts["normal"]
(array([0.7]), array([[-1.,  0.,  0.]]))

Points are arrays of shape (N, 3) or (N, 2), or anything of which numpy.asarray() makes one. float64 arrays in C order are read in
place; other numbers that float64 holds are copied first. Wrong shapes raise a ValueError, wrong types a TypeError, rows that do not
exist an IndexError.
Batches run without the interpreter lock, on `threads` threads; the results do not depend on their number. Any number of threads
may ask one environment; Environment.reshape() moves its walls among what lies in it, Environment.editing() opens and closes facets
and replaces cells, and both wait until they are alone.
"""

from ._cellwalk import (
    Body,
    Changes,
    CutReport,
    Edits,
    Environment,
    Locations,
    MeshArrays,
    Motions,
    Particles,
    RelaxReport,
    Replacement,
    Selection,
    Traces,
    WallMoves,
    __version__,
    build_features,
    draw,
)
from ._codes import Feature, MoveEnd, Place, Status
from ._errors import Error, InputError, NotCertifiedError, OutsideError, RowError, UsageError

__all__ = [
    "Body",
    "Changes",
    "CutReport",
    "Edits",
    "Environment",
    "Error",
    "Feature",
    "InputError",
    "Locations",
    "MeshArrays",
    "Motions",
    "MoveEnd",
    "NotCertifiedError",
    "OutsideError",
    "Particles",
    "Place",
    "RelaxReport",
    "Replacement",
    "RowError",
    "Selection",
    "Status",
    "Traces",
    "UsageError",
    "WallMoves",
    "__version__",
    "build_features",
    "draw",
]
