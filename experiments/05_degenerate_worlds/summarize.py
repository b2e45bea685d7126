#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of the experiment from its CSV files.

usage: summarize.py DIR        reads DIR/degenerate.csv and touches.csv; writes tables.md and plots there

Without gnuplot the tables and the scripts of the plots are written, and the program says so and returns 3.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common"))
import plots  # noqa: E402
import tables  # noqa: E402
from tables import OF_EXPERIMENT_02, read_rows, share, table, unique  # noqa: E402

EXACT, ROUNDED = ([k for k in kernels if k not in OF_EXPERIMENT_02] for kernels in (tables.EXACT, tables.ROUNDED))

PLACEMENTS = ["integer", "turned"]
FILLS = [1, 2, 4, 6]  # patterns of gnuplot that differ in print


def summed(rows, column):
    return sum(int(r[column]) for r in rows)


def verdicts(rows, key):
    """Shares of wrong walks by world or motion, for each dimension and placement."""
    lines = []
    for dimension, placement, name in unique((r["dimension"], r["placement"], r[key]) for r in rows):
        here = [r for r in rows if (r["dimension"], r["placement"], r[key]) == (dimension, placement, name)]
        of = {k: [r for r in here if r["kernel"] == k] for k in EXACT + ROUNDED}
        motions = summed(of["exact"], "motions")
        lines.append([f"{dimension}D", placement, name, motions, share(summed(of["exact"], "blocked"), motions),
                      sum(summed(of[k], "wrong") for k in EXACT), *(share(summed(of[k], "wrong"), motions) for k in ROUNDED)])
    return table(["", "lattice", key, "motions", "blocked", "wrong by exact kernels", *ROUNDED], lines, names=3)


def touches(rows):
    lines = []
    for dimension, motion in unique((r["dimension"], r["motion"]) for r in rows):
        here = [r for r in rows if (r["dimension"], r["motion"]) == (dimension, motion)]
        motions = summed(here, "motions")
        lines.append([f"{dimension}D", motion, motions, share(summed(here, "blocked"), motions),
                      share(summed(here, "either"), motions), share(summed(here, "contacts_with_stop"), motions),
                      summed(here, "wrong_with_stop")])
    return table(["", "motions", "count", "contact with pass", "by the side taken", "contact with stop", "wrong with stop"], lines,
                 names=3)


def plot(folder, rows, dimension):
    """Bars: wrong shares by family of motions, on the turned lattices."""
    rows = [r for r in rows if r["dimension"] == dimension and r["placement"] == "turned"]
    motions = unique(r["motion"] for r in rows)
    script = "$data << END\n"
    for motion in motions:
        values = []
        for kernel in ROUNDED:
            here = [r for r in rows if r["motion"] == motion and r["kernel"] == kernel]
            values.append(100 * summed(here, "wrong") / summed(here, "motions"))
        script += f'"{motion.replace("_", " ")}" ' + " ".join(f"{v:.4f}" for v in values) + "\n"
    script += f"""END
set title "degenerate motions in {dimension}D, turned lattices (exact kernels: none wrong)"
set style data histograms
set style histogram clustered gap 1
set boxwidth 0.9
set xtics rotate by -30
set xlabel "family of motions"
set ylabel "wrong walks (% of all)"
set yrange [0:]
set grid ytics lc rgb "#dddddd" lt 1
set key outside right top Left reverse
"""
    script += "plot " + ", ".join(
        f'$data using {i + 2}:xtic(1) fs pattern {FILLS[i]} border -1 lc rgb "#333333" title {plots.quoted(kernel)}'
        for i, kernel in enumerate(ROUNDED)) + "\n"
    return plots.draw(folder, f"degenerate_{dimension}d", script)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    rows = read_rows(folder / "degenerate.csv")
    text = "# Degenerate worlds: results\n\n## By world\n\n" + verdicts(rows, "world")
    text += "\n## By family of motions\n\n" + verdicts(rows, "motion")
    text += "\n## Touch policies, exact kernel\n\n" + touches(read_rows(folder / "touches.csv"))
    (folder / "tables.md").write_text(text, encoding="utf-8")
    drawn = [plot(folder, rows, dimension) for dimension in "23"]
    return 0 if all(drawn) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
