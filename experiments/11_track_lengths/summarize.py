#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of experiment 11 from its CSV files.

usage: summarize.py DIR     writes tables.md into DIR
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
from tables import read_rows, read_rows_if_any, share, table, unique  # noqa: E402


def count(text):
    return f"{int(text):,}"


def check_table(rows):
    return table(["world", "rays", "count", "pieces", "blocked", "broken", "judged", "their pieces", "wrong"],
                 [[r["world"], r["rays"], *(count(r[c]) for c in ("count", "pieces", "blocked", "broken", "judged", "judged_pieces", "wrong"))]
                  for r in rows], 2)


def cost_table(rows):
    return table(["world", "rays", "without a sign", "signs a ray", "exact fallbacks a ray"],
                 [[r["world"], r["rays"], share(r["without_signs"], r["judged"]), f'{int(r["signs"]) / int(r["count"]):.3g}',
                   f'{int(r["exact_fallbacks"]) / int(r["count"]):.3g}'] for r in rows], 2)


def failure_table(rows):
    def line(r):
        faults = [r[c] for c in ("endless", "lost", "wrong_cells", "wrong_sums")]
        return [r["world"], r["rays"], r["peer"], *(share(f, r["count"]) for f in faults), share(r["not_nearest"], r["compared"]) if int(r["compared"]) else "",
                r["greatest_error"]]
    return table(["world", "rays", "peer", "endless", "lost", "wrong cells", "wrong sum", "lengths not nearest", "greatest relative error"],
                 [line(r) for r in rows], 3)


def time_table(rows):
    methods = unique(r["method"] for r in rows)
    lines = []
    for world, cells, rays in unique((r["world"], r["cells"], r["rays"]) for r in rows):
        own = {r["method"]: r for r in rows if (r["world"], r["cells"], r["rays"]) == (world, cells, rays)}
        lines.append([world, count(cells), rays] + [f'{own[m]["ns_per_crossing"]} ({own[m]["of_trace"]})' if m in own else "" for m in methods])
    return table(["world", "cells", "rays", *methods], lines, 3)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    threads = read_rows(folder / "threads.csv")
    most = max(int(r["threads"]) for r in threads)
    text = "# Lengths of tracks\n\n## Checks\n\n" + check_table(read_rows(folder / "checks.csv"))
    same = len({(r["world"], r["rays"], r["digest"]) for r in threads}) == len({(r["world"], r["rays"]) for r in threads})
    text += f'\nCells and lengths with 1 to {most} threads: {"the same bytes" if same else "DIFFERENT"}.\n'
    text += "\n## Costs\n\n" + cost_table(read_rows(folder / "costs.csv"))
    text += "\n## Faults of peers\n\n" + failure_table(read_rows(folder / "failures.csv"))
    times = read_rows_if_any(folder / "times.csv")
    if times:
        text += "\n## Times\n\nNanoseconds a crossing, in parentheses over those of `trace`.\n\n" + time_table(times)
    (folder / "tables.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
