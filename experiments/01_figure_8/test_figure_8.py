#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs figure 8 in its quick form, without times, and compares answers and counts with expected/quick.csv.

usage: test_figure_8.py BUILD_DIR [PEER ...]     the peers that were built: bullet, bullet_double, embree, fcl
       test_figure_8.py BUILD_DIR --update       writes expected/quick.csv anew; needs all peers

Expected are the rows of methods whose answers and counts are the same on every machine. Of cellwalk only the answers are
compared: its counts change with every better certificate.
"""

import csv
import json
import math
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import summarize  # noqa: E402

EXPECTED = HERE / "expected" / "quick.csv"
ANSWERS = ["moves", "hits", "missed", "false"]
COUNTS = ["boxes", "queries", "triangle_tests", "walks", "crossings", "signs", "clear_moves"]
COLUMNS = ["trace", "method", *ANSWERS, *COUNTS]
ALWAYS = {"read_and_write", "unit_cubes", "cellwalk_three_segments", "cellwalk_triangle", "double_walk", "library_double",
          "double_regions", "map_walk", "cgal_segment", "cgal_triangle", "cgal_kept_box"}
PEERS = {
    "bullet": {"bullet_swept_box", "bullet_ray", "bullet_body_box", "bullet_kept_box", "gimpact_tau"},
    "bullet_double": {"bullet_swept_box_double", "bullet_ray_double", "bullet_body_box_double", "bullet_kept_box_double",
                      "gimpact_tau_double"},
    "embree": {"embree_ray", "embree_packet", "embree_ray_robust", "embree_packet_robust"},
    "fcl": {"fcl_collide", "fcl_boxes"},
}
EXACT = {"cellwalk_three_segments", "cellwalk_triangle", "cgal_segment", "cgal_triangle", "cgal_kept_box"}
BOTH = ["n_1e3", "n_1e4", "side_0.1", "side_1", "side_3"]  # motions
TRACES = [*BOTH, *("rigid_" + t for t in [*BOTH, "solid_01", "solid_30"])]


def read(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def quick(build, out):
    """The rows of a quick run."""
    subprocess.run([HERE / "run.sh", "--quick", "--counts", "--no-build", "--build", build, "--out", out], check=True,
                   stdout=subprocess.DEVNULL)
    return read(out / "figure_8.csv")


def kept(row):
    """What of a row is expected again."""
    counts = [] if row["method"].startswith("cellwalk") else COUNTS
    return {c: row[c] if c in ["trace", "method", *ANSWERS, *counts] else "" for c in COLUMNS}


HEXAHEDRON = 12 + 8 * 12  # bytes of a body: counts, and two vertices of each of 12 edges


class Trace:
    """A trace of hexahedra in a grid (docs/formats.md). Each move has four answers: the vertex, and three edges."""

    def __init__(self, path):
        data = path.read_bytes()
        origin = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
        self.side, self.speed = origin["body_side"], origin["speed"]
        solid, = struct.unpack("<I", data[28:32])
        self.bodies, self.steps = struct.unpack("<2I", data[32 + 4 * solid:40 + 4 * solid])
        self.vertices = 8 * self.bodies
        start = 40 + 4 * solid + HEXAHEDRON * self.bodies
        end = start + 24 * self.vertices * (2 * self.steps + 1)
        points = list(struct.iter_unpack("<3d", data[start:end]))
        self.before, self.targets = points[:self.vertices * (self.steps + 1)], points[self.vertices * (self.steps + 1):]
        self.answers = data[end + 1:]

    def motion(self, body):
        """Before each step of a body, and after the last: its positions, and whether walls hold one back in the step."""
        for step in range(self.steps + 1):
            at = self.vertices * step + 8 * body
            yield self.before[at:at + 8], any(a & 1 for a in self.answers[4 * at:4 * at + 32])

    def strain(self, x):
        """The largest change of an edge against its length at rest."""
        return max(abs(math.dist(x[v], x[v ^ 1 << k]) / self.side - 1) for v in range(8) for k in range(3))


def centre(x):
    return [sum(p[k] for p in x) / len(x) for k in range(3)]


def spoil(source, target):
    """Copies a trace with recorded answers of its last free move turned round: the vertex, and the triangle of its first edge."""
    data = bytearray(source.read_bytes())
    last = max(i for i in range(len(data) - 4 * Trace(source).vertices, len(data), 4) if not any(data[i:i + 4]))
    data[last:last + 2] = b"\1\2"
    target.write_bytes(data)
    shutil.copy(source.with_suffix(".json"), target.with_suffix(".json"))


class Figure8(unittest.TestCase):
    build, peers = None, ()

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        cls.rows = quick(cls.build, cls.out)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_all_methods_ran(self):
        methods = ALWAYS.union(*(PEERS[p] for p in self.peers))
        for trace in TRACES:
            self.assertEqual(methods, {r["method"] for r in self.rows if r["trace"] == trace}, trace)

    def test_answers_and_counts_are_as_expected(self):
        methods = {r["method"] for r in self.rows}
        got = [kept(r) for r in self.rows if r["reproducible"] == "1"]
        self.assertGreaterEqual(len(got), len(ALWAYS) * len(TRACES))
        self.assertEqual([r for r in read(EXPECTED) if r["method"] in methods], got)

    def test_exact_methods_are_never_wrong(self):
        exact = [r for r in self.rows if r["method"] in EXACT]
        self.assertEqual(len(EXACT) * len(TRACES), len(exact))
        for row in exact:
            self.assertGreater(int(row["hits"]), 10, row)
            self.assertEqual(("0", "0"), (row["missed"], row["false"]), row)

    def test_a_wrong_answer_shows(self):
        trace, out = self.out / "spoiled.bin", self.out / "spoiled"
        spoil(self.out / "traces" / "n_1e3.bin", trace)
        subprocess.run([self.build / "experiments/01_figure_8/figure_8", trace, "--out", out, "--rounds", "0", "--only",
                        "^(cellwalk|cgal)"], check=True, stdout=subprocess.DEVNULL)
        missed = {r["method"]: (r["missed"], r["false"]) for r in read(out / "figure_8.csv")}
        self.assertEqual({"cellwalk_three_segments": ("1", "0"), "cellwalk_triangle": ("2", "0"), "cgal_segment": ("1", "0"),
                          "cgal_triangle": ("1", "0"), "cgal_kept_box": ("1", "0")}, missed)

    def test_traces_are_the_same_again(self):
        again = self.out / "again.bin"
        subprocess.run([self.build / "experiments/01_figure_8/make_traces", again, "--steps", "10", "--cells", "10", "10",
                        "10"], check=True, stdout=subprocess.DEVNULL)
        self.assertEqual((self.out / "traces" / "n_1e3.bin").read_bytes(), again.read_bytes())

    def test_bodies_start_as_in_the_scene_of_the_paper(self):
        subprocess.run([self.build / "cellwalk", "run", "-o", self.out / "run", "--steps", "1", "--record", self.out / "run.trace", "--set",
                        "output.picture=false"], check=True, stdout=subprocess.DEVNULL)
        trace = Trace(self.out / "traces" / "n_1e3.bin")
        data = (self.out / "run.trace").read_bytes()
        head = 16 + trace.bodies * HEXAHEDRON
        points = list(struct.iter_unpack("<3d", data[head:head + 3 * 24 * trace.vertices]))
        self.assertEqual(trace.before[:trace.vertices], points[:trace.vertices])
        self.assertEqual(trace.targets[:trace.vertices], points[2 * trace.vertices:], "goals of the first step")

    def test_bodies_deform_recover_and_bounce(self):
        file, steps = self.out / "bounces.bin", 100
        subprocess.run([self.build / "experiments/01_figure_8/make_traces", file, "--steps", str(steps)], check=True,
                       stdout=subprocess.DEVNULL)
        trace = Trace(file)
        deformed = recovered = bounces = 0
        for body in range(trace.bodies):
            before, free, way = None, 0, None
            for x, is_held in trace.motion(body):
                strain = trace.strain(x)
                deformed += strain > 0.05
                if free >= 20:  # each step of free flight halves what deforms
                    recovered += 1
                    self.assertLess(strain, 1e-4, "a body that met no wall for so long is a cube")
                if before and free >= 20:
                    now = [b - a for a, b in zip(before, centre(x))]
                    bounces += way is not None and sum(a * b for a, b in zip(way, now)) < 0
                    way = now
                    self.assertLess(math.hypot(*now), 1.001 * trace.speed, "none gains energy; that of the spin is a thousandth")
                before, free = centre(x), 0 if is_held else free + 1
        self.assertGreater(deformed, 500)
        self.assertGreater(recovered, 8000)
        self.assertGreater(bounces, 60)

    def test_tables_name_every_method_and_trace(self):
        text = (self.out / "tables.md").read_text(encoding="utf-8")
        for name in {r["method"] for r in self.rows}.union(TRACES):
            self.assertIn(f"| {name} |", text)

    def test_the_plot_has_every_method_that_it_names(self):
        plotted = summarize.PLOTTED
        self.assertLessEqual(set(plotted), ALWAYS.union(*PEERS.values()))
        self.assertEqual(len({style[2:4] for style in plotted.values()}), len(plotted), "lines differ without colours")
        rows = [{"trace": f"n_{n}", "cells": n, "method": m, "ns_per_vertex_move": str(20 + i)}
                for n in (1000, 1000000) for i, m in enumerate(plotted)]
        script = summarize.plot_script(rows)
        for name, style in plotted.items():
            self.assertIn(f"${name} << END", script)
            self.assertEqual(script.count(style[0]), 2 if name in summarize.LOWEST else 1, name)
        self.assertIsNone(summarize.plot_script(rows[:len(plotted)]), "one size is no line")
        self.assertIsNone(summarize.plot_script(rows, summarize.RIGID), "rigid bodies have a plot of their own")
        rigid = [{**r, "trace": summarize.RIGID + r["trace"]} for r in rows]
        self.assertEqual(script, summarize.plot_script(rigid, summarize.RIGID))


def update(build):
    with tempfile.TemporaryDirectory() as folder:
        rows = quick(build, Path(folder))
    assert {r["method"] for r in rows} == ALWAYS.union(*PEERS.values()), "not all peers are built"
    EXPECTED.parent.mkdir(exist_ok=True)
    with EXPECTED.open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(kept(r) for r in rows if r["reproducible"] == "1")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    Figure8.build = Path(sys.argv[1]).resolve()
    if sys.argv[2:] == ["--update"]:
        update(Figure8.build)
    else:
        Figure8.peers = sys.argv[2:]
        unittest.main(argv=sys.argv[:1])
