# SPDX-License-Identifier: LGPL-3.0-or-later
"""What the report says of experiment 04: macros and a table from its outputs."""

from collect_numbers import count, decimal, has, percent, read, span

SEARCHES = [("exact", ""), ("exhaustive", ""), ("exhaustive_unlimited", ""), ("exhaustive_traversed", ""), ("dichotomic", "10"),
            ("dichotomic", "20"), ("dichotomic", "30"), ("dichotomic_segment", "20")]


def collect(report, folder):
    errors, costs = read(folder, "errors.csv"), read(folder, "costs.csv")
    times = {}
    if has(folder, "timings.csv"):
        times = {(r["world"], r["search"], r["tolerance_bits"]): float(r["us_per_contact"]) for r in read(folder, "timings.csv")}
    found = {(r["world"], r["search"], r["tolerance_bits"]): r for r in errors}
    spent = {(r["world"], r["search"], r["tolerance_bits"]): r for r in costs}
    worlds = list(dict.fromkeys(r["world"] for r in errors))
    lines = []
    for world in worlds:
        if lines:
            lines.append(None)
        for search, bits in SEARCHES:
            row, cost = found[world, search, bits], spent[world, search, bits]
            n = int(row["contacts"])
            name = {"exhaustive_traversed": "exhaustive, end cells", "exhaustive_unlimited": "exhaustive, no limit",
                    "dichotomic_segment": "dichotomic, segment"}.get(search, search) + (f", $2^{{-{bits}}}$" if bits else "")
            time = times.get((world, search, bits))
            lines.append([world, name, percent(int(row["late"]) / n), decimal(max(0, float(row["early_max"])), 2), decimal(row["gap_max"], 2),
                          decimal(row["normal_median"], 2), count(int(cost["signs"]) / n), f"{time:.0f}" if time else ""])
    report.table("searches", "llrrrrrr", ["world", "search", r"late, \%", "early, most", "gap, most", "normal", "signs",
                                          r"\textmu s"], lines)
    define_errors(report, errors, [found[world, "dichotomic_segment", "20"] for world in worlds])
    define_costs(report, worlds, spent, times)


def define_errors(report, errors, segment):
    def differ(search):
        return count(sum(int(r["contacts"]) - int(r["same_time"]) for r in errors if r["search"] == search))
    report.define("SearchContacts", count(sum(int(r["contacts"]) for r in errors if r["search"] == "exact")))
    report.define("SearchExhaustiveDiffer", differ("exhaustive"))
    report.define("SearchUnlimitedDiffer", differ("exhaustive_unlimited"))
    bisections = [r for r in errors if r["search"] == "dichotomic"]
    report.define("SearchBisectionLate", count(sum(int(r["late"]) for r in bisections)))
    report.define("SearchBisectionEarly", percent(max(float(r["early_max"]) * 2 ** int(r["tolerance_bits"]) for r in bisections)))
    report.define("SearchNormal", span([float(r["normal_median"]) for r in bisections]))
    late = [int(r["late"]) / int(r["contacts"]) for r in errors if r["search"] == "exhaustive_traversed"]
    report.define("SearchLateLeast", percent(min(late)))
    report.define("SearchLateMost", percent(max(late)))
    share = max(int(r["late"]) / int(r["contacts"]) for r in segment)
    report.define("SearchSegmentLate", rf"late in up to {percent(share)}\,\% of the contacts of a world, by up to "
                  f"{decimal(max(float(r['late_max']) for r in segment), 2)} of the motion" if share else "late at none of these contacts")
    report.define("SearchSegmentNone", percent(max(int(r["none_found"]) / int(r["contacts"]) for r in segment)))


def define_costs(report, worlds, spent, times):
    def ratios(one, other, bits=""):
        return [int(spent[w, one, bits]["signs"]) / int(spent[w, other, ""]["signs"]) for w in worlds]
    report.define("SearchRatio", span(ratios("dichotomic", "exact", "20")))
    report.define("SearchSegmentRatio", span(ratios("dichotomic_segment", "exact", "20"), 3))
    limit = ratios("exhaustive", "exhaustive_unlimited")
    pairs = [(times.get((w, "exhaustive", "")), times.get((w, "exhaustive_unlimited", ""))) for w in worlds]
    report.define("SearchLimit", f"{span(limit, 3)} times as many signs are computed" +
                  (", so the test costs more signs than it spares" if min(limit) > 1 else "") +
                  (f", in {span([limited / unlimited for limited, unlimited in pairs])} times the time" if all(map(all, pairs)) else ""))
