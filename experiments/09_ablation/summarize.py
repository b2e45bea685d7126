#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of experiment 09 from its CSV files.

usage: summarize.py DIR     writes tables.md, and orders as .gp, .png, .svg and .pdf, into DIR

Without gnuplot the tables and the plot's script are written, and the program says so and returns 3.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import read_rows_if_any, share, table  # noqa: E402


def count(text):
    return f"{int(text):,}"


def a_thousand(value, moves):
    return f"{1000 * int(value) / int(moves):,.3g}"


def spoken(name):
    return name.replace("_", " ")


def number(text):
    return f"{float(text):,.3g}" if float(text) < 1000 else f"{float(text):,.0f}"


def certificate_table(rows, times):
    known = {(r["scene"], r["regions"], r["certificates"]): r["ns_per_vertex_move"] for r in times}
    columns = ["in_region", "region_walls", "edges", "walks", "crossings", "event_sweeps", "plane_blocks", "signs", "exact_signs"]
    header = ["scene", "regions", "certificates", *(spoken(c) for c in columns), "ns a move", "ratio"]
    lines = []
    for r in rows:
        time = known.get((r["scene"], r["regions"], r["certificates"]), "")
        first = known.get((r["scene"], "1", "all"), "")
        lines.append([r["scene"], "yes" if r["regions"] == "1" else "no", spoken(r["certificates"]),
                      *(a_thousand(r[c], r["moves"]) for c in columns), number(time) if time else "",
                      f"{float(time) / float(first):.2f}" if time else ""])
    return table(header, lines, 3)


def flight_table(rows, times):
    known = {(r["world"], r["length_over_edge"], r["way"]): r["ns_per_move"] for r in times}
    columns = ["crossings", "plane_blocks", "side_tests", "along_tests", "turns", "signs", "exact_signs"]
    header = ["world", "length / edge", "way", "moves", *(spoken(c) for c in columns), "ns a move"]
    lines = []
    for r in rows:
        time = known.get((r["world"], r["length_over_edge"], r["way"]), "")
        lines.append([r["world"], r["length_over_edge"], spoken(r["way"]), count(r["moves"]),
                      *(f"{int(r[c]) / int(r['moves']):,.3g}" for c in columns), number(time) if time else ""])
    return table(header, lines, 3)


def order_table(rows):
    header = ["world", "side", "motion", "step / edge", "steps", "blocked, together", "p first", "q first", "p first, not together",
              "95 % interval", "together, not p first", "95 % interval", "one order only", "both orders, not together", "together, no order"]
    return table(header, [
        [r["world"], r["size"], r["motion"], r["step_over_edge"], count(r["made"]), count(r["together"]), count(r["p_first"]), count(r["q_first"]),
         share(r["p_first_only"], r["made"]), interval(r, "p_first_only"), share(r["together_only"], r["made"]), interval(r, "together_only"),
         share(r["orders_differ"], r["made"]), share(r["any_order_only"], r["made"]), share(r["no_order"], r["made"])] for r in rows], 3)


def interval(row, name):
    return f'{100 * float(row[name + "_low"]):.2g} to {100 * float(row[name + "_high"]):.2g} %'


def asked_table(rows):
    return table(["scene", "moves", "vertices blocked", "edges", "swept by a wall", "of these at the end", "unseen", "unseen, %", "95 % interval",
                  "moves around an obstacle"],
                 [[r["scene"], count(r["moves"]), count(r["vertices_blocked"]), count(r["edges"]), count(r["swept"]), count(r["at_end"]), count(r["unseen"]),
                   f'{100 * float(r["unseen_share"]):.3g}' if r["unseen_share"] else "", interval(r, "unseen"), count(r["rounds"])] for r in rows])


def stop_table(rows):
    return table(["scene", "sweep", "moves", "contacts", "of edges", "moves through walls", "steps with such moves", "undecided"],
                 [[r["scene"], spoken(r["sweep"]), *(count(r[c]) for c in ("moves", "contacts", "of_edges", "through", "steps_through", "undecided"))]
                  for r in rows], 2)


def form_table(rows, times):
    known = {(r["mesh"], r["form"]): r["ns_per_move"] for r in times}
    lines = []
    for r in rows:
        time = known.get((r["mesh"], r["form"]), "")
        lines.append([r["mesh"], r["form"], count(r["cells_read"]), count(r["not_planar"]), count(r["not_convex"]), count(r["cells"]),
                      count(r["facets"]), f'{int(r["bytes"]) / int(r["cells_read"]):,.0f}', f'{int(r["crossings"]) / int(r["moves"]):.3g}',
                      number(time) if time else ""])
    return table(["mesh", "form", "cells read", "not planar", "not convex", "cells", "sides of facets", "bytes a cell read", "crossings a move",
                  "ns a move"], lines, 2)


def draw_orders(folder, rows):
    series = {}
    for r in rows:
        if r["motion"] == "shift":
            continue
        world = "solid cubes" if r["world"] == "cubes" else f'boxes of {r["size"]}'
        series.setdefault(f'{world}, {r["motion"]}', []).append(
            (float(r["step_over_edge"]), *(100 * float(r[f"p_first_only_{c}"]) for c in ("share", "low", "high"))))
    tics = {r["step_over_edge"] if float(r["step_over_edge"]) >= 1 else f'1/{round(1 / float(r["step_over_edge"]))}': float(r["step_over_edge"]) for r in rows}
    return plots.draw(folder, "orders", plots.line_plot(
        series, "step / length of the edge", "blocked one end after the other, free together (% of steps)", "xy", xrange="0.025:2.5",
        yrange="0.001:10", tics=tics))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    read = {name: read_rows_if_any(folder / f"{name}.csv") for name in (
        "certificates", "certificate_times", "flights", "flight_times", "orders", "asked", "stops", "forms", "form_times")}
    text = "# Ablation: results\n\n## Certificates\n\nCounts a thousand vertex moves; the ratio of times is that to all certificates.\n\n"
    text += certificate_table(read["certificates"], read["certificate_times"])
    text += "\n## Flights\n\nCounts a move.\n\n" + flight_table(read["flights"], read["flight_times"])
    text += "\n## One end after the other, and both together\n\n" + order_table(read["orders"])
    text += "\n## What three segments see of recorded motions\n\n" + asked_table(read["asked"])
    text += "\n## Vertices that stop before their first contact\n\n" + stop_table(read["stops"])
    text += "\n## Polyhedra and tetrahedra\n\n" + form_table(read["forms"], read["form_times"])
    (folder / "tables.md").write_text(text, encoding="utf-8")
    return 0 if draw_orders(folder, read["orders"]) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
