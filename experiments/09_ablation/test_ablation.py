#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs experiment 09 in its quick form, without times, and compares its answers with those in expected/.

usage: test_ablation.py BUILD_DIR [--update]     --update writes expected/ anew

The program itself refuses answers that depend on certificates, ways to walk, or that the judge does not give. Counts of work are
only compared between runs: they change with every better certificate.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import quick_case  # noqa: E402
from tables import read_rows  # noqa: E402


class Ablation(quick_case.QuickCase):
    experiment = HERE
    expected = ["orders.csv", "asked.csv", "stops.csv"]
    repeated = ["certificates.csv", "flights.csv", "forms.csv"]  # change with every better certificate
    threads = [1, 2]

    def rows(self, name):
        return read_rows(self.out / name)

    def test_each_certificate_saves_work_where_it_is_asked(self):
        rows = {(r["scene"], r["regions"], r["certificates"]): r for r in self.rows("certificates.csv")}
        self.assertEqual(3 * 9, len(rows))
        for row in rows.values():
            self.assertEqual("0", row["different"], row)
            self.assertGreater(int(row["held"]), 20, row)

        def work(scene, regions, name, column):
            return int(rows[scene, regions, name][column])
        for scene in ("catheter", "fine_catheter", "hexahedra"):
            self.assertLess(work(scene, "0", "all", "walks"), work(scene, "0", "no_chains_in_place", "walks"))
            self.assertEqual(0, work(scene, "0", "no_certificate_of_edges", "same_cell"))
            self.assertLess(work(scene, "0", "all", "signs"), work(scene, "0", "no_certificate_of_edges", "signs"))
            self.assertLess(work(scene, "0", "all", "event_sweeps"), work(scene, "0", "no_certificate_of_edges", "event_sweeps"))
        self.assertLess(work("hexahedra", "1", "all", "edges"), work("hexahedra", "0", "all", "edges"))
        self.assertEqual(0, work("fine_catheter", "1", "all", "region_cells"), "rods have no regions")

    def test_ways_to_walk_agree_and_planes_need_few_signs(self):
        rows = self.rows("flights.csv")
        self.assertEqual(2 * 3 * 9, len(rows))
        for row in rows:
            self.assertEqual("0", row["different"], row)
            if not row["way"].startswith(("lazy", "rational")):  # those of fewer particles
                self.assertGreater(int(row["blocked"]), 5, row)
        signs = {(r["world"], r["length_over_edge"], r["way"]): int(r["signs"]) for r in rows}
        for world, length, _ in signs:
            self.assertLess(2 * signs[world, length, "planes"], signs[world, length, "signs"])
            self.assertLess(signs[world, length, "simplex"], signs[world, length, "simplex_no_forecast"])

    def test_shifts_are_the_same_in_any_order_and_together(self):
        rows = self.rows("orders.csv")
        self.assertEqual(45, len(rows))
        for row in rows:
            self.assertEqual(("0", "0"), (row["wrong"], row["undecided"]), row)
            self.assertGreater(int(row["made"]), 400, row)
            if row["motion"] == "shift":
                self.assertEqual(("0", "0", "0"), (row["p_first_only"], row["together_only"], row["orders_differ"]), row)
            if row["motion"] == "turn":
                self.assertEqual("0", row["together_only"], row)
        for column in ("p_first_only", "together_only", "orders_differ"):
            self.assertGreater(sum(int(r[column]) for r in rows), 5, column)

    def test_no_move_by_the_complete_sweep_leads_through_a_wall(self):
        for row in self.rows("stops.csv"):
            self.assertGreater(int(row["contacts"]), 20, row)
            if row["sweep"] == "complete":
                self.assertEqual("0", row["through"], row)
        for row in self.rows("asked.csv"):
            self.assertEqual("0", row["wrong"], row)

    def test_forms_are_the_same_space(self):
        rows = self.rows("forms.csv")
        self.assertEqual(3 * 2, len(rows))
        for polyhedra, tetrahedra in zip(rows[::2], rows[1::2]):
            self.assertEqual((polyhedra["mesh"], "polyhedra", "tetrahedra"), (tetrahedra["mesh"], polyhedra["form"], tetrahedra["form"]))
            self.assertEqual(polyhedra["blocked"], tetrahedra["blocked"])
            self.assertGreaterEqual(int(tetrahedra["cells"]), int(polyhedra["cells"]))
            self.assertEqual(polyhedra["mesh"] == "hexahedra_turned", int(polyhedra["not_planar"]) > 0)

    def test_tables_and_plots_are_written(self):
        self.assertEqual(6, (self.out / "tables.md").read_text(encoding="utf-8").count("\n## "))
        script = (self.out / "orders.gp").read_text(encoding="utf-8")
        self.assertIn("set xlabel", script)
        self.assertIn("set ylabel", script)


if __name__ == "__main__":
    quick_case.main(Ablation)
