#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of experiment 13 from its CSV files.

usage: summarize.py DIR     writes tables.md into DIR
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
from tables import read_rows_if_any, share, table  # noqa: E402

PARTS = [("walks", "Walks"), ("sweeps", "Complete sweeps among solid cells"),
         ("membrane_sweeps", "Complete sweeps among membranes"), ("thick_sweeps", "Complete sweeps with a radius")]


def rows_of(part, rows):
    counts = ["judged", "degenerate", "blocked", "by_edge", "wrong"]
    rows = [dict(row, **{c: int(row[c]) for c in counts}) for row in rows]
    rows.append(dict({c: sum(row[c] for row in rows) for c in counts}, dimension="all", cells="", motions=""))
    edge = part != "walks"
    header = ["dimension", "cells", "motions", "judged", "degenerate", "blocked", *(["by the edge alone"] if edge else []), "wrong"]
    return table(header, [[r["dimension"], r["cells"], r["motions"], f'{r["judged"]:,}', share(r["degenerate"], r["judged"]), share(r["blocked"], r["judged"]),
                           *([share(r["by_edge"], r["judged"])] if edge else []), r["wrong"]] for r in rows], 3)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    text = "# Endurance\n"
    for part, title in PARTS:
        rows = read_rows_if_any(folder / f"{part}.csv")
        if rows:
            text += f"\n## {title}\n\n{rows_of(part, rows)}"
    (folder / "tables.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
