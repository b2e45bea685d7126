#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and the plot of figure 8 from figure_8.csv.

usage: summarize.py DIR        reads DIR/figure_8.csv; writes tables.md, figure_8.gp, figure_8.png, .svg and .pdf there

Without gnuplot the tables and the plot's script are written, and the program says so and returns 3.
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))
import plots  # noqa: E402
from tables import read_rows, table, unique  # noqa: E402

# Method: label in the plot, and style: dash type, point type, line width. None: in the tables only, as it lies beside another
# line. The styles differ without colours.
PLOTTED = {
    "cellwalk_triangle": ("cellwalk, complete sweep", 1, 7, 4),
    "cellwalk_three_segments": ("cellwalk, three segments", 1, 6, 2),
    "bullet_swept_box": ("Bullet, a box an edge (paper)", 2, 5, 1.5),
    "bullet_ray": ("Bullet, rays", 3, 4, 1.5),
    "bullet_body_box": ("Bullet, a box a body", 2, 9, 1.5),
    "bullet_kept_box": ("Bullet, box kept", 2, 11, 1.5),
    "gimpact_tau": ("GIMPACT, triangles (paper)", 4, 13, 1.5),
    "embree_ray_robust": ("Embree robust, rays", 5, 8, 1.5),
    "embree_packet_robust": ("Embree robust, packets", 5, 10, 1.5),
    "cgal_segment": ("CGAL, segments", 4, 1, 1.5),
    "cgal_kept_box": ("CGAL, box kept", 4, 2, 1.5),
    "fcl_boxes": ("FCL, segments", 3, 12, 1.5),
    "double_walk": ("walk in doubles", 6, 3, 1.5),
    "unit_cubes": ("bound: unit cubes", 6, 14, 1.5),
    "read_and_write": ("bound: read and write", 6, 15, 1.5),
}
COUNTS = ["boxes", "queries", "triangle_tests", "walks", "crossings", "signs", "fallbacks", "certified_edges", "clear_moves"]


def number(text, digits):
    return f"{float(text):,.{digits}f}" if text else ""


def nanoseconds(text):
    return number(text, 1 if text and float(text) < 99.95 else 0)


def by_trace(rows, traces, cell):
    """A table with a line a method and a column a trace."""
    found = {(r["method"], r["trace"]): r for r in rows}
    return table(["method", *traces],
                 [[m, *(cell(found[m, t]) if (m, t) in found else "" for t in traces)]
                  for m in unique(r["method"] for r in rows)])


def tables(rows):
    """All tables as Markdown."""
    traces = unique(r["trace"] for r in rows)
    first = {t: next(r for r in rows if r["trace"] == t) for t in traces}
    text = "# Figure 8: results\n\n## Traces\n\n"
    text += table(["trace", "cells", "solid", "wall triangles", "body side", "bodies", "steps", "moves"],
                  [[t, *(f"{int(first[t][k]):,}" for k in ("cells", "solid_cells", "walls")), first[t]["body_side"],
                    *(f"{int(first[t][k]):,}" for k in ("bodies", "steps", "moves"))] for t in traces])
    if any(r["ns_per_vertex_move"] for r in rows):
        text += "\n## Nanoseconds a move of a vertex with its three edges (medians)\n\n"
        text += by_trace(rows, traces, lambda r: nanoseconds(r["ns_per_vertex_move"]))
        text += "\n## Microseconds a step of all bodies\n\n"
        text += by_trace(rows, traces, lambda r: number(r["us_per_step"], 0))
    text += "\n## Wrong answers: missed / false, of the hits among the bits that a method gives\n\n"
    text += by_trace(rows, traces, lambda r: f'{r["missed"]} / {r["false"]} of {r["hits"]}')
    text += "\n## Building: milliseconds; bytes a wall triangle or a cell\n\n"
    text += by_trace(rows, traces, lambda r: f'{number(r["build_ms"], 0)}; {r["bytes_per"]} a {r["unit"]}')
    for trace in traces:
        text += f"\n## Work a move on {trace}\n\nThe same on every machine, but for Embree.\n\n"
        text += table(["method", *COUNTS],
                      [[r["method"], *(f"{int(r[c]) / int(r['moves']):.4g}" if int(r[c]) else "" for c in COUNTS)]
                       for r in rows if r["trace"] == trace])
    return text


def apart(heights, distance):
    """Heights near the given ones, in the same order, and at least so far from each other."""
    order = sorted(range(len(heights)), key=lambda i: heights[i])
    moved = [heights[i] for i in order]
    for _ in range(1000):
        for i in range(1, len(moved)):
            lack = distance - (moved[i] - moved[i - 1])
            if lack > 1e-9:
                moved[i - 1] -= lack / 2
                moved[i] += lack / 2
    result = [0.0] * len(heights)
    for place, i in enumerate(order):
        result[i] = moved[place]
    return result


def plot_script(rows):
    """The script of gnuplot for the traces named n_*, or None where there are not two of them with times."""
    rows = [r for r in rows if r["trace"].startswith("n_") and r["ns_per_vertex_move"] and r["method"] in PLOTTED]
    sizes = sorted({int(r["cells"]) for r in rows})
    if len(sizes) < 2:
        return None
    lines = {m: sorted((int(r["cells"]), float(r["ns_per_vertex_move"])) for r in rows if r["method"] == m)
             for m in PLOTTED if any(r["method"] == m for r in rows)}
    values = [ns for line in lines.values() for _, ns in line]
    low, high = min(values) / 1.5, max(values) * 1.5
    moves_a_step = int(rows[0]["moves"]) // int(rows[0]["steps"])
    labels = apart([math.log10(line[-1][1]) for line in lines.values()], math.log10(high / low) / 27)
    # The labels stand in the plot, to the right of the last points.
    room = (sizes[-1] / sizes[0]) ** 0.55
    tics = ", ".join(f'"10^{{{round(math.log10(n))}}}" {n}' for n in sizes)
    script = ""
    for name, line in lines.items():
        script += f"${name} << END\n" + "".join(f"{n} {ns}\n" for n, ns in line) + "END\n"
    script += f"""set logscale xyy2
set xrange [{sizes[0] / 1.3}:{sizes[-1] * room}]
set yrange [{low}:{high}]
set y2range [{low * moves_a_step / 1e3}:{high * moves_a_step / 1e3}]
set xtics ({tics})
set xlabel "cells of the environment, n"
set ylabel "time of a vertex move with its three edges (ns)"
set y2label "time of a step, {moves_a_step} vertices ({{/Symbol m}}s)"
set ytics nomirror
set y2tics
set grid ytics lc rgb "#dddddd" lt 1
unset key
"""
    for (name, line), height in zip(lines.items(), labels):
        label = PLOTTED[name][0]
        at = f"first {sizes[-1] * room ** 0.2:.6g}, first {10 ** height:.6g}"
        script += f'set label "{label}" at {at} offset 0.3,0 font ",10" textcolor rgb "{shade(name)}" front\n'
        script += (f"set arrow from first {sizes[-1] * room ** 0.03:.6g}, first {line[-1][1]} to {at} "
                   'nohead lw 0.4 lc rgb "#999999"\n')
    script += "plot " + ", ".join(
        f'${name} with linespoints dt {PLOTTED[name][1]} pt {PLOTTED[name][2]} lw {PLOTTED[name][3]} ps 0.9 '
        f'lc rgb "{shade(name)}"' for name in lines) + "\n"
    return script


def shade(name):
    return "#000000" if name.startswith("cellwalk") else "#555555"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    rows = read_rows(folder / "figure_8.csv")
    (folder / "tables.md").write_text(tables(rows), encoding="utf-8")
    script = plot_script(rows)
    if script is None:
        print("summarize: no times of two sizes: no plot")
        return 0
    return 0 if plots.draw(folder, "figure_8", script) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
