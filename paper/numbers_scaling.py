# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 08: macros and a table from its outputs."""

from collect_numbers import count, decimal, read

SHOWN = ("8", "64", "1024")
WIDE = 200  # cells of a rank of which the text says how little is handed over


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
                          decimal(over_mean(r)), per_cent(r["moved"], r["vertices"]),
                          per_cent(r["parted"], r["edges"]), per_cent(part["ghosts"], part["cells"])])
    report.table("scaling", "lrrrrrr", ["scene", "ranks", "cells a rank", "fullest", "handed over", "edges parted", "ghosts"], lines)
    per_rank = {(r["scene"], r["ranks"]): int(parts[r["scene"], r["ranks"]]["cells"]) / int(r["ranks"]) for r in rows}
    least = min(WIDE, round(max(per_rank.values())))
    wide = [r for r in rows if per_rank[r["scene"], r["ranks"]] >= least]
    report.define("ScalingCellsLeast", count(least))
    report.define("ScalingHandedMost", decimal(max(100 * int(r["moved"]) / int(r["vertices"]) for r in wide), 2))
    report.define("ScalingRanksMost", count(max(int(r["ranks"]) for r in wide)))
    fullest = max(rows, key=over_mean)
    report.define("ScalingFullest", f"{decimal(over_mean(fullest), 2)} times the mean ({fullest['scene']}, {count(fullest['ranks'])} ranks)")
    report.define("ScalingGhosts", ghosts(parts, per_rank))


def over_mean(row):
    """The vertices of the fullest rank over the mean of all."""
    return int(row["most_vertices"]) * int(row["ranks"]) / int(row["vertices"])


def ghosts(parts, per_rank):
    """Up to how many cells a rank may hold more of others than its own."""
    crowded = {key: n for key, n in per_rank.items() if int(parts[key]["ghosts"]) > int(parts[key]["cells"])}
    if crowded:
        key = max(crowded, key=crowded.get)
        return f"ranks of {count(round(crowded[key]))} cells ({key[0]}) hold more cells of others than their own"
    key = max(per_rank, key=lambda k: int(parts[k]["ghosts"]) / int(parts[k]["cells"]))
    share = per_cent(parts[key]["ghosts"], parts[key]["cells"])
    return rf"ranks of {count(round(per_rank[key]))} cells ({key[0]}) hold {share}\,\% as many cells of others as of their own"
