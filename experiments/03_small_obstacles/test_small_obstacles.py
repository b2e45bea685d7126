#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 03 in its quick form, without times, and compares its tables with those in expected/.

usage: test_small_obstacles.py BUILD_DIR [--update]     --update writes expected/ anew

costs.csv is only compared between runs: it changes with every better certificate.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402


class SmallObstacles(quick_case.QuickCase):
    experiment = HERE
    expected = ["sweeps.csv", "spikes.csv", "floating.csv"]
    repeated = ["costs.csv"]  # changes with every better certificate
    threads = [1, 2]

    def rows(self, name):
        return read_rows(self.out / name)

    def test_three_segments_miss_what_is_small_and_nothing_is_made_up(self):
        rows = self.rows("sweeps.csv")
        self.assertEqual(28, len(rows))
        for row in rows:
            self.assertEqual("0", row["false_contacts"], row)
            self.assertGreater(int(row["edge_contacts"]), 10, row)
        for row in rows:
            size = float(row["size_over_step"])
            if size <= 0.0625:
                self.assertGreater(float(row["missed_share"]), 0.5, row)
            if size >= 1:
                self.assertLess(float(row["missed_share"]), 0.1, row)

    def test_contacts_are_as_many_as_integral_geometry_says(self):
        rows = [r for r in self.rows("sweeps.csv") if r["dimension"] == "3" and float(r["size_over_step"]) <= 0.25]
        self.assertEqual(8, len(rows))
        contacts, expected = (sum(float(r[c]) for r in rows) for c in ("contacts", "expected_contacts"))
        # Some 3,500 contacts: 5 % are three standard deviations.
        self.assertLess(abs(contacts - expected), 0.05 * expected)

    def test_spikes_keep_the_bound_and_reach_it(self):
        rows = self.rows("spikes.csv")
        self.assertEqual(12, len(rows))
        for row in rows:
            self.assertEqual("0", row["beyond_bound"], row)
            self.assertGreater(int(row["pierced"]), 30, row)
            if row["aim"] == "worst":
                self.assertGreater(float(row["share_of_bound_max"]), 0.97, row)

    def test_no_face_is_pierced_where_faces_are_swept(self):
        for row in self.rows("spikes.csv"):
            self.assertEqual("0", row["pierced_with_faces"], row)
            self.assertGreater(int(row["stopped_by_face"]), 30, row)
        for row in self.rows("floating.csv"):
            self.assertEqual("0", row["passed_with_faces"], row)
        self.assertGreater(int(self.rows("floating.csv")[0]["passed"]), 50)
        self.assertEqual("0", self.rows("floating.csv")[-1]["passed"])

    def test_tables_and_plots_are_written(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        self.assertEqual(4, text.count("\n## "))
        for name in ("missed", "cost", "depth", "floating"):
            script = (self.out / f"{name}.gp").read_text(encoding="utf-8")
            self.assertIn("set xlabel", script)
            self.assertIn("set ylabel", script)


if __name__ == "__main__":
    quick_case.main(SmallObstacles)
