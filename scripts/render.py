# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws triangles as the program does (src/drawing): the same light, translucent surfaces with a rim, layers sorted at each sample. For animate.py, which
needs one camera for all frames. Needs the package python3-numpy."""

from dataclasses import dataclass, field

import numpy

SUBPIXEL = 16          # corners are snapped to this fraction of a sample, so that a sample on a common edge belongs to one triangle
RIM_POWER = 2.5
BEHIND = 1.0 - 1e-6    # from this opacity on a surface hides what lies behind it
MOST_SAMPLES = 3_000_000  # tested at a time
LINE = 0.45            # samples: half the width of the edges of a mesh


@dataclass
class Material:
    colour: tuple
    opacity: float = 1
    rim: float = 0      # opacity added where the surface is seen edge-on
    line: tuple = ()    # the colour of the edges of triangles; none: they are not drawn
    line_opacity: float = 0.5
    low: tuple = ()     # colours at corners with the shades -1 and 1; none: the same
    high: tuple = ()
    shade_opacity: float = 0  # added there


@dataclass
class Camera:
    target: tuple
    toward: tuple       # from the target to the eye
    height: float       # of what is seen at the target
    up: tuple = (0, 0, 1)
    shift: tuple = (0, 0)  # of the target from the middle of the picture, in parts of its height
    distance: float = 6    # of the eye, in heights


@dataclass
class Drawing:
    corners: list = field(default_factory=list)
    normals: list = field(default_factory=list)
    materials: list = field(default_factory=list)
    shades: list = field(default_factory=list)
    numbers: list = field(default_factory=list)

    def add(self, corners, normals, material, shades=None):
        """Triangles, n x 3 x 3, with the normals and, where the material has colours for them, the shades of their corners."""
        if len(corners) == 0:
            return
        self.corners.append(corners)
        self.normals.append(normals)
        self.shades.append(numpy.zeros((len(corners), 3)) if shades is None else shades)
        self.numbers.append(numpy.full(len(corners), len(self.materials)))
        self.materials.append(material)

    def add_flat(self, corners, material):
        n = unit(numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
        self.add(corners, numpy.repeat(n[:, None], 3, axis=1), material)

    def add_surface(self, points, triangles, material, shades=None):
        """With the mean normals of the facets at points, and the shades of these."""
        if len(triangles) == 0:
            return
        p = points[triangles]
        n, sums = numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), numpy.zeros_like(points)
        for k in range(3):
            numpy.add.at(sums, triangles[:, k], n)
        self.add(p, unit(sums)[triangles], material, None if shades is None else shades[triangles])

    def add_tube(self, line, radius, material, sides=14):
        """A round line with balls at its ends; at each point its own radius, if there are as many."""
        radii = numpy.broadcast_to(numpy.asarray(radius, float), (len(line),))
        along = unit(numpy.gradient(line, axis=0)) if len(line) > 2 else numpy.repeat(unit(line[1:] - line[:1]), 2, axis=0)
        side = unit(numpy.cross(along[0], numpy.eye(3)[abs(along[0]).argmin()]))
        rings = []
        for t in along:
            side = unit(side - side.dot(t) * t)
            a = 2 * numpy.pi * numpy.arange(sides) / sides
            rings.append(numpy.cos(a)[:, None] * side + numpy.sin(a)[:, None] * numpy.cross(t, side))
        n = numpy.array(rings)
        p, q = line[:, None] + radii[:, None, None] * n, numpy.roll
        corners = [numpy.stack(part, axis=2).reshape(-1, 3, 3) for a in (p, n)
                   for part in [(a[:-1], q(a, -1, 1)[:-1], a[1:]), (q(a, -1, 1)[:-1], q(a, -1, 1)[1:], a[1:])]]
        self.add(numpy.vstack(corners[:2]), numpy.vstack(corners[2:]), material)

    def add_ball(self, centre, radius, material, sides=14):
        polar = numpy.linspace(0, numpy.pi, sides // 2 + 1)[:, None]
        a = 2 * numpy.pi * numpy.arange(sides + 1) / sides
        n = numpy.stack([numpy.sin(polar) * numpy.cos(a), numpy.sin(polar) * numpy.sin(a), numpy.cos(polar) * numpy.ones_like(a)], axis=-1)
        n = numpy.vstack([numpy.stack(t, axis=2).reshape(-1, 3, 3) for t in
                          [(n[:-1, :-1], n[1:, :-1], n[1:, 1:]), (n[:-1, :-1], n[1:, 1:], n[:-1, 1:])]])
        self.add(centre + radius * n, n, material)

    def add_arrow(self, tail, direction, length, radius, material):
        d = unit(numpy.asarray(direction, float))
        at = numpy.array([0, 0.62, 0.62, 1]) * length
        self.add_tube(tail + at[:, None] * d, numpy.array([1, 1, 2.8, 0]) * radius, material, 8)


def unit(v):
    return v / numpy.maximum(numpy.linalg.norm(v, axis=-1, keepdims=True), 1e-300)


def frame_of(camera):
    toward = unit(numpy.array(camera.toward, float))
    right = unit(numpy.cross(camera.up, toward))
    return right, numpy.cross(toward, right), toward


def shaded(colour, opacity, rim, normal, eye, frame):
    """The colours and opacities of samples (src/drawing/picture_band.cpp)."""
    right, up, toward = frame
    key, fill = unit(-0.45 * right + 0.75 * up + 0.75 * toward), unit(0.8 * right - 0.1 * up + 0.4 * toward)
    normal, eye = unit(normal), unit(eye)
    facing = (normal * eye).sum(axis=1)
    normal = normal * numpy.where(facing < 0, -1, 1)[:, None]
    facing = abs(facing)
    lit = numpy.maximum(normal.dot(key), 0)
    light = 0.42 + 0.52 * lit + 0.16 * numpy.maximum(normal.dot(fill), 0) + 0.08 * facing
    colour = numpy.minimum(colour * light[:, None] + (0.22 * lit**24)[:, None], 1)
    return colour, numpy.minimum(opacity + rim * (1 - numpy.minimum(facing, 1))**RIM_POWER, 1)


def samples_of(xy, near, size):
    """The triangle, place and barycentric weights of each sample inside a triangle, and its distance from the edges in samples."""
    width, height = size
    snapped = numpy.round(xy * SUBPIXEL).astype(numpy.int64)
    a, b, c = snapped[:, 0], snapped[:, 1], snapped[:, 2]
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    low = numpy.clip(snapped.min(axis=1) // SUBPIXEL, 0, [width, height])
    extent = numpy.clip(snapped.max(axis=1) // SUBPIXEL + 1, 0, [width, height]) - low
    extent[(area == 0) | (near.min(axis=1) <= 0)] = 0
    count = numpy.maximum(extent, 0).prod(axis=1)
    parts, total = [], numpy.cumsum(count)
    for first, last in pieces(total):
        t = numpy.repeat(numpy.arange(first, last), count[first:last])
        if len(t) == 0:
            continue
        rest = numpy.arange(len(t)) - numpy.repeat(total[first:last] - count[first:last] - (total[first] - count[first]), count[first:last])
        x, y = low[t, 0] + rest % extent[t, 0], low[t, 1] + rest // extent[t, 0]
        px, py = x * SUBPIXEL + SUBPIXEL // 2, y * SUBPIXEL + SUBPIXEL // 2
        turn = numpy.where(area < 0, -1, 1)[t]
        inside, e = numpy.ones(len(t), bool), []
        for k in range(3):
            p, q = snapped[:, (k + 1) % 3], snapped[:, (k + 2) % 3]
            dx, dy = (turn * (q - p)[t, 0]), (turn * (q - p)[t, 1])
            value = dx * (py - p[t, 1]) - dy * (px - p[t, 0])
            inside &= (value > 0) | ((value == 0) & ((dy > 0) | ((dy == 0) & (dx < 0))))
            e.append(value)
        t = t[inside]
        e = numpy.stack(e, axis=1)[inside]
        lengths = numpy.stack([numpy.linalg.norm(snapped[:, (k + 2) % 3] - snapped[:, (k + 1) % 3], axis=1) for k in range(3)], axis=1)
        parts.append((t, (y * width + x)[inside], e / abs(area[t])[:, None], (e / numpy.maximum(lengths[t], 1)).min(axis=1) / SUBPIXEL))
    return [numpy.concatenate(part) for part in zip(*parts)]


def pieces(total):
    """Ranges of triangles with a bounded number of samples."""
    first = 0
    while first < len(total):
        before = total[first - 1] if first > 0 else 0
        last = max(first + 1, int(numpy.searchsorted(total, before + MOST_SAMPLES, "right")))
        yield first, last
        first = last


def render(drawing, camera, width, height, background, oversampling=2):
    """The picture, height x width x 3 in [0, 1]. The background is such a picture, or a colour."""
    size = (width * oversampling, height * oversampling)
    colour = numpy.empty((size[0] * size[1], 3), numpy.float32)
    image = numpy.asarray(background, numpy.float32)
    colour[:] = image if image.ndim == 1 else image.repeat(oversampling, 0).repeat(oversampling, 1).reshape(-1, 3)
    if drawing.corners:
        blend(colour, drawing, camera, size)
    return colour.reshape(height, oversampling, width, oversampling, 3).mean(axis=(1, 3))


def blend(colour, drawing, camera, size):
    corners, normals = numpy.concatenate(drawing.corners), numpy.concatenate(drawing.normals)
    numbers = numpy.concatenate(drawing.numbers)
    frame = frame_of(camera)
    distance = camera.distance * camera.height
    eye = numpy.array(camera.target, float) + distance * frame[2]
    seen = numpy.stack([(corners - camera.target).dot(axis) for axis in frame], axis=-1)
    near = distance / (distance - seen[..., 2])
    scale = size[1] / camera.height
    middle = numpy.array([size[0] / 2 + camera.shift[0] * size[1], size[1] / 2 - camera.shift[1] * size[1]])
    xy = middle + scale * near[..., None] * seen[..., :2] * [1, -1]
    t, pixel, weight, edge = samples_of(xy, near, size)
    depth = (weight * near[t]).sum(axis=1)
    weight = weight * near[t] / depth[:, None]
    table = lambda get: numpy.array([get(m) for m in drawing.materials], float)[numbers[t]]
    normal = numpy.einsum("ij,ijk->ik", weight, normals[t])
    place = numpy.einsum("ij,ijk->ik", weight, corners[t])
    shade = (weight * numpy.concatenate(drawing.shades)[t]).sum(axis=1)
    base = table(lambda m: m.colour)
    base += numpy.maximum(shade, 0)[:, None] * (table(lambda m: m.high or m.colour) - base) + numpy.maximum(-shade, 0)[:, None] * (table(lambda m: m.low or m.colour) - base)
    rgb, opacity = shaded(base, table(lambda m: m.opacity) + abs(shade) * table(lambda m: m.shade_opacity), table(lambda m: m.rim), normal, eye - place, frame)
    has_line = table(lambda m: float(bool(m.line)))
    line = has_line * numpy.clip(2 * LINE + 0.5 - edge, 0, 1) * table(lambda m: m.line_opacity)
    rgb += line[:, None] * (table(lambda m: m.line or (0, 0, 0)) - rgb)
    opacity += line * (1 - opacity)

    nearest = numpy.full(len(colour), -numpy.inf)
    solid = opacity >= BEHIND
    numpy.maximum.at(nearest, pixel[solid], depth[solid])
    kept = depth >= nearest[pixel]
    pixel, depth, rgb, opacity = pixel[kept], depth[kept], rgb[kept], opacity[kept]
    order = numpy.lexsort((depth, pixel))
    pixel, rgb, opacity = pixel[order], rgb[order], opacity[order]
    begin = numpy.flatnonzero(numpy.concatenate([[True], pixel[1:] != pixel[:-1]])) if len(pixel) else numpy.array([], int)
    rank = numpy.arange(len(pixel)) - numpy.repeat(begin, numpy.diff(numpy.append(begin, len(pixel))))
    for layer in range(rank.max() + 1 if len(rank) else 0):
        at = numpy.flatnonzero(rank == layer)
        colour[pixel[at]] += opacity[at, None] * (rgb[at] - colour[pixel[at]])
