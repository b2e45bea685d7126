#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 12 in its quick form, without times, and compares what is learned and judged with expected/.

usage: test_catheter_runs.py BUILD_DIR [--update]     --update writes expected/ anew
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402


class CatheterRuns(quick_case.QuickCase):
    experiment = HERE
    expected = ["learning.csv", "reached.csv", "judged.csv"]
    threads = [1, 2]

    def test_nothing_is_violated(self):
        rows = read_rows(self.out / "judged.csv")
        self.assertEqual([(r["too_near"], r["through"]) for r in rows], [("0", "0")])
        self.assertGreater(sum(int(r["contacts"]) for r in rows), 1000)

    def test_it_learns(self):
        rows = read_rows(self.out / "learning.csv")
        self.assertGreater(sum(int(r["reached"]) for r in read_rows(self.out / "reached.csv")), 8, "of 16")
        self.assertGreater(float(rows[-1]["reached_by_all"]), float(rows[0]["reached_by_all"]))

    def test_tables_are_written(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        self.assertIn("Judged steps", text)
        self.assertNotIn("Times", text)


if __name__ == "__main__":
    quick_case.main(CatheterRuns)
