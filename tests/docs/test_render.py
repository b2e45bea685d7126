#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks scripts/render.py, which draws the animation of README: sides that triangles share, what hides what, and the order of translucent layers.

usage: test_render.py ROOT
"""

import sys
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(sys.argv[1]).resolve() / "scripts"))
from render import Camera, Drawing, Material, render

SIZE = 60
CAMERA = Camera((0, 0, 0), (0, -1, 0), 2)
WHITE = (1.0, 1.0, 1.0)
CORNERS = numpy.array([[-0.5, 0, -0.5], [0.5, 0, -0.5], [0.5, 0, 0.5], [-0.5, 0, 0.5]])


def fan(turn):
    """A square of triangles around a point, turned in its plane: they have many sides in common, at all angles."""
    c, s = numpy.cos(turn), numpy.sin(turn)
    p = CORNERS @ numpy.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    around = numpy.vstack([p + (q - p) * k / 5 for k in range(5) for q in [numpy.roll(p, -1, axis=0)]])
    around = around[numpy.argsort(numpy.arctan2(around[:, 2], around[:, 0]))]
    middle = numpy.broadcast_to([0.0, 0, 0], around.shape)
    return numpy.stack([middle, around, numpy.roll(around, -1, axis=0)], axis=1)


def picture(*layers):
    drawing = Drawing()
    for depth, material in layers:
        drawing.add_flat(CORNERS[[[0, 1, 2], [0, 2, 3]]] + [0, depth, 0], material)
    return render(drawing, CAMERA, SIZE, SIZE, WHITE)


def main():
    for turn in (0, 0.1, 0.7):
        drawing = Drawing()
        drawing.add_flat(fan(turn), Material((0.2, 0.4, 0.8), 0.5))
        image = render(drawing, CAMERA, SIZE, SIZE, WHITE)
        inside = image[SIZE // 2 - 9:SIZE // 2 + 9, SIZE // 2 - 9:SIZE // 2 + 9].reshape(-1, 3)
        assert numpy.ptp(inside, axis=0).max() < 0.01, "each sample on a common side belongs to one triangle"
        assert inside.max() < 0.95 and (image[0] == 1).all()
    middle = lambda image: image[SIZE // 2, SIZE // 2]
    red, blue, glass = Material((0.9, 0.1, 0.1)), Material((0.1, 0.1, 0.9)), Material((0.1, 0.9, 0.1), 0.4)
    assert numpy.allclose(middle(picture((0, red), (0.2, blue))), middle(picture((0, red)))), "what is nearer hides what lies behind"
    for behind in (red, glass):
        one, other = middle(picture((0, glass), (0.2, behind))), middle(picture((0.2, behind), (0, glass)))
        assert numpy.allclose(one, other, atol=1e-6), "layers are sorted"
    front, both = middle(picture((0, glass))), middle(picture((0, glass), (0.2, red)))
    assert both[0] < front[0] and both[1] < front[1] and abs(middle(picture((0.2, glass), (0, red))) - middle(picture((0, red)))).max() < 1e-6
    print("render: layers, sides and opacities as expected")


if __name__ == "__main__":
    main()
