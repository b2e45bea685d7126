# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 06: macros and tables from its outputs."""

from collect_numbers import count, decimal, escaped, percent, read

TITLES = {"S1a_vessel": "catheter, vessel", "S1b_vessel_fine": "fine catheter, vessel", "S2_aneurysm": "catheter, aneurysm",
          "S3_spheres": "soft spheres, vessel", "S3_aneurysm_spheres": "soft spheres, aneurysm", "S4_soft_ring": "soft ring",
          "S5_rigid_ring": "rigid ring", "S6_at_rest": "bodies at rest", "S7_many": "many hexahedra"}
CATHETERS = ("S1a_vessel", "S1b_vessel_fine", "S2_aneurysm")
LIBRARIES = {"bullet": "Bullet", "embree": "Embree", "cgal": "CGAL"}
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
    rounded = []
    for library in ("bullet", "embree"):
        methods = {}
        for r in rows:
            if r["library"] == library:
                methods.setdefault(r["method"], []).append(r)
        if methods:
            # One margin of each scene: all give the same answers.
            tallies = [wrong({r["scene"]: r for r in of_method}.values()) for of_method in methods.values()]
            missed, false = min(tallies, key=sum)
            rounded.append(f"{LIBRARIES[library]} misses {count(missed)} and makes up {count(false)}")
    report.define("AppRounded", "by the method with fewest wrong answers " + ", ".join(rounded) if rounded else
                  "none of them was installed where this was run")


def define_times(report, scenes):
    names = ["AppCatheterSteps", "AppFastest", "AppFastestExact", "AppLarge"]
    own = {s: next(r for r in rows if r["method"] == "cellwalk_complete") for s, rows in scenes.items()}
    if not all(r["ns_per_vertex_move"] for r in own.values()):
        for name in names:
            report.define(name, "(times were not taken)")
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
    report.define("AppLarge", ratios(False, [s for s in ("S4_soft_ring", "S5_rigid_ring") if s in scenes]))


def collect(report, folder):
    rows = read(folder, "real_scenes.csv")
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
