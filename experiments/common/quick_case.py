# SPDX-License-Identifier: LGPL-3.0-or-later
"""A test that runs an experiment at its quick length and compares its tables with expected/, byte by byte.

usage of the scripts that use it:
    test_NAME.py BUILD_DIR
    test_NAME.py BUILD_DIR --update      writes expected/ anew

The expected tables were written once; every compiler, build type and number of threads must write them again.
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path


class QuickCase(unittest.TestCase):
    """Derived classes name the experiment. The tables of its runs are in the folders `outs`, those of the first run in `out`."""

    experiment = None  # the folder
    expected = []  # tables that must be as in expected/
    omitted = []  # words of rows that are not compared, since they differ on this machine
    repeated = []  # tables that must be the same for each number of threads
    options = ["--counts"]  # of run.sh
    threads = [2]  # of each run
    build = None

    @classmethod
    def run_quick(cls, out, threads):
        done = subprocess.run([cls.experiment / "run.sh", "--quick", *cls.options, "--no-build", "--build", cls.build, "--out", out,
                               "--threads", str(threads)], capture_output=True, text=True)
        if done.returncode != 0:
            raise RuntimeError(done.stderr)

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.outs = [Path(cls.folder.name) / str(threads) for threads in cls.threads]
        for out, threads in zip(cls.outs, cls.threads):
            cls.run_quick(out, threads)
        cls.out = cls.outs[0]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_tables_are_as_expected_for_any_number_of_threads(self):
        self.assertTrue(self.expected)
        for out in self.outs:
            for name in self.expected:
                with self.subTest(f"{out.name}/{name}"):
                    expected = self.experiment / "expected" / name
                    self.assertEqual(self.compared(expected), self.compared(out / name))
            for name in self.repeated:
                with self.subTest(f"{out.name}/{name}"):
                    self.assertEqual((self.out / name).read_bytes(), (out / name).read_bytes())

    @classmethod
    def compared(cls, path):
        lines = path.read_bytes().decode().splitlines(keepends=True)
        return "".join(line for line in lines if not any(word in line for word in cls.omitted))

    @classmethod
    def update(cls):
        with tempfile.TemporaryDirectory() as folder:
            cls.run_quick(Path(folder), 1)
            (cls.experiment / "expected").mkdir(exist_ok=True)
            for name in cls.expected:
                (cls.experiment / "expected" / name).write_bytes((Path(folder) / name).read_bytes())


def main(case):
    """Runs the tests of a class, or writes its expected tables."""
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    case.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        case.update()
    else:
        unittest.main(argv=sys.argv[:1])
