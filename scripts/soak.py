#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The rounds of scripts/soak.sh, which builds what they run and tells of the options."""

import argparse
import csv
import json
import os
import re
import shlex
import shutil
import signal
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / "build" / "release"
PROGRAM = BUILD / "cellwalk"
# Those that would take much of a round, in fewer steps.
STEPS = {"soft_vessel": 100, "pulse": 100, "suture": 100, "cut": 100}
LONG_SCENE, LONG_STEPS = "pulse", 1500
GROWTH = 1.02, 2**20  # by which memory may grow in the second half of a long run: a factor, and bytes
# What a test says where its worlds had too little of something. Its own worlds have enough; of others that is no finding.
FEW = re.compile(r"Expected: (\(.+\) >=? \(.+\), actual: \d+ vs [\d.]+)$")
SLOW = 5              # times as long as in the first round: noted, no finding


def long_tests():
    """(name, filter) of the tests with a nightly length: those that make worlds by seeds."""
    found = []
    for file in sorted(ROOT.glob("tests/*/CMakeLists.txt")):
        found += re.findall(r'^cellwalk_long_test\((\w+) "([^"]+)"\)', file.read_text(encoding="utf-8"), re.MULTILINE)
    return found


class Soak:
    def __init__(self, out, seed, length):
        self.out, self.seed, self.length = out, seed, length
        self.findings, self.first, self.jobs = 0, {}, 0
        out.mkdir(parents=True, exist_ok=True)
        self.table = open(out / "rounds.csv", "a", newline="", encoding="utf-8")
        self.rows = csv.writer(self.table)
        if self.table.tell() == 0:
            self.rows.writerow(["round", "seed", "job", "seconds", "processor_seconds", "memory_bytes", "result"])

    def run(self, number, job, command, folder, **environment):
        """Runs a job to its end, and tells whether it succeeded. What it says is in folder/said."""
        folder.mkdir(parents=True, exist_ok=True)
        start = time.monotonic()
        with open(folder / "said", "wb") as said:
            pid = os.posix_spawn(command[0], command, {**os.environ, **environment},
                                 file_actions=[(os.POSIX_SPAWN_DUP2, said.fileno(), 1), (os.POSIX_SPAWN_DUP2, said.fileno(), 2)])
            _, status, usage = os.wait4(pid, 0)
        seconds = time.monotonic() - start
        code = os.waitstatus_to_exitcode(status)
        if code in (-signal.SIGINT, -signal.SIGTERM):
            raise KeyboardInterrupt
        memory = usage.ru_maxrss * 1024
        self.rows.writerow([number, self.seed + number, job, f"{seconds:.2f}", f"{usage.ru_utime + usage.ru_stime:.2f}", memory, code])
        self.table.flush()
        self.jobs += 1
        first = self.first.setdefault(job, usage.ru_utime)
        if usage.ru_utime > SLOW * first + 10:
            print(f"soak: slow: {job} took {usage.ru_utime:.0f} s, and {first:.0f} s at first", flush=True)
        few = too_few((folder / "said").read_text(encoding="utf-8", errors="replace")) if code == 1 else []
        for what in few:
            print(f"soak: few: {job}: {what}", flush=True)
        if code != 0 and not few:
            self.find(job, f"exit code {code}", command, folder, environment)
        return code == 0

    def find(self, job, what, command, folder, environment=None):
        """Keeps a finding: what was said and written, and how to see it again."""
        self.findings += 1
        kept = self.out / f"finding-{self.findings}"
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(folder, kept)
        settings = "".join(f"{k}={shlex.quote(v)} " for k, v in (environment or {}).items())
        (kept / "command").write_text(settings + shlex.join(map(str, command)) + "\n", encoding="utf-8")
        print(f"soak: FINDING: {job}: {what}; kept in {kept}", flush=True)

    def oracles(self, number):
        for name, chosen in long_tests():
            [test] = BUILD.glob(f"tests/*/test_{name}")
            self.run(number, f"test_{name}", [str(test), f"--gtest_filter={chosen}", "--gtest_brief=1"], self.out / "work" / name,
                     CELLWALK_TEST_SEED=str(self.seed + number), CELLWALK_TEST_LENGTH=str(self.length))

    def scenes(self, number):
        for file in sorted(ROOT.glob("data/*.json")):
            folder = self.out / "work" / file.stem
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir(parents=True)
            scene = reseeded(without_comments(file.read_text(encoding="utf-8")), self.seed + number)
            (folder / "scene.json").write_text(json.dumps(scene), encoding="utf-8")
            for other in file.parent.glob("*.*"):  # which scenes name
                if other.suffix != ".json":
                    shutil.copy(other, folder)
            steps = ["--steps", str(STEPS[file.stem])] if file.stem in STEPS else []
            commands = [[str(PROGRAM), "run", str(folder / "scene.json"), "-o", str(folder / f"threads{n}"), "--threads", str(n),
                         "--set", "output.picture=false", *steps] for n in (1, 2)]
            if all(self.run(number, f"{file.stem}, {n} threads", c, folder) for n, c in zip((1, 2), commands)):
                different = [name for name in files_of(folder / "threads1") | files_of(folder / "threads2")
                             if name != "run.json" and not same(folder / "threads1" / name, folder / "threads2" / name)]
                if different:
                    self.find(file.stem, f"{', '.join(sorted(different))} depend on the threads", commands[1], folder)

    def long_run(self, number):
        """A scene for long: its memory stays where it was in the middle."""
        folder = self.out / "work" / "long"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        log = folder / "log"
        command = [str(PROGRAM), "run", str(ROOT / "data" / f"{LONG_SCENE}.json"), "-o", str(folder / "out"), "--steps", str(LONG_STEPS),
                   "--set", "output.picture=false", "--set", "output.motion_every=0", "--log", str(log), "--log-interval", "0.2"]
        if not self.run(number, f"{LONG_SCENE}, {LONG_STEPS} steps", command, folder):
            return
        memory = [line["memory_bytes"] for line in map(json.loads, log.read_text(encoding="utf-8").splitlines())
                  if line["stage"].startswith("running") and not line.get("ended") and line.get("done")]
        half = memory[len(memory) // 2:]
        if half and half[-1] > GROWTH[0] * half[0] + GROWTH[1]:
            self.find(LONG_SCENE, f"memory grows from {half[0]} to {half[-1]} bytes in the second half", command, folder)


def too_few(said):
    """What a test had too little of, if it failed for nothing else."""
    lines = said.splitlines()
    failures = [i for i, line in enumerate(lines) if line.endswith(": Failure")]
    found = [FEW.match(lines[i + 1]) if i + 1 < len(lines) else None for i in failures]
    return [match[1] for match in found] if all(found) else []


def without_comments(text):
    return json.loads(re.sub(r"^\s*//.*$", "", text, flags=re.MULTILINE))


def reseeded(node, number):
    """A scene whose seeds are others."""
    if isinstance(node, dict):
        return {k: (v + 1000 * number) % 2**32 if k == "seed" else reseeded(v, number) for k, v in node.items()}
    return [reseeded(v, number) for v in node] if isinstance(node, list) else node


def files_of(folder):
    return {str(p.relative_to(folder)) for p in folder.rglob("*") if p.is_file()}


def same(one, other):
    return one.is_file() and other.is_file() and one.read_bytes() == other.read_bytes()


def main():
    parser = argparse.ArgumentParser(prog="soak.sh", description=__doc__)
    parser.add_argument("--hours", type=float, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--out", type=Path, default=ROOT / "build" / "soak")
    parser.add_argument("--length", type=float, default=1, help="of the oracle tests, as CELLWALK_TEST_LENGTH")
    parser.add_argument("--print-targets", action="store_true", help="the tests to build, and no more")
    given = parser.parse_args()
    if given.print_targets:
        print(*(f"test_{name}" for name, _ in long_tests()), sep="\n")
        return 0
    if not given.hours > 0:
        parser.error("--hours takes a number above 0")
    soak = Soak(given.out.resolve(), given.seed, given.length)
    start, number = time.monotonic(), 0
    try:
        while number == 0 or time.monotonic() - start < 3600 * given.hours:
            print(f"soak: round {number}, seed {given.seed + number}", flush=True)
            soak.oracles(number)
            soak.scenes(number)
            soak.long_run(number)
            number += 1
    except KeyboardInterrupt:
        print("soak: interrupted")
    shutil.rmtree(soak.out / "work", ignore_errors=True)
    hours = (time.monotonic() - start) / 3600
    print(f"soak: {number} rounds, {soak.jobs} jobs in {hours:.2f} hours: {soak.findings} findings")
    return 1 if soak.findings else 0


if __name__ == "__main__":
    sys.exit(main())
