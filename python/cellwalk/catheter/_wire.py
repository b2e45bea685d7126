# SPDX-License-Identifier: LGPL-3.0-or-later
"""A guidewire: an elastic rod with a curved tip, pushed and turned at its base, among walls.

Numbers are computed by + - * / and square roots only, with sums in a fixed order, so the same actions give the same bytes.
"""

import math
from typing import Any

import numpy
from numpy.typing import NDArray

from .. import Body, Environment

_Array = NDArray[numpy.float64]

_SLACK = 1.0  # in spacings: the drive slips rather than that the wire is compressed or stretched by more
_HELD = 4  # how many steps a wall that a vertex has met counts at most, without being met again
_LIFT = 2.0**-30  # in spacings: off such a wall


def turned(angle: float) -> tuple[float, float]:
    """Cosine and sine of an angle of at most pi, by series: the libraries of machines differ in the last bit."""
    small, cosine, sine = angle / 16, 0.0, 0.0
    for k in range(12, -1, -2):
        cosine = 1 - cosine * small * small / ((k + 1) * (k + 2))
        sine = 1 - sine * small * small / ((k + 2) * (k + 3))
    sine *= small
    for _ in range(4):
        cosine, sine = cosine * cosine - sine * sine, 2 * cosine * sine
    return cosine, sine


def _dot(a: Any, b: Any) -> Any:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Any, b: Any) -> Any:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _carried(v: Any, start: Any, end: Any) -> Any:
    """A vector across a unit direction, taken to one across another, or others, by the least rotation."""
    axis, cosine = _cross(start, end), _dot(start, end)
    share = _dot(axis, v) / (1 + cosine + 1e-300)
    return tuple(cosine * c + aside + share * along for c, aside, along in zip(v, _cross(axis, v), axis))


def _turned(v: Any, axis: Any, turn: tuple[float, float]) -> Any:
    """A vector across an axis, turned about it."""
    return tuple(turn[0] * along + turn[1] * aside for along, aside in zip(v, _cross(axis, v)))


def _times(first: tuple[float, float], second: tuple[float, float]) -> tuple[float, float]:
    """One turn after the other."""
    return first[0] * second[0] - first[1] * second[1], first[1] * second[0] + first[0] * second[1]


def _smoothers(count: int, stiffness: float) -> list[_Array]:
    """For each number of vertices inside, the inverse of 1 + stiffness D'D, where D takes second differences.

    Each is the former one, bordered by the row of a further vertex.
    """
    second = numpy.eye(count, count + 2) - 2 * numpy.eye(count, count + 2, 1) + numpy.eye(count, count + 2, 2)
    full = numpy.eye(count + 2) + stiffness * (second.T @ second)  # of small integers: exact
    result = [numpy.zeros((0, 0))]
    for n in range(count):
        border = (result[n] * full[n, :n]).sum(axis=1)
        rest = full[n, n] - (full[n, :n] * border).sum()
        column = numpy.append(border, -1.0)
        result.append(column[:, None] * column / rest)
        result[-1][:n, :n] += result[n]
    return result


class Wire:
    """Vertices from the tip to the base. Those that are not inside yet wait at the entry."""

    def __init__(self, environment: Environment, entry: _Array, direction: _Array, *, vertices: int, spacing: float, radius: float,
                 stiffness: float, tip_length: float, tip_angle: float) -> None:
        self.vertices, self.spacing, self.radius = vertices, spacing, radius
        self._environment, self._entry = environment, entry.copy()
        self._guide = direction / numpy.sqrt(_dot(direction, direction))
        self._guide_floats = tuple(self._guide.tolist())
        self._edges = numpy.stack([numpy.arange(vertices - 1), numpy.arange(1, vertices)], axis=1)
        self._starts = numpy.tile(self._entry, (vertices, 1))
        self._stiffness, self._smoothers = stiffness, _smoothers(vertices, stiffness)
        self._products = numpy.empty((vertices, vertices))
        self._bends = min(vertices - 2, int(min(vertices, tip_length / spacing)))  # vertices at which it is curved by nature
        cosine, sine = turned(tip_angle / max(1, self._bends) / 2)
        self._towards_side, self._back = 2 * spacing * sine * cosine, 2 * spacing * sine * sine
        side = _cross(self._guide_floats, numpy.eye(3)[numpy.argmin(numpy.abs(self._guide))].tolist())
        self._side = tuple(c / math.sqrt(_dot(side, side)) for c in side)
        self.restart((1.0, 0.0))

    def restart(self, turn: tuple[float, float]) -> Body:
        """Everything at the entry. turn: cosine and sine of the angle of the base."""
        self.body = Body(self._environment, self._starts, self._edges, radius=self.radius)
        self.inside, self.turn, self.slipped = 0.0, turn, 0.0
        self._normals, self._held = numpy.zeros((self.vertices, 3)), numpy.zeros(self.vertices, dtype=numpy.int64)
        self._look()
        return self.body

    @property
    def count(self) -> int:
        """How many vertices are inside."""
        return min(self.vertices, max(0, math.ceil(self.inside / self.spacing - 1 / 64)))

    def step(self, push: float, turn: float) -> NDArray[numpy.void]:
        """Pushes the base by a length, turns it by an angle, and moves the wire as far as walls allow. Returns the contacts."""
        x, n, spacing, targets = self._x, self._x.shape[1] - 2, self.spacing, self._starts.copy()
        self.turn = _times(self.turn, turned(turn))
        if n > 0:
            x[:, :-2] = self._relaxed()
        self._drive(push)
        (tangents, along), count = self._chain(x), self.count
        # Each vertex goes along the wire to its place. The first link goes on beyond the tip.
        place = self.inside - spacing * numpy.arange(count)
        both, most = min(n, count), 2 * abs(push) + spacing / 8
        place[:both] = numpy.minimum(numpy.maximum(place[:both], along[:both] - most), along[:both] + most)
        link = n - numpy.searchsorted(along[n::-1], place, side="right")
        link = numpy.maximum(link, 0) if n > 0 else link + 1  # if nothing is inside: the link of the guide
        after = numpy.minimum(link + 1, n)
        targets[:count] = (x[:, after] + (place - along[after]) * tangents[:, link]).T
        contacts = self.body.step(self._beside_walls(targets))
        self._normals[contacts["vertex"]], self._held[contacts["vertex"]] = contacts["normal"], _HELD
        self._look()
        return contacts

    def _beside_walls(self, targets: _Array) -> _Array:
        """Targets without the motion against walls that vertices have met in the last steps: this spares contacts."""
        into = ((targets - self.body.positions) * self._normals).sum(axis=1)
        self._held = numpy.where(into < 0, numpy.maximum(self._held - 1, 0), 0)
        return targets - numpy.where(self._held > 0, into - _LIFT * self.spacing, 0.0)[:, None] * self._normals

    def _drive(self, push: float) -> None:
        """The base moves, unless that would compress or stretch the wire further than the drive holds it."""
        slack, wanted = _SLACK * self.spacing, self.inside + push
        inside = min(max(wanted, 0.0), (self.vertices - 1) * self.spacing)
        self.inside = max(min(inside, max(self.inside, self.length + slack)), min(self.inside, self.length - slack))
        self.slipped = wanted - self.inside

    def _look(self) -> None:
        """The shape as it is: coordinates from the tip to the base, then the entry and a point of the guide."""
        x, n = numpy.empty((3, self.count + 2)), self.count
        x[:, :n], x[:, n], x[:, n + 1] = self.body.positions[:n].T, self._entry, self._entry - self.spacing * self._guide
        self._x, (self._tangents, self._along) = x, self._chain(x)
        self.length = float(self._along[0])
        self._bent = max(0, min(self._bends, n - 1))  # the last vertex that is curved by nature
        self._bend_side = self._carried_side(self._bent)

    def _chain(self, x: _Array) -> tuple[_Array, _Array]:
        """Directions of the links towards the tip, from the tip on, and the lengths from the entry to the vertices."""
        links = x[:, :-1] - x[:, 1:]
        lengths = numpy.sqrt(_dot(links, links))
        along = numpy.zeros(x.shape[1] - 1)
        along[:-1] = numpy.cumsum(lengths[-2::-1])[::-1]
        tangents = links / (lengths + 1e-300)
        if not lengths.all():
            tangents[:, lengths == 0] = self._guide[:, None]  # of vertices in one place
        return tangents, along

    def _carried_side(self, first: int) -> Any:
        """The side of the base, without its turn, taken along the wire to a link without a twist.

        Taken straight from the guide's direction to the link's, it would be off by the areas of the triangles on the sphere between
        the guide's direction and those of neighbouring links.
        """
        here, before, guide = self._tangents[:, first:-1], self._tangents[:, first + 1 :], self._guide_floats
        area = _dot(guide, _cross(before, here))
        rest = 1 + _dot(guide, before) + _dot(before, here) + _dot(here, guide)
        size = numpy.sqrt(area * area + rest * rest) + 1e-300
        half = (1.0, 0.0)
        for step in zip((rest / size).tolist(), (area / size).tolist()):
            half = _times(half, step)
        end = tuple(self._tangents[:, first].tolist())
        return _turned(_carried(self._side, guide, end), end, _times(half, half))

    def _relaxed(self) -> _Array:
        """The vertices after an implicit step of the overdamped rod, if there were no walls."""
        x, n, bends = self._x, self._x.shape[1] - 2, self._bent
        force = numpy.zeros((3, n + 2))  # how far second differences should be from 0, at vertices 0 .. n+1; there is none at the tip
        if bends > 0:
            last, back = tuple(self._tangents[:, bends].tolist()), self._tangents[:, 1 : bends + 1]
            sides = _carried(_turned(self._bend_side, last, self.turn), last, back)
            for k in range(3):
                force[k, 1 : bends + 1] = self._towards_side * sides[k] - self._back * back[k]
        behind = self._entry + (self.inside - n * self.spacing) * self._guide  # where the guide holds the next vertex, and another one
        force[:, n] += behind + self.spacing * self._guide
        if n > 1:
            force[:, n - 1] -= behind
        wanted = x[:, :n] + self._stiffness * (force[:, 1:-1] - 2 * force[:, :-2])
        wanted[:, 1:] += self._stiffness * force[:, : n - 1]
        result, products = numpy.empty((3, n)), self._products[:n, :n]
        for k in range(3):
            numpy.multiply(self._smoothers[n], wanted[k], out=products)
            products.sum(axis=1, out=result[k])
        return result

    def heading(self) -> tuple[_Array, _Array]:
        """The direction of the tip, and the side to which it is curved."""
        last, end = tuple(self._tangents[:, self._bent].tolist()), tuple(self._tangents[:, 0].tolist())
        side = _carried(_turned(self._bend_side, last, self.turn), last, end)
        return numpy.array(end), numpy.array([c / math.sqrt(_dot(side, side)) for c in side])

    def shape(self, count: int) -> _Array:
        """Points at equal distances along the wire inside, from the tip to the entry: (count, 3)."""
        x, along, n = self._x, self._along, self._x.shape[1] - 2
        if n == 0:
            return numpy.tile(self._entry, (count, 1))
        at = self.length * numpy.arange(count - 1, -1, -1) / (count - 1)
        before = numpy.minimum(numpy.maximum(n - numpy.searchsorted(along[n::-1], at, side="right"), 0), n - 1)
        share = (at - along[before + 1]) / numpy.maximum(along[before] - along[before + 1], 1e-300)
        return numpy.ascontiguousarray(((1 - share) * x[:, before + 1] + share * x[:, before]).T)
