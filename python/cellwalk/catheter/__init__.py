# SPDX-License-Identifier: LGPL-3.0-or-later
"""Catheters to learn with: a guidewire in any lumen, as an environment with the interface of Gymnasium.

>>> import cellwalk, cellwalk.catheter
>>> vessel = cellwalk.Environment.generate("vessel", generations=1)
>>> lumen = cellwalk.catheter.Lumen(vessel, start=(0, 0, 0.2))
>>> env = cellwalk.catheter.CatheterEnv(lumen, radius=0.1)
>>> observation, info = env.reset(seed=1)
>>> observation, reward, terminated, truncated, info = env.step([1, 0])
>>> round(reward, 2)
0.07

Gymnasium is not needed. Where it is installed, CatheterEnv is a gymnasium.Env, and its spaces are those of Gymnasium.
"""

from ._environment import CatheterEnv, progress
from ._lumen import Lumen

__all__ = ["CatheterEnv", "Lumen", "progress"]
