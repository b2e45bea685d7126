#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of experiment 10 from its CSV files.

usage: summarize.py DIR     writes tables.md into DIR
"""

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "common"))
from tables import read_rows, table  # noqa: E402

TITLES = {"vessels": "Vessels", "cells": "Meshes of cells", "surfaces": "Other surfaces"}


def group_table(rows, imports):
    heads = ["file", "triangles, cells", "faults", "`--strict`", "import", "changes", "cells", "components", "free volume", "moved", "s"]
    lines = []
    for r in rows:
        outcome = r["repaired"] if r["repaired"] == "imported" else f'{r["repaired"]}: {r["message"]}'
        own = imports[r["name"]]
        lines.append([f'`{r["name"]}`', f'{int(r["size"]):,}', r["faults"], r["strict"], outcome, r["changes"],
                      f'{int(own["cells"]):,}' if own["cells"] else "", r["components"], r["free_volume"], own["moved"], own["seconds"]])
    return table(heads, lines, 1)


def state_table(rows):
    heads = ["scene", "vessel", "edges", "meet the surface", "nearest", "contact distance", "radius", "nearer than the radius", "free", "contact",
             "outside", "close"]
    keys = ["edges", "meet_surface", "nearest", "contact_distance", "radius", "nearer_than_radius", "free", "contact", "outside", "close"]
    return table(heads, [[f'`{r["name"]}`', f'`{r["vessel"]}`', *(r[k] for k in keys)] for r in rows], 2)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    rows = read_rows(folder / "audit.csv")
    imports = {r["name"]: r for r in read_rows(folder / "imports.csv")}
    text = "# Public meshes\n"
    for group in dict.fromkeys(r["group"] for r in rows):
        some = [r for r in rows if r["group"] == group]
        faulty = sum(bool(r["faults"]) for r in some)
        strict, repaired = (sum(r[c] == "imported" for r in some) for c in ("strict", "repaired"))
        text += (f"\n## {TITLES[group]}\n\n{len(some)} files: {faulty} with faults; {strict} imported with `--strict`, {repaired} without.\n\n"
                 + group_table(some, imports))
    if (folder / "end_states.csv").exists():
        text += "\n## End states of catheters\n\n" + state_table(read_rows(folder / "end_states.csv"))
    (folder / "tables.md").write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
