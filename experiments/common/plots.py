# SPDX-License-Identifier: LGPL-3.0-or-later
"""Plots of experiments by gnuplot: PNG, SVG and PDF of one script. Lines are told apart by dashes and marks, and by colours."""

import shutil
import subprocess
import sys

NO_GNUPLOT = 3  # what summarize.py returns where the scripts are written but no pictures

TERMINALS = {
    "png": 'pngcairo size 1500,1000 fontscale 1.1 enhanced',
    "svg": 'svg size 1000,667 enhanced',
    "pdf": 'pdfcairo size 8in,5.3in enhanced',
}

# Dash type, point type, line width, colour.
STYLES = [(1, 7, 3, "#0060a8"), (2, 5, 2, "#c8501e"), (4, 9, 2, "#00805a"), (3, 11, 2, "#8a3fa0"), (5, 13, 2, "#a87800"),
          (1, 6, 1.5, "#5a6470"), (2, 4, 1.5, "#b03060"), (3, 8, 1.5, "#2e8b9a"), (4, 10, 1.5, "#222222")]


def draw(folder, name, script):
    """Writes the script as name.gp, and its pictures. False, and a line on stderr, where there is no gnuplot."""
    (folder / f"{name}.gp").write_text(f"# gnuplot {name}.gp\n{script}", encoding="utf-8")
    if not shutil.which("gnuplot"):
        print(f"gnuplot not found: {name}.gp is written, but no picture (package gnuplot-nox)", file=sys.stderr)
        return False
    for suffix, terminal in TERMINALS.items():
        subprocess.run(["gnuplot", "-"], input=f'set terminal {terminal}\nset output "{name}.{suffix}"\n{script}',
                       text=True, check=True, cwd=folder)
    return True


def quoted(text):
    return '"' + text.replace('"', "'").replace("_", r"\\_") + '"'


def line_plot(series, xlabel, ylabel, log="", xrange="", yrange="", tics=None, commands=""):
    """A script: one line with marks for each entry of `series`, name -> [(x, y) or (x, y, low, high), ...].

    The latter have bars from low to high. Axis labels must name their units. `log`: axes with logarithmic scale, of "xy".
    `tics`: {label: x} instead of numbers. An entry without points is named in the key all the same. Where y is logarithmic,
    points at 0 interrupt the line, and are drawn as a small mark at the top of their bar.
    """
    script = ""
    plots, bars_below = [], []  # marks are drawn over bars
    for number, (name, points) in enumerate(series.items()):
        dash, mark, width, colour = STYLES[number % len(STYLES)]
        style = f'dt {dash} pt {mark} lw {width} ps 1.1 lc rgb "{colour}"'
        zero = [p for p in points if "y" in log and p[1] <= 0]
        drawn = [p for p in points if p not in zero]
        block = f"$data_{number}"
        lines = ("\n" if p in zero else " ".join(map(repr, p)) + "\n" for p in points)
        script += f"{block} << END\n" + "".join(lines) + "END\n"
        plots.append(f"{block} using 1:2 with linespoints {style} title {quoted(name)}" if drawn
                     else f"NaN with linespoints {style} title {quoted(name)}")
        bars = [p for p in drawn if len(p) == 4]
        if bars:
            bars_below.append(f'{block} using 1:2:3:4 with yerrorbars dt 1 pt -1 lw 1 lc rgb "{colour}" notitle')
        bounds = [p for p in zero if len(p) == 4]
        if bounds:
            script += f"$bound_{number} << END\n" + "".join(f"{p[0]!r} {p[3]!r}\n" for p in bounds) + "END\n"
            plots.append(f'$bound_{number} using 1:2 with points pt {mark} ps 0.6 lw 1 lc rgb "{colour}" notitle')
    script += f"set xlabel {quoted(xlabel)}\nset ylabel {quoted(ylabel)}\n"
    script += 'set grid ytics lc rgb "#dddddd" lt 1\nset key outside right top Left reverse samplen 5\n'
    script += "".join(f"set logscale {axis}\n" for axis in log)
    script += "".join(f'set format {axis} "10^{{%L}}"\n' for axis in log if not (axis == "x" and tics))
    script += f"set xrange [{xrange}]\n" if xrange else ""
    script += f"set yrange [{yrange}]\n" if yrange else ""
    if tics:
        script += "set xtics (" + ", ".join(f'"{label}" {x!r}' for label, x in tics.items()) + ")\n"
    return script + commands + "plot " + ", \\\n  ".join(bars_below + plots) + "\n"
