#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and the plots of figure 8 from figure_8.csv.

usage: summarize.py DIR        reads DIR/figure_8.csv; writes tables.md there, and figure_8.gp, .png, .svg and .pdf: the motion of the
                               paper; figure_8_rigid.*: that of rigid bodies

Without gnuplot the tables and the scripts of the plots are written, and the program says so and returns 3.
"""

import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))
import plots  # noqa: E402
from tables import read_rows, table, unique  # noqa: E402

# Method: label in the plot, colour of its library, dash type, point type, line width. The others are in the tables only. Lines of one
# library differ by dashes and marks, so that the plot can be read without colours as well.
CELLWALK, BULLET, CGAL, EMBREE, GIMPACT, DOUBLE, MAP = "#0060a8", "#c8501e", "#8a3fa0", "#00805c", "#a87800", "#59636f", "#1a1a1a"
PLOTTED = {
    "cellwalk_triangle": ("Cellwalk, complete sweep*", CELLWALK, 1, 7, 4),
    "cellwalk_three_segments": ("Cellwalk, three segments*", CELLWALK, 3, 6, 2.5),
    "bullet_kept_box": ("Bullet, a box kept", BULLET, 2, 10, 2),
    "cgal_kept_box": ("CGAL, a box kept*", CGAL, 2, 8, 2),
    "double_walk": ("plain walk in doubles", DOUBLE, 4, 3, 2),
    "double_regions": ("walk in doubles, regions", DOUBLE, 1, 12, 2),
    "map_walk": ("walk on the map*", MAP, 5, 4, 2),
    "embree_packet_robust": ("Embree, robust packets", EMBREE, 1, 9, 2),
    "gimpact_tau": ("GIMPACT (paper)", GIMPACT, 1, 13, 2),
    "bullet_swept_box": ("Bullet (paper)", BULLET, 1, 5, 2),
    "cgal_segment": ("CGAL, segments*", CGAL, 1, 11, 2),
}
LOWEST = ["cellwalk_triangle", "cellwalk_three_segments", "bullet_kept_box", "cgal_kept_box", "double_walk", "double_regions"]  # enlarged, on a linear scale
RIGID = "rigid_"  # begins the names of traces of rigid bodies
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


def is_rigid(row):
    return row["trace"].startswith(RIGID)


def times(rows):
    traces = unique(r["trace"] for r in rows)
    if not any(r["ns_per_vertex_move"] for r in rows):
        return ""
    text = "\n### Nanoseconds a move of a vertex with its three edges (medians)\n\n"
    text += by_trace(rows, traces, lambda r: nanoseconds(r["ns_per_vertex_move"]))
    text += "\n### Microseconds a step of all bodies\n\n"
    return text + by_trace(rows, traces, lambda r: number(r["us_per_step"], 0))


def of_motion(rows):
    """The tables of the traces of one motion as Markdown."""
    traces = unique(r["trace"] for r in rows)
    first = {t: next(r for r in rows if r["trace"] == t) for t in traces}
    text = table(["trace", "cells", "solid", "wall triangles", "body side", "bodies", "steps", "moves", "held by walls, of 1,000 moves"],
                 [[t, *(f"{int(first[t][k]):,}" for k in ("cells", "solid_cells", "walls")), first[t]["body_side"],
                   *(f"{int(first[t][k]):,}" for k in ("bodies", "steps", "moves")),
                   f'{1000 * int(first[t]["held"]) / int(first[t]["moves"]):.1f}'] for t in traces])
    text += times(rows)
    text += "\n### Wrong answers: missed / false, of the hits among the bits that a method gives\n\n"
    text += by_trace(rows, traces, lambda r: f'{r["missed"]} / {r["false"]} of {r["hits"]}')
    text += "\n### Building: milliseconds; bytes a wall triangle or a cell\n\n"
    text += by_trace(rows, traces, lambda r: f'{number(r["build_ms"], 0)}; {r["bytes_per"]} a {r["unit"]}')
    for trace in traces:
        text += f"\n### Work a move on {trace}\n\nThe same on every machine, but for Embree.\n\n"
        text += table(["method", *COUNTS],
                      [[r["method"], *(f"{int(r[c]) / int(r['moves']):.4g}" if int(r[c]) else "" for c in COUNTS)]
                       for r in rows if r["trace"] == trace])
    return text


def tables(rows):
    """All tables as Markdown."""
    text = "# Figure 8: results\n"
    for title, of in (("Bodies deform and bounce", [r for r in rows if not is_rigid(r)]), ("Rigid bodies", [r for r in rows if is_rigid(r)])):
        if of:
            text += f"\n## {title}\n\n{of_motion(of)}"
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


def panel(lines, names, title, place, label_room, low, high, is_log):
    """One plot of lines, with labels to the right of their last points, between the shares `place` of the picture's width."""
    sizes = [n for n, _ in lines[names[0]]]
    scale, value = (math.log10, lambda h: 10 ** h) if is_log else (float, float)
    labels = apart([scale(lines[m][-1][1]) for m in names], (scale(high) - scale(low)) / 27)
    room = (sizes[-1] / sizes[0]) ** label_room
    tics = ", ".join(f'"10^{{{round(math.log10(n))}}}" {n}' for n in sizes)
    script = f"""set lmargin at screen {place[0]}
set rmargin at screen {place[1]}
set title {plots.quoted(title)}
set xrange [{sizes[0] / 1.3}:{sizes[-1] * room}]
set yrange [{low}:{high}]
set xtics ({tics})
unset label
unset arrow
"""
    for name, height in zip(names, labels):
        label, colour = PLOTTED[name][:2]
        at = f"first {sizes[-1] * room ** 0.14:.6g}, first {value(height):.6g}"
        label = f"{{/:Bold {label}}}" if name.startswith("cellwalk") else label
        script += f'set label "{label}" at {at} offset 0.3,0 font ",10.5" textcolor rgb "{colour}" front\n'
        script += (f"set arrow from first {sizes[-1] * room ** 0.03:.6g}, first {lines[name][-1][1]} to {at} "
                   f'nohead lw 0.7 lc rgb "{colour}"\n')
    styles = {m: PLOTTED[m][1:] for m in names}
    return script + "plot " + ", ".join(
        f'${m} with linespoints dt {dash} pt {mark} lw {width} ps 0.9 lc rgb "{colour}"'
        for m, (colour, dash, mark, width) in styles.items()) + "\n"


def plot_script(rows, prefix=""):
    """The script of gnuplot for the traces named n_* behind a prefix, or None where there are not two of them with times."""
    rows = [r for r in rows if r["trace"].startswith(prefix + "n_") and r["ns_per_vertex_move"] and r["method"] in PLOTTED]
    sizes = sorted({int(r["cells"]) for r in rows})
    if len(sizes) < 2:
        return None
    lines = {m: sorted((int(r["cells"]), float(r["ns_per_vertex_move"])) for r in rows if r["method"] == m)
             for m in PLOTTED if any(r["method"] == m for r in rows)}
    values = [ns for line in lines.values() for _, ns in line]
    low, high = min(values) / 1.5, max(values) * 1.5
    lowest = [m for m in LOWEST if m in lines]
    script = "".join(f"${name} << END\n" + "".join(f"{n} {ns}\n" for n, ns in line) + "END\n" for name, line in lines.items())
    script += f"""set multiplot
unset key
set tmargin at screen 0.94
set bmargin at screen 0.1
set grid ytics lc rgb "#dddddd" lt 1
set xlabel "cells of the environment, n"
set ylabel "time of a vertex move with its three edges (ns)"
set logscale xy
"""
    script += panel(lines, list(lines), "all, on a logarithmic scale (*: exact)", (0.09, 0.57), 0.95, low, high, True)
    if lowest:
        script += "unset ylabel\nunset logscale y\n"
        top = 1.2 * max(ns for m in lowest for _, ns in lines[m])
        script += panel(lines, lowest, "the lowest lines, on a linear scale (ns)", (0.63, 0.985), 1.75, 0, top, False)
    return script + "unset multiplot\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    rows = read_rows(folder / "figure_8.csv")
    (folder / "tables.md").write_text(tables(rows), encoding="utf-8")
    status = 0
    for name, prefix in (("figure_8", ""), ("figure_8_rigid", RIGID)):
        script = plot_script(rows, prefix)
        if script is None:
            print(f"summarize: no times of two sizes: no plot {name}")
        elif not plots.draw(folder, name, script):
            status = plots.NO_GNUPLOT
    return status


if __name__ == "__main__":
    sys.exit(main())
