# SPDX-License-Identifier: LGPL-3.0-or-later
"""The environment with the interface of Gymnasium."""

from typing import Any, Callable, Optional

import numpy
from numpy.typing import ArrayLike, NDArray

from .. import Body, InputError, UsageError
from ._gymnasium import Box, Dict, Env
from ._lumen import Lumen
from ._wire import Wire, turned

_PI = 3.141592653589793

Reward = Callable[[dict[str, Any], dict[str, Any]], float]


def progress(observation: dict[str, Any], info: dict[str, Any]) -> float:
    """The way that the tip has gained along the centre line in this step, and 1 for its arrival."""
    return float(info["gained"]) + float(info["is_success"])


class CatheterEnv(Env):  # type: ignore[misc]
    """A guidewire, pushed and turned at its base, whose tip is to reach a target.

    An action has two numbers from -1 to 1: how far the base is pushed (pulled), as a share of `most_push`, and how far it is turned, of
    `most_turn` degrees. Numbers beyond are taken as the nearest of these. The wire never comes nearer to a wall than its radius.

    lumen: a Lumen; several environments may share one.
    vertices, spacing: of the wire; a spacing of None gives a wire that is a tenth longer than the longest centre line.
    stiffness: by how much bends count more than motions: in one step, a bend evens out over the fourth root of this number of vertices.
    tip_length, tip_degrees: the natural curve of the tip; None: seven spacings.
    most_push: None: half a spacing. most_steps: after these an episode is truncated.
    reward: a function of an observation and its info.

    reset(options={"target": name or number, "turn": degrees}) chooses what is drawn otherwise.
    """

    metadata = {"render_modes": ["ansi"], "render_fps": 20}

    def __init__(self, lumen: Lumen, *, radius: float, vertices: int = 100, spacing: Optional[float] = None, stiffness: float = 100.0,
                 tip_length: Optional[float] = None, tip_degrees: float = 50.0, most_push: Optional[float] = None, most_turn: float = 10.0,
                 most_steps: int = 1000, reward: Reward = progress, shape_points: int = 16, path_points: int = 4,
                 render_mode: Optional[str] = None) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise UsageError(f"CatheterEnv(): render_mode is {render_mode!r}: only 'ansi' is known")
        for name, number, least in (("vertices", vertices, 4), ("most_steps", most_steps, 1), ("shape_points", shape_points, 2),
                                    ("path_points", path_points, 1)):
            if not isinstance(number, int) or number < least:
                raise UsageError(f"CatheterEnv(): {name} is {number}: an integer of at least {least} is needed")
        self.lumen = lumen
        self._left = [numpy.concatenate([_lengths_to_end(line), [0.0]]) for line in lumen.lines]
        spacing = 1.1 * max(float(left[0]) for left in self._left) / (vertices - 1) if spacing is None else spacing
        tip_length = 7 * spacing if tip_length is None else tip_length
        self.most_push, self.most_turn, self.most_steps = spacing / 2 if most_push is None else most_push, most_turn, most_steps
        for name, size, most in (("spacing", spacing, numpy.inf), ("stiffness", stiffness, numpy.inf), ("tip_length", tip_length, numpy.inf),
                                 ("tip_degrees", tip_degrees, 180), ("most_push", self.most_push, spacing), ("most_turn", most_turn, 180)):
            if not 0 <= size <= most or not numpy.isfinite(size) or size == 0 == spacing:
                raise UsageError(f"CatheterEnv(): {name} is {size}: a finite number from 0 to {most} is needed")
        self.wire = Wire(lumen.environment, lumen.entry, lumen.direction, vertices=vertices, spacing=spacing, radius=radius,
                         stiffness=stiffness, tip_length=tip_length, tip_angle=tip_degrees * _PI / 180)
        self._reward, self.render_mode, self._path_steps = reward, render_mode, 2 * numpy.arange(1, path_points + 1)
        self._points = shape_points
        self._is_over, self._steps = True, 0
        points = lumen.environment.points
        low, high = points.min(axis=0), points.max(axis=0)
        self.action_space = Box(-1.0, 1.0, (2,), numpy.float32)

        def places(*shape: int) -> Any:
            return Box(numpy.broadcast_to(low, (*shape, 3)), numpy.broadcast_to(high, (*shape, 3)), dtype=numpy.float64)

        self.observation_space = Dict({
            "tip": places(), "direction": Box(-1.0, 1.0, (3,), numpy.float64), "curve": Box(-1.0, 1.0, (3,), numpy.float64),
            "shape": places(shape_points), "contacts": Box(0.0, float(vertices), (shape_points,), numpy.float64),
            "inserted": Box(0.0, vertices * spacing, (1,), numpy.float64), "path": places(path_points), "target": places(),
        })

    @property
    def body(self) -> Body:
        """The wire as a body, its tip first: for pictures, and for judges."""
        return self.wire.body

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None) -> tuple[dict[str, Any], dict[str, Any]]:
        super().reset(seed=seed)
        options = dict(options or {})
        number, turn = int(self.np_random.integers(len(self.lumen.names))), float(self.np_random.uniform(-180.0, 180.0))
        target, turn = options.pop("target", number), float(options.pop("turn", turn))
        if options:
            raise UsageError(f"reset(): options has {', '.join(options)}: only target and turn are known")
        if isinstance(target, str):
            if target not in self.lumen.names:
                raise UsageError(f"reset(): no target is called {target}: there are {', '.join(self.lumen.names)}")
            target = self.lumen.names.index(target)
        if not 0 <= target < len(self.lumen.names) or not -180 <= turn <= 180:
            raise UsageError(f"reset(): target {target}, turn {turn}: there are {len(self.lumen.names)} targets, and turns from -180 to 180 degrees")
        self.target = int(target)
        self.wire.restart(turned(turn * _PI / 180))
        self._at, self._steps, self._is_over = 0, 0, False
        self._remaining = self._follow(self.wire.body.positions[0])
        none = numpy.zeros(0, dtype=[("vertex", "u4")])
        return self._observation(none), self._info(none, 0.0, False)

    def step(self, action: ArrayLike) -> tuple[dict[str, Any], float, bool, bool, dict[str, Any]]:
        if self._is_over:
            raise UsageError("step(): the episode is over, or has not begun: call reset()")
        numbers = numpy.asarray(action)
        if numbers.shape != (2,) or not numpy.isfinite(numbers).all():
            raise InputError(f"step(): the action is {action!r}: two finite numbers are needed, push and turn")
        push, turn = (min(1.0, max(-1.0, float(number))) for number in numbers)
        contacts = self.wire.step(push * self.most_push, turn * self.most_turn * _PI / 180)
        before, tip = self._remaining, self.wire.body.positions[0]
        self._remaining = self._follow(tip)
        self._steps += 1
        goal = self.lumen.lines[self.target][-1]
        way = tip - goal
        arrived = bool(way[0] * way[0] + way[1] * way[1] + way[2] * way[2] < self.lumen.reaches[self.target] ** 2)
        observation, info = self._observation(contacts), self._info(contacts, before - self._remaining, arrived)
        truncated = self._steps >= self.most_steps and not arrived
        self._is_over = arrived or truncated
        return observation, float(self._reward(observation, info)), arrived, truncated, info

    def render(self) -> Optional[str]:
        if self.render_mode != "ansi":
            return None
        tip = ", ".join(f"{x:.3f}" for x in self.wire.body.positions[0])
        return (f"step {self._steps}: {self.wire.inside:.3f} inside, the tip at ({tip}), {self._remaining:.3f} from "
                f"{self.lumen.names[self.target]}")

    def _follow(self, tip: NDArray[numpy.float64]) -> float:
        """How far the tip has to go along the centre line, on which it is near the point where it was before."""
        line = self.lumen.lines[self.target]
        first = max(0, self._at - 3)
        way = line[first : self._at + 4] - tip
        squares = (way * way).sum(axis=1)
        nearest = int(squares.argmin())
        self._at = first + nearest
        return float(self._left[self.target][self._at] + numpy.sqrt(squares[nearest]))

    def _observation(self, contacts: NDArray[numpy.void]) -> dict[str, Any]:
        wire, line = self.wire, self.lumen.lines[self.target]
        direction, curve = wire.heading()
        met = numpy.zeros(wire.vertices)
        met[contacts["vertex"]] = 1
        part = wire.indices * self._points // max(1, wire.count)
        return {
            "tip": wire.body.positions[0].copy(), "direction": direction, "curve": curve, "shape": wire.shape(self._points),
            "contacts": numpy.bincount(numpy.minimum(part, self._points - 1), met, self._points),
            "inserted": numpy.array([wire.inside]), "path": line[numpy.minimum(self._at + self._path_steps, len(line) - 1)],
            "target": line[-1].copy(),
        }

    def _info(self, contacts: NDArray[numpy.void], gained: float, arrived: bool) -> dict[str, Any]:
        return {"target": self.lumen.names[self.target], "remaining": self._remaining, "gained": gained, "is_success": arrived,
                "contacts": contacts, "slipped": self.wire.slipped}


def _lengths_to_end(line: NDArray[numpy.float64]) -> NDArray[numpy.float64]:
    pieces = line[1:] - line[:-1]
    x, y, z = pieces.T
    return numpy.cumsum(numpy.sqrt(x * x + y * y + z * z)[::-1])[::-1]
