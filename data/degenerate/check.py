#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the corpus of degenerate motions, or somebody's answers to it. Needs the standard library only; docs/corpus.md has the format.

usage: check.py [--in DIR]                  verifies the answers of the corpus in rational arithmetic, from the walls alone
       check.py [--in DIR] --answers FILE   compares the answers of a library: a table id,answer,move,time with a header, where answer is
                                            `free` or `contact`, move counts from 0 (may be left out if there is one), and time is a number
                                            or a fraction p/q of the move (may be left out)

  --kinds LIST                      of walks,sweeps,faces,moving_walls: those to look at; by default all

With --answers:
  --definition any|touch|crossing   what counts: `touch`, the first time at which the object meets a closed wall off its start; `crossing`,
                                    the first at which a wall blocks it; `any`, the default, takes either, and a contact at 0 of what
                                    starts on a wall
  --tolerance X                     of times, as a share of the move; 1e-9
  --strict                          exit 1 for every difference, not only for missed contacts and late times

Exit code 0: verified, or nothing missed; 1: otherwise; 2: files that cannot be read.
"""

import argparse
import csv
import json
import sys
from collections import Counter, defaultdict
from fractions import Fraction
from pathlib import Path

from exact.sweeps import pierced_at, sweep_truth
from exact.touches import first_touch, first_touch_of_walls
from exact.vectors import at, vec
from exact.volumes import face_hit, face_truth, moving_wall_truth, wall_hit
from exact.walks import walk_truth
from exact.world import World

POINTS = {"walk": 1, "sweep": 2, "face": 3, "moving_wall": 2}  # of an object


def read_corpus(folder):
    with open(folder / "worlds.jsonl", encoding="utf-8") as lines:
        worlds = {w["name"]: w for w in map(json.loads, lines)}
    cases = []
    for kind in POINTS:
        with open(folder / f"{kind}s.jsonl", encoding="utf-8") as lines:
            cases += map(json.loads, lines)
    return worlds, cases


def cases_of(kinds, cases):
    return [case for case in cases if case["kind"] + "s" in kinds]


# Answers of a library.


def legal_answers(case, definition):
    """All answers that a definition allows: None for free, or (move, time)."""
    answers = set()
    if definition in ("touch", "any"):
        touch = case["touch"]
        answers.add((touch["move"], Fraction(touch["time"])) if touch else None)
    if definition in ("crossing", "any"):
        answers |= {(c["move"], Fraction(c["time"])) for c in case["crossings"]}
        if case["crossing"] != "yes":
            answers.add(None)
    if definition == "any" and case["at_start"]:
        answers.add((0, Fraction(0)))
    return answers


def judge_answer(case, row, definition, tolerance):
    legal = legal_answers(case, definition)
    contacts = [a for a in legal if a is not None]
    if row is None:
        return "unanswered"
    if row["answer"] == "free":
        return "right" if None in legal else "missed"
    if not contacts:
        return "false"
    if not row.get("time"):
        return "right"
    move = int(row.get("move") or 0)
    at = move + Fraction(row["time"])
    if any(m == move and abs(m + t - at) <= tolerance for m, t in contacts):
        return "right"
    # At the end of a move is at the start of the next one.
    if any(abs(m + t - at) <= tolerance for m, t in contacts):
        return "right"
    return "late" if None not in legal and all(m + t < at for m, t in contacts) else "early"


def compare(cases, kinds, table, definition, tolerance, strict):
    with open(table, newline="", encoding="utf-8") as lines:
        rows = {row["id"]: row for row in csv.DictReader(lines)}
    unknown = rows.keys() - {c["id"] for c in cases}
    if unknown:
        sys.exit(f"check.py: {table}: {sorted(unknown)[0]} is no case")
    verdicts = ["right", "missed", "late", "false", "early", "unanswered"]
    counts, examples = defaultdict(Counter), defaultdict(list)
    for case in cases_of(kinds, cases):
        try:
            verdict = judge_answer(case, rows.get(case["id"]), definition, tolerance)
        except ValueError as error:
            print(f"check.py: {table}: {case['id']}: {error}", file=sys.stderr)
            sys.exit(2)
        kind = f"{case['kind']} {len(case['points'][0])}D"
        counts[kind, case["degeneracy"] + (" +-ulp" if case["near"] else "")][verdict] += 1
        examples[verdict].append(case["id"])
    print(f"{'kind':<16} {'degeneracy':<28} {'cases':>6} " + " ".join(f"{v:>10}" for v in verdicts))
    total = Counter()
    for (kind, name), count in sorted(counts.items()):
        print(f"{kind:<16} {name:<28} {sum(count.values()):>6} " + " ".join(f"{count[v]:>10}" for v in verdicts))
        total += count
    print(f"{'all':<16} {'':<28} {sum(total.values()):>6} " + " ".join(f"{total[v]:>10}" for v in verdicts))
    for verdict in verdicts[1:]:
        if examples[verdict]:
            print(f"{verdict}: {' '.join(examples[verdict][:8])}{' ...' if len(examples[verdict]) > 8 else ''}")
    bad = total["missed"] + total["late"]
    if strict:
        bad = sum(total.values()) - total["right"]
    return 1 if bad else 0


class Checker:
    def __init__(self, worlds):
        self.worlds = {name: World(record) for name, record in worlds.items()}
        self.determined = Counter()

    def faults(self, case):
        """Yields what is wrong with a case."""
        world = self.worlds[case["world"]]
        shape = [vec(p) for p in case["points"]]
        if len(shape) != POINTS[case["kind"]]:
            yield "not as many points as its kind has"
        if case["at_start"] != bool(world.met(shape)):
            yield "at_start is wrong"
        if case["at_start"] != (case["side"] is not None):
            yield "only what starts on a wall has a side"
        if case["side"] is not None:
            yield from self.side_faults(world, case, shape)
        yield from self.order_faults(case)
        shapes = [shape]
        for move in case["moves"]:
            moved = list(shapes[-1])
            if case["kind"] != "moving_wall":
                moved[move["vertex"]] = vec(move["to"])
            shapes.append(moved)
        yield from self.touch_faults(world, case, shapes)
        for m in case["crossings"] + ([case["touch"]] if case["touch"] else []):
            yield from self.meeting_faults(world, case, shapes, m)
        if case["kind"] == "walk":
            yield from self.walk_faults(world, case, shape)
        elif case["kind"] == "sweep":
            yield from self.sweep_faults(world, case, shapes)
        else:
            yield from self.hit_faults(world, case, shape)
        yield from self.convention_faults(case)

    def side_faults(self, world, case, shape):
        side = [vec(p) for p in case["side"]]
        if world.met(side):
            yield "the side touches a wall"
        now = list(shape)
        for i, p in enumerate(side):
            if first_touch(world, now, i, p) is not None:
                yield "the way to the side touches a wall"
            now[i] = p

    def order_faults(self, case):
        times = [(c["move"], Fraction(c["time"])) for c in case["crossings"]]
        if times != sorted(set(times)) or any(not 0 <= t <= 1 for _, t in times):
            yield "times of crossings are not in order"
        if (case["crossing"] == "no") != (not times) or case["crossing"] not in ("no", "yes", "either"):
            yield "crossing and its times disagree"

    def touch_faults(self, world, case, shapes):
        expected = None
        for m, move in enumerate(case["moves"]):
            first = first_touch_of_walls if case["kind"] == "moving_wall" else first_touch
            t = first(world, shapes[m], move["vertex"], vec(move["to"]))
            times = [Fraction(c["time"]) for c in case["crossings"] if c["move"] == m] + ([t] if t is not None else [])
            if times:
                expected = (m, min(times))
                break
        stated = (case["touch"]["move"], Fraction(case["touch"]["time"])) if case["touch"] else None
        if stated != expected:
            yield f"touch is {stated}, not {expected}"

    def meeting_faults(self, world, case, shapes, m):
        t = Fraction(m["time"])
        if float(t) != m["rounded"] or str(t) != m["time"]:
            yield f"{m['time']} is not reduced, or not {m['rounded']}"
        move = case["moves"][m["move"]]
        vertex, target = move["vertex"], vec(move["to"])
        shape = list(shapes[m["move"]])
        if case["kind"] == "moving_wall":
            world = world.moved(vertex, at(world.points[vertex], target, t))
        else:
            shape[vertex] = at(shape[vertex], target, t)
        met = world.met(shape)
        if met != m["walls"]:
            yield f"the walls met at {m['time']} are {met}"
        if m["feature"] != world.lowest_feature(shape):
            yield f"the feature met at {m['time']} is not a {m['feature']}"
        if sorted({world.kinds[w] for w in met}) != m["wall_kinds"]:
            yield f"the kinds of walls met at {m['time']} are wrong"

    def walk_faults(self, world, case, shape):
        side = vec(case["side"][0]) if case["side"] else None
        arrives, blocked = walk_truth(world, shape[0], vec(case["moves"][0]["to"]), side)
        crossing = "no" if not blocked else "either" if arrives else "yes"
        if case["crossing"] != crossing:
            yield f"crossing is {crossing}"
        if [Fraction(c["time"]) for c in case["crossings"]] != blocked:
            yield f"times of crossings are {' '.join(map(str, blocked))}"
        self.determined["walk", True] += 1

    def sweep_faults(self, world, case, shapes):
        """What the walls alone say of a crossing: all, or where a wall passes through the edge, and that something is touched before."""
        for m, move in enumerate(case["moves"]):
            a, b, q = shapes[m][move["vertex"]], vec(move["to"]), shapes[m][1 - move["vertex"]]
            passed = [t for t in (pierced_at(a, b, q, wall) for wall in world.walls) if t is not None]
            if passed:
                yield from self.late_faults(case, (m, min(passed)))
                break
        side = [vec(p) for p in case["side"]] if case["side"] else None
        is_known, crossing = sweep_truth(world, shapes, case["moves"], side)
        yield from self.crossing_faults(case, is_known, crossing)

    def hit_faults(self, world, case, shape):
        """What the walls alone say of a face, or of walls that move: a hit bounds what they do not determine."""
        if case["at_start"] or len(case["moves"]) != 1:
            yield "starts on a wall, or has several moves"
            return
        vertex, target = case["moves"][0]["vertex"], vec(case["moves"][0]["to"])
        hit, truth = (face_hit, face_truth) if case["kind"] == "face" else (wall_hit, moving_wall_truth)
        time = hit(world, shape, vertex, target)
        if time is not None:
            yield from self.late_faults(case, (0, time))
        is_known, time = truth(world, shape, vertex, target)
        yield from self.crossing_faults(case, is_known, None if time is None else (0, time))

    def late_faults(self, case, hit):
        times = [(c["move"], Fraction(c["time"])) for c in case["crossings"]]
        if case["crossing"] != "yes" or times[-1] > hit:
            yield f"a wall passes through the object at {hit}"

    def crossing_faults(self, case, is_known, crossing):
        times = [(c["move"], Fraction(c["time"])) for c in case["crossings"]]
        touch = (case["touch"]["move"], Fraction(case["touch"]["time"])) if case["touch"] else None
        if times and not case["at_start"] and (touch is None or times[0] < touch):
            yield "a crossing before a touch"
        if is_known and times != ([] if crossing is None else [crossing]):
            yield f"crossing is {crossing}"
        self.determined[case["kind"], is_known] += 1

    def convention_faults(self, case):
        touch = (case["touch"]["move"], case["touch"]["time"]) if case["touch"] else None
        crossings = [(c["move"], c["time"]) for c in case["crossings"]]
        same = crossings == ([touch] if touch else [])
        convention = "start" if case["at_start"] else "choice" if case["crossing"] == "either" else "none" if same else "touch"
        if case["convention"] != convention:
            yield f"convention is {convention}"


def verify(worlds, cases):
    checker = Checker(worlds)
    wrong = 0
    ids = set()
    for case in cases:
        try:
            faults = list(checker.faults(case))
        except (KeyError, IndexError, TypeError, ValueError, ZeroDivisionError) as error:
            faults = [f"cannot be read: {error!r}"]
        if case["id"] in ids:
            faults.append("its name is not its own")
        ids.add(case["id"])
        for fault in faults[:3]:
            print(f"{case['id']}: {fault}")
        wrong += bool(faults)
    for kind in dict.fromkeys(case["kind"] for case in cases):
        yes, no = checker.determined[kind, True], checker.determined[kind, False]
        print(f"{kind}s: {yes + no} cases; the walls alone determine the crossing of {yes}, and bound that of {no}")
    print(f"{len(cases)} cases, {wrong} wrong")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("usage: ")[1])
    parser.add_argument("--in", dest="folder", type=Path, default=Path(__file__).resolve().parent)
    parser.add_argument("--kinds", default=",".join(kind + "s" for kind in POINTS))
    parser.add_argument("--answers", type=Path)
    parser.add_argument("--definition", choices=["any", "touch", "crossing"], default="any")
    parser.add_argument("--tolerance", type=Fraction, default=Fraction(1, 10**9))
    parser.add_argument("--strict", action="store_true")
    options = parser.parse_args()
    kinds = options.kinds.split(",")
    if not {kind + "s" for kind in POINTS}.issuperset(kinds):
        parser.error(f"no such kind in {options.kinds}")
    try:
        worlds, cases = read_corpus(options.folder)
        if options.answers:
            return compare(cases, kinds, options.answers, options.definition, options.tolerance, options.strict)
    except (OSError, KeyError, json.JSONDecodeError) as error:
        print(f"check.py: {error!r}", file=sys.stderr)
        return 2
    return verify(worlds, cases_of(kinds, cases))


if __name__ == "__main__":
    sys.exit(main())
