#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Measures how runs shared among ranks scale (docs/scaling.md): the same work by one process and by several ranks, in turns.

usage: measure_ranks.py BUILD_DIR [--ranks 2] [--repeats 7] [--rows 2000000] [--bodies 10000] [--steps 200] [--only query|run] [--json FILE]

Each rank uses one thread. The wall time is that of the whole command; the processor time of a rank is what the system counts for it, which
other work on the machine disturbs less. The speedup of a pair is the time of one process over that of the ranks (their slowest one). The output is the
same, which is checked.
"""

import argparse
import filecmp
import json
import os
import random
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SEED = 1
CELLS = (46, 46, 47)  # hexahedra: about 10^5


def wrapped(words):
    """Runs a command as one rank, and notes its processor time."""
    code = subprocess.run(words[1:]).returncode
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    rank = os.environ.get("OMPI_COMM_WORLD_RANK", "0")
    Path(f"{words[0]}.{rank}").write_text(str(used.ru_utime + used.ru_stime))
    return code


def timed(words, ranks, mpirun, folder):
    """Wall time of a command, and the processor times of its ranks."""
    note = folder / "processor_time"
    command = [sys.executable, __file__, "--as-rank", note, *words]
    if ranks > 1:
        command = [mpirun, "--oversubscribe", "-n", ranks, *command]
    environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_plm": "isolated",
                   "OMPI_MCA_hwloc_base_binding_policy": "none"}
    start = time.monotonic()
    subprocess.run([str(word) for word in command], cwd=folder, env=environment, check=True, stdout=subprocess.DEVNULL)
    wall = time.monotonic() - start
    return wall, [float(Path(f"{note}.{rank}").read_text()) for rank in range(ranks)]


def is_same(a, b):
    if a.is_file():
        return filecmp.cmp(a, b, shallow=False)
    names = sorted(path.relative_to(a) for path in a.rglob("*") if path.is_file())
    return names == sorted(path.relative_to(b) for path in b.rglob("*") if path.is_file()) and all(
        filecmp.cmp(a / name, b / name, shallow=False) for name in names)


def write_moves(path, rows):
    numbers = random.Random(SEED)
    with path.open("w") as out:
        out.write("ax,ay,az,bx,by,bz\n")
        for _ in range(rows):
            start = [numbers.uniform(0, size) for size in CELLS]
            end = [x + numbers.uniform(-3, 3) for x in start]
            out.write(",".join(f"{x:.17g}" for x in start + end) + "\n")


def prepare(program, folder, arguments):
    """Makes the inputs; returns the commands, each as a function of its output."""
    subprocess.run([program, "generate", "hexes", "--cells", *map(str, CELLS), "--solid", "0.08", "-o", "env.cellwalk"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)
    write_moves(folder / "moves.csv", arguments.rows)
    scene = {"environment": "env.cellwalk", "time_step": 0.02, "steps": arguments.steps,
             "bodies": [{"shape": "hexahedron", "side": 0.3, "count": arguments.bodies, "seed": 7, "speed": 3, "spin": [0.5, 0.3, 0.2]}],
             "output": {"frame_every": 0, "motion_every": 0}}
    (folder / "scene.json").write_text(json.dumps(scene))
    return {"query": lambda out: [program, "query", "env.cellwalk", "moves.csv", "-o", out, "--threads", 1],
            "run": lambda out: [program, "run", "scene.json", "-o", out, "--threads", 1]}


def measure(name, command, folder, arguments):
    pairs = []
    for repeat in range(arguments.repeats):
        found = {}
        for ranks in (1, arguments.ranks) if repeat % 2 == 0 else (arguments.ranks, 1):
            out = folder / f"{name}_{ranks}"
            if out.is_dir():
                shutil.rmtree(out)
            found[ranks] = timed(command(out), ranks, arguments.mpirun, folder)
        if not is_same(folder / f"{name}_1", folder / f"{name}_{arguments.ranks}"):
            sys.exit(f"{name}: the output of {arguments.ranks} ranks differs")
        pairs.append((found[1], found[arguments.ranks]))
    spread = lambda values: {"min": min(values), "median": statistics.median(values), "max": max(values)}
    return {"wall_s_1": spread([one[0] for one, _ in pairs]), "wall_s_n": spread([many[0] for _, many in pairs]),
            "processor_s_1": spread([one[1][0] for one, _ in pairs]),
            "processor_s_n": [spread([many[1][rank] for _, many in pairs]) for rank in range(arguments.ranks)],
            "wall_speedup": spread([one[0] / many[0] for one, many in pairs]),
            "processor_speedup": spread([one[1][0] / max(many[1]) for one, many in pairs])}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path)
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--repeats", type=int, default=7)
    parser.add_argument("--rows", type=int, default=2000000)
    parser.add_argument("--bodies", type=int, default=10000)
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--only", choices=["query", "run"])
    parser.add_argument("--mpirun", default="mpirun")
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    results = {"ranks": arguments.ranks, "repeats": arguments.repeats, "rows": arguments.rows, "bodies": arguments.bodies,
               "steps": arguments.steps, "processors": os.cpu_count(), "load_before": os.getloadavg()}
    with tempfile.TemporaryDirectory() as folder:
        commands = prepare(arguments.build.resolve() / "cellwalk", Path(folder), arguments)
        for name, command in commands.items():
            if arguments.only in (None, name):
                results[name] = measure(name, command, Path(folder), arguments)
                print(name, json.dumps(results[name], indent=2), flush=True)
    results["load_after"] = os.getloadavg()
    if arguments.json:
        arguments.json.write_text(json.dumps(results, indent=2) + "\n")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--as-rank"]:
        sys.exit(wrapped(sys.argv[2:]))
    main()
