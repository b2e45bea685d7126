# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 08: macros and a table from its outputs."""

from collect_numbers import count, decimal, read

SHOWN = ("8", "64", "1024")


def per_cent(part, whole):
    return decimal(100 * int(part) / int(whole), 2) if int(whole) and int(part) else "0" if int(whole) else ""


def collect(report, folder):
    rows = read(folder, "handovers.csv")
    parts = {(r["scene"], r["ranks"]): r for r in read(folder, "parts.csv")}
    lines = []
    for scene in dict.fromkeys(r["scene"] for r in rows):
        of_scene = [r for r in rows if r["scene"] == scene]
        shown = [r for r in of_scene if r["ranks"] in SHOWN] or of_scene
        if lines:
            lines.append(None)
        for r in shown:
            part = parts[scene, r["ranks"]]
            lines.append([scene if r is shown[0] else "", count(r["ranks"]), count(round(int(part["cells"]) / int(r["ranks"]))),
                          decimal(int(r["most_vertices"]) * int(r["ranks"]) / int(r["vertices"])), per_cent(r["moved"], r["vertices"]),
                          per_cent(r["parted"], r["edges"]), per_cent(part["ghosts"], part["cells"])])
    report.table("scaling", "lrrrrrr", ["scene", "ranks", "cells a rank", "fullest", "handed over", "edges parted", "ghosts"], lines)
    # Where a rank has some hundred cells or more, little is handed over.
    wide = [r for r in rows if int(parts[r["scene"], r["ranks"]]["cells"]) >= 200 * int(r["ranks"])]
    report.define("ScalingHandedMost", decimal(max(100 * int(r["moved"]) / int(r["vertices"]) for r in wide or rows), 2))
    report.define("ScalingRanksMost", count(max(int(r["ranks"]) for r in wide or rows)))
