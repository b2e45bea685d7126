#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Drives a catheter of 100 vertices at random, and judges each step: is it nearer to a wall than its radius, or has it passed through one?

usage: judged_steps.py --steps N --out DIR

Writes judged.csv, a row for each part of 1000 steps, with a seed of its own, and memory.csv. Parts that are there already are not run again.
"""

import argparse
import csv
import pathlib
import resource
import sys
import zlib

import cellwalk
import numpy
from cellwalk.catheter import CatheterEnv, Lumen

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "python" / "tests"))
from wire_judge import Judge  # noqa: E402

RADIUS, PART = 0.15, 1000
COLUMNS = ["part", "steps", "episodes", "contacts", "pairs", "exact", "too_near", "through", "digest"]


def actions(seed):
    """Pushes and, now and then, pulls, 20 steps each, and turns to all sides, 10 steps each."""
    rng = numpy.random.default_rng(seed)
    pushes = numpy.repeat(rng.choice([1.0, 1.0, 1.0, 1.0, 0.3, -1.0], PART // 20), 20)
    return numpy.stack([pushes, numpy.repeat(rng.uniform(-1.5, 1.5, PART // 10), 10)], axis=1)


def run_part(env, judge, part):
    """A row of the table. The first episode has the number of the part as its seed."""
    pairs, exact, episodes, contacts, digest = judge.pairs, judge.exact, 0, 0, 0
    violations, over = numpy.zeros(2, dtype=int), True
    for number, action in enumerate(actions(part)):
        if over:
            env.reset(seed=part if number == 0 else None)
            before, episodes = env.body.positions.copy(), episodes + 1
            violations += [len(rows) for rows in judge.violations(None, before)]
        _, _, reached, truncated, info = env.step(action)
        after = env.body.positions.copy()
        violations += [len(rows) for rows in judge.violations(before, after)]
        before, over, contacts, digest = after, reached or truncated, contacts + len(info["contacts"]), zlib.crc32(after.tobytes(), digest)
    env.body.validate()
    return [part, PART, episodes, contacts, judge.pairs - pairs, judge.exact - exact, *violations.tolist(), digest]


def append(path, header, row):
    is_new = not path.exists()
    with path.open("a", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([header] * is_new + [row])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--steps", type=int, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    judged = given.out / "judged.csv"
    first = len(judged.read_text(encoding="utf-8").splitlines()) - 1 if judged.exists() else 0
    vessel = cellwalk.Environment.generate("vessel")
    env = CatheterEnv(Lumen(vessel, start=(0, 0, 0.2)), radius=RADIUS, most_steps=500)
    judge = Judge(vessel, RADIUS, env.wire.spacing)
    for part in range(first, given.steps // PART):
        append(judged, COLUMNS, run_part(env, judge, part))
        append(given.out / "memory.csv", ["part", "kilobytes"], [part, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss])


if __name__ == "__main__":
    main()
