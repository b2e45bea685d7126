#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the experiment at its quick length and compares its tables with expected/, byte by byte.

usage: test_endurance.py BUILD_DIR
       test_endurance.py BUILD_DIR --update      writes expected/ anew
"""

import json
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402


class Endurance(quick_case.QuickCase):
    experiment = HERE
    expected = ["walks.csv", "sweeps.csv", "membrane_sweeps.csv", "thick_sweeps.csv"]

    def test_nothing_is_wrong_and_half_is_degenerate(self):
        for name in self.expected:
            rows = read_rows(self.out / name)
            self.assertEqual(len(rows), 12)
            total = {column: sum(int(row[column]) for row in rows) for column in ("judged", "degenerate", "blocked", "by_edge", "wrong")}
            self.assertEqual(total["wrong"], 0, name)
            self.assertGreater(total["degenerate"], total["judged"] / 2 if name != "thick_sweeps.csv" else total["judged"] / 4, name)
            self.assertGreater(total["blocked"], total["judged"] / 5, name)
            if name != "walks.csv":
                self.assertGreater(total["by_edge"], total["judged"] / 50, name)
            self.assertEqual(json.loads((self.out / name).with_suffix(".json").read_text())["judged"], total["judged"])
        self.assertFalse((self.out / "wrong").exists())

    def test_a_run_that_was_cut_off_goes_on(self):
        program = self.build / "experiments/13_endurance/endurance"
        out = self.out / "cut_off"
        run = [program, "--part", "walks", "--motions", "400000", "--out", out]
        subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
        kept, table = out / "kept_walks.jsonl", out / "walks.csv"
        whole, lines = table.read_bytes(), kept.read_text().splitlines(keepends=True)
        table.unlink()
        # One part is made anew; the counts of another one are taken from the file, whatever they are.
        lines[1] = lines[1].replace('"counts":[60000,', '"counts":[60007,')
        kept.write_text("".join(lines[:-1]) + lines[-1][:20])
        subprocess.run(run, check=True, stdout=subprocess.DEVNULL)
        self.assertEqual(table.read_bytes(), whole.replace(b",60000,", b",60007,", 1))
        other = subprocess.run([*run, "--seed", "2"], capture_output=True, text=True)
        self.assertEqual((other.returncode, "other settings" in other.stderr), (1, True), other.stderr)


if __name__ == "__main__":
    quick_case.main(Endurance)
