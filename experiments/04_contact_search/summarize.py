#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of experiment 04 from its CSV files.

usage: summarize.py DIR     writes tables.md, and time, normal and cost as .gp, .png, .svg and .pdf, into DIR

Without gnuplot the tables and the plots' scripts are written, and the program says so and returns 3.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import read_rows_if_any, table  # noqa: E402

TOLERANCE = "tolerance of the dichotomic search (share of the motion)"
ONE_SHOT = {"exact": "exact", "exhaustive": "exhaustive", "exhaustive_unlimited": "exhaustive, beyond the end as well",
            "exhaustive_traversed": "exhaustive, cells of the edge at its end"}
BISECTIONS = {"dichotomic": "dichotomic", "dichotomic_segment": "dichotomic, of the segment"}


def tolerance(row):
    return 2.0 ** -int(row["tolerance_bits"])


def name_of(row):
    if row["tolerance_bits"]:
        return f'{BISECTIONS[row["search"]]}, 2^-{row["tolerance_bits"]}'
    return ONE_SHOT[row["search"]]


def key(row):
    return row["world"], row["search"], row["tolerance_bits"]


def error_table(errors):
    def percent(row, column):
        return f'{100 * int(row[column]) / int(row["contacts"]):.3g}'
    header = ["search", "exact time, %", "late, %", "none found, %", "same feature, %", "early, mean", "early, most", "late, most",
              "gap, median", "gap, most", "point, most", "normal, median", "normal, most"]
    return table(header, [
        [name_of(r), *(percent(r, c) for c in ("same_time", "late", "none_found", "same_feature")),
         *(f"{float(r[c]):.3g}" for c in ("early_mean", "early_max", "late_max", "gap_median", "gap_max", "point_max", "normal_median",
                                          "normal_max"))] for r in errors])


def cost_table(costs, timings):
    times = {key(r): float(r["us_per_contact"]) for r in timings}
    return table(["search", "sweeps", "walks", "walls", "signs", "exact signs", "us"], [
        [name_of(r), *(f'{int(r[c]) / int(r["contacts"]):.4g}'
                       for c in ("search_sweeps", "search_walks", "search_walls", "signs", "exact_signs")),
         f"{times[key(r)]:.1f}" if key(r) in times else ""] for r in costs])


def dichotomic(rows, world, value):
    return [(tolerance(r), value(r)) for r in reversed(rows) if r["world"] == world and r["search"] == "dichotomic"]


def across(rows, world, search, value):
    """A search without tolerance as a horizontal line."""
    ends = [x for x, _ in dichotomic(rows, world, lambda r: 0)]
    y = next(value(r) for r in rows if r["world"] == world and r["search"] == search)
    return [(ends[0], y), (ends[-1], y)]


def draw_all(folder, errors, costs):
    worlds = list(dict.fromkeys(r["world"] for r in errors))
    of_world = [dichotomic(errors, world, lambda r: r) for world in worlds]
    rows_of = [(points[0][0], [r for _, r in points]) for points in zip(*of_world)]
    time = {"the tolerance": [(x, x) for x, _ in rows_of],
            "greatest of all worlds": [(x, max(float(r["early_max"]) for r in rows)) for x, rows in rows_of],
            "mean of all worlds": [(x, sum(float(r["early_mean"]) for r in rows) / len(rows)) for x, rows in rows_of]}
    done = plots.draw(folder, "time", plots.line_plot(
        time, TOLERANCE, "how early the time is (share of the motion)", "xy", commands="set key inside left top\n"))
    normal = {}
    for world in worlds:
        normal[f"dichotomic, {world}"] = dichotomic(errors, world, lambda r: float(r["normal_median"]))
    normal["exhaustive and exact, all"] = across(errors, worlds[0], "exhaustive", lambda r: float(r["normal_median"]))
    done &= plots.draw(folder, "normal", plots.line_plot(
        normal, TOLERANCE, "angle with the exact normal, median (degrees)", "x", yrange="-2:90",
        commands="set key inside left top\n"))
    cost = {}
    for world in worlds:
        cost[f"dichotomic, {world}"] = dichotomic(costs, world, lambda r: int(r["signs"]) / int(r["contacts"]))
    for world in worlds:
        for search in ("exhaustive", "exact"):
            cost[f"{search}, {world}"] = across(costs, world, search, lambda r: int(r["signs"]) / int(r["contacts"]))
    return plots.draw(folder, "cost", plots.line_plot(
        cost, TOLERANCE, "signs of orientations a contact (count)", "xy", yrange="100:1e6",
        commands="set key outside center bottom maxrows 3\nset bmargin 8\n")) and done


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    errors, costs, timings = (read_rows_if_any(folder / f"{name}.csv") for name in ("errors", "costs", "timings"))
    text = "# Contact searches: results\n\nTimes as shares of the motion, distances in lengths of the step, angles in degrees; "
    text += "costs a contact, with the sweep that finds it.\n"
    for world in dict.fromkeys(r["world"] for r in errors):
        rows = [r for r in errors if r["world"] == world]
        text += f'\n## {world}: {int(rows[0]["contacts"]):,} contacts\n\n' + error_table(rows) + "\n"
        text += cost_table([r for r in costs if r["world"] == world], timings)
    (folder / "tables.md").write_text(text, encoding="utf-8")
    return 0 if draw_all(folder, errors, costs) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
