#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 04 in its quick form, without times, and compares its errors with those in expected/.

usage: test_contact_search.py BUILD_DIR [--update]     --update writes expected/ anew

costs.csv is only compared between runs: it changes with every better certificate.
"""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXPECTED = HERE / "expected" / "errors.csv"
WORLDS = {"room", "boxes", "vessel"}


def quick(build, out, threads=1):
    subprocess.run([HERE / "run.sh", "--quick", "--counts", "--no-build", "--build", build, "--out", out, "--threads",
                    str(threads)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def read(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class ContactSearch(unittest.TestCase):
    build = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        quick(cls.build, cls.out / "one")
        quick(cls.build, cls.out / "two", threads=2)
        cls.errors = read(cls.out / "one" / "errors.csv")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def of(self, search):
        rows = [r for r in self.errors if r["search"] == search]
        self.assertEqual(WORLDS, {r["world"] for r in rows})
        return rows

    def test_errors_are_as_expected(self):
        self.assertEqual(EXPECTED.read_text(encoding="utf-8"), (self.out / "one" / "errors.csv").read_text(encoding="utf-8"))

    def test_tables_do_not_depend_on_threads(self):
        for name in ("errors.csv", "costs.csv"):
            self.assertEqual((self.out / "one" / name).read_bytes(), (self.out / "two" / name).read_bytes())

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
        text = (self.out / "one" / "tables.md").read_text(encoding="utf-8")
        self.assertEqual(3, text.count("\n## "))
        for name in ("time", "normal", "cost"):
            script = (self.out / "one" / f"{name}.gp").read_text(encoding="utf-8")
            self.assertIn("set xlabel", script)
            self.assertIn("set ylabel", script)


def update(build):
    with tempfile.TemporaryDirectory() as folder:
        quick(build, Path(folder))
        EXPECTED.parent.mkdir(exist_ok=True)
        EXPECTED.write_bytes((Path(folder) / "errors.csv").read_bytes())


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    ContactSearch.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        update(ContactSearch.build)
    else:
        unittest.main(argv=sys.argv[:1])
