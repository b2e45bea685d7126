#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the experiment at its quick length and compares its tables with expected/, byte by byte.

usage: test_degenerate_worlds.py BUILD_DIR
       test_degenerate_worlds.py BUILD_DIR --update      writes expected/ anew
"""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
TABLES = ["degenerate.csv", "touches.csv"]
EXACT = {"exact", "exact_signs", "lazy", "rational"}


def quick(build, out, threads):
    subprocess.run([HERE / "run.sh", "--quick", "--no-build", "--build", build, "--out", out, "--threads", str(threads)],
                   check=True, stdout=subprocess.DEVNULL)


def read(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Degenerate_worlds(unittest.TestCase):
    build = None

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        quick(cls.build, cls.out, 2)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_tables_are_as_expected(self):
        for name in TABLES:
            self.assertEqual((HERE / "expected" / name).read_bytes(), (self.out / name).read_bytes(), name)

    def test_exact_kernels_are_never_wrong(self):
        rows = [r for r in read(self.out / "degenerate.csv") if r["kernel"] in EXACT]
        self.assertEqual(0, sum(int(r["wrong"]) for r in rows))
        self.assertGreater(sum(int(r["motions"]) for r in rows), 40_000)
        for family in {r["motion"] for r in rows}:
            blocked = sum(int(r["blocked"]) for r in rows if r["motion"] == family)
            self.assertGreater(blocked, 200, family)

    def test_doubles_are_right_on_integers_only(self):
        rows = [r for r in read(self.out / "degenerate.csv") if r["kernel"] == "double" and r["dimension"] == "3"]
        self.assertEqual(0, sum(int(r["wrong"]) for r in rows if r["placement"] == "integer"))
        self.assertGreater(sum(int(r["wrong"]) for r in rows if r["placement"] == "turned"), 100)

    def test_touches_stop_more_than_crossings(self):
        rows = read(self.out / "touches.csv")
        self.assertEqual(0, sum(int(r["wrong_with_stop"]) for r in rows))
        for r in rows:
            self.assertGreaterEqual(int(r["contacts_with_stop"]), int(r["blocked"]), r)
        more = sum(int(r["contacts_with_stop"]) - int(r["blocked"]) - int(r["either"]) for r in rows)
        self.assertGreater(more, 1000)


def update(build):
    with tempfile.TemporaryDirectory() as folder:
        quick(build, Path(folder), 1)
        (HERE / "expected").mkdir(exist_ok=True)
        for name in TABLES:
            (HERE / "expected" / name).write_bytes((Path(folder) / name).read_bytes())


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    Degenerate_worlds.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        update(Degenerate_worlds.build)
    else:
        unittest.main(argv=sys.argv[:1])
