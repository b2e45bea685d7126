#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Counts the instructions of moves, and compares them with a table: the same on every machine, however busy, for the same build.

    scripts/check_instructions.py [--build DIR] [--table FILE] [--update]

    --build DIR   a build with cellwalk and make_traces; default build/release
    --table FILE  default tests/instructions/expected.json
    --update      writes what was counted into the table, as the row of this build

Free moves: motions are recorded, what walls hold is made to stay (free_moves.py), and the rest is replayed under callgrind, which counts what is
inside the steps of the replay. Contacts apart: the steps of a catheter that is pressed on walls, with its solver, stops and slides. Valgrind
rounds to nearest always, so that the few signs left to intervals of numbers take other paths than they do natively;
experiments/benchmarks/bench_contact and bench_steps measure times.

Counts depend on the compiler and on libraries: a row of the table holds for one build, and where none fits, nothing is compared, which is said.
Exit code 1 if a scene takes over 2 % more instructions than its row says, or is not in it.
"""
import argparse
import concurrent.futures
import gzip
import json
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

import free_moves

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOLERANCE = 2  # percent
SWEEPS = ("three_segments", "triangle")
COUNTED = ("cellwalk::Body_replay::step()", "cellwalk::World<3>::step()")
# The library of C picks its functions by the processor: these leave the choice that every x86-64 has.
BASELINE = "glibc.cpu.hwcaps=" + ",".join(
    f"-{name}" for name in ("AVX2", "AVX2_Usable", "AVX_Fast_Unaligned_Load", "AVX512F", "AVX512VL", "ERMS", "FSRM", "SSSE3", "SSE4_1", "SSE4_2"))

# The grid of the paper's scene with rigid bodies, a catheter in tetrahedra, and soft bodies: how a trace is made, and its environment where it has none of its own.
SCENES = {
    "figure_8": ([["make_traces", "TRACE", "--motion", "rigid", "--cells", "10", "10", "10", "--steps", "100"]], None),
    "catheter": ([["cellwalk", "generate", "vessel", "--generations", "2", "-o", "vessel.ovm"],
                  ["cellwalk", "run", "DATA/catheter.json", "--set", "environment.generations=2", "--steps", "150",
                   "--set", "catheter.radius=0", "--set", "output.picture=false", "-o", "catheter", "--record", "TRACE"]],
                 "vessel.ovm"),
    "soft": ([["cellwalk", "generate", "hexes", "--cells", "6", "6", "4", "--solid", "0.1", "--seed", "3", "-o", "grid.ovm"],
              ["cellwalk", "run", "DATA/soft.json", "--steps", "60",
               "--set", "output.picture=false", "-o", "soft", "--record", "TRACE"]],
             "grid.ovm"),
}

# With contacts: how a scene is run.
STEPS = {
    "steps of a catheter": ["cellwalk", "run", "DATA/catheter.json", "--set", "environment.generations=2", "--steps", "220",
                            "--set", "catheter.radius=0", "--set", "output.picture=false", "-o", "steps"],
}


class Failure(Exception):
    """What keeps the counts from being made."""


def run(command, folder):
    environment = {"PATH": os.environ["PATH"], "LANG": "C", "GLIBC_TUNABLES": BASELINE}
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        raise Failure(f"{' '.join(str(word) for word in command)}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def programs_of(build):
    programs = {"cellwalk": build / "cellwalk", "make_traces": build / "experiments/01_figure_8/make_traces"}
    for name, program in programs.items():
        if not program.exists():
            raise Failure(f"{program} is not there: cmake --build {build} --target cellwalk_cli make_traces")
    if shutil.which("valgrind") is None:
        raise Failure("valgrind is not there: scripts/setup.sh --for ci")
    return programs


def build_of(program, folder):
    """All that counts depend on beside the sources: rows of the table are told apart by it."""
    version = json.loads(run([program, "--version", "--json"], folder))
    with open("/proc/cpuinfo", encoding="utf-8") as info:
        has_avx2 = re.search(r"^flags.*\bavx2\b", info.read(), re.MULTILINE) is not None
    return {"compiler": version["compiler"], "flags": version["flags"], "cgal": version["parts"]["cgal"]["version"],
            "libc": os.confstr("CS_GNU_LIBC_VERSION"), "machine": platform.machine(), "avx2": has_avx2}


def record(name, programs, folder):
    """The free moves of a scene: TRACE in the folder."""
    trace = folder / f"{name}.trace"
    for command in SCENES[name][0]:
        words = [word.replace("TRACE", trace.name).replace("DATA", str(ROOT / "data")) for word in command]
        run([programs[words[0]], *words[1:]], folder)
    data = trace.read_bytes()
    trace.write_bytes(free_moves.free_moves(gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data)[0])


def replay(name, sweep, program, folder):
    """The command that replays a scene once, and its report."""
    report = folder / f"{name}_{sweep}.json"
    environment = SCENES[name][1]
    return [program, "replay", f"{name}.trace", "--sweep", sweep, "--repeat", "1", "--warmup", "0", "--json", report.name,
            *(["--environment", environment] if environment else [])], report


def count(name, sweep, program, folder):
    """Instructions and moves of a replay. The moves are free, or other ones are counted than were meant."""
    command, report = replay(name, sweep, program, folder)
    run(command, folder)
    said = json.loads(report.read_text())
    if said["mismatches"] != 0 or said["blocked"] != 0:
        raise Failure(f"{name}, {sweep}: {said['blocked']} moves are not free, {said['mismatches']} answers differ from those of the trace")
    return {"moves": said["moves"], "instructions": instructions(f"{name}_{sweep}", command, folder)}


def count_steps(name, programs, folder):
    """Instructions and moves of the steps of a run. It has contacts."""
    words = [programs["cellwalk"], *(word.replace("DATA", str(ROOT / "data")) for word in STEPS[name][1:])]
    counted = instructions(name.replace(" ", "_"), words, folder)
    said = json.loads((folder / words[-1] / "run.json").read_text())["body_counts"]
    if said["contacts"] == 0:
        raise Failure(f"{name}: there is no contact")
    return {"moves": said["moves"], "instructions": counted}


def instructions(name, command, folder):
    """Those of a command within the functions that make a step."""
    profile = folder / f"{name}.callgrind"
    run(["valgrind", "--tool=callgrind", f"--callgrind-out-file={profile.name}", *(f"--toggle-collect={f}" for f in COUNTED), *command], folder)
    total = re.search(r"^(?:totals|summary): (\d+)", profile.read_text(), re.MULTILINE)
    if total is None or int(total[1]) == 0:
        raise Failure(f"{name}: no instruction was counted in {' or '.join(COUNTED)}: name the functions that make a step")
    return int(total[1])


def count_all(programs, folder):
    for name in SCENES:
        record(name, programs, folder)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = {f"{name} {sweep}": pool.submit(count, name, sweep, programs["cellwalk"], folder) for name in SCENES for sweep in SWEEPS}
        counts |= {name: pool.submit(count_steps, name, programs, folder) for name in STEPS}
        return {scene: counted.result() for scene, counted in counts.items()}


def per_move(counted):
    return counted["instructions"] / counted["moves"]


def compare(counted, expected):
    """Lines of a table, and the scenes that take more than expected, less, or are not in the row."""
    lines = [f"{'scene':<26}{'moves':>8}{'a move':>9}{'expected':>10}{'change':>9}"]
    more, less, unknown = [], [], []
    for scene, now in counted.items():
        line = f"{scene:<26}{now['moves']:>8}{per_move(now):>9.2f}"
        if expected is not None and scene in expected:
            old = expected[scene]
            line += f"{per_move(old):>10.2f}{100 * (per_move(now) / per_move(old) - 1):>+7.1f} %"
            # In integers: exactly 2 % is allowed.
            hundred, unit = 100 * now["instructions"] * old["moves"], old["instructions"] * now["moves"]
            if hundred > (100 + TOLERANCE) * unit:
                more.append(scene)
            elif hundred < (100 - TOLERANCE) * unit:
                less.append(scene)
        else:
            unknown.append(scene)
        lines.append(line)
    return lines, more, less, unknown


def row_of(table, build):
    return next((row for row in table["rows"] if row["build"] == build), None)


def update(table, build, counted):
    """The table with the counts as the row of a build; other rows stay."""
    rows = [row for row in table["rows"] if row["build"] != build]
    return {"rows": rows + [{"build": build, "scenes": counted}]}


def verdict(build, row, more, less, unknown):
    """What to print after the table, and the exit code."""
    named = ", ".join(f"{key} {value}" for key, value in build.items())
    if row is None:
        return f"instructions: NOT COMPARED: the table has no row for this build ({named}); --update adds it", 0
    if more or unknown:
        said = [f"{', '.join(more)}: over {TOLERANCE} % more than expected"] if more else []
        said += [f"{', '.join(unknown)}: not in the table"] if unknown else []
        return f"instructions: {'; '.join(said)}. Where that is meant, scripts/check_instructions.py --update", 1
    if less:
        return f"instructions: {', '.join(less)}: over {TOLERANCE} % less than expected. Keep that: scripts/check_instructions.py --update", 0
    return f"instructions: within {TOLERANCE} % of the table", 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", type=pathlib.Path, default=ROOT / "build/release")
    parser.add_argument("--table", type=pathlib.Path, default=ROOT / "tests/instructions/expected.json")
    parser.add_argument("--update", action="store_true")
    options = parser.parse_args(arguments)
    try:
        programs = programs_of(options.build.resolve())
        with tempfile.TemporaryDirectory() as name:
            build = build_of(programs["cellwalk"], name)
            counted = count_all(programs, pathlib.Path(name))
    except Failure as failure:
        print(f"instructions: {failure}", file=sys.stderr)
        return 1
    table = json.loads(options.table.read_text()) if options.table.exists() else {"rows": []}
    row = row_of(table, build)
    lines, *found = compare(counted, row and row["scenes"])
    print("\n".join(lines))
    if options.update:
        options.table.write_text(json.dumps(update(table, build, counted), indent=2) + "\n")
        print(f"instructions: written to {options.table}")
        return 0
    said, code = verdict(build, row, *found)
    print(said)
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
