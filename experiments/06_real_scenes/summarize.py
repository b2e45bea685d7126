#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of experiment 06 from real_scenes.csv.

usage: summarize.py DIR     writes tables.md, and ratios and times as .gp, .png, .svg and .pdf, into DIR

Without gnuplot the tables and the plots' scripts are written, and the program says so and returns 3.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import read_rows, table, unique  # noqa: E402

OWN = {"cellwalk_three_segments": "Cellwalk, three segments", "cellwalk_complete": "Cellwalk, complete sweep"}
COMPLETE = "cellwalk_complete"
LIBRARIES = {"bullet": "Bullet", "fcl": "FCL", "embree": "Embree", "cgal": "CGAL, exact", "cgal_doubles": "CGAL, in doubles"}
STEP_TIMES = ["step_us_median", "step_us_p99", "step_us_p999", "step_us_max", "step_max_over_median"]
STEP_TITLES = ["median", "99 %", "99.9 %", "longest", "longest / median"]
WORK = ["in_region", "edges_checked", "walks", "crossings", "region_cells", "fallbacks"]
FINER = re.compile(r"(.*)_finer_([0-9.]+)")
THICK = re.compile(r"T[0-9].*")


def number(text):
    if not text:
        return ""
    value = float(text)
    return f"{value:,.1f}" if abs(value) < 99.95 else f"{value:,.0f}"


def time(row):
    return float(row["ns_per_vertex_move"])


def fastest(rows, exact=False, library=None):
    """The fastest row of a peer; `exact`: of those that decide by exact signs; `library`: of one library. None if there is none."""
    peers = [r for r in rows if r["library"] != "cellwalk" and (not exact or r["exact"] == "1") and library in (None, r["library"])]
    return min(peers, key=time, default=None)


def ratio(own, peer):
    return time(own) / time(peer)


def described(row):
    """Its time, and of which method with which margin; nothing if there is none."""
    if row is None:
        return ""
    margin = f', {row["margin_steps"]}' if row["margin_steps"] != "0" else ""
    return f'{number(row["ns_per_vertex_move"])} ({row["method"].split("_", 1)[1].replace("_", " ")}{margin})'


def of_method(rows, method):
    return next(r for r in rows if r["method"] == method)


def share_blocked(row):
    return f"{100 * int(row['blocked']) / int(row['moves']):.2g} %"


def scene_table(scenes):
    keys = ["cells", "walls", "bodies", "vertices", "edges", "steps", "moves", "blocked"]
    return table(["scene", *keys, "step length", "moves blocked", "cells an edge lies in"],
                 [[name, *(f"{int(rows[0][k]):,}" for k in keys), rows[0]["step_length"], share_blocked(rows[0]),
                   number(of_method(rows, COMPLETE)["edge_cells"])] for name, rows in scenes.items()])


def ratio_table(scenes, coarse=None):
    """A table of the README. `coarse`: the scenes with the cells that these are finer than."""
    libraries = unique(r["library"] for rows in scenes.values() for r in rows if r["library"] != "cellwalk")
    header = ["scene", "cells", "moves blocked", *OWN.values(), *(f"fastest of {LIBRARIES.get(name, name)}" for name in libraries),
              "complete / fastest", "complete / fastest exact"]
    lines = []
    for name, rows in scenes.items():
        own = {m: of_method(rows, m) for m in OWN}
        found = [fastest(rows, library=library) for library in libraries]
        lines.append([f"`{name}`", f"{int(rows[0]['cells']):,}", share_blocked(rows[0]),
                      *(number(r["ns_per_vertex_move"]) for r in own.values()), *map(described, found),
                      f"{ratio(own[COMPLETE], fastest(rows)):.2f}", f"{ratio(own[COMPLETE], fastest(rows, exact=True)):.2f}"])
        if coarse is not None:
            before = coarse.get(FINER.fullmatch(name)[1])
            lines[-1].append(f"{ratio(own[COMPLETE], of_method(before, COMPLETE)):.2f}" if before else "")
    return table(header + (["complete / with the coarse cells"] if coarse is not None else []), lines)


def step_table(scenes):
    """A table of the README: Cellwalk beside the peer that is the fastest on average."""
    lines = []
    for name, rows in scenes.items():
        for row in (of_method(rows, COMPLETE), fastest(rows)):
            margin = f', {row["margin_steps"]}' if row["margin_steps"] != "0" else ""
            lines.append([f"`{name}`", f'`{row["method"]}`{margin}', *(number(row[k]) for k in STEP_TIMES)])
    return table(["scene", "method", *STEP_TITLES], lines, 2)


def method_table(rows, timed):
    """All methods and margins in a scene."""
    header = ["method", "margin, steps", "missed", "false", "building, ms", "held, MB"]
    lines = [[r["method"], r["margin_steps"], r["missed"], r["false"], number(r["build_ms"]), number(str(int(r["bytes"]) / 1e6))]
             for r in rows]
    if timed:
        header[2:2] = ["ns a move", *STEP_TITLES]
        for line, row in zip(lines, rows):
            line[2:2] = [number(row["ns_per_vertex_move"]), *(number(row[k]) for k in STEP_TIMES)]
    return table(header, lines)


def work_table(scenes):
    lines = []
    for name, rows in scenes.items():
        for row in rows:
            if row["library"] == "cellwalk":
                counts = [f"{int(row[c]) / int(row['moves']):.3g}" for c in WORK]
                lines.append([name, row["method"], *counts])
    return table(["scene", "method", *WORK], lines, 2)


def tables(scenes):
    """All tables as Markdown."""
    timed = any(rows[0]["ns_per_vertex_move"] for rows in scenes.values())
    thick = {name: rows for name, rows in scenes.items() if THICK.fullmatch(name)}
    coarse = {name: rows for name, rows in scenes.items() if not FINER.fullmatch(name) and name not in thick}
    finer = {name: rows for name, rows in scenes.items() if FINER.fullmatch(name)}
    text = "# Real scenes: results\n\n## Scenes\n\n" + scene_table(scenes)
    if timed:
        if coarse:
            text += "\n## A vertex move with its edges\n\n" + ratio_table(coarse)
        if finer:
            text += "\n## The same among finer cells\n\n" + ratio_table(finer, coarse)
        if thick:
            text += "\n## Catheters with a radius\n\n" + ratio_table(thick)
        if coarse or thick:
            text += "\n## Steps\n\n" + step_table({**coarse, **thick})
        if finer:
            text += "\n## Steps among finer cells\n\n" + step_table(finer)
    text += "\n## Cellwalk's work a move\n\n" + work_table(scenes)
    for name, rows in scenes.items():
        text += f"\n## All methods: {name}\n\n" + method_table(rows, timed)
    return text


def marks(name, series, scenes, ylabel, line=None):
    """A script: for each scene a mark of each entry of `series`, name -> values. `line`: a height to compare with."""
    script = f"${name} << END\n"
    for i, scene in enumerate(scenes):
        script += f'"{scene}" ' + " ".join(f"{values[i]:.4g}" for values in series.values()) + "\n"
    highest = max(max(values) for values in series.values())
    lowest = min(min(values) for values in series.values())
    if line is not None:
        lowest, highest = min(lowest, line), max(highest, line)
    script += f"""END
set logscale y
set yrange [{lowest / 1.3:.4g}:{highest * 1.3:.4g}]
set xrange [-0.6:{len(scenes) - 0.4}]
set ylabel {plots.quoted(ylabel)}
set xtics rotate by -55 noenhanced
set bmargin 15
set rmargin 9
set grid xtics ytics lc rgb "#dddddd" lt 1
set key tmargin center horizontal Left reverse samplen 1 maxcols 2 width 2
"""
    if line is not None:
        script += f"set arrow from graph 0, first {line} to graph 1, first {line} nohead lw 2 dt 2\n"
    drawn = []
    for k, title in enumerate(series):
        _, mark, width, colour = plots.STYLES[k]
        drawn.append(f'${name} using 0:{k + 2}:xtic(1) with points pt {mark} lw {width} ps 1.5 lc rgb "{colour}" '
                     f'title {plots.quoted(title)}')
    return script + "plot " + ", \\\n  ".join(drawn) + "\n"


def scripts(scenes):
    own = {m: [of_method(rows, m) for rows in scenes.values()] for m in OWN}
    peers = {"fastest peer": [fastest(rows) for rows in scenes.values()],
             "fastest exact peer": [fastest(rows, exact=True) for rows in scenes.values()]}
    ratios = {f"{OWN[m]} / {name}": [ratio(a, b) for a, b in zip(own[m], found)] for name, found in peers.items() for m in OWN}
    times = {OWN[m]: [time(r) for r in own[m]] for m in OWN}
    times.update({name: [time(r) for r in found] for name, found in peers.items()})
    return {"ratios": marks("ratios", ratios, scenes, "time of Cellwalk / time of the peer", 1),
            "times": marks("times", times, scenes, "time of a vertex move with its edges (ns)")}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    rows = read_rows(folder / "real_scenes.csv")
    scenes = {s: [r for r in rows if r["scene"] == s] for s in sorted(unique(r["scene"] for r in rows))}
    (folder / "tables.md").write_text(tables(scenes), encoding="utf-8")
    if not all(r["ns_per_vertex_move"] for r in rows):
        print("summarize: no times: no plots")
        return 0
    drawn = [plots.draw(folder, name, script) for name, script in scripts(scenes).items()]
    return 0 if all(drawn) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
