# SPDX-License-Identifier: LGPL-3.0-or-later
"""Catheters in small vessels, and runs of them."""

import functools

import numpy

import cellwalk
from cellwalk.catheter import CatheterEnv, Lumen


@functools.lru_cache(maxsize=None)
def lumen(forks=1):
    return Lumen(cellwalk.Environment.generate("vessel", generations=forks), start=(0, 0, 0.2))


def wire_env(forks=1, **words):
    return CatheterEnv(lumen(forks), **{"radius": 0.15, "vertices": 40, **words})


def actions(seed, count):
    """Long pushes, now and then a pull, and turns to all sides; some beyond the space."""
    rng = numpy.random.default_rng(seed)
    pushes = numpy.repeat(rng.choice([1.0, 1.0, 1.0, 0.3, -1.0], count // 20 + 1), 20)[:count]
    return numpy.stack([pushes, numpy.repeat(rng.uniform(-1.5, 1.5, count // 10 + 1), 10)[:count]], axis=1)


def run(env, seed, count):
    """The bytes of all that a run gives."""
    observation, info = env.reset(seed=seed)
    parts, over = [], False
    for action in actions(seed, count):
        if over:
            observation, info = env.reset()
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        parts += [observation[name].tobytes() for name in sorted(observation)]
        parts += [repr((reward, terminated, truncated, info["remaining"])).encode(), repr((info["contacts"], info["normals"])).encode(), env.contacts.tobytes(), env.body.positions.tobytes()]
    return b"".join(parts)
