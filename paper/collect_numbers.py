#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Everything in the report that was measured: macros, tables and figures from the outputs of the experiments.

usage: collect_numbers.py [--no-figures] OUT NAME=KIND:FOLDER ...

NAME is an experiment (figure_8, exact_versus_float, small_obstacles, contact_search, degenerate_worlds, real_scenes, moving_walls, scaling,
ablation), KIND is quick or full, FOLDER what its run.sh wrote. Writes OUT/numbers.tex and OUT/table_*.tex, and draws the figures again, in the size of the page.
"""

import csv
import importlib
import json
import subprocess
import sys
from pathlib import Path

TITLES = {"figure_8": "01, figure 8", "exact_versus_float": "02, exact versus float", "small_obstacles": "03, small obstacles",
          "contact_search": "04, contact searches", "degenerate_worlds": "05, degenerate worlds",
          "real_scenes": "06, real scenes", "moving_walls": "07, moving walls", "scaling": "08, decomposed environments",
          "ablation": "09, ablation"}
# How far a face falls in a step of experiment 03: the bound of its depth over this (face_trials.cpp).
STEPS_A_BOUND = 64
# The plots of each experiment that are used, with their width and height in inches and the scale of their type.
HALF, WIDE = ("4.6in,3.2in", 0.44), ("8in,4.6in", 0.5)
FIGURES = {"figure_8": {"figure_8": WIDE}, "exact_versus_float": {},
           "small_obstacles": {"missed": HALF, "cost": HALF, "depth": HALF, "floating": HALF},
           "contact_search": {"time": HALF, "cost": HALF}, "degenerate_worlds": {},
           "real_scenes": {"ratios": WIDE}, "moving_walls": {"steps_one": HALF, "steps_all": HALF}, "scaling": {}, "ablation": {"orders": WIDE}}
EXACT_KERNELS = ("exact", "exact_signs", "adaptive", "epick", "lazy", "rational")


def read(folder, name):
    if not has(folder, name):
        sys.exit(f"collect_numbers.py: {folder / name} is missing: run the experiment again")
    with (folder / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def has(folder, name):
    return (folder / name).exists()


def count(value):
    return f"{int(value):,}".replace(",", r"\,")


def percent(value):
    value = 100 * float(value)
    return f"{value:.1f}" if value < 99.95 else f"{value:.0f}"


def decimal(value, digits=3):
    """A number as TeX has it: 1.2e-06 becomes a power of ten, 1.23e+04 has its thousands apart."""
    text = f"{float(value):.{digits}g}"
    if "e" not in text:
        return text
    if 1 <= float(text) < 1e6:
        return count(float(text))
    mantissa, exponent = text.split("e")
    return rf"${mantissa}\cdot 10^{{{int(exponent)}}}$"


def span(values, digits=2):
    least, most = decimal(min(values), digits), decimal(max(values), digits)
    return least if least == most else f"{least} to {most}"


def escaped(text):
    return text.replace("_", r"\_").replace("&", r"\&").replace("%", r"\%").replace("#", r"\#")


def table(columns, header, lines):
    text = rf"\begin{{tabular}}{{{columns}}}\toprule" + "\n" + " & ".join(header) + r" \\\midrule" + "\n"
    text += "".join((r"\midrule" if line is None else " & ".join(line) + r" \\") + "\n" for line in lines)
    return text + r"\bottomrule\end{tabular}" + "\n"


class Report:
    def __init__(self, out):
        self.out = out
        self.macros = {}

    def define(self, name, value):
        assert name.isalpha() and name not in self.macros, name
        self.macros[name] = str(value)

    def table(self, name, columns, header, lines):
        (self.out / f"table_{name}.tex").write_text(table(columns, header, lines), encoding="utf-8")

    def write(self):
        text = "".join(rf"\newcommand{{\{name}}}{{{value}}}" + "\n" for name, value in self.macros.items())
        (self.out / "numbers.tex").write_text(text, encoding="utf-8")


def draw(report, name, folder):
    """The plots of an experiment as NAME_PLOT.pdf."""
    for plot, (size, scale) in FIGURES[name].items():
        script = folder / f"{plot}.gp"
        if not script.exists():
            sys.exit(f"collect_numbers.py: {script} is missing: run the experiment again")
        terminal = f'set terminal pdfcairo size {size} fontscale {scale} enhanced\nset output "{name}_{plot}.pdf"\n'
        subprocess.run(["gnuplot", "-"], input=terminal + script.read_text(encoding="utf-8"), text=True, check=True, cwd=report.out)


def exact_versus_float(report, folder):
    walks, sweeps = read(folder, "walks.csv"), read(folder, "sweeps.csv")
    lines = []
    for dimension in ("2", "3"):
        if lines:
            lines.append(None)
        of = [r for r in walks if r["dimension"] == dimension]
        for kernel in dict.fromkeys(r["kernel"] for r in of):
            if kernel in EXACT_KERNELS[1:]:
                continue  # as right as the first one
            rows = [r for r in of if r["kernel"] == kernel]

            def total(*columns):
                return sum(int(r[c]) for r in rows for c in columns)
            lines.append([f"{dimension}D", r"\texttt{" + escaped(kernel) + "}", count(total("motions")), count(total("wrong")),
                          percent(total("wrong") / total("motions")), count(total("missed_wall")), count(total("false_contact")),
                          count(total("stuck", "lost"))])
    report.table("walks", "llrrrrrr", ["", "kernel", "walks", "wrong", r"\%", "missed walls", "false contacts", "no end"], lines)
    certain = [r for r in walks if r["kernel"] in EXACT_KERNELS]
    report.define("ExactWalks", count(sum(int(r["motions"]) for r in certain)))
    meshes = {r["value"] for r in walks if r.get("variable") == "mesh"}
    report.define("ExactMeshes", f", and {len(meshes)} are public meshes of tetrahedra" if meshes else "")
    report.define("ExactWalksWrong", count(sum(int(r["wrong"]) for r in certain)))

    def share(kernel):
        rows = [r for r in walks if r["kernel"] == kernel]
        return percent(sum(int(r["wrong"]) for r in rows) / sum(int(r["motions"]) for r in rows))
    report.define("DoubleWrong", share("double"))
    report.define("TolerantWrong", share("double_1e-9"))
    lines = []
    for dimension in ("2", "3"):
        if lines:
            lines.append(None)
        of = [r for r in sweeps if r["dimension"] == dimension]
        for method in dict.fromkeys(r["method"] for r in of):
            if method in (f"walks_{kernel}" for kernel in EXACT_KERNELS[1:]):
                continue  # the same signs as walks_exact
            rows = [r for r in of if r["method"] == method]
            lines.append([f"{dimension}D", r"\texttt{" + escaped(method) + "}",
                          *(count(sum(int(r[c]) for r in rows)) for c in ("sweeps", "blocked", "wrong", "missed", "false_contact"))])
    report.table("sweeps", "llrrrrr", ["", "method", "sweeps", "blocked", "wrong", "missed", "false"], lines)
    segments = [r for r in sweeps if r["method"] == "three_segments"]
    report.define("SegmentsFalse", count(sum(int(r["false_contact"]) for r in segments)))
    report.define("SegmentsMissed", count(sum(int(r["missed"]) for r in segments)))
    triangle = [r for r in sweeps if r["method"] == "triangle"]
    report.define("ExactSweeps", count(sum(int(r["sweeps"]) for r in triangle)))
    report.define("ExactSweepsWrong", count(sum(int(r["wrong"]) for r in triangle)))


def small_obstacles(report, folder):
    sweeps, costs = read(folder, "sweeps.csv"), read(folder, "costs.csv")
    spikes, floating = read(folder, "spikes.csv"), read(folder, "floating.csv")
    sizes = list(dict.fromkeys(r["size_over_step"] for r in sweeps))
    lines = []
    for dimension in ("2", "3"):
        for edge in dict.fromkeys(r["edge_over_step"] for r in sweeps):
            of = {r["size_over_step"]: r for r in sweeps if r["dimension"] == dimension and r["edge_over_step"] == edge}
            lines.append([f"{dimension}D, {edge}", *(percent(of[s]["missed_share"]) for s in sizes)])
    report.table("missed", "l" + "r" * len(sizes),
                 ["edge / step", *(f"1/{round(1 / float(s))}" if float(s) < 1 else s for s in sizes)], lines)
    report.define("SweepMoves", count(sum(int(r["sweeps"]) for r in sweeps)))
    report.define("SweepContacts", count(sum(int(r["edge_contacts"]) for r in sweeps)))
    report.define("SweepMissed", count(sum(int(r["missed"]) for r in sweeps)))
    report.define("SweepFalse", count(sum(int(r["false_contacts"]) for r in sweeps)))
    define_missed(report, sweeps)
    rare = [r for r in sweeps if r["dimension"] == "3" and float(r["size_over_step"]) <= 0.125]
    report.define("RareContacts", count(sum(int(r["contacts"]) for r in rare)))
    report.define("RareExpected", count(round(sum(float(r["expected_contacts"]) for r in rare))))
    signs = {(r["dimension"], r["edge_over_step"], r["size_over_step"], r["sweep"]): int(r["signs"]) for r in costs}
    ratios = [signs[(*k[:3], "complete")] / signs[k] for k in signs if k[0] == "3" and k[3] == "three_segments"]
    report.define("SignRatioLeast", decimal(min(ratios), 2))
    report.define("SignRatioMost", decimal(max(ratios), 2))
    complete = [r for r in costs if r["dimension"] == "3" and r["sweep"] == "complete"]
    report.define("SweepEventsMost", percent(max(int(r["event_sweeps"]) / int(r["sweeps"]) for r in complete)))
    sentence = "Times were not taken in this run."
    if has(folder, "timings.csv"):
        timings = [r for r in read(folder, "timings.csv") if r["dimension"] == "3" and float(r["size_over_step"]) <= 1]

        def times(sweep):
            values = [float(r["ns_per_sweep"]) / 1000 for r in timings if r["sweep"] == sweep]
            return f"{min(values):.1f} to {max(values):.1f}"
        sentence = (rf"In space a move takes {times('complete')} \textmu s instead of {times('three_segments')} \textmu s, "
                    "for obstacles up to the size of the step.")
    report.define("SweepTimes", sentence)
    report.define("Falls", count(sum(int(r["faces"]) for r in spikes)))
    report.define("FallsPierced", count(sum(int(r["pierced"]) for r in spikes)))
    report.define("FallsBeyond", count(sum(int(r["beyond_bound"]) for r in spikes)))
    report.define("FallsShare", percent(max(float(r["share_of_bound_max"]) for r in spikes)))
    report.define("FallsDisplacements", decimal(max(STEPS_A_BOUND * float(r["depth_max"]) / float(r["bound"]) for r in spikes), 2))
    report.define("FallsWithFaces", count(sum(int(r["pierced_with_faces"]) for r in spikes)))
    report.define("FloatingFaces", count(sum(int(r["faces"]) for r in floating)))
    report.define("FloatingWithFaces", count(sum(int(r["passed_with_faces"]) for r in floating)))
    report.define("FloatingSmallest", floating[0]["size_over_inradius"])
    report.define("FloatingSmallestShare", percent(floating[0]["passed_share"]))
    deepest = next(r for r in reversed(spikes) if r["aim"] == "worst")
    report.define("DeepestSharpness", deepest["sharpness"])
    report.define("DeepestInradii", decimal(2 * float(deepest["depth_max"]), 3))


def define_missed(report, sweeps):
    sixteenth = [r for r in sweeps if float(r["size_over_step"]) == 0.0625]
    report.define("MissedSixteenthLeast", percent(min(float(r["missed_share"]) for r in sixteenth)))
    report.define("MissedSpaceLeast", percent(min(float(r["missed_share"]) for r in sweeps if r["dimension"] == "3")))
    planar = {float(r["size_over_step"]) for r in sweeps if r["dimension"] == "2"}
    some = {float(r["size_over_step"]) for r in sweeps if r["dimension"] == "2" and int(r["missed"])}
    beyond = [size for size in planar if size > max(some, default=0)]
    report.define("MissedPlanar", f"none in 2D where it is {decimal(min(beyond))} or more" if beyond else "some in 2D for the largest, too")


def degenerate_worlds(report, folder):
    rows, touches = read(folder, "degenerate.csv"), read(folder, "touches.csv")
    exact, rounded = EXACT_KERNELS, ("double", "float")

    def total(column, **where):
        return sum(int(r[column]) for r in rows if all(r[k] in v for k, v in where.items()))
    report.define("DegenerateWalks", count(total("motions", kernel=exact)))
    report.define("DegenerateWrong", count(total("wrong", kernel=exact)))
    report.define("DegenerateInteger", count(total("wrong", kernel=rounded, placement=("integer",))))
    report.define("DegeneratePlanarDouble", count(total("wrong", kernel=("double",), dimension=("2",), placement=("turned",))))
    shares = []
    lines = []
    for world in dict.fromkeys(r["world"] for r in rows):
        line = [escaped(world).replace(r"\_", " ")]
        for dimension in "23":
            for kernel in rounded:
                where = {"world": (world,), "dimension": (dimension,), "kernel": (kernel,), "placement": ("turned",)}
                share = total("wrong", **where) / total("motions", **where)
                line.append(percent(share))
                if dimension == "3" and kernel == "double":
                    shares.append(share)
        lines.append(line)
    report.table("degenerate", "lrrrr", ["world", "2D, double", "2D, float", "3D, double", "3D, float"], lines)
    report.define("DegenerateDoubleLeast", percent(min(shares)))
    report.define("DegenerateDoubleMost", percent(max(shares)))
    report.define("DegenerateTouches", count(sum(int(r["motions"]) for r in touches)))
    report.define("DegenerateTouchesWrong", count(sum(int(r["wrong_with_stop"]) for r in touches)))
    to_walls = [r for r in touches if r["motion"] == "to_walls"]
    for name, column in (("Pass", "blocked"), ("Stop", "contacts_with_stop")):
        report.define(f"DegenerateToWalls{name}",
                      percent(sum(int(r[column]) for r in to_walls) / sum(int(r["motions"]) for r in to_walls)))


def of_module(name):
    """What a module of its own collects, which imports this one."""
    return lambda report, folder: importlib.import_module(name).collect(report, folder)


def provenance(report, runs):
    lines = []
    for name, (kind, folder) in runs.items():
        if not has(folder, "manifest.json"):
            sys.exit(f"collect_numbers.py: {folder / 'manifest.json'} is missing: run the experiment again")
        manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
        lines.append([TITLES[name], kind, r"\texttt{" + escaped(manifest["commit"][:12]) + "}", escaped(manifest["compiler"]),
                      escaped(manifest["processor"])])
    report.table("runs", "lllll", ["experiment", "length", "commit", "compiler", "processor"], lines)
    numbers = {kind: [TITLES[name][:2] for name, (of, _) in runs.items() if of == kind] for kind in ("full", "quick")}
    fewer, more = sorted(numbers, key=lambda kind: len(numbers[kind]))
    report.define("RunKinds", f"{more} runs of all experiments" if not numbers[fewer] else
                  f"{fewer} runs of experiments {' and '.join(numbers[fewer])}, and {more} runs of the others" if len(numbers[fewer]) > 1 else
                  f"a {fewer} run of experiment {numbers[fewer][0]}, and {more} runs of the others")


def main(arguments):
    draws = "--no-figures" not in arguments
    arguments = [a for a in arguments if a != "--no-figures"]
    if len(arguments) < 2:
        sys.exit(__doc__)
    runs = {}
    for argument in arguments[1:]:
        name, _, rest = argument.partition("=")
        kind, _, folder = rest.partition(":")
        if name not in TITLES or kind not in ("quick", "full"):
            sys.exit(f"collect_numbers.py: {argument}: use NAME=quick:FOLDER or NAME=full:FOLDER, NAME one of {', '.join(TITLES)}")
        runs[name] = (kind, Path(folder))
    report = Report(Path(arguments[0]))
    report.out.mkdir(parents=True, exist_ok=True)
    for name, (_, folder) in runs.items():
        SECTIONS[name](report, folder)
        if draws:
            draw(report, name, folder)
    provenance(report, runs)
    report.write()


SECTIONS = {"figure_8": of_module("numbers_figure_8"), "exact_versus_float": exact_versus_float, "small_obstacles": small_obstacles,
            "contact_search": of_module("numbers_search"), "degenerate_worlds": degenerate_worlds,
            "real_scenes": of_module("numbers_application"), "moving_walls": of_module("numbers_moving_walls"),
            "scaling": of_module("numbers_scaling"), "ablation": of_module("numbers_ablation")}

if __name__ == "__main__":
    main(sys.argv[1:])
