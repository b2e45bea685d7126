# SPDX-License-Identifier: LGPL-3.0-or-later
"""Where wires enter a lumen, where they are to go, and the centre lines between.

All distances are along the means of neighbouring cells. Centre lines are for guidance: only the wire is tested against walls.
"""

import heapq
import math
from typing import Any, Optional, Sequence, Union

import numpy
from numpy.typing import ArrayLike, NDArray

from .. import Environment, OutsideError, Place, UsageError

_Array = NDArray[numpy.float64]
_Place = Union[str, ArrayLike]


def lengths(vectors: _Array) -> Any:
    x, y, z = vectors.T
    return numpy.sqrt(x * x + y * y + z * z)


def evenly(points: _Array, distance: float) -> _Array:
    """Points along a line at the same distance, or a little less, from the first to the last."""
    along = numpy.concatenate([[0.0], numpy.cumsum(lengths(points[1:] - points[:-1]))])
    at = numpy.linspace(0, along[-1], max(2, int(numpy.ceil(along[-1] / distance)) + 1))
    k = numpy.clip(numpy.searchsorted(along, at) - 1, 0, len(points) - 2)
    share = ((at - along[k]) / numpy.maximum(along[k + 1] - along[k], 1e-300))[:, None]
    line: _Array = (1 - share) * points[k] + share * points[k + 1]
    return line


class Lumen:
    """An environment in which wires go from a start to targets: what all catheters in it can share.

    start: a point, or the name of a group of cells or facets.
    targets: points or names; by default all other groups of facets or, where there is none, the ends of all branches.

    names, lines: of targets, and the centre line (N, 3) from the start to each; left: the way from its points to the end; reaches: the
    distances of the targets from all walls.
    """

    def __init__(self, environment: Environment, start: _Place, targets: Optional[Sequence[_Place]] = None) -> None:
        if environment.dimension != 3:
            raise UsageError("Lumen(): the environment has 2 dimensions: wires need 3")
        self.environment = environment
        self._read(environment)
        cell, self.entry = self._place("start", start)
        cost = self._distances([cell], self._costs)
        own = start if isinstance(start, str) else None
        surfaces: list[Any] = [name for name in environment.groups if name != own and len(environment.select(group=name).cells) == 0]
        given = surfaces if targets is None else [*targets]
        if targets is not None and (isinstance(targets, str) or not given):
            raise UsageError(f"Lumen(): targets are {targets!r}: a list of points or names is needed")
        self.names = [place if isinstance(place, str) else f"target {i + 1}" for i, place in enumerate(given)]
        places = [self._place(name, place) for name, place in zip(self.names, given)]
        if not given:
            places = [self._widest_near([end]) for end in self._ends(cell, cost)]
            self.names = [f"end {i + 1}" for i in range(len(places))]
        for name, (goal, point) in zip(self.names, places):
            if (point == self.entry).all():
                raise UsageError(f"Lumen(): {name} is at the start")
            if not math.isfinite(cost[goal]):
                raise OutsideError(f"Lumen(): {name} is not connected with the start")
        paths = [self._path(goal, cost) for goal, _ in places]
        step = float(numpy.median(self._width[numpy.concatenate(paths)])) / 2
        self.lines = [self._line(path, point, step) for path, (_, point) in zip(paths, places)]
        self.left = [numpy.concatenate([numpy.cumsum(lengths(line[1:] - line[:-1])[::-1])[::-1], [0.0]]) for line in self.lines]
        goals, at = [goal for goal, _ in places], numpy.array([point for _, point in places])
        wide = self._width[goals] + lengths(at - self._means[goals])
        self.reaches = numpy.fmin(environment.walk(at, at, radius=wide, threads=1).distance, wide).tolist()
        ahead = self.lines[0][min(2, len(self.lines[0]) - 1)] - self.entry
        self.direction: _Array = ahead / lengths(ahead[None])
        del self._first, self._links, self._link_lengths, self._costs, self._means, self._width

    def _read(self, environment: Environment) -> None:
        """The graph of the cells: for each cell the neighbours behind passable facets, and the distance of walls."""
        facets, self._means = environment.facets(), numpy.ascontiguousarray(environment.cells()["mean"])
        count = len(self._means)
        open_, walls = facets[~facets["wall"]], facets[facets["wall"]]
        cells, links = numpy.concatenate([open_["cell"], open_["neighbour"]]), numpy.concatenate([open_["neighbour"], open_["cell"]])
        order = numpy.argsort(cells, kind="stable")
        cells, links = cells[order], links[order]
        self._first = numpy.searchsorted(cells, numpy.arange(count + 1)).tolist()
        self._links, link_lengths = links.tolist(), lengths(self._means[cells] - self._means[links])
        self._link_lengths = link_lengths.tolist()
        known = numpy.full(count, numpy.inf)
        for side in ("cell", "neighbour"):
            beside = walls[walls[side] >= 0]
            numpy.minimum.at(known, beside[side], lengths(self._means[beside[side]] - beside["mean"]))
        beside_walls = numpy.flatnonzero(numpy.isfinite(known)).tolist()
        self._width = numpy.array(self._distances(beside_walls, self._link_lengths, known=known.tolist()))
        self._width[numpy.isinf(self._width)] = 0
        self._costs = (link_lengths * (1 / self._width[links] + 1 / self._width[cells]) / 2).tolist()

    def _distances(self, sources: list[int], link_lengths: list[float], limit: float = math.inf,
                   known: Optional[list[float]] = None) -> list[float]:
        """The least distances of cells from the sources (Dijkstra), or, where they are less, `known` ones, the sources' among them."""
        distance = [math.inf] * len(self._means) if known is None else known
        for cell in sources:
            distance[cell] = distance[cell] if known is not None else 0.0
        queue = [(distance[cell], cell) for cell in sources]
        heapq.heapify(queue)
        while queue:
            so_far, cell = heapq.heappop(queue)
            for k in range(self._first[cell], self._first[cell + 1] if so_far <= distance[cell] else 0):
                longer = so_far + link_lengths[k]
                if longer < distance[self._links[k]] and longer <= limit:
                    distance[self._links[k]] = longer
                    heapq.heappush(queue, (longer, self._links[k]))
        return distance

    def _widest_near(self, cells: list[int]) -> tuple[int, _Array]:
        """The middle of the lumen at some cells: the widest cell that is not farther from them than two of its own distances from walls."""
        near = numpy.array(self._distances(cells, self._link_lengths, 2 * float(self._width.max()))) <= 2 * self._width
        cell = int(numpy.argmax(numpy.where(near, self._width, -1)))
        return cell, self._means[cell]

    def _place(self, name: str, given: _Place) -> tuple[int, _Array]:
        if isinstance(given, str):
            group = self.environment.select(group=given)
            cells = numpy.concatenate([group.cells["cell"], group.facets["cell"], group.facets["neighbour"]])
            return self._widest_near(numpy.unique(cells[cells >= 0]).tolist())
        point = numpy.array(given, dtype=float)
        if point.shape != (3,):
            raise UsageError(f"Lumen(): {name} has shape {point.shape}: a point of shape (3,), or the name of a group, is needed")
        found = self.environment.locate(point[None], threads=1)
        if found.status[0] != Place.FREE:
            raise OutsideError(f"Lumen(): {name} at {tuple(point.tolist())} is not in free space")
        return int(found.cell[0]), point

    def _path(self, cell: int, cost: list[float]) -> list[int]:
        """Cells from one back to the start."""
        path = [cell]
        while cost[cell] > 0:
            _, cell = min((cost[self._links[k]] + self._costs[k], self._links[k]) for k in range(self._first[cell], self._first[cell + 1]))
            path.append(cell)
        return path

    def _ends(self, start: int, cost: list[float]) -> list[int]:
        """The farthest cells of all branches that are longer than twice the width of the lumen."""
        ends: list[int] = []
        distance = self._distances([start], self._link_lengths)
        within = numpy.isfinite(distance)
        least = 2 * float(self._width[within].max())
        while (end := int(numpy.argmax(numpy.where(within, distance, -1)))) not in ends and (not ends or distance[end] >= least):
            ends.append(end)
            path = self._path(end, cost)
            for at in path:
                distance[at] = 0.0
            self._distances(path, self._link_lengths, known=distance)
        return ends

    def _line(self, path: list[int], goal: _Array, step: float) -> _Array:
        line = evenly(numpy.concatenate([self.entry[None], self._means[path[::-1][1:-1]], goal[None]]), step)
        for _ in range(8):
            line[1:-1] = (line[:-2] + 2 * line[1:-1] + line[2:]) / 4
        return evenly(line, step)
