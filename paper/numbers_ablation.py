# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 09: macros and tables from its outputs."""

from collect_numbers import count, decimal, escaped, has, percent, read, span

SCENES = {"catheter": "catheter", "fine_catheter": "fine catheter", "hexahedra": "hexahedra"}
CATHETERS = ("catheter", "fine_catheter")
CHOICES = {"all": "all certificates", "no_region_of_the_body": "no region of the body", "no_regions_of_stars": "no regions of stars",
           "no_clusters": "no clusters", "no_chains_in_place": "no chains in place", "no_certificate_of_edges": "none of edges"}
WAYS = {"planes": "planes, then signs", "planes_no_own_cell_first": "no test of the own cell first", "planes_no_forecast": "no forecast",
        "signs": "signs, exit rule", "signs_no_forecast": "no forecast", "simplex": "signs, predictive simplex",
        "simplex_no_forecast": "no forecast", "lazy_signs": "lazy signs, exit rule", "rational_signs": "rational signs, exit rule"}
WORLDS = {("boxes", "0.0625"): "boxes of 1/16", ("boxes", "0.25"): "boxes of 1/4", ("cubes", "1"): "solid cubes"}


def share(row, column):
    """In per cent of the motions made, with two digits."""
    value = 100 * int(row[column]) / int(row["made"])
    return decimal(value, 2) if value else "0"


def certificates(report, folder):
    rows = {(r["scene"], r["regions"], r["certificates"]): r for r in read(folder, "certificates.csv")}
    times = {}
    if has(folder, "certificate_times.csv"):
        times = {(r["scene"], r["regions"], r["certificates"]): float(r["ns_per_vertex_move"]) for r in read(folder, "certificate_times.csv")}

    def per_move(key, column):
        return int(rows[key][column]) / int(rows[key]["moves"])
    lines = []
    for regions in "10":
        if lines:
            lines.append(None)
        for choice, title in CHOICES.items():
            if ("catheter", regions, choice) not in rows:
                continue
            line = [("" if regions == "1" else "no regions; ") + title]
            for scene in SCENES:
                key = (scene, regions, choice)
                line += [decimal(1000 * per_move(key, "event_sweeps"), 2), decimal(per_move(key, "signs"), 2),
                         f"{times[key]:.0f}" if times else ""]
            lines.append(line)
    columns = ["events", "signs", "ns"]
    report.table("certificates", "l" + "rrr" * len(SCENES), ["", *(f"{title.split()[0]}, {c}" if c == "events" else c
                                                               for title in SCENES.values() for c in columns)], lines)
    report.define("AblationAnswers", count(sum(int(r["moves"]) for r in rows.values())))
    report.define("AblationDifferent", count(sum(int(r["different"]) for r in rows.values())))
    report.define("AblationChoices", len(rows) // len(SCENES))

    def ratio_of(column, one, other, scenes=SCENES):
        return span([per_move((s, *one), column) / max(per_move((s, *other), column), 1e-9) for s in scenes], 3)
    report.define("AblationRegions", ratio_of("edges", ("0", "all"), ("1", "all")))
    report.define("AblationEdges", ratio_of("signs", ("0", "no_certificate_of_edges"), ("0", "all")))
    for name, scenes in (("Catheters", CATHETERS), ("Hexahedra", ("hexahedra",))):
        report.define(f"AblationPlace{name}", ratio_of("signs", ("0", "no_chains_in_place"), ("0", "all"), scenes))
    whole = [r for (_, _, choice), r in rows.items() if choice == "all" and int(r["edges"])]
    report.define("AblationRelinked", percent(max((int(r["relinked"]) / int(r["edges"]) for r in whole), default=0)))
    sentence = "Times were not taken in this run."
    if times:
        def ratio(choice, regions="0"):
            values = [times[s, regions, choice] / times[s, regions, "all"] for s in SCENES]
            return f"{min(values):.1f} to {max(values):.1f}"
        sentence = (f"Without regions, moves take {ratio('no_chains_in_place')} times as long if chains are not confirmed in place, and "
                    f"{ratio('no_certificate_of_edges')} times if each edge is swept by its events.")
    report.define("AblationTimes", sentence)


def flights(report, folder):
    rows = [r for r in read(folder, "flights.csv") if r["length_over_edge"] == "0.5"]
    times = {}
    if has(folder, "flight_times.csv"):
        times = {(r["world"], r["way"]): float(r["ns_per_move"]) for r in read(folder, "flight_times.csv") if r["length_over_edge"] == "0.5"}
    found = {(r["world"], r["way"]): r for r in rows}
    worlds = list(dict.fromkeys(r["world"] for r in rows))
    lines = []
    for way, title in WAYS.items():
        line = [title]
        for world in worlds:
            r = found[world, way]
            line += [decimal(int(r[c]) / int(r["moves"]), 2) for c in ("plane_blocks", "signs")]
            line.append(count(times[world, way]) if times else "")
        lines.append(line)
    report.table("flights", "l" + "rrr" * len(worlds), ["", *(t for w in worlds for t in (f"{escaped(w)}, blocks", "signs", "ns"))], lines)
    define_flights(report, read(folder, "flights.csv"))
    ratios = [times[w, "rational_signs"] / times[w, "signs"] for w in worlds] if times else []
    report.define("FlightRational", f" By the exit rule, moves by rational signs take {span(ratios)} times as long as by filtered ones." if ratios else "")


def define_flights(report, rows):
    report.define("FlightMoves", count(sum(int(r["moves"]) for r in rows)))
    report.define("FlightDifferent", count(sum(int(r["different"]) for r in rows)))
    report.define("FlightPlaneSigns", span([1000 * int(r["signs"]) / int(r["moves"]) for r in rows if r["way"] == "planes"]))
    signs = {(r["world"], r["length_over_edge"], r["way"]): int(r["signs"]) for r in rows}

    def saved(way):
        """The most that the forecast saves, and the length of the moves."""
        without = {k: signs[(*k[:2], f"{way}_no_forecast")] for k in signs if k[2] == way}
        return max((1 - signs[k] / n if n else 0, k[1]) for k, n in without.items())
    most, length = saved("simplex")
    report.define("FlightForecast", percent(most))
    report.define("FlightForecastLength", length)
    others = max(saved(way)[0] for way in ("planes", "signs"))
    report.define("FlightForecastOthers", rf"at most {percent(others)}\,\% there" if others else "none there")


def orders(report, folder):
    rows = read(folder, "orders.csv")
    found = {(r["world"], r["size"], r["motion"], r["step_over_edge"]): r for r in rows}
    steps = list(dict.fromkeys(r["step_over_edge"] for r in rows))
    lines = []
    for motion in ("turn", "independent"):
        if lines:
            lines.append(None)
        for step in steps:
            line = [motion, f"1/{round(1 / float(step))}" if float(step) < 1 else step]
            for world in WORLDS:
                r = found[(*world, motion, step)]
                line += [share(r, "together"), share(r, "p_first_only"), share(r, "together_only"), share(r, "orders_differ")]
            lines.append(line)
    report.table("orders", "ll" + "rrrr" * len(WORLDS), ["motion", "step", *(t for w in WORLDS.values() for t in (w, "+", "$-$", r"$\ne$"))], lines)
    report.define("OrderMotions", count(sum(int(r["made"]) for r in rows)))
    report.define("OrderWrong", count(sum(int(r["wrong"]) for r in rows)))
    shifts = [r for r in rows if r["motion"] == "shift"]
    report.define("OrderShifts", count(sum(int(r["made"]) for r in shifts)))
    report.define("OrderShiftsBlocked", count(sum(int(r["together"]) for r in shifts)))
    report.define("OrderShiftsDiffer", count(sum(int(r[c]) for r in shifts for c in ("p_first_only", "together_only", "orders_differ"))))
    turns = [r for r in rows if r["motion"] == "turn"]
    report.define("OrderTurnsReverse", count(sum(int(r["together_only"]) for r in turns)))
    free = [r for r in rows if r["motion"] == "independent"]

    def of_blocked(column, some):
        return percent(sum(int(r[column]) for r in some) / max(1, sum(int(r["together"]) for r in some)))
    small, large = ([r for r in free if float(r["step_over_edge"]) <= 0.125], [r for r in free if float(r["step_over_edge"]) >= 1])
    for name, some in (("Small", small), ("Large", large)):
        report.define(f"Order{name}More", of_blocked("p_first_only", some))
        report.define(f"Order{name}Fewer", of_blocked("together_only", some))
        report.define(f"Order{name}Differ", of_blocked("orders_differ", some))
    shortest = [r for r in free if r["step_over_edge"] == min(steps, key=float)]
    for name, column in (("Together", "together"), ("More", "p_first_only"), ("Fewer", "together_only"), ("Differ", "orders_differ")):
        report.define(f"OrderShortest{name}", count(sum(int(r[column]) for r in shortest)))
    report.define("OrderNone", count(sum(int(r["no_order"]) for r in rows)))
    report.define("OrderBoth", count(sum(int(r["any_order_only"]) for r in rows)))


def segments(report, folder):
    asked, stops = read(folder, "asked.csv"), read(folder, "stops.csv")
    rods = [r for r in asked if r["scene"] != "hexahedra"]
    for name, column in (("Moves", "moves"), ("Edges", "edges"), ("Swept", "swept"), ("Unseen", "unseen"), ("Held", "vertices_blocked")):
        report.define(f"Rod{name}", count(sum(int(r[column]) for r in rods)))
    high = percent(max(float(r["unseen_high"]) for r in rods))
    report.define("RodUnseenHigh", rf" (of each catheter, at most {high}\,\% with 95\,\% confidence, if edges count as independent)"
                  if all(int(r["swept"]) for r in rods) else "")
    cubes = [r for r in asked if r["scene"] == "hexahedra"]
    for name, column in (("Moves", "moves"), ("Swept", "swept"), ("Unseen", "unseen")):
        report.define(f"Cube{name}", count(sum(int(r[column]) for r in cubes)))
    report.define("AskedWrong", count(sum(int(r["wrong"]) for r in asked)))
    for name, sweep in (("Segments", "three_segments"), ("Complete", "complete")):
        some = [r for r in stops if r["sweep"] == sweep]
        report.define(f"Stops{name}", count(sum(int(r["contacts"]) for r in some)))
        report.define(f"Stops{name}Edges", count(sum(int(r["of_edges"]) for r in some)))
        report.define(f"Stops{name}Through", count(sum(int(r["through"]) for r in some)))


def forms(report, folder):
    rows = read(folder, "forms.csv")
    times = {}
    if has(folder, "form_times.csv"):
        times = {(r["mesh"], r["form"]): float(r["ns_per_move"]) for r in read(folder, "form_times.csv")}
    lines = []
    for r in rows:
        read_cells = int(r["cells_read"])
        is_first = r["form"] == "polyhedra"
        lines.append([escaped(r["mesh"]).replace(r"\_", " ") if is_first else "", r["form"], count(read_cells) if is_first else "",
                      count(r["not_planar"]) if is_first else "", count(r["cells"]), count(int(r["bytes"]) / read_cells),
                      decimal(int(r["crossings"]) / int(r["moves"]), 2), f'{times[r["mesh"], r["form"]]:.0f}' if times else ""])
    report.table("forms", "llrrrrrr", ["mesh", "form", "cells read", "not planar", "cells", "bytes a cell read", "crossings", "ns"], lines)
    exact = [(a, b) for a, b in zip(rows[::2], rows[1::2]) if a["not_planar"] == "0"]
    memory = [int(b["bytes"]) / int(a["bytes"]) for a, b in exact]
    report.define("FormMemory", span(memory))
    bent = [r for r in rows if r["form"] == "polyhedra" and r["not_planar"] != "0"]
    report.define("FormBent", len(bent))
    report.define("FormMeshes", len(rows) // 2)
    polyhedra = {r["mesh"]: int(r["bytes"]) / int(r["cells_read"]) for r in rows if r["form"] == "polyhedra"}
    report.define("FormTurnedMemory", decimal(polyhedra["hexahedra_turned"] / polyhedra["hexahedra"], 2))
    growth = [int(r["cells"]) / int(r["cells_read"]) for r in bent]
    report.define("FormGrowth", span(growth))


def collect(report, folder):
    for part in (certificates, flights, orders, segments, forms):
        part(report, folder)
