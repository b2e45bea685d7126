#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of the experiment from its CSV files.

usage: summarize.py DIR        reads DIR/walks.csv, sweeps.csv, flights.csv and, where it is there, times.csv; writes tables.md, plots

Without gnuplot the tables and the scripts of the plots are written, and the program says so and returns 3.
"""

import math
import sys
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))
import plots  # noqa: E402
from tables import EXACT, ROUNDED, per_million, read_rows, share, table, unique  # noqa: E402

LABELS = {
    "degeneracy": "distance of the target from a degenerate position (ulp)",
    "scale": "size of a cell (units)",
    "offset": "distance of the world from the origin (cells)",
    "aspect": "aspect ratio of the cells",
    "rotation": "rotation of the lattice (degrees)",
    "rounded": "rotation of a lattice whose points are rounded (degrees)",
    "length": "length of a motion (cells)",
}

# How walks fail, as a user meets it: columns of walks.csv and flights.csv.
CLASSES = {
    "missed wall": ["missed_wall"],
    "false wall": ["false_contact"],
    "wrong cell": ["wrong_cell", "illegal_way"],
    "lost": ["stuck", "lost"],
    "only time or kind": ["wrong_time", "wrong_kind", "wrong_wall", "wrong_dimension"],
}
# Motions of one sort: of walks.csv, by variable and value; those of flights.csv have no variable.
POPULATIONS = {
    "exactly degenerate": lambda variable, value: variable == "degeneracy" and float(value) == 0,
    "1 to 2^16 ulp beside": lambda variable, value: variable == "degeneracy" and 1 <= float(value) <= 2 ** 16,
    "2^20 ulp beside or more": lambda variable, value: variable == "degeneracy" and float(value) >= 2 ** 20,
    "varied worlds": lambda variable, value: variable in ("scale", "offset", "aspect", "rotation", "length"),
    "rounded worlds": lambda variable, value: variable == "rounded",
    "meshes": lambda variable, value: variable == "mesh",
    "rounded constructions": lambda variable, value: variable is None,
}


def place(variable, value):
    """Where a value stands on the logarithmic axis; 0 stands to the left of all others."""
    if variable in ("rotation", "rounded"):
        return math.degrees(2 * math.atan(value)) if value else 2.0 ** -8
    if value == 0:
        return 2.0 ** -4
    return value


def tics(variable, values):
    """Labels of the values on the axis."""
    labels = {}
    for value in values:
        if value == 0:
            label = "0"
        elif variable in ("rotation", "rounded"):
            label = f"{place(variable, value):.2g}"
        else:
            label = f"2^{{{round(math.log2(value))}}}"
        labels[label] = place(variable, value)
    return labels


def points(rows, kernel):
    """x, share, low, high; kernels that never fail are drawn at their upper bound."""
    return [(place(r["variable"], float(r["value"])), int(r["wrong"]) / int(r["motions"]), float(r["low"]), float(r["high"]))
            for r in rows if r["kernel"] == kernel]


def walk_plot(folder, rows, dimension, variable):
    rows = [r for r in rows if r["dimension"] == dimension and r["variable"] == variable]
    series = {"exact kernels (upper bound)": [], **{k: points(rows, k) for k in ROUNDED}}
    # The exact kernels never fail, or the run would have ended with an error: one line for all, at the bound of 0 of N.
    series["exact kernels (upper bound)"] = [(x, high) for x, wrong, _, high in points(rows, "exact") if wrong == 0]
    values = [float(v) for v in unique(r["value"] for r in rows)]
    script = plots.line_plot(series, LABELS[variable], "wrong walks (share of all, 95 % interval)", log="xy", yrange=":1.5",
                             tics=tics(variable, values), commands=f'set title "walks in {dimension}D"\n')
    return plots.draw(folder, f"walks_{dimension}d_{variable}", script)


def sweep_plot(folder, rows, dimension):
    rows = [r for r in rows if r["dimension"] == dimension]
    shown = {"triangle": "complete sweep (upper bound)", "three_segments": "three segments, exact",
             **{f"walks_{k}": f"walks, {k}" for k in ROUNDED if k != "simple_cartesian"}}
    series = {}
    for method, label in shown.items():
        series[label] = [(place("degeneracy", float(r["value"])), *(
            (float(r["high"]),) if method == "triangle" else
            (int(r["wrong"]) / int(r["sweeps"]), float(r["low"]), float(r["high"]))))
            for r in rows if r["method"] == method]
    script = plots.line_plot(series, LABELS["degeneracy"], "wrong sweeps (share of all, 95 % interval)", log="xy",
                             yrange=":1.5", tics=tics("degeneracy", [float(v) for v in unique(r["value"] for r in rows)]),
                             commands=f'set title "sweeps of edges in {dimension}D"\n')
    return plots.draw(folder, f"sweeps_{dimension}d", script)


def nearest_wall(point, walls):
    """The distance from a point to the nearest wall, and the wall: exact but for the last step, as it may be less than an ulp."""
    best, nearest = math.inf, None
    for wall in walls:
        a, b = ((Fraction(wall[f"{end}x"]), Fraction(wall[f"{end}y"])) for end in "ab")
        p = Fraction(point[0]), Fraction(point[1])
        along = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2
        t = min(1, max(0, ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / along))
        off = (p[0] - a[0] - t * (b[0] - a[0])) ** 2 + (p[1] - a[1] - t * (b[1] - a[1])) ** 2
        if math.sqrt(off) < best:
            best, nearest = math.sqrt(off), (a, b)
    return best, nearest


def half_plane(half, foot, normal):
    """The part of the square of corners (+-half, +-half) to which the normal points from the line through the foot."""
    square = [(-half, -half), (half, -half), (half, half), (-half, half)]
    height = [sum((x - f) * n for x, f, n in zip(p, foot, normal)) for p in square]
    part = []
    for i in range(4):
        p, q, h, k = square[i - 1], square[i], height[i - 1], height[i]
        if h * k < 0:
            part.append([x + (y - x) * h / (h - k) for x, y in zip(p, q)])
        if k >= 0:
            part.append(q)
    return part


def zoom(way, wall):
    """Blocks of gnuplot about the end of the last move: exact differences over a power of ten. The wall's line, what is behind it, the
    points with double coordinates, the way of the move. Then the exponent of the unit, half the window's width in units, and
    whether the end is behind.
    """
    start, end = ([Fraction(x) for x in p] for p in way[-2:])
    corners = [[x - e for x, e in zip(corner, end)] for corner in wall]
    along = [b - a for a, b in zip(*corners)]
    share = sum(a * d for a, d in zip(corners[0], along)) / sum(d * d for d in along)
    foot = [a - d * share for a, d in zip(corners[0], along)]  # of the perpendicular from the end
    off = math.hypot(*map(float, foot))
    spacing = [math.ulp(x) for x in way[-1]]
    reach = max(6 * off, 6.5 * min(spacing))
    exponent = math.floor(math.log10(reach))
    unit = Fraction(10) ** exponent
    half = float(reach / unit)
    came = [(s - e) / unit for s, e in zip(start, end)]
    foot = [float(f / unit) for f in foot]
    normal = [-float(along[1]), float(along[0])]
    if sum(n * (float(c) - f) for n, c, f in zip(normal, came, foot)) > 0:
        normal = [-n for n in normal]  # away from the start
    is_behind = sum(n * f for n, f in zip(normal, foot)) < 0
    far = 2 * half / math.hypot(*normal)
    shrink = 3 * half / max(math.hypot(*map(float, came)), 3 * half)
    counts = [int(reach / s) for s in spacing]
    blocks = {
        "near_wall": [[foot[0] + t * normal[1], foot[1] - t * normal[0]] for t in (-far, far)],
        "behind": half_plane(half, foot, normal),
        "grid": [[float(i * Fraction(spacing[0]) / unit), float(j * Fraction(spacing[1]) / unit)]
                 for i in range(-counts[0], counts[0] + 1) for j in range(-counts[1], counts[1] + 1)] if max(counts) < 100 else [],
        "arrival": [[shrink * float(c) for c in came], [0, 0]],
        "end": [[0, 0]],
    }
    text = "".join(f"${name} << END\n" + "".join(f"{x!r} {y!r}\n" for x, y in points) + "END\n" for name, points in blocks.items())
    return text, exponent, half, is_behind


WALL, WAY, LAST, BEHIND = "#1e293b", "#7a8699", "#d02746", "#f3dcd6"


def escape_script(kernel, wall_rows, way):
    """The world on the left; on the right, enlarged, where the last move ends."""
    off, wall = nearest_wall(way[-1], wall_rows)
    near, exponent, half, is_behind = zoom(way, wall)
    walls = "".join(f"{r['ax']!r} {r['ay']!r}\n{r['bx']!r} {r['by']!r}\n\n" for r in wall_rows)
    block = "".join(f"{x!r} {y!r}\n" for x, y in way)
    last = "".join(f"{x!r} {y!r}\n" for x, y in way[-2:])
    title = f"the first escape under {kernel}: the move ends {off:.2g} cells {'behind' if is_behind else 'before'} the wall"
    return f"""$walls << END
{walls}END
$path << END
{block}END
$last << END
{last}END
{near}set multiplot title {plots.quoted(title)} font ",13"
set size ratio -1
set lmargin at screen 0.05
set rmargin at screen 0.48
set tmargin at screen 0.93
set bmargin at screen 0.24
set xlabel "x (cells)"
set ylabel "y (cells)"
set key at screen 0.05, screen 0.13 left top Left reverse samplen 3 font ",12"
set label 1 "enlarged" at {way[-1][0]!r}, {way[-1][1]!r} offset 2,-1.2 textcolor rgb "{LAST}"
set object 1 circle at {way[-1][0]!r}, {way[-1][1]!r} size 0.16 fs empty border lc rgb "{LAST}" lw 1.5 front
plot $walls with lines lw 3 dt 1 lc rgb "{WALL}" title "walls", \
  $path with linespoints dt 2 pt 6 lw 1.5 lc rgb "{WAY}" title "way of the particle", \
  $last with linespoints dt 1 pt 7 ps 0.8 lw 2 lc rgb "{LAST}" title "the move that escapes"
unset label 1
unset object 1
set clip two
set key at screen 0.56, screen 0.13 left top
set lmargin at screen 0.56
set rmargin at screen 0.99
set xrange [{-half!r}:{half!r}]
set yrange [{-half!r}:{half!r}]
set xlabel "x, from the end of the move (10^{{{exponent}}} cells)"
set ylabel "y, from the end of the move (10^{{{exponent}}} cells)"
plot $behind with filledcurves closed fc rgb "{BEHIND}" title "behind the wall", \
  $near_wall with lines lw 3 lc rgb "{WALL}" title "the wall, exactly", \
  $grid with points pt 7 ps 0.8 lc rgb "{WAY}" title "points that doubles can name", \
  $arrival with lines lw 2 lc rgb "{LAST}" notitle, \
  $end with points pt 7 ps 1.8 lc rgb "{LAST}" title "where the move ends"
unset multiplot
"""


def escape_plots(folder):
    """What the first escape of each kernel in the plane looks like."""
    drawn = True
    for path in sorted(folder.glob("escape_2d_*_path.csv")):
        name = path.stem.removesuffix("_path")
        wall_rows = [{k: float(v) for k, v in r.items()} for r in read_rows(folder / f"{name}_walls.csv")]
        way = [(float(r["x"]), float(r["y"])) for r in read_rows(path)]
        drawn = plots.draw(folder, name, escape_script(name.removeprefix("escape_2d_"), wall_rows, way)) and drawn
    return drawn


def failure_table(rows, dimension):
    """Failures per million motions by class, of each kernel in each population; the exact kernels together."""
    lines = []
    for population, is_in in POPULATIONS.items():
        here = [r for r in rows if r["dimension"] == dimension and is_in(r.get("variable"), r.get("value"))]
        for name, kernels in [("exact kernels", EXACT), *((k, [k]) for k in ROUNDED)]:
            mine = [r for r in here if r["kernel"] in kernels]
            motions = sum(int(r["motions"]) for r in mine)
            if motions:
                lines.append([population, name, f"{motions:,}",
                              *(per_million(sum(int(r[c]) for r in mine for c in columns), motions) for columns in CLASSES.values())])
    return table(["motions", "kernel", "number", *CLASSES], lines, names=2)


def walk_tables(rows):
    text = ""
    for dimension in unique(r["dimension"] for r in rows):
        here = [r for r in rows if r["dimension"] == dimension]
        text += f"\n## Walks in {dimension}D: share of wrong ones\n\n"
        lines = []
        for variable, value in unique((r["variable"], r["value"]) for r in here):
            found = {r["kernel"]: r for r in here if (r["variable"], r["value"]) == (variable, value)}
            any_row = next(iter(found.values()))
            lines.append([variable, value if variable == "mesh" else f"{float(value):.6g}", any_row["motions"], share(any_row["degenerate"], any_row["motions"]),
                          sum(int(found[k]["wrong"]) for k in EXACT)]
                         + [share(found[k]["wrong"], found[k]["motions"]) for k in ROUNDED])
        text += table(["variable", "value", "motions", "degenerate", "wrong by exact kernels", *ROUNDED], lines, names=2)
        text += f"\n## Walks in {dimension}D: how they go wrong, of all at the point\n\n"
        kinds = list(here[0])[10:]
        sums = []
        for kernel in EXACT + ROUNDED:
            mine = [r for r in here if r["kernel"] == kernel]
            sums.append([kernel, sum(int(r["motions"]) for r in mine), *(sum(int(r[k]) for r in mine) for k in kinds)])
        text += table(["kernel", "motions", *kinds], sums, names=2)
    return text


def plain_table(title, rows):
    def cell(text):
        try:
            return str(int(text))
        except ValueError:
            pass
        try:
            return f"{float(text):.4g}"
        except ValueError:
            return text
    return f"\n## {title}\n\n" + table(list(rows[0]), [[cell(v) for v in r.values()] for r in rows], names=2)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    text = "# Exact versus float: results\n"
    drawn = True
    judged = [r for name in ("walks.csv", "flights.csv") if (folder / name).exists() for r in read_rows(folder / name)]
    for dimension in unique(r["dimension"] for r in judged):
        text += f"\n## Failures in {dimension}D per million motions (95 %)\n\n" + failure_table(judged, dimension)
    if (folder / "walks.csv").exists():
        walks = read_rows(folder / "walks.csv")
        text += walk_tables(walks)
        for dimension in "23":
            for variable in LABELS:
                drawn = walk_plot(folder, walks, dimension, variable) and drawn
    if (folder / "sweeps.csv").exists():
        sweeps = read_rows(folder / "sweeps.csv")
        text += plain_table("Sweeps of edges", sweeps)
        for dimension in "23":
            drawn = sweep_plot(folder, sweeps, dimension) and drawn
    for name, title in [("flights", "Long simulations"), ("times", "Times and memory")]:
        if (folder / f"{name}.csv").exists():
            text += plain_table(title, read_rows(folder / f"{name}.csv"))
    drawn = escape_plots(folder) and drawn
    (folder / "tables.md").write_text(text, encoding="utf-8")
    return 0 if drawn else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
