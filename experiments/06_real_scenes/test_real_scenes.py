#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 06 in its quick form, without times, and compares moves, blocked moves and wrong answers with expected/answers.csv.

usage: test_real_scenes.py BUILD_DIR [PART ...]     the parts that were built: bullet, embree, fcl, tetgen
       test_real_scenes.py BUILD_DIR --update       writes expected/answers.csv anew; needs bullet and fcl

Expected are the rows of methods whose answers are the same on every machine. Counts of Cellwalk's work are not compared: they
change with every better certificate.
"""

import json
import struct
import subprocess
import sys
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402

KEPT = [(kept, margin) for kept in ("star", "group", "body") for margin in ("2", "6", "20")]
PEERS = {
    "bullet": {("bullet_move", "0"), *((f"bullet_{kept}", margin) for kept, margin in KEPT)},
    "fcl": {("fcl_move", "0"), *((f"fcl_{kept}", margin) for kept, margin in KEPT)},
    "embree": {(f"embree_{lanes}{mode}", "0") for lanes in (8, 16) for mode in ("", "_robust")},
}
EXACT = {("cellwalk_three_segments", "0"), ("cellwalk_complete", "0"), ("cgal_move", "0"), ("cgal_tree", "0"),
         *((f"cgal_{kept}", margin) for kept, margin in KEPT)}
# Where bodies have a radius, all measure distances; of the peers that need not be there, FCL does.
THICK_SCENE = "T1_thick_05"
THICK_EXACT = EXACT - {("cgal_tree", "0")}
THICK = THICK_EXACT.union({("cgal_doubles_move", "0")}, {(f"cgal_doubles_{kept}", margin) for kept, margin in KEPT})
SCENES = ["S1a_vessel", "T1_thick_05", "S1b_vessel_fine", "R1_pressed", "S3_spheres", "S4_soft_ring", "S5_rigid_ring", "S6_at_rest", "S7_many"]


def spoil(source, target):
    """Copies a trace with the answer to the very last move turned round: its last vertex is then blocked, or not, by the way."""
    data = bytearray(source.read_bytes())
    bodies = struct.unpack_from("<I", data, 8)[0]
    at = 16
    for _ in range(bodies):
        vertices, edges, faces = struct.unpack_from("<III", data, at)
        last = at + 12  # the edges of the last body remain
        at += 12 + 8 * edges + 12 * faces
    joints = struct.unpack_from(f"<{2 * edges}I", data, last)
    answer = len(data) - 1 - joints.count(vertices - 1)
    assert not any(data[answer:]), "the last move is not free"
    data[answer] = 1
    target.write_bytes(data)


class RealScenes(quick_case.QuickCase):
    experiment = HERE
    threads = [1]
    parts = ()

    def setUp(self):
        self.rows = read_rows(self.out / "real_scenes.csv")

    def test_tables_are_as_expected_for_any_number_of_threads(self):
        methods = {(r["method"], r["margin_steps"]) for r in self.rows}
        expected = [r for r in read_rows(HERE / "expected/answers.csv") if (r["method"], r["margin_steps"]) in methods]
        self.assertGreaterEqual(len(expected), len(EXACT) * (len(SCENES) - 1) + len(THICK))
        self.assertEqual(expected, read_rows(self.out / "answers.csv"))

    def test_all_methods_ran_in_all_scenes(self):
        methods = EXACT.union(*(PEERS[p] for p in self.parts if p in PEERS))
        thick = THICK.union(PEERS["fcl"] if "fcl" in self.parts else ())
        for scene in SCENES:
            expected = thick if scene == THICK_SCENE else methods
            self.assertEqual(expected, {(r["method"], r["margin_steps"]) for r in self.rows if r["scene"] == scene}, scene)
        self.assertEqual(SCENES, list(dict.fromkeys(r["scene"] for r in self.rows)))

    def test_exact_methods_are_never_wrong(self):
        exact = [r for r in self.rows if r["exact"] == "1"]
        self.assertEqual(len(EXACT) * (len(SCENES) - 1) + len(THICK_EXACT), len(exact))
        for row in exact:
            self.assertGreater(int(row["blocked"]), 10, row)
            self.assertLess(int(row["blocked"]), int(row["moves"]) / 2, row)
            self.assertEqual(("0", "0"), (row["missed"], row["false"]), row)

    def answered_exactly(self, entry, out):
        """The rows of exact methods in a scene of its own."""
        scenes = self.out / "scenes"
        (scenes / "one.json").write_text(json.dumps([entry]), encoding="utf-8")
        subprocess.run([self.program("real_scenes"), scenes / "one.json", "--out", out, "--rounds", "0", "--only", "^(cellwalk|cgal)"],
                       check=True, stdout=subprocess.DEVNULL)
        rows = read_rows(out / "real_scenes.csv")
        self.assertEqual(len(EXACT), len(rows))
        return rows

    def program(self, name):
        return self.build / "experiments/06_real_scenes" / name

    def test_finer_cells_change_no_answer(self):
        if "tetgen" not in self.parts:
            return
        scenes = self.out / "scenes"
        subprocess.run([self.program("finer_cells"), scenes / "scenes.json", "S1a_vessel", "2", scenes / "finer.ovm"], check=True,
                       stdout=subprocess.DEVNULL)
        coarse = next(r for r in self.rows if r["scene"] == "S1a_vessel")
        entry = next(e for e in json.loads((scenes / "scenes.json").read_text(encoding="utf-8")) if e["name"] == "S1a_vessel")
        for row in self.answered_exactly({**entry, "environment": "finer.ovm"}, self.out / "finer"):
            self.assertGreater(int(row["cells"]), 4 * int(coarse["cells"]), row)
            self.assertEqual(coarse["walls"], row["walls"], row)
            self.assertEqual((coarse["blocked"], "0", "0"), (row["blocked"], row["missed"], row["false"]), row)

    def test_a_scene_with_too_few_contacts_is_refused(self):
        scenes = self.out / "scenes"
        entry = next(e for e in json.loads((scenes / "scenes.json").read_text(encoding="utf-8")) if e["name"] == "R1_pressed")
        self.assertEqual(0.1, entry["least_blocked"])
        (scenes / "one.json").write_text(json.dumps([{**entry, "least_blocked": 0.9}]), encoding="utf-8")
        result = subprocess.run([self.program("real_scenes"), scenes / "one.json", "--out", self.out / "refused", "--rounds", "0"],
                                capture_output=True, text=True)
        self.assertEqual(1, result.returncode)
        self.assertRegex(result.stderr, "R1_pressed: walls block 17.04 % of the moves; this scene is to have at least 90 %")

    def test_a_wrong_answer_shows(self):
        scenes, out = self.out / "scenes", self.out / "spoiled"
        spoil(scenes / "S7_many.trace", scenes / "spoiled.trace")
        entry = {"name": "spoiled", "scene": "S7_many.json", "trace": "spoiled.trace", "first_step": 0}
        rows = self.answered_exactly(entry, out)
        for row in rows:
            self.assertEqual(("1", "0"), (row["missed"], row["false"]), row)

    def test_tables_name_every_method_and_scene(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        for name in {r["method"] for r in self.rows}.union(SCENES):
            self.assertIn(f"| {name} |", text)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    RealScenes.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        RealScenes.expected = ["answers.csv"]
        RealScenes.update()
    else:
        RealScenes.parts = sys.argv[2:]
        unittest.main(argv=sys.argv[:1])
