#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the scenes of this experiment and records their motions, by the means of experiment 06.

usage: make_scenes.py BUILD_DIR OUT [--quick]

OUT receives scenes (.json), recorded motions (.trace) and the list scenes.json. What exists already is kept.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "06_real_scenes"))
import make_scenes as real  # noqa: E402


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("out")
    parser.add_argument("--quick", action="store_true")
    options = parser.parse_args()
    maker = real.Maker(argparse.Namespace(**vars(options), only="", finer=[]))
    if options.quick:
        vessel, rods = real.SMALL_VESSEL, [("catheter", real.SMALL_PATH, 0.2, 30, 60), ("fine_catheter", real.SMALL_PATH, 0.05, 100, 120)]
        cells, count, steps = [12, 12, 12], 60, 20
    else:
        vessel, rods = real.VESSEL, [("catheter", real.VESSEL_PATH, 0.2, 110, 240), ("fine_catheter", real.VESSEL_PATH, 0.05, 440, 960)]
        cells, count, steps = [46, 46, 46], 225, 100
    for name, path, spacing, particles, length in rods:
        maker.add(name, {"environment": vessel, "catheter": real.catheter(path, spacing, particles), "steps": length})
    maker.add("hexahedra", {"environment": {"generate": "hexes", "cells": cells, "solid": 0.1},
                            "bodies": [{"shape": "hexahedron", "side": 0.3, "count": count, "seed": 7, "speed": 2}],
                            "time_step": 0.01, "steps": steps})


if __name__ == "__main__":
    main()
