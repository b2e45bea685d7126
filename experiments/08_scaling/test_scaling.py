#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 08 in its quick form, without times, and compares its counts with those in expected/.

usage: test_scaling.py BUILD_DIR [--update]     --update writes expected/ anew
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402


class Scaling(quick_case.QuickCase):
    experiment = HERE
    expected = ["handovers.csv", "parts.csv"]
    threads = [1, 2]

    def test_more_ranks_hand_over_more(self):
        rows = read_rows(self.out / "handovers.csv")
        self.assertEqual({r["scene"] for r in rows}, {"hexahedra", "catheter", "particles"})
        for first, second in zip(rows, rows[1:]):
            if first["scene"] == second["scene"]:
                self.assertEqual(2 * int(first["ranks"]), int(second["ranks"]))
                for column in ("moved", "crossings"):
                    self.assertLessEqual(int(first[column]), int(second[column]), second)
                self.assertGreaterEqual(int(first["most_vertices"]), int(second["most_vertices"]), second)

    def test_tables_are_written(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        self.assertEqual(3, text.count("\n## "))
        self.assertNotIn("Model", text, "it needs times")


if __name__ == "__main__":
    quick_case.main(Scaling)
