#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 11 in its quick form, without times, and compares its checks with those in expected/.

usage: test_track_lengths.py BUILD_DIR [--update]     --update writes expected/ anew

costs.csv is only compared between runs: it changes with every better certificate.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402

WORLDS = ["grid", "random points", "lattice"]


class TrackLengths(quick_case.QuickCase):
    experiment = HERE
    expected = ["checks.csv", "threads.csv"]
    repeated = ["costs.csv"]
    threads = [1, 2]

    def rows(self, name):
        rows = read_rows(self.out / name)
        self.assertEqual({(w, k) for w in WORLDS for k in ("chords", "degenerate")}, {(r["world"], r["rays"]) for r in rows})
        return rows

    def test_no_row_is_wrong(self):
        for row in self.rows("checks.csv"):
            for column in ("broken", "wrong", "divided"):
                self.assertEqual("0", row[column], row)
            self.assertGreater(int(row["pieces"]), 5 * int(row["count"]), row)
            self.assertGreater(int(row["judged"]), 100, row)
            self.assertLess(int(row["blocked"]), int(row["count"]) / 5, row)

    def test_degenerate_rays_are_degenerate(self):
        for row in self.rows("costs.csv"):
            plain = int(row["without_signs"]) / int(row["judged"])
            if row["rays"] == "chords":
                self.assertGreater(plain, 0.9, row)
            else:
                self.assertLess(plain, 0.5, row)

    def test_peers_fail_in_degenerate_positions(self):
        rows = self.rows("failures.csv")
        for row in rows:
            faults = sum(int(row[c]) for c in ("endless", "lost", "wrong_cells", "wrong_sums"))
            if row["rays"] == "chords":
                self.assertLess(faults, int(row["count"]) / 20, row)
            elif row["world"] == "lattice" and row["peer"] != "midpoints by trees":
                self.assertGreater(faults, 0, row)
            if row["peer"] == "plain walk, double":
                self.assertGreater(int(row["not_nearest"]), 0, row)

    def test_tables_are_written(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        self.assertIn("the same bytes", text)
        self.assertNotIn("Times", text)


if __name__ == "__main__":
    quick_case.main(TrackLengths)
