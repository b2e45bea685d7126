#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the experiment at its quick length and compares its tables with expected/, byte by byte.

usage: test_degenerate_worlds.py BUILD_DIR
       test_degenerate_worlds.py BUILD_DIR --update      writes expected/ anew
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import EXACT, read_rows  # noqa: E402


class DegenerateWorlds(quick_case.QuickCase):
    experiment = HERE
    expected = ["degenerate.csv", "touches.csv"]
    options = []

    def test_exact_kernels_are_never_wrong(self):
        rows = [r for r in read_rows(self.out / "degenerate.csv") if r["kernel"] in EXACT]
        self.assertEqual(0, sum(int(r["wrong"]) for r in rows))
        self.assertGreater(sum(int(r["motions"]) for r in rows), 40_000)
        for family in {r["motion"] for r in rows}:
            blocked = sum(int(r["blocked"]) for r in rows if r["motion"] == family)
            self.assertGreater(blocked, 200, family)

    def test_doubles_are_right_on_integers_only(self):
        rows = [r for r in read_rows(self.out / "degenerate.csv") if r["kernel"] == "double" and r["dimension"] == "3"]
        self.assertEqual(0, sum(int(r["wrong"]) for r in rows if r["placement"] == "integer"))
        self.assertGreater(sum(int(r["wrong"]) for r in rows if r["placement"] == "turned"), 100)

    def test_touches_stop_more_than_crossings(self):
        rows = read_rows(self.out / "touches.csv")
        self.assertEqual(0, sum(int(r["wrong_with_stop"]) for r in rows))
        for r in rows:
            self.assertGreaterEqual(int(r["contacts_with_stop"]), int(r["blocked"]), r)
        more = sum(int(r["contacts_with_stop"]) - int(r["blocked"]) - int(r["either"]) for r in rows)
        self.assertGreater(more, 1000)


if __name__ == "__main__":
    quick_case.main(DegenerateWorlds)
