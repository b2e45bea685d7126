#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables and plots of experiment 03 from its CSV files.

usage: summarize.py DIR     writes tables.md, and missed, cost, depth and floating as .gp, .png, .svg and .pdf, into DIR

Without gnuplot the tables and the plots' scripts are written, and the program says so and returns 3.
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
import plots  # noqa: E402
from tables import read_rows_if_any, table  # noqa: E402

INRADIUS = 0.5  # of all faces, in the unit of the depths
SIZE = "side of the obstacles / length of the step"


def count(text):
    return f"{int(text):,}"


def percent(text):
    return f"{100 * float(text):.3g}" if text else ""


def key(row):
    return row["dimension"], row["edge_over_step"], row["size_over_step"]


def sweep_table(sweeps):
    header = ["dimension", "edge / step", "size / step", "sweeps", "contacts", "expected", "of the edge", "missed", "late", "false",
              "missed, %", "95 % interval"]
    return table(header, [
        [r["dimension"], r["edge_over_step"], r["size_over_step"], count(r["sweeps"]), count(r["contacts"]),
         f'{float(r["expected_contacts"]):,.0f}', count(r["edge_contacts"]), count(r["missed"]), count(r["late"]),
         count(r["false_contacts"]), percent(r["missed_share"]),
         f'{percent(r["missed_share_low"])} to {percent(r["missed_share_high"])}'] for r in sweeps])


def cost_table(costs, timings):
    times = {(key(r), r["sweep"]): r["ns_per_sweep"] for r in timings}
    header = ["dimension", "edge / step", "size / step", "sweep", "by certificates, %", "events, %", "signs",
              "exact signs", "ns"]
    lines = []
    for r in costs:
        n, edges = int(r["sweeps"]), max(1, int(r["edges"]))
        certified = sum(int(r[c]) for c in ("same_cell", "same_chain"))
        time = times.get((key(r), r["sweep"]))
        lines.append([r["dimension"], r["edge_over_step"], r["size_over_step"], r["sweep"].replace("_", " "),
                      f"{100 * certified / edges:.3g}",
                      f'{100 * int(r["event_sweeps"]) / n:.3g}', f'{int(r["signs"]) / n:.3g}',
                      f'{int(r["exact_signs"]) / n:.2g}', f"{float(time):,.0f}" if time else ""])
    return table(header, lines)


def spike_table(spikes):
    header = ["faces", "sharpness", "trials", "pierced", "bound", "mean depth", "median", "greatest", "of the bound, median", "greatest", "beyond",
              "pierced, faces swept"]
    return table(header, [
        [r["aim"], r["sharpness"], count(r["faces"]), count(r["pierced"]),
         *(f"{float(r[c]):.4g}" if r[c] else "" for c in ("bound", "depth_mean", "depth_median", "depth_max",
                                                          "share_of_bound_median", "share_of_bound_max")),
         r["beyond_bound"], r["pierced_with_faces"]] for r in spikes])


def floating_table(floating):
    return table(["side / inradius", "faces", "passed, %", "95 % interval", "passed, faces swept"],
                 [[r["size_over_inradius"], count(r["faces"]), percent(r["passed_share"]),
                   f'{percent(r["passed_share_low"])} to {percent(r["passed_share_high"])}', r["passed_with_faces"]]
                  for r in floating])


def series_of(rows, name, point):
    result = {}
    for r in rows:
        result.setdefault(name(r), []).append(point(r))
    return result


def size_tics(rows):
    values = sorted({float(r["size_over_step"]) for r in rows})
    return {f"1/{round(1 / x)}" if x < 1 else f"{x:g}": x for x in values}


def shares(row, name):
    """A share and its interval, as percentages."""
    return [100 * float(row[c]) for c in (f"{name}_share", f"{name}_share_low", f"{name}_share_high")]


def draw_sweeps(folder, sweeps, costs):
    missed = series_of(sweeps, lambda r: f'{r["dimension"]}D, edge = {float(r["edge_over_step"]):g} step(s)',
                       lambda r: (float(r["size_over_step"]), *shares(r, "missed")))
    cost = series_of([r for r in costs if r["dimension"] == "3"],
                     lambda r: f'{r["sweep"].replace("_", " ")}, edge = {float(r["edge_over_step"]):g} step(s)',
                     lambda r: (float(r["size_over_step"]), int(r["signs"]) / int(r["sweeps"])))
    tics = size_tics(sweeps)
    done = plots.draw(folder, "missed", plots.line_plot(
        missed, SIZE, "contacts of the edge that three segments miss (%)", "x", xrange="0.025:2", yrange="0:100", tics=tics,
        commands="set key inside right top\n"))
    return plots.draw(folder, "cost", plots.line_plot(
        cost, SIZE, "signs of orientations a sweep, 3D (count)", "xy", xrange="0.025:2", yrange="1:30000", tics=tics,
        commands="set key inside left top\n")) and done


def draw_faces(folder, spikes, floating):
    random = [r for r in spikes if r["aim"] == "random"]
    worst = [r for r in spikes if r["aim"] == "worst"]

    def depths(rows, column):
        return [(float(r["sharpness"]), float(r[column]) / INRADIUS) for r in rows]
    depth = {"bound": depths(random, "bound"), "greatest, aimed at the centre": depths(worst, "depth_max"),
             "greatest, random": depths(random, "depth_max"), "median, random": depths(random, "depth_median")}
    done = plots.draw(folder, "depth", plots.line_plot(
        depth, "sharpness of the spike: height / radius of its base", "depth behind the face (inradii of the face)", "xy",
        xrange="0.9:36", tics={r["sharpness"]: float(r["sharpness"]) for r in random},
        commands="set key inside left top\n"))
    passed = {"edges swept, no faces": [(float(r["size_over_inradius"]), *shares(r, "passed")) for r in floating],
              "faces swept": [(float(r["size_over_inradius"]), 100 * int(r["passed_with_faces"]) / int(r["faces"]))
                              for r in floating]}
    return plots.draw(folder, "floating", plots.line_plot(
        passed, "side of a floating cube / inradius of the face", "faces that it passes unseen (%)", xrange="0.2:2.05",
        yrange="-2:100", commands="set key inside right top\n")) and done


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    sweeps, costs, timings = (read_rows_if_any(folder / f"{name}.csv") for name in ("sweeps", "costs", "timings"))
    spikes, floating = (read_rows_if_any(folder / f"{name}.csv") for name in ("spikes", "floating"))
    text = "# Small obstacles: results\n\n## Contacts of an edge, and those that three segments miss\n\n" + sweep_table(sweeps)
    text += "\n## What a sweep costs\n\nA move of one end, its walk included.\n\n" + cost_table(costs, timings)
    text += "\n## Faces that come down on a spike, their edges swept completely\n\nDepths in units in which the inradius of each "
    text += "face is 1/2.\n\n" + spike_table(spikes)
    text += "\n## Faces that fall over a floating cube\n\n" + floating_table(floating)
    (folder / "tables.md").write_text(text, encoding="utf-8")
    drawn = [draw_sweeps(folder, sweeps, costs), draw_faces(folder, spikes, floating)]
    return 0 if all(drawn) else plots.NO_GNUPLOT


if __name__ == "__main__":
    sys.exit(main())
