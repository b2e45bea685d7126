# SPDX-License-Identifier: LGPL-3.0-or-later
"""A catheter learns to steer into the branches of a vessel: a plain search finds the seven numbers of a policy.

usage: learn_catheter.py [--out DIR] [--processes N] [--rounds N] [--forks N] [--trials N]

In each round, policies are drawn around the best of the round before, and each is tried on a few targets (the cross-entropy method).
Only + - * / and square roots are used, and results do not depend on the number of processes: the same numbers come out everywhere.
"""

import argparse
import csv
import functools
import math
import multiprocessing
import pathlib

import cellwalk
import numpy
from cellwalk.catheter import CatheterEnv, Lumen

NUMBERS, POLICIES, BEST, EPISODES = 7, 16, 4, 4  # of a policy; of a round; those that are kept; for each policy


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def action(numbers, observation, met):
    """The push and the turn. `met`: how much the tip has met walls of late, from 0 to 1."""
    look, bend, turn, push, along, sideways, stuck = numbers
    tip, direction, curve, path = (observation[name].tolist() for name in ("tip", "direction", "curve", "path"))
    # The shaft behind the curved tip, the side to which the tip is curved, and the third direction.
    shaft, side = [d - bend * c for d, c in zip(direction, curve)], [bend * d + c for d, c in zip(direction, curve)]
    third = [shaft[k - 2] * side[k - 1] - shaft[k - 1] * side[k - 2] for k in range(3)]
    # Where to go: a point of the centre line ahead, as it is seen from there.
    way = [a + look * (b - a) - t for a, b, t in zip(path[0], path[1], tip)]
    size = math.sqrt(dot(way, way) * (1 + bend * bend)) + 1e-9
    forward, beside, across = dot(way, shaft) / size, dot(way, side) / size, dot(way, third) / size / math.sqrt(1 + bend * bend)
    share = across / (abs(across) + abs(beside) + 1e-9)  # from -1 to 1 for a quarter turn to either side, then on to -2 and 2
    angle = share if beside >= 0 else math.copysign(2 - abs(share), share)
    return push + along * forward + sideways * beside + stuck * met, turn * angle


def episode(env, numbers, seed):
    """The share of the way that was gained, whether the target was reached, and the number of steps."""
    observation, info = env.reset(seed=seed)
    whole, met, steps, over = info["remaining"], 0.0, 0, False
    while not over:
        met += 0.1 * (float(observation["contacts"][0] > 0) - met)
        observation, _, reached, truncated, info = env.step(action(numbers, observation, met))
        steps, over = steps + 1, reached or truncated
    return 1 - info["remaining"] / whole + reached, reached, steps


@functools.lru_cache(maxsize=None)  # once for each process
def catheter(forks, vertices):
    vessel = cellwalk.Environment.generate("vessel", generations=forks)
    return CatheterEnv(Lumen(vessel, start=(0, 0, 0.2)), radius=0.15, vertices=vertices, most_steps=4 * vertices)


def trial(task):
    which, numbers, seeds = task
    return [episode(catheter(*which), numbers, seed) for seed in seeds]


def search(which, rounds, run):
    """Yields, for each round, the middle of the best policies, the steps so far, and the share of targets that all policies reached."""
    rng, middle, spread, steps = numpy.random.default_rng(1), numpy.zeros(NUMBERS), numpy.ones(NUMBERS), 0
    for number in range(rounds):
        policies = middle + spread * rng.uniform(-math.sqrt(3), math.sqrt(3), size=(POLICIES, NUMBERS))
        seeds = [number * EPISODES + k for k in range(EPISODES)]
        results = run(trial, [(which, policy.tolist(), seeds) for policy in policies])
        values = [sum(value for value, _, _ in result) / EPISODES for result in results]
        best = sorted(range(POLICIES), key=lambda i: (-values[i], i))[:BEST]
        middle, spread = policies[best].mean(axis=0), 0.05 + policies[best].std(axis=0)
        steps += sum(count for result in results for _, _, count in result)
        yield middle.tolist(), steps, sum(reached for result in results for _, reached, _ in result) / (POLICIES * EPISODES)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    for name, default in (("processes", 2), ("rounds", 8), ("forks", 3), ("vertices", 100), ("trials", 96)):
        parser.add_argument(f"--{name}", type=int, default=default)
    given = parser.parse_args()
    which, names = (given.forks, given.vertices), catheter(given.forks, given.vertices).lumen.names
    given.out.mkdir(parents=True, exist_ok=True)
    with multiprocessing.Pool(given.processes) as pool, open(given.out / "learning.csv", "w", newline="") as file:
        def test(policy, first, count):
            """Targets and turns of the base that the policy has not seen: seeds of the search are less."""
            return [result for rows in pool.map(trial, [(which, policy, [first + k]) for k in range(count)]) for result in rows]

        table, most, chosen = csv.writer(file, lineterminator="\n"), -1, None
        table.writerow(["round", "steps", "reached_by_all", "reached", "trials", *(f"number_{k}" for k in range(NUMBERS))])
        for number, (policy, steps, share) in enumerate(search(which, given.rounds, pool.map), 1):
            reached, count = sum(reached for _, reached, _ in test(policy, 10_000, given.trials // 4)), given.trials // 4
            table.writerow([number, steps, share, reached, count, *map(repr, policy)])
            print(f"round {number}: {steps} steps, {share:.0%} of targets reached; the middle of the best reaches {reached} of {count}", flush=True)
            most, chosen = (reached, policy) if reached >= most else (most, chosen)
        results = test(chosen, 20_000, given.trials)
    env = catheter(*which)
    targets = [env.reset(seed=20_000 + k)[1]["target"] for k in range(given.trials)]
    with open(given.out / "reached.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["target", "reached", "trials"])
        for name in names:
            own = [reached for target, (_, reached, _) in zip(targets, results) if target == name]
            table.writerow([name, sum(own), len(own)])
    print(f"the one that reached most: {sum(reached for _, reached, _ in results)} of {given.trials} further targets")


if __name__ == "__main__":
    main()
