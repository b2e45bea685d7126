#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of experiment 07 from moving_walls.csv.

usage: summarize.py DIR     writes tables.md, and steps and vertices as .gp, .png, .svg and .pdf, into DIR

Without gnuplot the tables and the plots' scripts are written, and the program says so and returns 3.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import read_rows, table, unique  # noqa: E402

OWN = "cellwalk"
ARITHMETICS = ["float", "double", "exact"]
PARTS = ["update_us", "query_us", "answer_us"]


def number(text):
    if not text:
        return ""
    value = float(text)
    return f"{value:,.3g}" if abs(value) < 99.95 else f"{value:,.0f}"


def per_step(row, column):
    return int(row[column]) / int(row["steps"])


def exact(rows):
    return [r for r in rows if r["arithmetic"] == "exact"]


def scene_table(scenes):
    lines = []
    for name, rows in scenes.items():
        r = rows[0]
        lines.append([f"`{name}`", *(f"{int(r[k]):,}" for k in ["cells", "points", "walls"]),
                      *(f"{per_step(r, k):,.0f}" for k in ["point_moves", "moves"]), f"{int(r['dropped']):,}",
                      *(f"{int(r[k]):,}" for k in ["judged", "blocked", "touches"])])
    return table(["scene", "cells", "points", "wall triangles", "points asked to move a step", "wall vertices that move a step",
                  "moves dropped", "judged", "of these blocked", "touches"], lines)


def wrong_table(scenes):
    """Missed and false answers. They depend on the arithmetic only, unless a hierarchy loses pairs."""
    lines = []
    for name, rows in scenes.items():
        cells = [f"{rows[0]['missed']} / {rows[0]['false']}"]
        for a in ARITHMETICS:
            found = unique(f"{r['missed']} / {r['false']}" for r in rows if r["arithmetic"] == a and r["method"] != OWN)
            cells.append("; ".join(found))
        lines.append([f"`{name}`", f"{int(rows[0]['judged']):,}", f"{int(rows[0]['blocked']):,}", *cells])
    return table(["scene", "judged", "blocked", "Cellwalk", *(f"peers, {a}" for a in ARITHMETICS)], lines)


def method_table(scenes):
    """Missed and false answers of each method in all scenes."""
    rows = [r for of_scene in scenes.values() for r in of_scene]
    lines = []
    for method in unique(r["method"] for r in rows):
        cells = []
        for a in ARITHMETICS:
            found = [r for r in rows if r["method"] == method and r["arithmetic"] == a]
            cells.append(" / ".join(f"{sum(int(r[k]) for r in found):,}" for k in ("missed", "false")) if found else "")
        lines.append([method, *cells])
    return table(["method", *ARITHMETICS], lines)


def time_table(scenes, cell):
    """A line a method, with exact tests, and a column a scene."""
    methods = unique(r["method"] for rows in scenes.values() for r in rows)
    found = {(name, r["method"]): r for name, rows in scenes.items() for r in exact(rows)}
    return table(["method", *scenes], [[m, *(cell(found[name, m]) if (name, m) in found else "" for name in scenes)] for m in methods])


def step_table(scenes):
    """The table of the README: a line a scene, a column a method."""
    methods = unique(r["method"] for rows in scenes.values() for r in rows)
    lines = []
    for name, rows in scenes.items():
        found = {r["method"]: r for r in exact(rows)}
        lines.append([f"`{name}`", f"{int(rows[0]['cells']):,}", f"{per_step(rows[0], 'moves'):,.0f}",
                      *(number(found[m]["step_us"]) if m in found else "" for m in methods)])
    return table(["scene", "cells", "wall vertices that move", *methods], lines)


def parts(row):
    return " + ".join(number(row[k]) for k in PARTS)


def per_vertex(row):
    return float(row["step_us"]) * 1000 / max(per_step(row, "moves"), 1e-9)


def work_table(scenes):
    """Cellwalk's, and that of one peer: hierarchies give the same pairs, in another order."""
    keys = ["pairs", "tests", "signs", "exact_signs"]
    lines = []
    for name, rows in scenes.items():
        own = rows[0]
        peer = next((r for r in exact(rows) if r["method"] != OWN), None)
        lines.append([f"`{name}`", *(number(str(per_step(own, k))) for k in ["pairs", "signs", "exact_signs"]),
                      *(number(str(per_step(peer, k))) if peer else "" for k in keys)])
    return table(["scene", "Cellwalk: edges in stars", "signs", "in exact numbers", "a peer: pairs whose boxes meet", "tests", "signs",
                  "in exact numbers"], lines)


def by_movers(scenes):
    return {m: {n: rows for n, rows in scenes.items() if rows[0]["movers"] == m} for m in unique(r[0]["movers"] for r in scenes.values())}


def arithmetic_table(scenes):
    """What testing the pairs takes by each arithmetic."""
    lines = []
    for name, rows in scenes.items():
        method = next((r["method"] for r in rows if r["method"] != OWN), None)
        own = {r["arithmetic"]: r for r in rows if r["method"] == method}
        lines.append([f"`{name}`", number(str(per_step(own["exact"], "tests"))), *(number(own[a]["answer_us"]) for a in ARITHMETICS)])
    return table(["scene", "tests a step", *(f"{a}, us a step" for a in ARITHMETICS)], lines)


def tables(scenes):
    timed = all(rows[0]["step_us"] for rows in scenes.values())
    text = "# Moving walls: results\n\n## Scenes\n\n" + scene_table(scenes)
    text += "\n## Wrong answers: missed / false\n\n" + wrong_table(scenes) + "\n" + method_table(scenes)
    if timed:
        text += "\n## Microseconds a step, exact tests\n\n" + step_table(scenes)
    for movers, group in by_movers(scenes).items():
        if not timed:
            break
        text += f"\n## {movers}: nanoseconds a wall vertex that moves, exact tests\n\n" + time_table(group, lambda r: number(str(per_vertex(r))))
        text += f"\n## {movers}: microseconds for boxes and hierarchy + pairs + tests (Cellwalk: certificates + 0 + moves)\n\n"
        text += time_table(group, parts)
    if timed:
        text += "\n## Tests of pairs by arithmetic\n\n" + arithmetic_table(scenes)
        whole = by_movers(scenes).get("all", scenes)
        text += "\n## Megabytes held\n\n" + time_table(whole, lambda r: number(str(int(r["bytes"]) / 1e6)))
    return text + "\n## Work a step, exact tests\n\n" + work_table(scenes)


def line(group, method, value):
    return [(int(r["cells"]), value(r)) for rows in group.values() for r in exact(rows) if r["method"] == method]


def scripts(scenes):
    result = {}
    for movers, group in by_movers(scenes).items():
        methods = unique(r["method"] for rows in group.values() for r in rows)
        series = {("Cellwalk" if m == OWN else m): line(group, m, lambda r: float(r["step_us"])) for m in methods}
        result[f"steps_{movers}"] = plots.line_plot(series, "cells (count)", "time of a step with exact tests (us)", "xy")
        if movers == "all":
            series = {("Cellwalk" if m == OWN else m): line(group, m, per_vertex) for m in methods}
            result["vertices_all"] = plots.line_plot(series, "cells (count)", "time of a wall vertex that moves, exact tests (ns)", "xy")
    return result


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    rows = read_rows(folder / "moving_walls.csv")
    scenes = {s: [r for r in rows if r["scene"] == s] for s in unique(r["scene"] for r in rows)}
    (folder / "tables.md").write_text(tables(scenes), encoding="utf-8")
    if not all(r["step_us"] for r in rows):
        print("summarize: no times: no plots")
        return 0
    drawn = [plots.draw(folder, name, script) for name, script in scripts(scenes).items()]
    return 0 if all(drawn) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
