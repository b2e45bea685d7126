# SPDX-License-Identifier: LGPL-3.0-or-later
"""The codes in arrays. They compare with arrays: ``motions.status == Status.CONTACT``."""

import enum


class Status(enum.IntEnum):
    """The status of a motion (Motions.status)."""

    FREE = 0
    CONTACT = 1
    OUTSIDE = 2
    INVALID = 3
    LOST = 4
    CLOSE = 5


class Place(enum.IntEnum):
    """The location of a point (Locations.status): in free space, only in solid cells, or in no cell."""

    FREE = 0
    SOLID = 1
    OUTSIDE = 2


class Feature(enum.IntEnum):
    """Features: `kind` of the environment (VERTEX, EDGE, FACET), `body` of the moving object (VERTEX, EDGE, FACE)."""

    VERTEX = 0
    EDGE = 1
    FACET = 2
    FACE = 2


class MoveEnd(enum.IntEnum):
    """How the move of a point of the environment ended (WallMoves.end).

    CONTACT: a wall would pass through something. TOUCH: it passes through nothing, but what it touches would end on different
    sides of it. CELL: a cell would be flat or inverted. BOUNDARY: the boundary would run into itself, or into another point.
    """

    REACHED = 0
    CONTACT = 1
    TOUCH = 2
    CELL = 3
    BOUNDARY = 4
