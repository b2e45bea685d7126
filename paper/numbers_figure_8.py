# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 01: macros and a table from its outputs."""

from collect_numbers import count, decimal, percent, read, span

METHODS = [("cellwalk_three_segments", "Cellwalk, three segments"), ("cellwalk_triangle", "Cellwalk, complete"),
           ("bullet_swept_box", "Bullet, a box an edge"), ("bullet_body_box", "Bullet, a box a body"),
           ("bullet_kept_box", "Bullet, box kept a body"), ("gimpact_tau", "GIMPACT, triangles"),
           ("embree_packet_robust", "Embree, robust packets"), ("fcl_boxes", "FCL, segments"), ("cgal_segment", "CGAL, segments"),
           ("cgal_kept_box", "CGAL, box kept a body"), ("double_walk", "walk in doubles"),
           ("double_regions", "walk in doubles, with regions"), ("map_walk", "walk on the map, three segments"),
           ("unit_cubes", "bound: unit cubes"), ("read_and_write", "bound: reading and writing")]


def power_of_ten(n):
    return f"$10^{{{len(str(n)) - 1}}}$" if str(n).strip("0") == "1" else count(n)


def held_share(rows):
    """Of the motions of some rows: the vertices that walls hold, of 1,000 moves."""
    return span([1000 * int(r["held"]) / int(r["moves"]) for r in rows])


def rigid_cubes(rows):
    """What is said of the second motion of figure 8, if it was measured."""
    times = {m: [float(r["ns_per_vertex_move"]) for r in rows if r["method"] == m and r["ns_per_vertex_move"]] for m, _ in METHODS}
    if not times["cellwalk_triangle"]:
        return ""
    kept = f", Bullet with kept boxes {span(times['bullet_kept_box'])}\\,ns" if times["bullet_kept_box"] else ""
    return (f" If the vertices aim at rigid cubes instead, which take another course where a wall holds a vertex ({count(rows[0]['steps'])} steps; "
            f"walls hold {held_share(rows)} of 1,000 moves), the complete sweep takes {span(times['cellwalk_triangle'])}\\,ns, three segments "
            f"{span(times['cellwalk_three_segments'])}\\,ns{kept}.")


def times_by_size(rows, method):
    return {r["cells"]: float(r["ns_per_vertex_move"]) for r in rows if r["method"] == method and r["ns_per_vertex_move"]}


def price_of_exactness(rows):
    """What is said of walks in doubles: in the abstract and in the text."""
    exact, complete, walk, regions = (times_by_size(rows, m) for m in ("cellwalk_three_segments", "cellwalk_triangle", "double_walk", "double_regions"))
    without = f"the complete sweep takes {span([complete[n] / walk[n] for n in walk])} times the time of a walk in doubles, which has no regions free of walls"
    if not regions:
        return without, f"{without[0].upper()}{without[1:]}."
    price = span([exact[n] / regions[n] for n in regions])
    return (f"three segments with exact signs and contacts take {price} times the time of the same segments in doubles, both with regions free of walls",
            f"Walks in doubles with regions, which are not proved free and give no contact, take {span(regions.values())}\\,ns; three segments {price} times as "
            f"long: this is the price of exact signs and contacts. Compared with doubles without regions, {without.split(',')[0]}.")


def walk_on_the_map(rows):
    """What is said of the walk from dart to dart, if it was measured."""
    own, tables = times_by_size(rows, "map_walk"), times_by_size(rows, "cellwalk_three_segments")
    if not own:
        return ""
    wrong = sum(int(r["missed"]) + int(r["false"]) for r in rows if r["method"] == "map_walk")
    return (f" The original method as it is written, from dart to dart of the map with exact predicates and without regions (Section~\\ref{{thewalk}}), takes "
            f"{span(own.values())}\\,ns, {span([own[n] / tables[n] for n in own])} times as long as three segments over tables, with {count(wrong)} wrong answers.")


def memory(rows):
    """The memory of the structures at the largest size, if it was measured."""
    of = {r["method"]: r for r in rows if r.get("bytes_per")}
    own, other = of.get("cellwalk_triangle"), of.get("bullet_swept_box")
    if not own or not other:
        return ""
    return f" Cellwalk's tables take {float(own['bytes_per']):.0f} bytes a cell there, Bullet's hierarchy {float(other['bytes_per']):.0f} a wall triangle."


def collect(report, folder):
    of_all = read(folder, "figure_8.csv")
    rows = [r for r in of_all if r["trace"].startswith("n_")]
    sizes = sorted({int(r["cells"]) for r in rows})
    found = {(r["method"], int(r["cells"])): r for r in rows}

    def time(method, n):
        return float(found[method, n]["ns_per_vertex_move"])
    present = [(m, title) for m, title in METHODS if (m, sizes[-1]) in found and found[m, sizes[-1]]["ns_per_vertex_move"]]
    lines = []
    for method, title in present:
        row = found[method, sizes[-1]]
        lines.append([title, *(f"{time(method, n):.1f}" if time(method, n) < 99.95 else f"{time(method, n):,.0f}".replace(",", r"\,")
                               for n in sizes), f'{count(row["missed"])} / {count(row["false"])}'])
    report.table("figure_8", "l" + "r" * (len(sizes) + 1),
                 ["method", *(f"$n={power_of_ten(n).strip('$')}$" for n in sizes), "missed / false"], lines)
    ours = [r for r in rows if r["method"].startswith("cellwalk")]
    report.define("FigEightHits", count(sum(int(r["hits"]) for r in ours)))
    report.define("FigEightWrong", count(sum(int(r["missed"]) + int(r["false"]) for r in ours)))
    report.define("FigEightSizes", f"{power_of_ten(sizes[0])} to {power_of_ten(sizes[-1])}")
    report.define("FigEightGrowth", f'{time("cellwalk_triangle", sizes[-1]) / time("cellwalk_triangle", sizes[0]):.1f}')
    report.define("FigEightTriangle", decimal(time("cellwalk_triangle", sizes[-1])))
    report.define("FigEightSegments", decimal(time("cellwalk_three_segments", sizes[-1])))
    report.define("FigEightExtra", decimal(time("cellwalk_triangle", sizes[-1]) / time("cellwalk_three_segments", sizes[-1]), 2))
    report.define("FigEightSteps", count(rows[0]["steps"]))
    report.define("FigEightHeld", held_share(rows))
    report.define("FigEightRigid", rigid_cubes([r for r in of_all if r["trace"].startswith("rigid_n_")]))
    report.define("FigEightMap", walk_on_the_map(rows))
    report.define("FigEightMemory", memory([r for r in rows if int(r["cells"]) == sizes[-1]]))
    report.define("FigEightMoves", count(found["cellwalk_triangle", sizes[-1]]["moves"]))
    price, text = price_of_exactness(rows)
    report.define("FigEightPrice", price)
    report.define("FigEightDoubles", f" {text}")
    own = [found["cellwalk_triangle", n] for n in sizes]
    report.define("FigEightClear", percent(min(int(r["clear_moves"]) / int(r["moves"]) for r in own)))
    sentence = "Bullet was not installed where this was run, so the comparison of the original paper is missing."
    if any(m == "bullet_swept_box" for m, _ in present):
        paper = [time("bullet_swept_box", n) / time("cellwalk_three_segments", n) for n in sizes]
        kept = [time("bullet_kept_box", n) / time("cellwalk_three_segments", n) for n in sizes]
        sentence = (f"The box query for each edge that the original paper compares with takes {span(paper)} times as long as three segments "
                    f"here. Bullet with the triangles of an enlarged box kept for each body takes {span(kept)} times as long.{conclusion(paper, kept)}")
    report.define("FigEightBullet", sentence)


def conclusion(paper, kept):
    """Of the comparison of the original paper and that with kept boxes: only what their times show."""
    clauses = []
    if min(paper) > 1:
        clauses.append("for bodies of this size the original conclusion holds against the comparison chosen there")
    if max(kept) < min(paper):
        clauses.append("a hierarchy that exploits the same coherence, with rounded answers, is a stronger competitor than one that is searched anew")
    return " So " + ", but ".join(clauses) + "." if clauses else ""
