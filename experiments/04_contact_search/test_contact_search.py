#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 04 in its quick form, without times, and compares its errors with those in expected/.

usage: test_contact_search.py BUILD_DIR [--update]     --update writes expected/ anew

costs.csv is only compared between runs: it changes with every better certificate.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402

WORLDS = {"room", "boxes", "vessel"}


class ContactSearch(quick_case.QuickCase):
    experiment = HERE
    expected = ["errors.csv"]
    repeated = ["costs.csv"]  # changes with every better certificate
    threads = [1, 2]

    def of(self, search):
        rows = [r for r in read_rows(self.out / "errors.csv") if r["search"] == search]
        self.assertEqual(WORLDS, {r["world"] for r in rows})
        return rows

    def test_exact_and_exhaustive_agree(self):
        for row in self.of("exact") + self.of("exhaustive") + self.of("exhaustive_unlimited"):
            self.assertGreaterEqual(int(row["contacts"]), 100)
            self.assertEqual(row["contacts"], row["same_time"], row)
            self.assertEqual(row["contacts"], row["same_feature"], row)

    def test_dichotomic_keeps_its_tolerance_and_is_never_late(self):
        rows = self.of("dichotomic")
        self.assertEqual(45, len(rows))
        for row in rows:
            tolerance = 2.0 ** -int(row["tolerance_bits"])
            self.assertEqual("0", row["late"], row)
            self.assertLess(float(row["early_max"]), tolerance, row)
            self.assertGreater(float(row["early_max"]), tolerance / 2, row)

    def test_bisection_of_the_segment_keeps_its_tolerance_and_finds_most(self):
        rows = self.of("dichotomic_segment")
        self.assertEqual(45, len(rows))
        for row in rows:
            tolerance = 2.0 ** -int(row["tolerance_bits"])
            self.assertLess(float(row["early_max"]), tolerance, row)
            self.assertGreater(float(row["early_max"]), tolerance / 2, row)
            self.assertEqual(row["none_found"], row["same_time"], row)
            if int(row["tolerance_bits"]) >= 10:
                self.assertLess(int(row["none_found"]), int(row["contacts"]) / 4, row)

    def test_cells_of_the_end_are_not_enough(self):
        for row in self.of("exhaustive_traversed"):
            self.assertGreater(int(row["late"]), 10, row)
            self.assertEqual(int(row["contacts"]), int(row["late"]) + int(row["same_time"]), row)

    def test_tables_and_plots_are_written(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        self.assertEqual(3, text.count("\n## "))
        for name in ("time", "normal", "cost"):
            script = (self.out / f"{name}.gp").read_text(encoding="utf-8")
            self.assertIn("set xlabel", script)
            self.assertIn("set ylabel", script)


if __name__ == "__main__":
    quick_case.main(ContactSearch)
