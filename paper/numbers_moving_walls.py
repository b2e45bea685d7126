# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 07: macros and tables from its outputs."""

from collect_numbers import count, decimal, escaped, read

OWN = "cellwalk"
TITLES = {"bullet_refit": "Bullet, refit", "bullet_partial": "in part", "bullet_bodies": "of bodies", "embree_refit": "Embree, refit",
          "embree_low": "built", "fcl_refit": "FCL", "cgal_rebuild": "CGAL"}
MOVERS = {"one": "one", "hundred": "100", "branch": "branch", "all": "all"}


def tally(rows, arithmetic):
    """Missed and false answers of all scenes: those of one peer, as all have the same pairs; the most where they differ."""
    methods = {}
    for r in rows:
        if r["method"] != OWN and r["arithmetic"] == arithmetic:
            methods.setdefault(r["method"], []).append(r)
    return max(([sum(int(r[k]) for r in found) for k in ("missed", "false")] for found in methods.values()), key=sum, default=[0, 0])


def collect(report, folder):
    rows = read(folder, "moving_walls.csv")
    own = [r for r in rows if r["method"] == OWN]
    found = {(r["scene"], r["method"]): r for r in rows if r["arithmetic"] == "exact"}
    methods = [m for m in TITLES if any((r["scene"], m) in found for r in own)]
    is_timed = all(r["step_us"] for r in own)
    lines, size = [], None
    for r in own:
        if size not in (None, r["cells"]):
            lines.append(None)
        moves = int(r["moves"]) / int(r["steps"])
        lines.append([count(r["cells"]) if r["cells"] != size else "", MOVERS.get(r["movers"], escaped(r["movers"])), count(round(moves)),
                      *(decimal(float(found[r["scene"], m]["step_us"])) if is_timed and (r["scene"], m) in found else "" for m in [OWN, *methods])])
        size = r["cells"]
    report.table("moving_walls", "rlr" + "r" * (len(methods) + 1), ["cells", "moves", "walls", "Cellwalk", *(TITLES[m] for m in methods)], lines)
    report.define("WallJudged", count(sum(int(r["judged"]) for r in own)))
    report.define("WallBlocked", count(sum(int(r["blocked"]) for r in own)))
    report.define("WallWrong", count(sum(int(r["missed"]) + int(r["false"]) for r in own)))
    report.define("WallBadStops", count(sum(int(r["bad_stops"]) for r in own)))
    for arithmetic in ("float", "double", "exact"):
        missed, false = tally(rows, arithmetic)
        report.define(f"Wall{arithmetic.capitalize()}Missed", count(missed))
        report.define(f"Wall{arithmetic.capitalize()}False", count(false))
    sentence = "Times were not taken in this run."
    if is_timed and methods:
        largest = max(int(r["cells"]) for r in own)

        def ratio(movers):
            r = next(r for r in own if r["movers"] == movers and int(r["cells"]) == largest)
            return float(r["step_us"]) / min(float(found[r["scene"], m]["step_us"]) for m in methods if (r["scene"], m) in found)
        sentence = (f"In the largest vessel a step takes Cellwalk {decimal(ratio('one'), 2)} times as long as the fastest hierarchy if one vertex moves, "
                    f"and {decimal(ratio('all'), 2)} times if all do.")
    report.define("WallTimes", sentence)
