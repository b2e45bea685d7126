#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks that the report takes its numbers from the outputs of the experiments; these are made up for that."""

import csv
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import collect_numbers

HERE = Path(__file__).resolve().parent
REPORT = "".join(path.read_text(encoding="utf-8") for path in sorted(HERE.glob("*.tex")))
MANIFEST = {"commit": "0123456789abcdef", "compiler": "GNU 12", "processor": "some_processor"}


def write(folder, name, rows):
    with (folder / name).open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


def figure_8(folder, peers=True, paper=200, kept=8, rigid=True, on_map=True, regions=True):
    methods = {"cellwalk_three_segments": 10, "cellwalk_triangle": 15, "double_walk": 30}
    if peers:
        methods |= {"bullet_swept_box": paper, "bullet_kept_box": kept}
    if on_map:
        methods["map_walk"] = 120
    if regions:
        methods["double_regions"] = 4
    write(folder, "figure_8.csv", [
        {"trace": f"{motion}n_{n}", "cells": n, "method": m, "ns_per_vertex_move": ns / parts * (1 if n == 1000 else 1.5), "missed": 0, "false": 0,
         "hits": 300, "steps": 40 // parts, "moves": 72000 // parts, "held": 216 if parts == 1 else 360, "clear_moves": 72000 - 18 * n // 5,
         "bytes_per": 250.4 if m == "cellwalk_triangle" else 104}
        for motion, parts in (("", 1), ("rigid_", 2))[:1 + rigid] for n in (1000, 10000) for m, ns in methods.items()])


def exact_versus_float(folder, variable="mesh"):
    verdicts = {"missed_wall": 1, "false_contact": 2, "stuck": 3, "lost": 4}
    write(folder, "walks.csv", [
        {"dimension": d, "kernel": k, "variable": variable, "value": "liver.msh", "motions": 1000, "wrong": wrong, **(verdicts if wrong else dict.fromkeys(verdicts, 0))}
        for d in (2, 3) for k, wrong in (("exact", 0), ("adaptive", 0), ("double", 10), ("double_1e-9", 20))])
    write(folder, "sweeps.csv", [
        {"dimension": d, "method": m, "sweeps": 500, "blocked": 100, "wrong": wrong, "missed": wrong, "false_contact": 0}
        for d in (2, 3) for m, wrong in (("triangle", 0), ("three_segments", 7), ("walks_lazy", 99))])


def small_obstacles(folder):
    settings = [{"dimension": d, "edge_over_step": 1, "size_over_step": s} for d in (2, 3) for s in (0.0625, 1)]
    missed = [0 if s["dimension"] == 2 and s["size_over_step"] == 1 else 5 for s in settings]
    write(folder, "sweeps.csv", [{**s, "sweeps": 100, "contacts": 12, "expected_contacts": 12.4, "edge_contacts": 10, "missed": n,
                                  "false_contacts": 0, "missed_share": n / 10} for s, n in zip(settings, missed)])
    write(folder, "costs.csv", [{**s, "sweep": k, "signs": n, "sweeps": 100, "event_sweeps": 3}
                                for s in settings for k, n in (("three_segments", 10), ("complete", 40))])
    write(folder, "spikes.csv", [{"aim": a, "sharpness": g, "faces": 50, "pierced": 40, "beyond_bound": 0, "share_of_bound_max": 0.98,
                                  "depth_max": 0.5 * g, "bound": 0.51 * g, "pierced_with_faces": 0} for a in ("random", "worst") for g in (1, 8)])
    write(folder, "floating.csv", [{"size_over_inradius": s, "faces": 50, "passed_share": 0.6, "passed_with_faces": 0} for s in (0.25, 2)])


def contact_search(folder, late=None, limited=1000):
    late = late or {"dichotomic": 0}
    kinds = [("exact", ""), ("exhaustive", ""), ("exhaustive_unlimited", ""), ("exhaustive_traversed", ""),
             *(("dichotomic", k) for k in (10, 20, 30)), ("dichotomic_segment", 20)]
    rows = [{"world": w, "search": s, "tolerance_bits": k} for w in ("room", "vessel") for s, k in kinds]
    write(folder, "errors.csv", [{**r, "contacts": 50, "same_time": 49, "late": late.get(r["search"], 10), "none_found": 5, "late_max": 0.8,
                                  "early_max": 0.75 * 2 ** -(r["tolerance_bits"] or 0), "gap_max": 1e-6, "normal_median": 9} for r in rows])
    write(folder, "costs.csv", [{**r, "signs": {"dichotomic": 20000, "dichotomic_segment": 1050, "exhaustive": limited}.get(r["search"], 1000)}
                                for r in rows])


def degenerate_worlds(folder):
    write(folder, "degenerate.csv", [
        {"dimension": d, "world": w, "placement": p, "motion": m, "kernel": k, "motions": 50, "wrong": wrong if p == "turned" else 0}
        for d in (2, 3) for w, wrong_3d in (("lattice", 10), ("coplanar_walls", 20)) for p in ("integer", "turned")
        for m in ("along_edges", "to_walls")
        for k, wrong in (("exact", 0), ("lazy", 0), ("double", wrong_3d if d == 3 else 0), ("double_1e-9", 1), ("float", 25))])
    write(folder, "touches.csv", [
        {"dimension": d, "motion": m, "motions": 50, "blocked": 10, "contacts_with_stop": 40, "wrong_with_stop": 0}
        for d in (2, 3) for m in ("along_edges", "to_walls")])


def real_scenes(folder, scenes=4, rounded=True):
    methods = {"cellwalk_complete": ("cellwalk", 1, 200), "bullet_group": ("bullet", 0, 100), "embree_16": ("embree", 0, 150), "cgal_body": ("cgal", 1, 160)}
    methods = {m: method for m, method in methods.items() if rounded or method[1]}
    write(folder, "real_scenes.csv", [
        {"scene": s, "method": m, "margin_steps": margin, "library": library, "exact": exact, "cells": 5000, "moves": 1000, "blocked": 40,
         "missed": 0 if exact else 2, "false": 0 if exact else 3, "step_us_p999": ns, "step_us_max": 2 * ns,
         "ns_per_vertex_move": ns * margin * (1.5 if "finer" in s and library == "cellwalk" else 1)}
        for s, of_scene in [*((s, methods) for s in ("S1a_vessel", "S5_rigid_ring", "S5_rigid_ring_finer_2", "S6_at_rest")[:scenes]),
                            ("T1_thick_05", {"cellwalk_complete": methods["cellwalk_complete"], "cgal_doubles_body": ("cgal", 0, 50)})]
        for m, (library, exact, ns) in of_scene.items() for margin in ((1,) if library == "cellwalk" else (1, 2))])


def moving_walls(folder, own=900):
    kinds = [("cellwalk", "exact", own)] + [(m, a, 90) for m in ("bullet_refit", "bullet_partial") for a in ("float", "double", "exact")]
    write(folder, "moving_walls.csv", [
        {"scene": f"{z}_{w}", "movers": w, "cells": n, "steps": 8, "moves": 80, "judged": 70, "blocked": 7, "bad_stops": 0, "method": m, "arithmetic": a,
         "missed": 2 if a == "float" else 0, "false": 3 if a != "exact" else 0, "step_us": us * (2 if w == "all" and m == "cellwalk" else 1)}
        for z, n in (("coarse", 1000), ("fine", 20000)) for w in ("one", "all") for m, a, us in kinds])


def scaling(folder, ghosts=10):
    scenes, ranks = (("hexahedra", 2000), ("catheter", 100)), (2, 8, 64)
    write(folder, "handovers.csv", [{"scene": s, "ranks": k, "steps": 20, "vertices": 1000, "moved": k, "edges": 0 if s == "catheter" else 500, "parted": k,
                                     "most_vertices": 1500 // k} for s, _ in scenes for k in ranks])
    write(folder, "parts.csv", [{"scene": s, "ranks": k, "cells": n, "ghosts": ghosts * k} for s, n in scenes for k in ranks])


def ablation(folder, swept=9):
    scenes, worlds = ("catheter", "fine_catheter", "hexahedra"), (("boxes", 0.0625), ("boxes", 0.25), ("cubes", 1))
    choices = ("all", "no_chains_in_place", "no_certificate_of_edges")
    signs = {"all": 10, "no_chains_in_place": 50, "no_certificate_of_edges": 200}
    keys = [{"scene": s, "regions": g, "certificates": c} for s in scenes for g in (1, 0) for c in choices]
    write(folder, "certificates.csv", [{**k, "moves": 1000, "held": 20, "different": 0, "edges": 300 if k["regions"] else 2400, "event_sweeps": 2, "relinked": 6,
                                        "signs": signs.get(k["certificates"], 10)} for k in keys])
    ways = ("planes", "planes_no_own_cell_first", "planes_no_forecast", "signs", "signs_no_forecast", "simplex", "simplex_no_forecast",
            "lazy_signs", "rational_signs")
    write(folder, "flights.csv", [{"world": w, "length_over_edge": n, "way": y, "moves": 100, "different": 0, "plane_blocks": 200,
                                   "signs": 3 if "planes" in y else 1000 - 50 * (n == 0.05 and y == "simplex")}
                                  for w in ("vessel", "hexahedra") for n in (0.05, 0.5) for y in ways])
    write(folder, "orders.csv", [
        {"world": w, "size": z, "motion": m, "step_over_edge": s, "made": 1000, "together": 100, "p_first_only": 5 if m != "shift" else 0,
         "together_only": 2 if m == "independent" else 0, "orders_differ": 7 if m != "shift" else 0, "any_order_only": 0, "no_order": 0, "wrong": 0}
        for w, z in worlds for m in ("shift", "turn", "independent") for s in (0.125, 1)])
    write(folder, "asked.csv", [{"scene": s, "moves": 1000, "vertices_blocked": 30, "edges": 1900, "swept": swept, "unseen": 3, "unseen_high": 0.646,
                                 "wrong": 0} for s in scenes])
    write(folder, "stops.csv", [{"scene": s, "sweep": w, "contacts": 40, "of_edges": 4, "through": n} for s in scenes
                                for w, n in (("three_segments", 2), ("complete", 0))])
    write(folder, "forms.csv", [{"mesh": m, "form": f, "cells_read": 100, "not_planar": bent, "cells": n, "bytes": 250 * n, "moves": 100,
                                 "crossings": 2 * n} for m, bent in (("hexahedra", 0), ("hexahedra_turned", 90))
                                for f, n in (("polyhedra", 550 if bent else 100), ("tetrahedra", 600))])


MADE_UP = {"figure_8": figure_8, "exact_versus_float": exact_versus_float, "small_obstacles": small_obstacles,
           "contact_search": contact_search, "degenerate_worlds": degenerate_worlds,
           "real_scenes": real_scenes, "moving_walls": moving_walls, "scaling": scaling, "ablation": ablation}


class CollectNumbers(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.runs = []
        for name, make in MADE_UP.items():
            folder = self.root / name
            folder.mkdir()
            make(folder)
            (folder / "manifest.json").write_text(json.dumps(MANIFEST), encoding="utf-8")
            self.runs.append(f"{name}={'full' if name == 'figure_8' else 'quick'}:{folder}")

    def tearDown(self):
        self.folder.cleanup()

    def collect(self, *runs):
        return subprocess.run([sys.executable, HERE / "collect_numbers.py", "--no-figures", self.root / "out", *runs],
                              capture_output=True, text=True, check=False)

    def macros(self, of=""):
        """Those of all experiments, or of one."""
        self.assertEqual("", self.collect(*(run for run in self.runs if run.startswith(of))).stderr)
        text = (self.root / "out" / "numbers.tex").read_text(encoding="utf-8")
        return dict(re.findall(r"\\newcommand\{\\(\w+)\}\{(.*)\}\n", text))

    def test_macros_have_the_numbers_of_the_outputs(self):
        macros = self.macros()
        self.assertEqual("1.5", macros["FigEightGrowth"])
        self.assertIn("compares with takes 20 times as long", macros["FigEightBullet"])
        self.assertEqual(("40", "3"), (macros["FigEightSteps"], macros["FigEightHeld"]))
        self.assertIn(r"(20 steps; walls hold 10 of 1,000 moves), the complete sweep takes 7.5 to 11\,ns, three segments 5 to 7.5\,ns, Bullet with",
                      macros["FigEightRigid"])
        self.assertEqual("50.0", macros["FigEightClear"])
        self.assertIn("three segments with exact signs and contacts take 2.5 times the time of the same segments in doubles", macros["FigEightPrice"])
        self.assertIn(r"Walks in doubles with regions, which are not proved free and give no contact, take 4 to 6\,ns", macros["FigEightDoubles"])
        self.assertIn("the complete sweep takes 0.5 times the time of a walk in doubles.", macros["FigEightDoubles"])
        self.assertEqual(("4\\,000", "0"), (macros["ExactWalks"], macros["ExactWalksWrong"]))
        self.assertEqual(("1.0", "2.0"), (macros["DoubleWrong"], macros["TolerantWrong"]))
        self.assertEqual(("0", "14"), (macros["SegmentsFalse"], macros["SegmentsMissed"]))
        self.assertEqual(("40", "15", "4", "3.0"), tuple(macros[n] for n in ("SweepContacts", "SweepMissed", "SignRatioMost", "SweepEventsMost")))
        self.assertEqual(("50.0", "50.0", "none in 2D where it is 1 or more"), tuple(macros[f"Missed{n}"] for n in ("SixteenthLeast", "SpaceLeast", "Planar")))
        self.assertEqual(("98.0", "8", "63"), (macros["FallsShare"], macros["DeepestInradii"], macros["FallsDisplacements"]))
        self.assertIn(r"takes 120 to 180\,ns, 12 times as long as three segments over tables, with 0 wrong answers", macros["FigEightMap"])
        self.assertIn("take 250 bytes a cell there, Bullet's hierarchy 104 a wall triangle", macros["FigEightMemory"])
        self.assertEqual(("20.0", "20", "0", "75.0", "1.05"),
                         tuple(macros[f"Search{n}"] for n in ("LateMost", "Ratio", "BisectionLate", "BisectionEarly", "SegmentRatio")))
        self.assertEqual(("1\\,600", "0", "0"), tuple(macros[f"Degenerate{n}"] for n in ("Walks", "Wrong", "Integer")))
        self.assertEqual(("20.0", "40.0"), (macros["DegenerateDoubleLeast"], macros["DegenerateDoubleMost"]))
        self.assertEqual(("200", "20.0", "80.0"), tuple(macros[f"Degenerate{n}"] for n in ("Touches", "ToWallsPass", "ToWallsStop")))
        self.assertEqual("0", macros["DegeneratePlanarDouble"])
        self.assertEqual(("8", "5", "5", "20", "2.0"),
                         tuple(macros[f"Ablation{n}"] for n in ("Regions", "PlaceCatheters", "PlaceHexahedra", "Edges", "Relinked")))
        self.assertEqual(("30", "5.0", "0.05", "none there", ""),
                         tuple(macros[f"Flight{n}"] for n in ("PlaneSigns", "Forecast", "ForecastLength", "ForecastOthers", "Rational")))
        self.assertEqual(("5.0", "2.0", "7.0"), tuple(macros[f"Order{n}"] for n in ("SmallMore", "LargeFewer", "LargeDiffer")))
        self.assertEqual(("300", "15", "6", "21"), tuple(macros[f"OrderShortest{n}"] for n in ("Together", "More", "Fewer", "Differ")))
        self.assertIn(r"at most 64.6\,\% with 95\,\% confidence", macros["RodUnseenHigh"])
        self.assertEqual(("18", "6", "6", "0"), tuple(macros[n] for n in ("RodSwept", "RodUnseen", "StopsSegmentsThrough", "StopsCompleteThrough")))
        self.assertEqual(("6", "1", "5.5", "5.5"), tuple(macros[f"Form{n}"] for n in ("Memory", "Bent", "Growth", "TurnedMemory")))
        self.assertEqual((r"late in up to 20.0\,\% of the contacts of a world, by up to 0.8 of the motion", "10.0", "2", "2"),
                         tuple(macros[f"Search{n}"] for n in ("SegmentLate", "SegmentNone", "UnlimitedDiffer", "ExhaustiveDiffer")))
        self.assertEqual(("4", "4\\,000", "0", "0"), tuple(macros[f"App{n}"] for n in ("Scenes", "Moves", "Wrong", "ExactWrong")))
        self.assertIn("Bullet misses 8 blocked moves and makes up 12 (5 of these where bodies rest on oblique walls), Embree misses 8", macros["AppRounded"])
        self.assertEqual(("2.0 to 3.0", "1.2 to 1.9", "2.0 to 2.0 (Bullet, group)"), tuple(macros[f"App{n}"] for n in ("Fastest", "FastestExact", "Rings")))
        self.assertEqual(" The fastest peers are kept boxes in 4 of the scenes.", macros["AppKinds"])
        self.assertIn("are 2 times shorter in the same walls, we take 1.5 times as long, and the fastest peer 1 times", macros["AppFiner"])
        self.assertIn("at most 200\\,\\textmu s, and the longest of all takes 400", macros["AppCatheterSteps"])
        self.assertIn("leaves 5 times the former", macros["AppCatheterSteps"])
        self.assertEqual(("280", "28", "0", "0"), tuple(macros[f"Wall{n}"] for n in ("Judged", "Blocked", "Wrong", "ExactFalse")))
        self.assertEqual(("8", "12", "0", "12"), tuple(macros[f"Wall{n}"] for n in ("FloatMissed", "FloatFalse", "DoubleMissed", "DoubleFalse")))
        self.assertIn("10 times as long as the fastest hierarchy if one vertex moves (Bullet, in part), and 20 times if all do", macros["WallTimes"])
        self.assertIn("refitted as a whole or built take 0.1 times as long", macros["WallTimes"])
        self.assertEqual(("0.8", "8", "200"), tuple(macros[f"Scaling{n}"] for n in ("HandedMost", "RanksMost", "CellsLeast")))
        self.assertEqual("1.5 times the mean (hexahedra, 2 ranks)", macros["ScalingFullest"])
        self.assertEqual("a full run of experiment 01, and quick runs of the others", macros["RunKinds"])

    def test_claims_are_made_only_where_the_outputs_have_them(self):
        """What is said of the outputs made up above, and of others that do not have it."""
        for name, make, other, macro, claim in (
                ("figure_8", figure_8, {"paper": 5}, "FigEightBullet", "the original conclusion holds"),
                ("figure_8", figure_8, {"kept": 300}, "FigEightBullet", "a stronger competitor"),
                ("figure_8", figure_8, {"rigid": False}, "FigEightRigid", "aim at rigid cubes"),
                ("figure_8", figure_8, {"peers": False}, "FigEightRigid", "Bullet with kept boxes"),
                ("figure_8", figure_8, {"on_map": False}, "FigEightMap", "from dart to dart"),
                ("figure_8", figure_8, {"peers": False}, "FigEightMemory", "Bullet's hierarchy"),
                ("figure_8", figure_8, {"regions": False}, "FigEightPrice", "with exact signs and contacts"),
                ("exact_versus_float", exact_versus_float, {"variable": "scale"}, "ExactMeshes", "1 are public meshes"),
                ("contact_search", contact_search, {"late": {"dichotomic_segment": 0}}, "SearchSegmentLate", "late in up to"),
                ("real_scenes", real_scenes, {"rounded": False}, "AppRounded", "Bullet misses"),
                ("real_scenes", real_scenes, {"scenes": 2}, "AppFiner", "times shorter"),
                ("moving_walls", moving_walls, {"own": 50}, "WallChoice", "is the better choice"),
                ("ablation", ablation, {"swept": 0}, "RodUnseenHigh", "at most"),
                ("scaling", scaling, {"ghosts": 1}, "ScalingGhosts", "more cells of others than their own")):
            with self.subTest(macro=macro, claim=claim):
                self.assertIn(claim, self.macros(name)[macro])
                make(self.root / name, **other)
                self.assertNotIn(claim, self.macros(name)[macro])
                make(self.root / name)
        self.assertNotIn("costs more signs", self.macros("contact_search")["SearchLimit"])
        contact_search(self.root / "contact_search", limited=1010)
        self.assertIn("costs more signs than it spares", self.macros("contact_search")["SearchLimit"])

    def test_tables_show_the_outputs(self):
        self.macros()
        out = self.root / "out"
        self.assertIn(r"Bullet, a box an edge & 200 & 300 & 0 / 0 \\", (out / "table_figure_8.tex").read_text(encoding="utf-8"))
        self.assertIn(r"3D & \texttt{double} & 1\,000 & 10 & 1.0 & 1 & 2 & 7 \\", (out / "table_walks.tex").read_text(encoding="utf-8"))
        self.assertNotIn("adaptive", (out / "table_walks.tex").read_text(encoding="utf-8"))
        self.assertIn(r"\texttt{0123456789ab} & GNU 12 & some\_processor", (out / "table_runs.tex").read_text(encoding="utf-8"))
        self.assertIn(r"coplanar walls & 0.0 & 50.0 & 40.0 & 50.0 \\", (out / "table_degenerate.tex").read_text(encoding="utf-8"))
        self.assertIn(r"no regions; no chains in place & 2 & 0.05 &", (out / "table_certificates.tex").read_text(encoding="utf-8"))
        self.assertIn(r"hexahedra turned & polyhedra & 100 & 90 & 550 & 1\,375 & 11 &", (out / "table_forms.tex").read_text(encoding="utf-8"))
        self.assertIn(r"rigid ring, cells 1/2 & 5\,000 & 4.0 & 300 & 200 / 400 & Bullet, group & 100 & 100 / 200 & CGAL, body & 160 &",
                      (out / "table_application.tex").read_text(encoding="utf-8"))
        self.assertIn(r"20\,000 & one & 10 & 900 & 90 & 90 \\", (out / "table_moving_walls.tex").read_text(encoding="utf-8"))
        self.assertIn(r"catheter & 8 & 12 & 1.5 & 0.8 &  & 80 \\", (out / "table_scaling.tex").read_text(encoding="utf-8"))
        self.assertNotIn("lazy", (out / "table_sweeps.tex").read_text(encoding="utf-8"))

    def test_report_uses_what_is_written_and_nothing_else(self):
        macros = self.macros()
        used = set(re.findall(r"\\([A-Z][A-Za-z]+)", REPORT))
        self.assertEqual(set(macros), used)
        tables = set(re.findall(r"\\input\{(table_\w+\.tex)\}", REPORT))
        self.assertEqual({p.name for p in (self.root / "out").glob("table_*.tex")}, tables)

    def test_report_shows_the_plots_that_are_drawn(self):
        drawn = {f"{name}_{plot}.pdf" for name, plots in collect_numbers.FIGURES.items() for plot in plots}
        shown = set(re.findall(r"\\includegraphics(?:\[[^\]]*\])?\{([^}]*)\}", REPORT))
        self.assertEqual(drawn | {"face_3d.png"}, shown)
        self.assertTrue((HERE.parent / "docs" / "images" / "face_3d.png").exists())

    def test_without_bullet_the_report_says_so(self):
        figure_8(self.root / "figure_8", peers=False)
        self.assertIn("Bullet was not installed", self.macros()["FigEightBullet"])

    def test_citations_resolve_and_all_references_are_cited(self):
        keys = re.findall(r"@\w+\{(\w+),", (HERE / "references.bib").read_text(encoding="utf-8"))
        self.assertEqual(len(keys), len(set(keys)))
        self.assertEqual(set(keys), {key for group in re.findall(r"\\cite\{([^}]*)\}", REPORT) for key in group.split(",")})

    def test_all_parts_of_the_text_are_there(self):
        parts = set(re.findall(r"\\input\{([^}]*)\}", REPORT)) - {"numbers.tex"}
        self.assertEqual({path.name for path in HERE.glob("*.tex")} - {"report.tex"}, {p for p in parts if not p.startswith("table_")})

    def test_cross_references_resolve(self):
        labels = re.findall(r"\\label\{([^}]*)\}", REPORT)
        self.assertEqual(len(labels), len(set(labels)))
        self.assertLessEqual(set(re.findall(r"\\ref\{([^}]*)\}", REPORT)), set(labels))

    def test_no_proof_is_left_to_the_documentation(self):
        self.assertNotIn("docs/", REPORT)

    def test_a_missing_output_is_named(self):
        for name in ("walks.csv", "manifest.json"):
            (self.root / "exact_versus_float" / name).unlink()
            result = self.collect(*self.runs)
            self.assertNotEqual(0, result.returncode)
            self.assertIn(f"{name} is missing", result.stderr)
            exact_versus_float(self.root / "exact_versus_float")

    def test_a_wrong_argument_is_refused(self):
        for argument in ("figure_9=full:x", "figure_8=half:x", "figure_8"):
            result = self.collect(argument)
            self.assertNotEqual(0, result.returncode)
            self.assertIn(argument, result.stderr)


if __name__ == "__main__":
    unittest.main()
