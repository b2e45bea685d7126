# SPDX-License-Identifier: LGPL-3.0-or-later
"""The environment with the interface of Gymnasium."""

import math
from typing import Any, Callable, Optional

import numpy
from numpy.typing import ArrayLike, NDArray

from .. import Body, InputError, UsageError
from ._gymnasium import Box, Dict, Env
from ._lumen import Lumen
from ._wire import Wire, turned

_RADIANS = math.pi / 180


def progress(observation: dict[str, Any], info: dict[str, Any]) -> float:
    """The way that the tip has gained along the centre line in this step, and 1 for its arrival."""
    return float(info["gained"]) + float(info["is_success"])


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

    metadata: dict[str, Any] = {"render_modes": ["ansi"], "render_fps": 20}

    def __init__(self, lumen: Lumen, *, radius: float, vertices: int = 100, spacing: Optional[float] = None, stiffness: float = 100.0,
                 tip_length: Optional[float] = None, tip_degrees: float = 50.0, most_push: Optional[float] = None, most_turn: float = 10.0,
                 most_steps: int = 1000, reward: Callable[[dict[str, Any], dict[str, Any]], float] = progress, shape_points: int = 16,
                 path_points: int = 4, render_mode: Optional[str] = None) -> None:
        if render_mode not in (None, "ansi"):
            raise UsageError(f"CatheterEnv(): render_mode is {render_mode!r}: only 'ansi' is known")
        for name, number, least in (("vertices", vertices, 4), ("most_steps", most_steps, 1), ("shape_points", shape_points, 2),
                                    ("path_points", path_points, 1)):
            if not isinstance(number, int) or number < least:
                raise UsageError(f"CatheterEnv(): {name} is {number}: an integer of at least {least} is needed")
        spacing = 1.1 * max(float(left[0]) for left in lumen.left) / (vertices - 1) if spacing is None else spacing
        tip_length, most_push = 7 * spacing if tip_length is None else tip_length, spacing / 2 if most_push is None else most_push
        for name, size, most in (("spacing", spacing, math.inf), ("stiffness", stiffness, math.inf), ("tip_length", tip_length, math.inf),
                                 ("tip_degrees", tip_degrees, 180.0), ("most_push", most_push, spacing), ("most_turn", most_turn, 180.0)):
            if not (0 <= size <= most and math.isfinite(size)) or spacing == 0:
                raise UsageError(f"CatheterEnv(): {name} is {size}: a finite number from 0 to {most}, and a spacing above 0, are needed")
        self.lumen, self.most_push, self.most_turn, self.most_steps, self.render_mode = lumen, most_push, most_turn, most_steps, render_mode
        self.wire = Wire(lumen.environment, lumen.entry, lumen.direction, vertices=vertices, spacing=spacing, radius=radius,
                         stiffness=stiffness, tip_length=tip_length, tip_angle=tip_degrees * _RADIANS)
        self.body: Body = self.wire.body  # its tip first
        self._reward, self._ahead, self._parts = reward, 2 * numpy.arange(1, path_points + 1), shape_points
        self._steps, self._is_over = 0, True
        corners = lumen.environment.points.min(axis=0), lumen.environment.points.max(axis=0)

        def places(*shape: int) -> Any:
            return Box(*(numpy.broadcast_to(corner, (*shape, 3)) for corner in corners), dtype=numpy.float64)

        self.action_space = Box(-1.0, 1.0, (2,), numpy.float32)
        self.observation_space = Dict({
            "tip": places(), "direction": Box(-1.0, 1.0, (3,), numpy.float64), "curve": Box(-1.0, 1.0, (3,), numpy.float64),
            "shape": places(shape_points), "contacts": Box(0.0, float(vertices), (shape_points,), numpy.float64),
            "inserted": Box(0.0, vertices * spacing, (1,), numpy.float64), "path": places(path_points), "target": places(),
        })

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None) -> tuple[dict[str, Any], dict[str, Any]]:
        super().reset(seed=seed)
        names: list[Any] = self.lumen.names
        drawn = {"target": int(self.np_random.integers(len(names))), "turn": float(self.np_random.uniform(-180.0, 180.0))}
        chosen: dict[str, Any] = {**drawn, **(options or {})}
        target, turn = chosen.pop("target"), chosen.pop("turn")
        target = names.index(target) if target in names else target
        if chosen or target not in range(len(names)) or not -180 <= turn <= 180:
            raise UsageError(f"reset(): options are {options}: target, one of {names} or its number, and turn, from -180 to 180, are known")
        self.target, self._at, self._steps, self._is_over = int(target), 0, 0, False
        self.body = self.wire.restart(turned(turn * _RADIANS))
        self._remaining = self._follow(self.body.positions[0])
        self.contacts = self.body.step(self.body.positions)  # none
        return self._observation(), self._info(0.0, False)

    def step(self, action: ArrayLike) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        if self._is_over:
            raise UsageError("step(): the episode is over, or has not begun: call reset()")
        numbers = numpy.asarray(action, dtype=float)
        if numbers.shape != (2,) or not numpy.isfinite(numbers).all():
            raise InputError(f"step(): the action is {action!r}: two finite numbers, the push and the turn, are needed")
        push, turn = (min(1.0, max(-1.0, number)) for number in numbers.tolist())
        self.contacts = self.wire.step(push * self.most_push, turn * self.most_turn * _RADIANS)
        tip, before = self.body.positions[0], self._remaining
        self._remaining, self._steps = self._follow(tip), self._steps + 1
        arrived = bool(((tip - self.lumen.lines[self.target][-1]) ** 2).sum() < self.lumen.reaches[self.target] ** 2)
        truncated = self._steps >= self.most_steps and not arrived
        self._is_over = arrived or truncated
        observation, info = self._observation(), self._info(before - self._remaining, arrived)
        return observation, float(self._reward(observation, info)), arrived, truncated, info

    def render(self) -> Optional[str]:
        way = f"{self.wire.inside:.3f} inside, {self._remaining:.3f} from {self.lumen.names[self.target]}"
        return None if self.render_mode is None else f"step {self._steps}: {way}"

    def _follow(self, tip: NDArray[numpy.float64]) -> float:
        """How far the tip has to go by the point of the centre line after the nearest, which is near the one before."""
        line, first = self.lumen.lines[self.target], max(0, self._at - 3)
        self._at = first + int(((line[first : self._at + 4] - tip) ** 2).sum(axis=1).argmin())
        after = min(self._at + 1, len(line) - 1)
        return float(self.lumen.left[self.target][after] + numpy.sqrt(((line[after] - tip) ** 2).sum()))

    def _observation(self) -> dict[str, Any]:
        wire, line = self.wire, self.lumen.lines[self.target]
        (direction, curve), met = wire.heading(), numpy.unique(self.contacts["vertex"])
        return {
            "tip": self.body.positions[0].copy(), "direction": direction, "curve": curve, "shape": wire.shape(self._parts),
            "contacts": numpy.bincount(met * self._parts // max(1, wire.count), minlength=self._parts).astype(float),
            "inserted": numpy.array([wire.inside]), "path": line[numpy.minimum(self._at + self._ahead, len(line) - 1)],
            "target": line[-1].copy(),
        }

    def _info(self, gained: float, arrived: bool) -> dict[str, Any]:
        return {"target": self.lumen.names[self.target], "remaining": self._remaining, "gained": gained, "is_success": arrived,
                "contacts": self.contacts["point"], "normals": self.contacts["normal"], "slipped": self.wire.slipped}
