#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Times of the steps of a catheter of 100 vertices, in processor time of one thread, by how much of it is inside.

usage: times.py --out DIR     writes times.csv: medians of 7 rounds
"""

import argparse
import csv
import pathlib
import statistics
import time

import cellwalk
from cellwalk.catheter import CatheterEnv, Lumen
from judged_steps import actions

ROUNDS = 7


def measure(env, seed):
    """By quarters of the wire inside: steps, seconds and contacts. All of the environment's work counts: observations, rewards, resets."""
    sums, over = {}, True
    for number, action in enumerate(actions(seed)):
        began = time.process_time()
        if over:
            env.reset(seed=seed if number == 0 else None)
        observation, _, reached, truncated, info = env.step(action)
        seconds, over = time.process_time() - began, reached or truncated
        for key in (min(3, 4 * env.wire.count // env.wire.vertices), "all"):
            steps, before, contacts = sums.get(key, (0, 0.0, 0))
            sums[key] = steps + 1, before + seconds, contacts + len(info["contacts"])
    return sums


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=pathlib.Path, required=True)
    given = parser.parse_args()
    env = CatheterEnv(Lumen(cellwalk.Environment.generate("vessel"), start=(0, 0, 0.2)), radius=0.15, most_steps=500)
    measure(env, 0)  # so that caches are warm
    rounds = [[measure(env, seed) for seed in range(4)] for _ in range(ROUNDS)]
    with open(given.out / "times.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["inside", "steps", "contacts", "us_a_step"])
        for key in (0, 1, 2, 3, "all"):
            parts = [[sums[key] for sums in runs if key in sums] for runs in rounds]
            steps, contacts = sum(part[0] for part in parts[0]), sum(part[2] for part in parts[0])
            microseconds = statistics.median(1e6 * sum(part[1] for part in own) / steps for own in parts)
            table.writerow([key if key == "all" else f"{25 * key} to {25 * key + 25} %", steps, contacts, f"{microseconds:.1f}"])


if __name__ == "__main__":
    main()
