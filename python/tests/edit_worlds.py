# SPDX-License-Identifier: LGPL-3.0-or-later
"""Small environments that are edited."""

import numpy

import cellwalk


def plane(cells=(4, 3)):
    """Unit squares; cell x + 4 y is [x,x+1] x [y,y+1]."""
    return cellwalk.Environment.generate("squares", cells=cells)


def room(cells=(2, 2, 2)):
    return cellwalk.Environment.generate("tets", cells=cells)


def thread(environment, *points):
    return cellwalk.Body(environment, numpy.array(points), numpy.array([[i, i + 1] for i in range(len(points) - 1)]))


def walls_inside(environment):
    facets = environment.facets()
    return numpy.count_nonzero(facets["wall"] & (facets["neighbour"] >= 0))
