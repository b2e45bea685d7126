#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 03 in its quick form, without times, and compares its tables with those in expected/.

usage: test_small_obstacles.py BUILD_DIR [--update]     --update writes expected/ anew

costs.csv is only compared between runs: it changes with every better certificate.
"""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXPECTED = HERE / "expected"
EXPECTED_TABLES = ["sweeps.csv", "spikes.csv", "floating.csv"]
TABLES = [*EXPECTED_TABLES, "costs.csv"]


def quick(build, out, threads=1):
    subprocess.run([HERE / "run.sh", "--quick", "--counts", "--no-build", "--build", build, "--out", out, "--threads",
                    str(threads)], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def read(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class SmallObstacles(unittest.TestCase):
    build = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        quick(cls.build, cls.out / "one")
        quick(cls.build, cls.out / "two", threads=2)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def rows(self, name):
        return read(self.out / "one" / name)

    def test_tables_are_as_expected(self):
        for name in EXPECTED_TABLES:
            with self.subTest(name):
                self.assertEqual((EXPECTED / name).read_text(encoding="utf-8"),
                                 (self.out / "one" / name).read_text(encoding="utf-8"))

    def test_tables_do_not_depend_on_threads(self):
        for name in TABLES:
            with self.subTest(name):
                self.assertEqual((self.out / "one" / name).read_bytes(), (self.out / "two" / name).read_bytes())

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
        text = (self.out / "one" / "tables.md").read_text(encoding="utf-8")
        self.assertEqual(4, text.count("\n## "))
        for name in ("missed", "cost", "depth", "floating"):
            script = (self.out / "one" / f"{name}.gp").read_text(encoding="utf-8")
            self.assertIn("set xlabel", script)
            self.assertIn("set ylabel", script)


def update(build):
    with tempfile.TemporaryDirectory() as folder:
        quick(build, Path(folder))
        EXPECTED.mkdir(exist_ok=True)
        for name in EXPECTED_TABLES:
            (EXPECTED / name).write_bytes((Path(folder) / name).read_bytes())


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    SmallObstacles.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        update(SmallObstacles.build)
    else:
        unittest.main(argv=sys.argv[:1])
