# SPDX-License-Identifier: LGPL-3.0-or-later
"""The environment with the interface of Gymnasium."""

import math
from numbers import Integral, Real
from typing import Any, Callable, Optional

import numpy
from numpy.typing import ArrayLike, NDArray

from .. import Body, InputError, OutsideError, UsageError
from ._gymnasium import Box, Dict, Env
from ._lumen import Lumen
from ._wire import Wire, turned


def progress(observation: dict[str, Any], info: dict[str, Any]) -> float:
    """The way that the tip has gained along the centre line in this step, and 1 for its arrival."""
    return float(info["gained"]) + float(info["is_success"])


def _expect(sort: Any, **words: tuple[Any, float, float]) -> None:
    for name, (number, least, most) in words.items():
        if not (isinstance(number, sort) and least <= number <= most and number < math.inf):
            kind = "an integer" if sort is Integral else "a finite number"
            raise UsageError(f"CatheterEnv(): {name} is {number!r}: {kind} from {least} to {most} is needed")


class CatheterEnv(Env):  # type: ignore[misc]
    """A guidewire, pushed and turned at its base, whose tip is to reach a target. It never comes nearer to a wall than its radius.

    An action is two numbers from -1 to 1, or the nearest of these: the push, a share of `most_push`, and the turn, of `most_turn` degrees.

    lumen: a Lumen, which several environments may share.
    vertices, spacing: of the wire. By default it is a tenth longer than the longest centre line.
    stiffness: how much bends count beside motions: in one step a bend evens out over about the fourth root of this number of vertices.
    tip_length, tip_degrees: the natural curve of the tip; by default of seven spacings. most_push: by default half a spacing.
    most_steps: after these an episode is truncated. reward: a function of an observation and its info.

    reset(options={"target": name or number, "turn": degrees}) chooses what is drawn otherwise.
    """

    def __init__(self, lumen: Lumen, *, radius: float, vertices: int = 100, spacing: Optional[float] = None, stiffness: float = 100.0,
                 tip_length: Optional[float] = None, tip_degrees: float = 50.0, most_push: Optional[float] = None, most_turn: float = 10.0,
                 most_steps: int = 1000, reward: Callable[[dict[str, Any], dict[str, Any]], float] = progress, shape_points: int = 16,
                 path_points: int = 4) -> None:
        if not isinstance(lumen, Lumen) or not callable(reward):
            raise UsageError(f"CatheterEnv(): a Lumen and a function as reward are needed, not {lumen!r} and {reward!r}")
        _expect(Integral, vertices=(vertices, 4, 1000), most_steps=(most_steps, 1, math.inf), shape_points=(shape_points, 2, math.inf),
                path_points=(path_points, 1, math.inf))
        spacing = 1.1 * max(float(left[0]) for left in lumen.left) / (vertices - 1) if spacing is None else spacing
        _expect(Real, spacing=(spacing, 1e-150, 1e150))
        tip_length, most_push = 7 * spacing if tip_length is None else tip_length, spacing / 2 if most_push is None else most_push
        _expect(Real, stiffness=(stiffness, 0, 1e9), tip_length=(tip_length, 0, math.inf), tip_degrees=(tip_degrees, 0, 180),
                most_push=(most_push, 0, spacing), most_turn=(most_turn, 0, 180))
        self.lumen, self.most_push, self.most_turn, self.most_steps = lumen, most_push, most_turn, most_steps
        self.wire = Wire(lumen.environment, lumen.entry, lumen.direction, vertices=vertices, spacing=spacing, radius=radius,
                         stiffness=stiffness, tip_length=tip_length, tip_angle=math.radians(tip_degrees))
        for name, reach in zip(lumen.names, lumen.reaches):
            if reach <= radius / 2:  # as the tip stays at a radius from the wall that is so near
                raise OutsideError(f"CatheterEnv(): {name} is {reach} from a wall: a wire of radius {radius} does not reach it; choose other targets")
        self.body: Body = self.wire.body  # its tip first
        self._reward, self._ahead, self._parts = reward, 2 * numpy.arange(1, path_points + 1), shape_points
        self._is_over = True
        low, high = lumen.environment.points.min(axis=0), lumen.environment.points.max(axis=0)
        shape, path = ((numpy.tile(low, (count, 1)), numpy.tile(high, (count, 1))) for count in (shape_points, path_points))
        self.action_space = Box(-1.0, 1.0, (2,), numpy.float32)
        self.observation_space = Dict({
            "tip": Box(low, high, dtype=numpy.float64), "direction": Box(-1.0, 1.0, (3,), numpy.float64), "curve": Box(-1.0, 1.0, (3,), numpy.float64),
            "shape": Box(*shape, dtype=numpy.float64), "contacts": Box(0.0, float(vertices), (shape_points,), numpy.float64),
            "inserted": Box(0.0, vertices * spacing, (1,), numpy.float64), "path": Box(*path, dtype=numpy.float64),
            "target": Box(low, high, dtype=numpy.float64),
        })

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None) -> tuple[dict[str, Any], dict[str, Any]]:
        self._is_over, names, given = True, self.lumen.names, {**(options or {})}
        target, turn = given.get("target", 0), given.get("turn", 0)
        target = names.index(target) if target in names else target
        if given.keys() - {"target", "turn"} or target not in range(len(names)) or not (isinstance(turn, Real) and -180 <= float(turn) <= 180):
            raise UsageError(f"reset(): options are {options}: target, one of {names} or its number, and turn, from -180 to 180, are known")
        super().reset(seed=seed)
        drawn = int(self.np_random.integers(len(names))), float(self.np_random.uniform(-180.0, 180.0))
        self.target, turn = int(target) if "target" in given else drawn[0], float(turn) if "turn" in given else drawn[1]
        self.body = self.wire.restart(turned(math.radians(turn)))
        self._at, self._steps = 0, 0
        self._remaining = self._follow(self.body.positions[0])
        self.contacts = self.body.step(self.body.positions)  # none
        self._is_over = False
        return self._result(0.0, False)

    def step(self, action: ArrayLike) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        if self._is_over:
            raise UsageError("step(): the episode is over, or has not begun: call reset()")
        numbers = numpy.asarray(action, dtype=float)
        if numbers.shape != (2,) or not numpy.isfinite(numbers).all():
            raise InputError(f"step(): the action is {action!r}: two finite numbers, the push and the turn, are needed")
        push, turn = (min(1.0, max(-1.0, number)) for number in numbers.tolist())
        self.contacts = self.wire.step(push * self.most_push, math.radians(turn * self.most_turn))
        tip, before = self.body.positions[0], self._remaining
        self._remaining, self._steps = self._follow(tip), self._steps + 1
        arrived = bool(((tip - self.lumen.lines[self.target][-1]) ** 2).sum() < self.lumen.reaches[self.target] ** 2)
        truncated = self._steps >= self.most_steps and not arrived
        self._is_over = arrived or truncated
        observation, info = self._result(before - self._remaining, arrived)
        return observation, float(self._reward(observation, info)), arrived, truncated, info

    def _follow(self, tip: NDArray[numpy.float64]) -> float:
        """How far the tip has to go by the point of the centre line after the nearest, which is near the one before."""
        line, first = self.lumen.lines[self.target], max(0, self._at - 3)
        self._at = first + int(((line[first : self._at + 4] - tip) ** 2).sum(axis=1).argmin())
        after = min(self._at + 1, len(line) - 1)
        return float(self.lumen.left[self.target][after] + numpy.sqrt(((line[after] - tip) ** 2).sum()))

    def _result(self, gained: float, arrived: bool) -> tuple[dict[str, Any], dict[str, Any]]:
        """The observation and its info."""
        wire, line = self.wire, self.lumen.lines[self.target]
        (direction, curve), met = wire.heading(), numpy.unique(self.contacts["vertex"])
        met = met[met < wire.count]  # others were pulled out
        return {
            "tip": self.body.positions[0].copy(), "direction": direction, "curve": curve, "shape": wire.shape(self._parts),
            "contacts": numpy.bincount(met * self._parts // max(1, wire.count), minlength=self._parts).astype(float),
            "inserted": numpy.array([wire.inside], dtype=float), "path": line[numpy.minimum(self._at + self._ahead, len(line) - 1)],
            "target": line[-1].copy(),
        }, {"target": self.lumen.names[self.target], "remaining": self._remaining, "gained": gained, "is_success": arrived,
                "contacts": self.contacts["point"].tolist(), "normals": self.contacts["normal"].tolist(), "slipped": self.wire.slipped}
