#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Draws the figures, and checks them: the numbers against fractions computed here, the pictures against those of the docs.

usage: test_draw_sweeps.py PROGRAM DOCS_IMAGES
"""

import json
import subprocess
import sys
import tempfile
import unittest
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "docs"))
from pictures import read_png, same_picture  # noqa: E402

NAMES = ["sweep_2d", "sweep_3d", "face_3d"]
LARGEST_FILE = 160_000  # bytes, in the docs


def vector(a, b):
    return [Fraction(y) - Fraction(x) for x, y in zip(a, b)]


def orientation(first, *others):
    """The determinant of the vectors from one point to two or three others, exact."""
    rows = [vector(first, x) for x in others]
    if len(rows) == 2:
        return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    (a, b, c), (d, e, f), (g, h, i) = rows
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def root(motion, points):
    """When p comes to lie on the line or plane of points: the orientation is affine in time."""
    first, last = orientation(motion["p"], *points), orientation(motion["target"], *points)
    return first / (first - last)


class Figures(unittest.TestCase):
    program, docs = "", Path()

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name) / "new"
        subprocess.run([cls.program, cls.folder], check=True)
        cls.data = {n: json.loads((cls.folder / f"{n}.json").read_text(encoding="utf-8")) for n in NAMES}

    def time(self, contact):
        time = Fraction(contact["time"]["exact"])
        self.assertLessEqual(Fraction(contact["time"]["rounded"]), time)
        self.assertAlmostEqual(contact["time"]["rounded"], float(time), places=15)
        self.assertTrue(0 < time < 1)
        return time

    def test_it_writes_just_these_files(self):
        expected = {n + end for n in NAMES for end in (".png", ".json")}
        self.assertEqual({f.name for f in self.folder.iterdir()}, expected)

    def test_the_pictures_of_the_docs_are_these(self):
        for name in NAMES:
            self.assertLess((self.docs / f"{name}.png").stat().st_size, LARGEST_FILE)
            width, height, rows = read_png(self.folder / f"{name}.png")
            ink = sum(1 for row in rows for x in range(width) if row[3 * x:3 * x + 3] != b"\xff\xff\xff")
            self.assertTrue(0.1 < ink / (width * height) < 0.9, name)
            self.assertTrue(same_picture(self.folder / f"{name}.png", self.docs / f"{name}.png"),
                            name + ": draw it again, see docs/sweep.md")

    def test_the_times_beside_the_pictures_of_the_docs_are_these(self):
        def times(value):
            if not isinstance(value, (dict, list)):
                return []
            if isinstance(value, dict) and "exact" in value and "rounded" in value:
                return [value["exact"]]
            return [t for part in (value.values() if isinstance(value, dict) else value) for t in times(part)]

        for name in NAMES:
            kept = times(json.loads((self.docs / f"{name}.json").read_text(encoding="utf-8")))
            self.assertGreater(len(kept), 0)
            self.assertEqual(kept, times(self.data[name]))

    def test_2d_what_floats_is_missed_by_three_segments_only(self):
        data = self.data["sweep_2d"]
        floating, motion = data["floating"], data["motion"]
        self.assertIsNone(floating["three_segments"]["contact"])
        contact = floating["triangle"]["contact"]
        self.assertEqual(contact["environment"]["kind"], "vertex")
        self.assertEqual(self.time(contact), root(motion, [motion["q"], contact["environment"]["points"][0]]))
        self.assertLess(len(floating["three_segments"]["cells"]), len(floating["triangle"]["cells"]))

    def test_2d_the_searches_agree(self):
        data = self.data["sweep_2d"]
        spikes, motion = data["spikes"], data["motion"]
        exact = self.time(spikes["exact"])
        self.assertEqual(self.time(spikes["exhaustive"]["contact"]), exact)
        self.assertEqual(self.time(spikes["three_segments"]["contact"]), exact)
        times = [Fraction(c["time"]["exact"]) for c in spikes["exhaustive"]["candidates"]]
        self.assertEqual(times, [root(motion, [motion["q"], c["vertex"]]) for c in spikes["exhaustive"]["candidates"]])
        self.assertEqual(len(times), 3)
        self.assertEqual(min(times), exact)
        steps = spikes["dichotomic"]["steps"]
        self.assertEqual({step["free"] for step in steps}, {True, False})
        for step in steps:
            self.assertEqual(step["free"], Fraction(step["time"]["exact"]) <= exact)
        low = self.time(spikes["dichotomic"]["contact"])
        self.assertEqual(low, max(Fraction(s["time"]["exact"]) for s in steps if s["free"]))
        self.assertLessEqual(exact - low, Fraction(spikes["dichotomic"]["tolerance"]))

    def test_3d_the_spike_is_missed_by_three_segments_only(self):
        data = self.data["sweep_3d"]
        motion, contact = data["motion"], data["triangle"]["contact"]
        self.assertIsNone(data["three_segments"]["contact"])
        self.assertEqual((contact["body"], contact["environment"]["kind"]), ("edge", "edge"))
        self.assertEqual(self.time(contact), root(motion, [motion["q"], *contact["environment"]["points"]]))
        self.assertEqual(data["exhaustive"]["contact"]["time"], contact["time"])
        late = self.time(contact) - self.time(data["dichotomic"]["contact"])
        self.assertTrue(0 <= late <= Fraction(data["dichotomic"]["tolerance"]))

    def test_the_face_is_met_by_the_tip_and_its_edges_by_nothing(self):
        data = self.data["face_3d"]
        motion, contact = data["motion"], data["face"]["contact"]
        self.assertTrue(data["vertex_is_free"] and data["edges_are_free"])
        self.assertEqual((contact["body"], contact["environment"]["kind"]), ("face", "vertex"))
        self.assertEqual(contact["environment"]["points"], [data["spike"]["tip"]])
        self.assertEqual(self.time(contact), root(motion, [motion["q"], motion["r"], data["spike"]["tip"]]))

    def test_it_fails_where_it_cannot_write(self):
        for arguments in ([], [self.folder / "face_3d.json"]):
            done = subprocess.run([self.program, *arguments], capture_output=True, check=False)
            self.assertNotEqual(done.returncode, 0)
            self.assertTrue(done.stderr)


if __name__ == "__main__":
    Figures.docs = Path(sys.argv.pop())
    Figures.program = sys.argv.pop()
    unittest.main()
