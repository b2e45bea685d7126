# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 06: macros and tables from its outputs."""

import re

from collect_numbers import count, decimal, escaped, percent, read, span

TITLES = {"R1_pressed": "pressed catheter, vessel", "R2_pressed_aneurysm": "pressed catheter, aneurysm",
          "S1a_vessel": "catheter, vessel", "S1b_vessel_fine": "fine catheter, vessel", "S2_aneurysm": "catheter, aneurysm",
          "S3_spheres": "soft spheres, vessel", "S3_aneurysm_spheres": "soft spheres, aneurysm", "S4_soft_ring": "soft ring",
          "S5_rigid_ring": "rigid ring", "S6_at_rest": "bodies at rest", "S7_many": "many hexahedra"}
RINGS = ("S4_soft_ring", "S5_rigid_ring")
THICK = r"T\d+_"  # bodies with a radius, of which the report says nothing
AT_REST = "S6_at_rest"
CATHETERS = ("R1_pressed", "R2_pressed_aneurysm", "S1a_vessel", "S1b_vessel_fine", "S2_aneurysm")
LIBRARIES = {"bullet": "Bullet", "fcl": "FCL", "embree": "Embree", "cgal": "CGAL"}
# What a method is, by the second word of its name.
KINDS = {"star": "kept boxes", "group": "kept boxes", "body": "kept boxes", "move": "a box of each move", "8": "rays", "16": "rays", "tree": "segments"}
HAPTIC_PERIOD = 1000  # microseconds, of a device served at 1 kHz


def time(row):
    return float(row["ns_per_vertex_move"])


def title(scene):
    base, _, finer = scene.partition("_finer_")
    name = TITLES.get(base, escaped(base).replace(r"\_", " "))
    return f"{name}, cells 1/{finer}" if finer else name


def brief(value):
    return f"{value:.1f}" if value < 99.95 else count(round(value))


def step(row):
    most, longest = brief(float(row["step_us_p999"])), brief(float(row["step_us_max"]))
    return most if most == longest else f"{most} / {longest}"


def named(row):
    return LIBRARIES.get(row["library"], escaped(row["library"])) + ", " + row["method"].split("_")[1]


def fastest(rows, is_exact=False):
    return min((r for r in rows if r["library"] != "cellwalk" and (r["exact"] == "1" or not is_exact)), key=time, default=None)


def wrong(rows, **where):
    found = [r for r in rows if all(r[k] == v for k, v in where.items())]
    return [sum(int(r[k]) for r in found) for k in ("missed", "false")]


def define_wrong(report, scenes):
    rows = [r for of_scene in scenes.values() for r in of_scene]
    own, exact = wrong(rows, library="cellwalk"), wrong([r for r in rows if r["library"] != "cellwalk"], exact="1")
    firsts = [of_scene[0] for of_scene in scenes.values()]
    report.define("AppScenes", len(scenes))
    report.define("AppMoves", count(sum(int(r["moves"]) for r in firsts)))
    report.define("AppBlocked", count(sum(int(r["blocked"]) for r in firsts)))
    report.define("AppWrong", count(sum(own)))
    report.define("AppExactWrong", count(sum(exact)))
    report.define("AppRounded", rounded_peers(rows))


def rounded_peers(rows):
    rounded = []
    for library in ("bullet", "fcl", "embree"):
        methods = {}
        for r in rows:
            if r["library"] == library:
                methods.setdefault(r["method"], []).append(r)
        if methods:
            # One margin of each scene: all give the same answers.
            tallies = [wrong({r["scene"]: r for r in of_method}.values()) for of_method in methods.values()]
            missed, false = min(tallies, key=sum)
            chosen = list(methods.values())[tallies.index([missed, false])]
            at_rest = sum(wrong({r["scene"]: r for r in chosen if r["scene"].partition("_finer_")[0] == AT_REST}.values()))
            where = "there" if rounded else "of these where bodies rest on oblique walls"
            rounded.append(f"{LIBRARIES[library]} misses {count(missed)} blocked moves and makes up {count(false)} ({count(at_rest)} {where})")
    if not rounded:
        return "No rounded peer was installed where this was run."
    return f"Of rounded peers, by the method with fewest wrong answers, {', '.join(rounded)}."


def define_times(report, scenes):
    names = ["AppCatheterSteps", "AppFastest", "AppFastestExact", "AppRings"]
    own = {s: next(r for r in rows if r["method"] == "cellwalk_complete") for s, rows in scenes.items()}
    if not all(r["ns_per_vertex_move"] for r in own.values()):
        for name in names:
            report.define(name, "(times were not taken)")
        for name in ("AppKinds", "AppFiner"):
            report.define(name, "")
        return

    def ratios(is_exact, chosen):
        found = [time(own[s]) / time(peer) for s in chosen if (peer := fastest(scenes[s], is_exact)) is not None]
        return f"{min(found):.1f} to {max(found):.1f}" if found else "(no peer)"
    catheters = [own[s] for s in own if s.partition("_finer_")[0] in CATHETERS]
    least = min(HAPTIC_PERIOD / float(r["step_us_p999"]) for r in catheters)
    report.define("AppCatheterSteps", rf"at most {brief(max(float(r['step_us_p999']) for r in catheters))}\,\textmu s, and the longest of all takes "
                                      rf"{brief(max(float(r['step_us_max']) for r in catheters))}\,\textmu s; a device that is served at 1\,kHz leaves "
                                      f"{decimal(least, 2)} times the former")
    report.define("AppFastest", ratios(False, scenes))
    report.define("AppFastestExact", ratios(True, scenes))
    rings = [s for s in RINGS if s in scenes]
    peers = dict.fromkeys(named(fastest(scenes[s])) for s in rings if fastest(scenes[s]) is not None)
    report.define("AppRings", f"{ratios(False, rings)} ({'; '.join(peers)})" if peers else "(no peer)")
    report.define("AppKinds", kinds_of_peers(scenes))
    report.define("AppFiner", with_finer_cells(scenes, own))


def kinds_of_peers(scenes):
    kinds = [KINDS[peer["method"].split("_")[1]] for rows in scenes.values() if (peer := fastest(rows)) is not None]
    if not kinds:
        return ""
    most_first = sorted(set(kinds), key=lambda kind: (-kinds.count(kind), kind))
    return " The fastest peers are " + ", ".join(f"{kind} in {kinds.count(kind)}" for kind in most_first) + " of the scenes."


def with_finer_cells(scenes, own):
    """What the finest cells in the same walls cost, each scene beside the one without."""
    finer = {s: s.partition("_finer_") for s in scenes if "_finer_" in s and s.partition("_finer_")[0] in scenes}
    finest = max((f for _, _, f in finer.values()), key=int, default=None)
    pairs = [(s, base) for s, (base, _, f) in finer.items() if f == finest and fastest(scenes[s]) is not None]
    if not pairs:
        return ""
    ours = [time(own[s]) / time(own[base]) for s, base in pairs]
    peers = [time(fastest(scenes[s])) / time(fastest(scenes[base])) for s, base in pairs]
    return f" If edges of cells are {finest} times shorter in the same walls, we take {span(ours)} times as long, and the fastest peer {span(peers)} times."


def collect(report, folder):
    rows = [r for r in read(folder, "real_scenes.csv") if not re.match(THICK, r["scene"])]
    scenes = {s: [r for r in rows if r["scene"] == s] for s in sorted({r["scene"] for r in rows})}
    lines = []
    for scene, of_scene in scenes.items():
        own = next(r for r in of_scene if r["method"] == "cellwalk_complete")
        line = [title(scene), count(own["cells"]), percent(int(own["blocked"]) / int(own["moves"]))]
        if own["ns_per_vertex_move"]:
            line += [brief(time(own)), step(own)]
            for peer in (fastest(of_scene), fastest(of_scene, is_exact=True)):
                line += [named(peer), brief(time(peer)), step(peer)] if peer is not None else ["", "", ""]
        else:
            line += [""] * 8
        lines.append(line)
    report.table("application", "lrr|rr|lrr|lrr", ["scene", "cells", r"\%", "ours", "step", "fastest peer", "ns", "step", "fastest exact", "ns", "step"],
                 lines)
    define_wrong(report, scenes)
    define_times(report, scenes)
