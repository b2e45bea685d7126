#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The corpus in data/degenerate: made again it is the same, its checker verifies it and sees damage, and Cellwalk answers all of it.

usage: test_degenerate_corpus.py PROGRAM
"""

import csv
import filecmp
import json
import re
import subprocess
import sys
import tempfile
import unittest
from collections import Counter
from fractions import Fraction
from pathlib import Path

CORPUS = Path(__file__).resolve().parents[2] / "data" / "degenerate"
sys.path.insert(0, str(CORPUS))
sys.dont_write_bytecode = True
from exact.vectors import at, vec  # noqa: E402
from exact.world import World  # noqa: E402

CHECKER = CORPUS / "check.py"
KINDS = ["walks", "sweeps", "faces", "moving_walls"]
BY_HAND = {"README.md", "check.py", "exact"}  # files, and a folder
PROGRAM = None


def cases_of(folder):
    return [json.loads(line) for kind in KINDS for line in (folder / f"{kind}.jsonl").read_text().splitlines()]


def check(*options):
    done = subprocess.run([sys.executable, str(CHECKER), *map(str, options)], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


class Corpus(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def answers(self, touch):
        table = self.folder / f"{touch}.csv"
        subprocess.run([PROGRAM, "--in", CORPUS, "--answers", table, "--touch", touch], check=True)
        return table

    def test_is_reproduced(self):
        subprocess.run([PROGRAM, "--out", self.folder], check=True, stdout=subprocess.DEVNULL)
        made = sorted(p.relative_to(self.folder) for p in self.folder.rglob("*") if p.is_file())
        kept = sorted(p.relative_to(CORPUS) for p in CORPUS.rglob("*") if p.is_file() and "__pycache__" not in p.parts)
        self.assertEqual(made, [p for p in kept if p.parts[0] not in BY_HAND])
        for name in made:
            self.assertTrue(filecmp.cmp(self.folder / name, CORPUS / name, shallow=False), name)
        self.assertLess(sum((CORPUS / name).stat().st_size for name in made), 1_000_000)

    def test_has_both_answers_everywhere(self):
        cases = cases_of(CORPUS)
        for kind, least, sorts in (("walk", 150, 8), ("sweep", 150, 8), ("face", 100, 8), ("moving_wall", 100, 6)):
            for dimension in (2, 3) if kind != "face" else (3,):
                some = [c for c in cases if c["kind"] == kind and len(c["points"][0]) == dimension]
                crossings = Counter(c["crossing"] for c in some)
                self.assertGreater(len(some), least)
                self.assertGreater(crossings["yes"], 40)
                self.assertGreater(crossings["no"], 40)
                self.assertGreater(sum(c["convention"] == "none" for c in some), 40)
                self.assertGreater(sum(c["near"] is not None for c in some), 20)
                self.assertGreater(len({c["degeneracy"] for c in some}), sorts)
        for some, least in ((("walk", "sweep"), 30), (("face",), 20), (("moving_wall",), 20)):
            kinds = Counter(k for c in cases if c["kind"] in some and c["touch"] for k in c["touch"]["wall_kinds"])
            self.assertTrue(all(kinds[k] > least for k in ("solid", "membrane", "slit")), kinds)
        self.assertTrue(all(len(c["moves"]) == 1 for c in cases if c["kind"] != "sweep"))
        self.assertTrue(all(not c["at_start"] for c in cases if c["kind"] in ("face", "moving_wall")))
        self.assertGreater(sum(len(c["moves"]) == 2 for c in cases), 50)

    def test_some_faces_are_met_by_no_edge(self):
        worlds = {w["name"]: World(w) for w in map(json.loads, (CORPUS / "worlds.jsonl").read_text().splitlines())}

        def is_met_within(case):
            world, shape, move = worlds[case["world"]], list(map(vec, case["points"])), case["moves"][0]
            v, time = move["vertex"], Fraction(case["touch"]["time"])
            shape[v] = at(shape[v], vec(move["to"]), time)
            return not any(world.met([shape[v], end]) for i, end in enumerate(shape) if i != v)

        within = [c for c in cases_of(CORPUS) if c["kind"] == "face" and c["touch"] and is_met_within(c)]
        self.assertGreater(sum(c["crossing"] == "yes" for c in within), 4)
        self.assertGreater(sum(c["crossing"] == "no" for c in within), 0)

    def test_is_verified(self):
        code, text = check()
        self.assertEqual(0, code, text)
        self.assertIn(" 0 wrong", text)

    def test_cellwalk_answers_all(self):
        kinds = [c["kind"] for c in cases_of(CORPUS)]
        table = self.answers("pass")
        self.assertEqual(len(kinds), len(table.read_text().splitlines()) - 1)
        self.expect_all_right(table, ",".join(KINDS), "crossing")
        table = self.answers("stop")
        self.assertEqual(len(kinds) - kinds.count("moving_wall"), len(table.read_text().splitlines()) - 1)
        self.expect_all_right(table, "walks,sweeps", "touch")
        # What only the inside of a face touches is no contact by Touch::stop.
        self.expect_all_right(table, "faces", "any")

    def expect_all_right(self, table, kinds, definition):
        options = ["--answers", table, "--kinds", kinds]
        code, text = check(*options, "--definition", definition, "--tolerance", 0, "--strict")
        self.assertEqual(0, code, text)
        self.assertEqual(0, check(*options)[0])

    def damaged(self, kind, change, convention="none", most=1):
        """How many cases of a corpus the checker finds wrong, and how many there are, when all are changed."""
        cases = [c for c in cases_of(CORPUS) if Probe.is_fit(c, kind, convention)][:most]
        for case in cases:
            change(case)
        for name in KINDS:
            lines = [json.dumps(c) + "\n" for c in cases if name == kind + "s"]
            (self.folder / f"{name}.jsonl").write_text("".join(lines))
        (self.folder / "worlds.jsonl").write_bytes((CORPUS / "worlds.jsonl").read_bytes())
        code, text = check("--in", self.folder)
        count, wrong = map(int, re.fullmatch(r"(\d+) cases, (\d+) wrong", text.splitlines()[-1]).groups())
        self.assertEqual((len(cases), wrong > 0), (count, code == 1), text)
        return wrong, count

    def test_checker_sees_a_damaged_corpus(self):
        def flip(c):
            c.update(crossing="no", crossings=[], convention="touch")

        def forget(c):
            c.update(crossing="no", crossings=[], touch=None)

        def delay(c):
            for m in (c["touch"], *c["crossings"]):
                m.update(time="7/8", rounded=0.875)

        def move_target(c):
            c["moves"][0]["to"] = [x + 0.125 * (i + 1) for i, x in enumerate(c["moves"][0]["to"])]

        def wrong_wall(c):
            c["touch"]["walls"][0] += 1

        def wrong_feature(c):
            c["touch"]["feature"] = "edge" if c["touch"]["feature"] != "edge" else "vertex"

        def start_on_wall(c):
            c["at_start"] = True

        def other_vertex(c):
            c["moves"][0]["vertex"] = (c["moves"][0]["vertex"] + 1) % 3

        def block(c):
            c.update(crossing="yes", crossings=[c["touch"]], convention="none")

        def lose_point(c):
            c["points"].pop()

        seen = (flip, forget, delay, move_target, wrong_wall, wrong_feature, start_on_wall)
        for kind, more in (("walk", ()), ("face", (other_vertex, lose_point)), ("moving_wall", (other_vertex, lose_point))):
            self.assertEqual((0, 1), self.damaged(kind, lambda c: None))
            for change in seen + more:
                self.assertEqual((1, 1), self.damaged(kind, change), f"{kind}, {change.__name__}")
            wrong, count = self.damaged(kind, block, "touch", 24)
            self.assertGreater(count, 4)
            # The walls alone do not determine what stays in a wall that moves.
            self.assertGreaterEqual(wrong, count / 3 if kind == "moving_wall" else count, f"{kind}, blocked where it touches")

    def test_checker_sees_damaged_answers(self):
        table = self.answers("stop")
        with open(table, newline="") as lines:
            rows = [r for r in csv.DictReader(lines) if not r["id"].startswith("face")]
        contact = next(i for i, r in enumerate(rows) if r["answer"] == "contact" and 0 < Probe.value(r["time"]) < 1)
        clear = {c["id"] for c in cases_of(CORPUS) if c["touch"] is None and not c["at_start"] and c["crossing"] == "no"}
        free = next(i for i, r in enumerate(rows) if r["id"] in clear)

        def says(change, definition="touch"):
            changed = [dict(r) for r in rows]
            change(changed)
            out = self.folder / "changed.csv"
            with open(out, "w", newline="") as file:
                writer = csv.DictWriter(file, rows[0].keys())
                writer.writeheader()
                writer.writerows(changed)
            code, text = check("--answers", out, "--definition", definition, "--kinds", "walks,sweeps")
            last = next(line for line in text.splitlines() if line.startswith("all "))
            return code, dict(zip(["right", "missed", "late", "false", "early", "unanswered"], map(int, last.split()[2:])))

        def miss(r):
            r[contact].update(answer="free", move="", time="")

        def late(r):
            r[contact]["time"] = str(Probe.value(r[contact]["time"]) + 1e-6)

        def early(r):
            r[contact]["time"] = str(Probe.value(r[contact]["time"]) * 0.5)

        def invent(r):
            r[free].update(answer="contact", move="0", time="0.5")

        def omit(r):
            del r[free]

        for change, verdict, code in ((miss, "missed", 1), (late, "late", 1), (early, "early", 0), (invent, "false", 0), (omit, "unanswered", 0)):
            got, counts = says(change)
            self.assertEqual((code, 1), (got, counts[verdict]), f"{verdict}: {counts}")
            self.assertEqual(len(rows) - 1, counts["right"])


class Probe:
    @staticmethod
    def value(text):
        p, _, q = text.partition("/")
        return int(p) / int(q or 1)

    @staticmethod
    def is_fit(case, kind, convention):
        """True for a case of one move of that kind that touches a wall on its way, and is not blocked if the convention is touch."""
        is_kind = case["kind"] == kind and case["convention"] == convention and len(case["moves"]) == 1
        is_blocked = case["crossing"] == "yes"
        return is_kind and case["touch"] and 0 < case["touch"]["rounded"] < 0.75 and is_blocked == (convention == "none")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
