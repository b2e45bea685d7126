# SPDX-License-Identifier: LGPL-3.0-or-later
"""A catheter in a vessel, as an environment with the interface of Gymnasium, steered by a rule of a few lines."""

## [make]
import cellwalk
import numpy
from cellwalk.catheter import CatheterEnv, Lumen

vessel = cellwalk.Environment.generate("vessel", generations=2)  # or .import_mesh("aorta.stl")
lumen = Lumen(vessel, start=(0, 0, 0.2))  # targets: the ends of branches that it finds, or groups, or points
env = CatheterEnv(lumen, radius=0.15)
print(lumen.names, env.action_space.shape, list(env.observation_space.spaces))
## [make]


## [steer]
def steer(observation):
    """Push, and turn the base so that the curve of the tip is on the side of the centre line."""
    direction, curve = observation["direction"], observation["curve"]
    way = observation["path"][1] - observation["tip"]  # to a point of the centre line ahead
    shaft, side = direction - curve, direction + curve  # as they are behind the tip, which is bent by about 45 degrees
    turn = numpy.arctan2(way @ numpy.cross(direction, curve) * 2**0.5, way @ side)
    return (1.0 if way @ shaft > 0 else -1.0), turn


observation, info = env.reset(seed=1)
total, steps, over = 0.0, 0, False
while not over:
    observation, reward, terminated, truncated, info = env.step(steer(observation))
    total, steps, over = total + reward, steps + 1, terminated or truncated
print(f"{info['target']}: reached {terminated} after {steps} steps, {observation['inserted'][0]:.1f} inside, reward {total:.1f}")
env.body.validate()  # exact: no wall is nearer to the wire than its radius
## [steer]


## [reward]
def careful(observation, info):
    """A reward of your own: gain, less a price for each part of the wire that meets a wall."""
    return info["gained"] - 0.01 * observation["contacts"].sum()


env = CatheterEnv(lumen, radius=0.15, reward=careful)
env.reset(seed=1, options={"target": "end 3", "turn": 30})
print("reward of a step:", round(env.step([1.0, 0.0])[1], 3))
## [reward]
