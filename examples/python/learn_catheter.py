# SPDX-License-Identifier: LGPL-3.0-or-later
"""A catheter learns to steer into the branches of a vessel: a plain search finds the seven numbers of a policy.

usage: learn_catheter.py [--vessel MESH --start X Y Z --radius R] [--policy LEARNING.csv] [--out DIR] [--processes N] [--rounds N] [--forks N] [--trials N]

The vessel is any mesh that import_mesh() reads, by default a generated one. --start: a point, or the name of a group, such as a cap.
--policy: no search; the best policy of an earlier one is tried on targets of this vessel.

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
def catheter(forks, vertices, mesh=None, start=(0, 0, 0.2), radius=0.15):
    vessel = cellwalk.Environment.import_mesh(mesh) if mesh else cellwalk.Environment.generate("vessel", generations=forks)
    return CatheterEnv(Lumen(vessel, start=start), radius=radius, vertices=vertices, most_steps=4 * vertices)


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


def learn(which, rounds, trials, pool, file):
    """Searches, and writes a row for each round: the middle of the best policies, and how many targets it reached that the search has not seen."""
    table = csv.writer(file, lineterminator="\n")
    table.writerow(["round", "steps", "reached_by_all", "reached", "trials", *(f"number_{k}" for k in range(NUMBERS))])
    for number, (policy, steps, share) in enumerate(search(which, rounds, pool.map), 1):
        reached = sum(reached for _, reached, _ in unseen(which, policy, 10_000, trials, pool))
        table.writerow([number, steps, share, reached, trials, *map(repr, policy)])
        print(f"round {number}: {steps} steps, {share:.0%} of targets reached; the middle of the best reaches {reached} of {trials}", flush=True)


def unseen(which, policy, first, count, pool):
    """Episodes with targets and turns of the base that no search has seen: its seeds are less."""
    return [result for rows in pool.map(trial, [(which, policy, [first + k]) for k in range(count)]) for result in rows]


def best_policy(path):
    """Of a table that learn() wrote: the policy that reached most, the last one of several."""
    with open(path, newline="") as file:
        row = max(csv.DictReader(file), key=lambda row: (int(row["reached"]), int(row["round"])))
    return [float(row[f"number_{k}"]) for k in range(NUMBERS)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--vessel")
    parser.add_argument("--start", nargs="+", default=["0", "0", "0.2"])
    parser.add_argument("--radius", type=float, default=0.15)
    parser.add_argument("--policy", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."))
    for name, default in (("processes", 2), ("rounds", 8), ("forks", 3), ("vertices", 100), ("trials", 96)):
        parser.add_argument(f"--{name}", type=int, default=default)
    given = parser.parse_args()
    start = given.start[0] if len(given.start) == 1 else tuple(map(float, given.start))
    which = (given.forks, given.vertices, given.vessel, start, given.radius)
    env = catheter(*which)
    given.out.mkdir(parents=True, exist_ok=True)
    with multiprocessing.Pool(given.processes) as pool:
        if given.policy is None:
            with open(given.out / "learning.csv", "w", newline="") as file:
                learn(which, given.rounds, given.trials // 4, pool, file)
        results = unseen(which, best_policy(given.policy or given.out / "learning.csv"), 20_000, given.trials, pool)
    targets = [env.reset(seed=20_000 + k)[1]["target"] for k in range(given.trials)]
    with open(given.out / "reached.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["target", "reached", "trials"])
        for name in env.lumen.names:
            own = [reached for target, (_, reached, _) in zip(targets, results) if target == name]
            table.writerow([name, sum(own), len(own)])
    print(f"the best policy: {sum(reached for _, reached, _ in results)} of {given.trials} further targets")


if __name__ == "__main__":
    main()
