# SPDX-License-Identifier: LGPL-3.0-or-later
"""What environments need of Gymnasium: the classes of the package where it is installed, else small ones that do the same."""

import importlib
from typing import Any, Mapping, Optional

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


class _Dict:
    """A space for each name."""

    def __init__(self, spaces: Mapping[str, Any]) -> None:
        self.spaces = dict(spaces)

    def seed(self, seed: Optional[int] = None) -> None:
        for space, own in zip(self.spaces.values(), numpy.random.SeedSequence(seed).spawn(len(self.spaces))):
            space.seed(int(own.generate_state(1)[0]))

    def sample(self) -> dict[str, Any]:
        return {name: space.sample() for name, space in self.spaces.items()}

    def contains(self, x: Any) -> bool:
        return isinstance(x, dict) and x.keys() == self.spaces.keys() and all(x[name] in space for name, space in self.spaces.items())

    __contains__ = contains

    def __getitem__(self, name: str) -> Any:
        return self.spaces[name]


class _Env:
    """Random numbers, and what wrappers expect."""

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


Env: Any = _Env
Box: Any = _Box
Dict: Any = _Dict
try:
    _gymnasium = importlib.import_module("gymnasium")
    Env, Box, Dict = _gymnasium.Env, _gymnasium.spaces.Box, _gymnasium.spaces.Dict
except ImportError:
    pass
