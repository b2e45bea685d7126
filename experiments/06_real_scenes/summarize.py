#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of experiment 06 from real_scenes.csv.

usage: summarize.py DIR     writes tables.md, and ratios and times as .gp, .png, .svg and .pdf, into DIR

Without gnuplot the tables and the plots' scripts are written, and the program says so and returns 3.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import read_rows, table, unique  # noqa: E402

OWN = {"cellwalk_three_segments": "Cellwalk, three segments", "cellwalk_complete": "Cellwalk, complete sweep"}
LIBRARIES = {"bullet": "Bullet", "embree": "Embree", "cgal": "CGAL, exact"}
STEP_TIMES = ["step_us_median", "step_us_p99", "step_us_p999", "step_us_max"]
WORK = ["in_region", "edges_checked", "walks", "crossings", "region_cells", "fallbacks"]


def number(text):
    if not text:
        return ""
    value = float(text)
    return f"{value:,.1f}" if abs(value) < 99.95 else f"{value:,.0f}"


def time(row):
    return float(row["ns_per_vertex_move"])


def best(rows):
    """Of each method the row of its best margin; the first one without times."""
    found = {}
    for row in rows:
        known = found.get(row["method"])
        if known is None or (row["ns_per_vertex_move"] and time(row) < time(known)):
            found[row["method"]] = row
    return found


def fastest(rows, exact=False, library=None):
    """The fastest row of a peer; `exact`: of those that decide by exact signs; `library`: of one library. None if there is none."""
    peers = [r for r in rows if r["library"] != "cellwalk" and (not exact or r["exact"] == "1") and library in (None, r["library"])]
    return min(peers, key=time, default=None)


def ratio(own, peer):
    return time(own) / time(peer)


def described(row):
    """Its time, and of which method with which margin."""
    margin = f', {row["margin_steps"]}' if row["margin_steps"] != "0" else ""
    return f'{number(row["ns_per_vertex_move"])} ({row["method"].split("_", 1)[1].replace("_", " ")}{margin})'


def by_scene(scenes, cell):
    """A table with a line a method and a column a scene."""
    methods = unique(m for rows in scenes.values() for m in best(rows))
    return table(["method", *scenes],
                 [[m, *(cell(best(rows)[m]) if m in best(rows) else "" for rows in scenes.values())] for m in methods])


def scene_table(scenes):
    keys = ["cells", "walls", "bodies", "vertices", "edges", "steps", "moves", "blocked"]
    return table(["scene", *keys, "step length", "blocked, %"],
                 [[name, *(f"{int(rows[0][k]):,}" for k in keys), rows[0]["step_length"],
                   f"{100 * int(rows[0]['blocked']) / int(rows[0]['moves']):.2g}"] for name, rows in scenes.items()])


def ratio_table(scenes):
    """The table of the README."""
    libraries = unique(r["library"] for rows in scenes.values() for r in rows if r["library"] != "cellwalk")
    header = ["scene", "cells", "moves blocked", *OWN.values(), *(f"fastest of {LIBRARIES.get(name, name)}" for name in libraries),
              "complete / fastest", "complete / fastest exact"]
    lines = []
    for name, rows in scenes.items():
        own = {m: next(r for r in rows if r["method"] == m) for m in OWN}
        found = [fastest(rows, library=library) for library in libraries]
        lines.append([f"`{name}`", f"{int(rows[0]['cells']):,}", f"{100 * int(rows[0]['blocked']) / int(rows[0]['moves']):.2g} %",
                      *(number(r["ns_per_vertex_move"]) for r in own.values()), *map(described, found),
                      f"{ratio(own['cellwalk_complete'], fastest(rows)):.1f}",
                      f"{ratio(own['cellwalk_complete'], fastest(rows, exact=True)):.1f}"])
    return table(header, lines)


def margin_table(scenes):
    kept = [r for rows in scenes.values() for r in rows if r["margin_steps"] != "0"]
    keys = unique((r["method"], r["margin_steps"]) for r in kept)
    found = {(r["method"], r["margin_steps"], r["scene"]): r for r in kept}
    return table(["method", "margin, steps", *scenes],
                 [[*key, *(number(found[(*key, s)]["ns_per_vertex_move"]) if (*key, s) in found else "" for s in scenes)] for key in keys], 2)


def work_table(scenes):
    lines = []
    for name, rows in scenes.items():
        for row in rows:
            if row["library"] == "cellwalk":
                lines.append([name, row["method"], *(f"{int(row[c]) / int(row['moves']):.3g}" for c in WORK)])
    return table(["scene", "method", *WORK], lines, 2)


def tables(scenes):
    """All tables as Markdown."""
    timed = any(rows[0]["ns_per_vertex_move"] for rows in scenes.values())
    text = "# Real scenes: results\n\n## Scenes\n\n" + scene_table(scenes)
    if timed:
        text += "\n## Cellwalk beside the fastest peers (nanoseconds a move of a vertex with its edges; method and margin in steps)\n\n"
        text += ratio_table(scenes)
        text += "\n## Nanoseconds a move (medians; with boxes kept: the best margin)\n\n"
        text += by_scene(scenes, lambda r: number(r["ns_per_vertex_move"]))
        text += "\n## Microseconds a step of all bodies: median / 99 % / 99.9 % / most, each step by its least round\n\n"
        text += by_scene(scenes, lambda r: " / ".join(number(r[k]) for k in STEP_TIMES))
    text += "\n## Wrong answers: missed / false, of all moves\n\n"
    text += by_scene(scenes, lambda r: f'{r["missed"]} / {r["false"]}')
    if timed:
        text += "\n## Margins of kept boxes: nanoseconds a move\n\n" + margin_table(scenes)
    text += "\n## Building: milliseconds; megabytes held\n\n"
    text += by_scene(scenes, lambda r: f'{number(r["build_ms"])}; {number(str(int(r["bytes"]) / 1e6))}')
    text += "\n## Cellwalk's work a move\n\n" + work_table(scenes)
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
set xtics rotate by -35 noenhanced
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
    own = {m: [next(r for r in rows if r["method"] == m) for rows in scenes.values()] for m in OWN}
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
