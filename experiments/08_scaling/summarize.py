#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of experiment 08 from its CSV files, with the model of docs/scaling.md.

usage: summarize.py DIR [--latency US] [--bandwidth GB_PER_S]     writes tables.md into DIR
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
from tables import read_rows, read_rows_if_any, share, table, unique  # noqa: E402

VERTEX_BYTES = 128  # a vertex that is handed over: position, target, cell, number, and its share of edges
CHAIN_BYTES = 96    # a temporary particle that goes on in another range: ends, the chain so far, number
ROUNDS = 3          # of messages a step to each neighbour: targets, chains that go on, answers


def handover_table(rows):
    return table(["ranks", "vertices of the fullest rank, of the mean", "vertices handed over", "edges in several ranks",
                  "crossings an edge", "bodies in several ranks", "vertices of a body that wait"], [
        [r["ranks"], f'{int(r["most_vertices"]) * int(r["ranks"]) / int(r["vertices"]):.3g}', share(r["moved"], r["vertices"]),
         share(r["parted"], r["edges"]) if int(r["edges"]) else "", f'{int(r["crossings"]) / int(r["edges"]):.3g}' if int(r["edges"]) else "",
         share(r["parted_bodies"], r["bodies"]) if int(r["bodies"]) else "",
         f'{int(r["longest"]) / (int(r["steps"]) + 1):.3g}' if int(r["edges"]) else ""] for r in rows])


def part_table(rows):
    return table(["ranks", "cells a rank", "cells of others, of its own", "neighbours, at most"], [
        [r["ranks"], f'{int(r["cells"]) / int(r["ranks"]):.0f}', share(r["ghosts"], r["cells"]), r["most_neighbours"]] for r in rows])


def seconds(row, neighbours, us_per_vertex, latency, bandwidth):
    """Of a step, by the model: the fullest rank works, the longest body waits for answers, and messages are sent."""
    steps = int(row["steps"]) + 1
    work = 1e-6 * us_per_vertex * int(row["most_vertices"]) / steps
    received = int(row["most_received"]) / steps
    waiting = 2e-6 * latency * int(row["longest"]) / steps
    return work + waiting + 1e-6 * latency * ROUNDS * neighbours + received * max(VERTEX_BYTES, CHAIN_BYTES) / (1e9 * bandwidth)


def model_table(rows, parts, us_per_vertex, given):
    neighbours = {r["ranks"]: int(r["most_neighbours"]) for r in parts}
    lines = []
    for r in rows:
        alone = 1e-6 * us_per_vertex * int(r["vertices"]) / (int(r["steps"]) + 1)
        together = seconds(r, neighbours[r["ranks"]], us_per_vertex, given.latency, given.bandwidth)
        lines.append([r["ranks"], f"{1e6 * together:.3g}", f"{alone / together:.3g}", f"{100 * alone / together / int(r['ranks']):.3g} %"])
    return table(["ranks", "us a step", "speed-up", "efficiency"], lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder", type=Path)
    parser.add_argument("--latency", type=float, default=2, help="of a message, us")
    parser.add_argument("--bandwidth", type=float, default=10, help="of a rank, GB/s")
    given = parser.parse_args()
    handovers, parts = read_rows(given.folder / "handovers.csv"), read_rows(given.folder / "parts.csv")
    times = {r["scene"]: float(r["us_per_vertex"]) for r in read_rows_if_any(given.folder / "timings.csv")}
    text = "# Decomposed environments\n"
    for scene in unique(r["scene"] for r in handovers):
        own, own_parts = ([r for r in rows if r["scene"] == scene] for rows in (handovers, parts))
        steps = int(own[0]["steps"]) + 1
        text += (f'\n## {scene}\n\n{own_parts[0]["cells"]} cells, {int(own[0]["vertices"]) // steps} vertices and '
                 f'{int(own[0]["edges"]) // steps} edges on average, {own[0]["steps"]} steps.\n\n')
        text += handover_table(own) + "\n" + part_table(own_parts)
        if scene in times:
            text += f"\nModel, with {times[scene]:.3g} us a vertex measured:\n\n" + model_table(own, own_parts, times[scene], given)
    (given.folder / "tables.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
