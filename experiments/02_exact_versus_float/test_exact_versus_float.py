#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs the experiment at its quick length and compares its tables with expected/, byte by byte.

usage: test_exact_versus_float.py BUILD_DIR
       test_exact_versus_float.py BUILD_DIR --update      writes expected/ anew

The expected tables were written once; every compiler, build type and number of threads must write them again.
"""

import json
import platform
import signal
import subprocess
import sys
import time
from fractions import Fraction
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
import summarize  # noqa: E402
from tables import EXACT, ROUNDED, interval, read_rows  # noqa: E402


class ExactVersusFloat(quick_case.QuickCase):
    experiment = HERE
    expected = ["walks.csv", "sweeps.csv", "flights.csv"]
    omitted = [] if platform.machine() == "x86_64" else ["long_double"]  # it has another format elsewhere

    def test_threads_make_no_difference(self):
        other = self.out / "one_thread"
        program = self.build / "experiments/02_exact_versus_float/exact_versus_float"
        few = ["--part", "sweeps", "--part", "flights", "--sweeps", "101", "--moves", "500", "--seed", "2"]
        for threads in "12":
            subprocess.run([program, *few, "--out", other / threads, "--threads", threads], check=True,
                           stdout=subprocess.DEVNULL)
        for name in ["sweeps.csv", "flights.csv"]:
            self.assertEqual((other / "1" / name).read_bytes(), (other / "2" / name).read_bytes())
            self.assertNotEqual((other / "1" / name).read_bytes(), (self.out / name).read_bytes())

    def test_a_run_that_was_killed_goes_on(self):
        program = self.build / "experiments/02_exact_versus_float/exact_versus_float"
        few = ["--part", "walks", "--part", "sweeps", "--kernel", "exact", "--kernel", "float", "--motions", "300", "--sweeps", "50"]
        runs = {}
        for name in ["whole", "killed"]:
            runs[name] = [program, *few, "--out", self.out / "kills" / name, "--threads", "2"]
        subprocess.run(runs["whole"], check=True, stdout=subprocess.DEVNULL)
        lines = (self.out / "kills/whole/kept.jsonl").read_text().splitlines()
        killed = self.out / "kills/killed"
        kept = killed / "kept.jsonl"
        kills = 0
        for share in [0.1, 0.5, 0.9]:
            process = subprocess.Popen([*runs["killed"], "--resume"], stdout=subprocess.DEVNULL)
            while process.poll() is None and (not kept.exists() or kept.read_text().count("\n") < share * len(lines)):
                time.sleep(0.002)
            process.kill()
            kills += process.wait() == -signal.SIGKILL
        self.assertGreaterEqual(kills, 2)
        before = kept.read_text().count("\n")
        done = subprocess.run([*runs["killed"], "--seed", "3", "--resume"], capture_output=True, text=True)
        self.assertEqual((done.returncode, "other settings" in done.stderr), (1, True), done.stderr)
        self.assertGreaterEqual(kept.read_text().count("\n"), before)
        subprocess.run([*runs["killed"], "--resume"], check=True, stdout=subprocess.DEVNULL)
        for name in ["walks.csv", "sweeps.csv", "kept.jsonl"]:
            self.assertEqual((self.out / "kills/whole" / name).read_bytes(), (killed / name).read_bytes(), name)
        kernels = {row["kernel"] for row in read_rows(killed / "walks.csv")}
        self.assertEqual(kernels, {"exact", "float"})

    def test_exact_kernels_are_never_wrong(self):
        walks = [r for r in read_rows(self.out / "walks.csv") if r["kernel"] in EXACT]
        self.assertEqual(sum(int(r["wrong"]) for r in walks), 0)
        self.assertGreater(sum(int(r["motions"]) for r in walks), 100_000)
        sweeps = [r for r in read_rows(self.out / "sweeps.csv") if r["method"] == "triangle"]
        self.assertEqual(sum(int(r["wrong"]) for r in sweeps), 0)
        self.assertGreater(sum(int(r["blocked"]) for r in sweeps), 1000)
        flights = [r for r in read_rows(self.out / "flights.csv") if r["kernel"] in EXACT]
        self.assertEqual(sum(int(r["wrong"]) + int(r["escapes"]) for r in flights), 0)
        self.assertGreater(min(int(r["contacts"]) for r in flights), 100)
        self.assertEqual(json.loads((self.out / "manifest.json").read_text())["exact"]["walks"]["wrong"], 0)

    def test_rounded_kernels_are_wrong(self):
        walks = read_rows(self.out / "walks.csv")
        wrong = {k: sum(int(r["wrong"]) for r in walks if r["kernel"] == k and r["dimension"] == "3") for k in ROUNDED}
        for kernel in ("double", "simple_cartesian", "double_16u", "double_1e-9", "float"):
            self.assertGreater(wrong[kernel], 100, kernel)
        self.assertLess(wrong["long_double"], wrong["double"])
        self.assertLessEqual(wrong["double_double"], wrong["long_double"])
        for kind in ["missed_wall", "false_contact", "wrong_cell", "stuck", "wrong_kind"]:
            self.assertGreater(sum(int(r[kind]) for r in walks), 10, kind)
        self.assertTrue(any(int(r["degenerate"]) > int(r["motions"]) / 3 for r in walks))

    def test_the_paper_s_sweep_misses_what_the_complete_one_finds(self):
        sweeps = [r for r in read_rows(self.out / "sweeps.csv") if r["method"] == "three_segments" and r["dimension"] == "3"]
        self.assertGreater(sum(int(r["missed"]) for r in sweeps), 5)

    def test_escapes_are_enlarged_until_the_side_is_seen(self):
        way = [(0.0, 0.0), (0.5, 0.125)]  # the coordinates of its end have ulps of 2^-53 and 2^-55
        for off, behind in [(Fraction(-1, 2 ** 60), True), (Fraction(1, 2 ** 60), False)]:
            wall = [(Fraction(1, 2) + off, Fraction(y)) for y in (-1, 1)]
            text, exponent, half, is_behind = summarize.zoom(way, wall)
            self.assertEqual(is_behind, behind)
            self.assertAlmostEqual(half * 10.0 ** exponent, 6.5 * 2.0 ** -55)
            near_wall = text.partition("$near_wall << END\n")[2].splitlines()[0].split()
            self.assertAlmostEqual(float(near_wall[0]) * 10.0 ** exponent, float(off), delta=1e-30)
        square = summarize.half_plane(1.0, [0.5, 0.0], [1.0, 0.0])
        self.assertEqual(sorted(map(list, square)), [[0.5, -1.0], [0.5, 1.0], [1.0, -1.0], [1.0, 1.0]])

    def test_every_wrong_walk_is_in_a_class_of_failures(self):
        columns = [c for of in summarize.CLASSES.values() for c in of]
        for name in ("walks.csv", "flights.csv"):
            for row in read_rows(self.out / name):
                self.assertEqual(int(row["wrong"]), sum(int(row[c]) for c in columns), row)
        for row in read_rows(self.out / "walks.csv"):
            for bound, value in zip(("low", "high"), interval(int(row["wrong"]), int(row["motions"]))):
                self.assertAlmostEqual(float(row[bound]), value, places=12, msg=row)
        rows = [{"dimension": "3", "variable": "degeneracy", "value": "0", "kernel": k, "motions": "1000", **dict.fromkeys(columns, "0")}
                for k in ("exact", "lazy", "double")]
        rows[2] |= {"wrong_cell": "3", "illegal_way": "2"}
        text = summarize.failure_table(rows, "3")
        self.assertIn("| exactly degenerate | exact kernels | 2,000 | 0 (0 to 1,500) |", text)
        self.assertIn("| exactly degenerate | double | 1,000 | 0 (0 to 3,000) | 0 (0 to 3,000) | 5,000 (2,138 to 11,651) |", text)

    def test_failures_can_be_replayed(self):
        records = sorted((self.out / "failures").glob("*.json"))
        self.assertGreater(len(records), 10)
        told = 0
        for record in records:
            done = subprocess.run([self.build / "cellwalk", "query", "--replay-failure", record], capture_output=True, text=True,
                                  check=True)
            told += "compared with the exact walk: no difference" not in done.stdout
        self.assertEqual(told, len(records))


if __name__ == "__main__":
    quick_case.main(ExactVersusFloat)
