# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 07: macros and tables from its outputs."""

from collect_numbers import count, decimal, escaped, read, span

OWN = "cellwalk"
TITLES = {"bullet_refit": "Bullet, refit", "bullet_partial": "in part", "bullet_bodies": "of bodies", "embree_refit": "Embree, refit",
          "embree_low": "built", "fcl_refit": "FCL", "cgal_rebuild": "CGAL"}
WHOLE = ("bullet_refit", "embree_refit", "embree_low", "fcl_refit", "cgal_rebuild")  # hierarchies of all walls, made anew as a whole
NAMES = {"bullet_refit": "Bullet, refitted", "bullet_partial": "Bullet, in part", "bullet_bodies": "Bullet, of bodies", "embree_refit": "Embree, refitted",
         "embree_low": "Embree, built", "fcl_refit": "FCL", "cgal_rebuild": "CGAL"}
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
    report.define("WallTimes", wall_times(own, found, methods) if is_timed and methods else "Times were not taken in this run.")
    tallies = [sum(tally(rows, "exact")), sum(int(r["missed"]) + int(r["false"]) for r in own)]
    is_beaten = is_timed and methods and all(float(r["step_us"]) > quickest(r, found, methods)[0] for r in own)
    report.define("WallChoice", " So if only hits are asked for, a hierarchy with exact tests is the better choice." if is_beaten and not any(tallies) else "")


def quickest(row, found, methods):
    """The time of the fastest hierarchy in the scene of a row, and its name."""
    return min((float(found[row["scene"], m]["step_us"]), m) for m in methods if (row["scene"], m) in found)


def wall_times(own, found, methods):
    largest = max(int(r["cells"]) for r in own)
    one, every = (next(r for r in own if r["movers"] == movers and int(r["cells"]) == largest) for movers in ("one", "all"))

    def ratio(row):
        time, method = quickest(row, found, methods)
        return decimal(float(row["step_us"]) / time, 2), NAMES[method]
    (few, fastest), (many, fastest_of_many) = ratio(one), ratio(every)
    whole = [float(found[one["scene"], m]["step_us"]) / float(one["step_us"]) for m in WHOLE if (one["scene"], m) in found]
    return (f"In the largest vessel a step takes Cellwalk {few} times as long as the fastest hierarchy if one vertex moves ({fastest}), "
            f"and {many} times if all do ({fastest_of_many})." +
            (f" With one vertex, the hierarchies of Table~\\ref{{wallstable}} that are refitted as a whole or built take {span(whole)} times as long as Cellwalk."
             if whole else ""))
