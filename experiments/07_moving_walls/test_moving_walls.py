#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 07 in its quick form, without times, and compares its answers with those in expected/.

usage: test_moving_walls.py BUILD_DIR [PEER ...]    peers that were built: bullet, embree, fcl, cgal
       test_moving_walls.py BUILD_DIR --update      writes expected/ anew; all peers must be there
"""

import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows, unique  # noqa: E402

METHODS = {"bullet": ["bullet_refit", "bullet_partial", "bullet_bodies"], "embree": ["embree_refit", "embree_low", "embree_medium"],
           "fcl": ["fcl_refit"], "cgal": ["cgal_rebuild"]}
SCENES = [f"{size}_{movers}" for size in ("coarse", "middle") for movers in ("one", "hundred", "branch", "all")]


class MovingWalls(quick_case.QuickCase):
    experiment = HERE
    peers = list(METHODS)

    @classmethod
    def methods(cls):
        return ["cellwalk"] + [m for peer, methods in METHODS.items() if peer in cls.peers for m in methods]

    @classmethod
    def program(cls):
        return cls.build / "experiments/07_moving_walls/moving_walls"

    def rows(self, folder=None):
        return read_rows((folder or self.out) / "answers.csv")

    def spoiled(self, what):
        """The answers of a run that spoils them."""
        out = self.out / what
        subprocess.run([self.program(), "--quick", "--counts", "--scenes", "coarse_(hundred|all)", "--spoil", what, "--out", out], check=True,
                       stdout=subprocess.DEVNULL)
        return self.rows(out)

    def test_tables_are_as_expected_for_any_number_of_threads(self):
        expected = [r for r in read_rows(HERE / "expected" / "answers.csv") if r["method"] in self.methods()]
        self.assertEqual(expected, self.rows())

    def test_every_method_answers_every_scene(self):
        self.assertEqual(SCENES, unique(r["scene"] for r in self.rows()))
        for scene in SCENES:
            self.assertEqual(set(self.methods()), {r["method"] for r in self.rows() if r["scene"] == scene}, scene)

    def test_exact_answers_are_never_wrong(self):
        for row in self.rows():
            self.assertEqual("0", row["bad_stops"], row)
            if row["arithmetic"] == "exact":
                self.assertEqual(("0", "0"), (row["missed"], row["false"]), row)

    def test_there_is_something_to_miss(self):
        for scene in SCENES:
            row = next(r for r in self.rows() if r["scene"] == scene)
            self.assertEqual(row["moves"], row["judged"], row)
            if not scene.endswith("_one"):
                self.assertGreater(int(row["blocked"]), 3, row)
            self.assertLess(int(row["blocked"]), int(row["moves"]) / 2 + 4, row)

    def test_answers_depend_on_the_arithmetic_only(self):
        for scene in SCENES:
            for arithmetic in ("float", "double", "exact"):
                answers = {(r["missed"], r["false"]) for r in self.rows() if r["scene"] == scene and r["arithmetic"] == arithmetic}
                self.assertEqual(1, len(answers), (scene, arithmetic))

    def test_a_hit_that_is_ignored_is_missed(self):
        for row in self.spoiled("hits"):
            if row["arithmetic"] == "exact":
                self.assertEqual(row["method"] == "cellwalk", int(row["missed"]) > 0, row)

    def test_a_box_that_is_too_small_is_missed(self):
        for row in self.spoiled("boxes"):
            if row["arithmetic"] == "exact":
                self.assertEqual(row["method"] != "cellwalk", int(row["missed"]) > 0, row)

    def test_tables_name_every_method_and_scene(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        for name in self.methods():
            self.assertIn(f"| {name} |", text)
        for scene in SCENES:
            self.assertIn(f"`{scene}`", text)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    MovingWalls.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        MovingWalls.expected = ["answers.csv"]
        MovingWalls.update()
    else:
        MovingWalls.peers = sys.argv[2:]
        unittest.main(argv=sys.argv[:1])
