#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and the plot of experiment 12 from its CSV files.

usage: summarize.py DIR     writes tables.md and success.png, .svg, .pdf into DIR
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import interval, read_rows, read_rows_if_any, table  # noqa: E402


def learning_table(rows):
    return table(["round", "steps so far", "reached by all policies tried", "reached by the middle of the best"],
                 [[r["round"], f'{int(r["steps"]):,}', f'{100 * float(r["reached_by_all"]):.0f} %', f'{r["reached"]} of {r["trials"]}'] for r in rows])


def reached_of(rows):
    return "{} of {}".format(*(sum(int(r[c]) for r in rows) for c in ("reached", "trials")))


def reached_table(rows):
    return table(["target", "reached"], [[r["target"], f'{r["reached"]} of {r["trials"]}'] for r in rows] + [["all", reached_of(rows)]])


def vessels_table(folder):
    """Of the vessels in which the policy was tried without learning there: each has a folder."""
    rows = []
    for file in sorted(folder.glob("*/reached.csv")):
        ends = read_rows(file)
        rows.append([f"`{file.parent.name}`", len(ends), sum(int(r["reached"]) > 0 for r in ends), reached_of(ends)])
    return "### Other vessels\n\n" + table(["vessel", "ends", "ends reached", "targets reached"], rows) + "\n" if rows else ""


def judged_table(rows, memory):
    sums = [sum(int(r[c]) for r in rows) for c in ("steps", "episodes", "contacts", "pairs", "exact", "too_near", "through")]
    peak = [f'{int(m["kilobytes"]) / 1024:.0f}' for m in (memory[min(len(memory) - 1, 9)], memory[-1])]
    return table(["steps", "episodes", "contacts", "edges and walls near each other", "of these in integers", "nearer than the radius",
                  "through a wall", "MB after 10,000 steps", "MB at the end"], [[f"{s:,}" for s in sums] + peak], 0)


def time_table(rows):
    return table(["inside", "contacts a step", "us a step", "steps a second"],
                 [[r["inside"], f'{int(r["contacts"]) / int(r["steps"]):.1f}', f'{float(r["us_a_step"]):.0f}', f'{1e6 / float(r["us_a_step"]):,.0f}']
                  for r in rows])


def success_plot(folder, rows):
    points = []
    for r in rows:
        reached, trials = int(r["reached"]), int(r["trials"])
        low, high = interval(reached, trials)
        points.append((int(r["steps"]) / 1000, 100 * reached / trials, 100 * low, 100 * high))
    tried = [(int(r["steps"]) / 1000, 100 * float(r["reached_by_all"])) for r in rows]
    script = plots.line_plot({"the middle of the best policies, unseen episodes (bars: 95 %)": points, "all policies tried in the round": tried},
                             "steps of the search, in thousands", "targets reached, in per cent", xrange="0:", yrange="0:105", commands="set key inside right bottom\n")
    return plots.draw(folder, "success", script)


def main():
    folder = Path(sys.argv[1])
    learned, judged, times = read_rows(folder / "learning.csv"), read_rows_if_any(folder / "judged.csv"), read_rows_if_any(folder / "times.csv")
    text = "## Learning\n\n" + learning_table(learned) + "\n" + reached_table(read_rows(folder / "reached.csv")) + "\n" + vessels_table(folder)
    if judged:
        text += "## Judged steps\n\n" + judged_table(judged, read_rows(folder / "memory.csv"))
    if times:
        text += "\n## Times\n\n" + time_table(times)
    (folder / "tables.md").write_text(text, encoding="utf-8")
    if not success_plot(folder, learned):
        sys.exit(plots.NO_GNUPLOT)


if __name__ == "__main__":
    main()
