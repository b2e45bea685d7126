#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws the vessel with a catheter at each target that the best policy of learning.csv reaches.

usage: picture.py DIR     reads learning.csv, and writes catheters.png into DIR
"""

import sys
from pathlib import Path

import cellwalk

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "examples" / "python"))
import learn_catheter  # noqa: E402


def main():
    folder = Path(sys.argv[1])
    numbers = learn_catheter.best_policy(folder / "learning.csv")
    env, bodies, seed = learn_catheter.catheter(3, 100), {}, 0
    while len(bodies) < len(env.lumen.names) and seed < 1000:
        target = env.reset(seed=seed)[1]["target"]
        if target not in bodies and learn_catheter.episode(env, numbers, seed)[1]:
            bodies[target] = env.body  # each episode has a body of its own
        seed += 1
    cellwalk.draw(env.lumen.environment, list(bodies.values()), file=folder / "catheters.png")
    print(f"{len(bodies)} catheters at targets")


if __name__ == "__main__":
    main()
