# SPDX-License-Identifier: LGPL-3.0-or-later
"""What environments need of Gymnasium: the classes of the package where it is installed, else small ones with what is used here."""

import importlib
from typing import Any, Optional

import numpy


class _Box:
    """Arrays of a shape and a type between bounds."""

    def __init__(self, low: Any, high: Any, shape: Optional[tuple[int, ...]] = None, dtype: Any = numpy.float32) -> None:
        self.dtype, self.shape = numpy.dtype(dtype), numpy.broadcast(low, high).shape if shape is None else shape
        self.low, self.high = (numpy.broadcast_to(bound, self.shape).astype(self.dtype) for bound in (low, high))
        self.seed()

    def seed(self, seed: Optional[int] = None) -> None:
        self._random = numpy.random.default_rng(seed)

    def sample(self) -> Any:
        return self._random.uniform(self.low, self.high).astype(self.dtype)

    def contains(self, x: Any) -> bool:
        return bool(isinstance(x, numpy.ndarray) and numpy.can_cast(x.dtype, self.dtype) and x.shape == self.shape
                    and (x >= self.low).all() and (x <= self.high).all())

    __contains__ = contains


class _Dict(dict[str, Any]):
    """A space for each name."""

    @property
    def spaces(self) -> dict[str, Any]:
        return self

    def seed(self, seed: Optional[int] = None) -> None:
        for space, own in zip(self.values(), numpy.random.SeedSequence(seed).spawn(len(self))):
            space.seed(int(own.generate_state(1)[0]))

    def sample(self) -> dict[str, Any]:
        return {name: space.sample() for name, space in self.items()}

    def contains(self, x: Any) -> bool:
        return isinstance(x, dict) and x.keys() == self.keys() and all(x[name] in space for name, space in self.items())

    __contains__ = contains


class _Env:
    """Random numbers, and what wrappers expect."""

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode, spec = None, None
    _np_random: Optional[numpy.random.Generator] = None

    @property
    def np_random(self) -> numpy.random.Generator:
        if self._np_random is None:
            self._np_random = numpy.random.default_rng()
        return self._np_random

    @property
    def unwrapped(self) -> Any:
        return self

    def reset(self, *, seed: Optional[int] = None, options: Optional[dict[str, Any]] = None) -> Any:
        if seed is not None:
            self._np_random = numpy.random.default_rng(seed)

    def close(self) -> None:
        pass


try:
    _gymnasium: Any = importlib.import_module("gymnasium")
    Env, Box, Dict = _gymnasium.Env, _gymnasium.spaces.Box, _gymnasium.spaces.Dict
except ImportError:
    Env, Box, Dict = _Env, _Box, _Dict
