#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The commands that ranks share: the same bytes as of one process, for any number of ranks and threads; one message, its exit code and
no output where one of them fails.

usage: test_mpi.py BUILD_DIR [MPIRUN]
"""

import json
import os
import random
import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

from ranks_case import RanksCase, main

SHARES = [(ranks, threads) for ranks in (1, 2, 3) for threads in (1, 2)]

SCENE = {
    "environment": {"generate": "hexes", "cells": [8, 6, 6], "solid": 0.06},
    "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 21, "seed": 7, "speed": 3, "spin": [0.5, 0.3, 0.2]},
               {"shape": "hexahedron", "side": 0.4, "count": 5, "seed": 3, "speed": 2, "material": {"mode": "linear", "stiffness": 0.5}},
               {"shape": "hexahedron", "side": 0.2, "motion": {"path": [[0.5, 0.5, 0.5], [6.5, 4.5, 4.5]], "speed": 2}}],
    "particles": [{"count": 7, "seed": 2, "speed": 3}],
    "catheter": {"path": [[0.5, 0.5, 0.3], [5.5, 3.5, 4.5]], "spacing": 0.3, "particles": 20, "advance": 0.1},
    "gravity": [0, 0, -1], "time_step": 0.02, "steps": 41,
    "output": {"frame_every": 6, "motion_every": 4, "picture": {"width": 160, "height": 100}},
}


class Program(RanksCase):
    def cellwalk(self, ranks, *words, **how):
        return self.run_ranks(ranks, [self.build / "cellwalk", *words], **how)

    def succeed(self, ranks, *words, **how):
        done = self.cellwalk(ranks, *words, **how)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def write_table(self, name, columns, rows, box):
        numbers = random.Random(5)
        lines = ["# motions", ",".join(columns)]
        for row in range(rows):
            lines.append(",".join(repr(numbers.uniform(-0.2, size + 0.2)) for _ in range(len(columns) // 3) for size in box))
            if row % 97 == 96:
                lines += ["", "# a comment", "1,2,oops"]
        (self.folder / name).write_text("\n".join(lines) + "\n")


class Commands(Program):
    def test_query_gives_the_same_bytes(self):
        self.succeed(1, "generate", "tets", "--cells", "6", "5", "4", "--jitter", "0.1", "-o", "env.ovm")
        self.write_table("moves.csv", ["ax", "ay", "az", "bx", "by", "bz"], 1501, (6, 5, 4))
        self.write_table("sweeps.csv", ["px", "py", "pz", "tx", "ty", "tz", "qx", "qy", "qz"], 400, (6, 5, 4))
        moves = ["--record", "row.json", "--row", "700", "--trace", "pieces.csv", "--tally", "cells.vtu"]
        for table, options in (("moves.csv", moves), ("sweeps.csv", ["--mode", "sweep"])):
            expected = None
            for ranks, threads in SHARES:
                with self.subTest(table=table, ranks=ranks, threads=threads):
                    done = self.succeed(ranks, "query", "env.ovm", table, "-o", "out.csv", "--json", "out.json", "--threads", threads,
                                        *options)
                    found = (self.files(self.folder), done.stdout, done.stderr)
                    expected = expected or found
                    self.assertEqual(found, expected)
            self.assertIn("; rows marked invalid: ", expected[2])
            self.assertGreater(expected[0]["out.csv"].count(b"contact"), 50)
            self.assertGreater(expected[0]["pieces.csv"].count(b"\n"), 3000)
            self.assertIn(b"track_length", expected[0]["cells.vtu"])

    def test_query_of_fewer_rows_than_ranks(self):
        self.succeed(1, "generate", "squares", "--cells", "4", "-o", "flat.ovm")
        for rows in ("", "0.5,0.5,2.5,0.5\n"):
            (self.folder / "moves.csv").write_text("ax,ay,bx,by\n" + rows)
            picture = ["--picture", "row.png", "--row", "0"] if rows else []
            expected = self.succeed(1, "query", "flat.ovm", "moves.csv", "-o", "out.csv", *picture).stdout, self.files(self.folder)
            found = self.succeed(3, "query", "flat.ovm", "moves.csv", "-o", "out.csv", *picture).stdout, self.files(self.folder)
            self.assertEqual(found, expected)

    def test_query_of_the_standard_input(self):
        self.succeed(1, "generate", "hexes", "--cells", "4", "-o", "env.ovm")
        self.write_table("moves.csv", ["ax", "ay", "az", "bx", "by", "bz"], 200, (4, 4, 4))
        self.succeed(1, "query", "env.ovm", "moves.csv", "-o", "alone.csv")
        self.succeed(2, "query", "env.ovm", "/dev/stdin", "-o", "out.csv", input=(self.folder / "moves.csv").read_text())
        self.assertEqual((self.folder / "alone.csv").read_bytes(), (self.folder / "out.csv").read_bytes())

    def test_run_gives_the_same_bytes(self):
        (self.folder / "scene.json").write_text(json.dumps(SCENE))
        expected = None
        for ranks, threads in SHARES:
            with self.subTest(ranks=ranks, threads=threads):
                done = self.succeed(ranks, "run", "scene.json", "-o", "out", "--threads", threads, "--force", "--json", "report.json")
                found = (self.files(self.folder), done.stdout, done.stderr)
                expected = expected or found
                self.assertEqual(sorted(found[0]), sorted(expected[0]))
                for name, content in expected[0].items():
                    self.assertEqual(found[0][name], content, name)
                self.assertEqual(found[1:], expected[1:])
        report = json.loads(expected[0]["report.json"])
        self.assertGreater(sum(report["contacts"].values()), 40)
        self.assertGreater(report["motion"]["records"], 10)

    def test_run_in_the_plane_and_with_more_ranks_than_bodies(self):
        scene = {"dimension": 2, "environment": {"generate": "room2d"},
                 "bodies": [{"shape": "polygon", "corners": 6, "radius": 0.6, "count": 2, "seed": 5, "speed": 4}],
                 "time_step": 0.02, "steps": 30, "output": {"frame_every": 0}}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        self.succeed(1, "run", "scene.json", "-o", "out")
        expected = self.files(self.folder / "out")
        self.succeed(3, "run", "scene.json", "-o", "out", "--force")
        self.assertEqual(self.files(self.folder / "out"), expected)

    def test_the_first_rank_works_alone_where_walls_move(self):
        scene = {"environment": {"generate": "vessel"}, "bodies": [{"shape": "hexahedron", "side": 0.1, "count": 3, "speed": 1}],
                 "walls": {"pulsation": {"amplitude": 0.05, "period": 1}}, "time_step": 0.02, "steps": 3}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        done = self.succeed(1, "run", "scene.json", "-o", "out")
        expected = self.files(self.folder / "out"), done.stdout
        done = self.succeed(2, "run", "scene.json", "-o", "out", "--force")
        self.assertEqual((self.files(self.folder / "out"), done.stdout), expected)
        self.assertEqual(done.stderr, "cellwalk: scene.json: walls move, so the first of 2 ranks works alone\n")

    def test_replay_gives_the_same_answers(self):
        self.succeed(1, "generate", "hexes", "--cells", "6", "--solid", "0.06", "-o", "env.ovm")
        scene = {"environment": "env.ovm", "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 11, "speed": 3}], "time_step": 0.02,
                 "steps": 60}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        self.succeed(1, "run", "scene.json", "-o", "out", "--record", "motion.trace")
        answers = None
        for ranks in (1, 2, 3):
            self.succeed(ranks, "replay", "motion.trace", "--environment", "env.ovm", "--json", "out.json", "--repeat", "2")
            report = json.loads((self.folder / "out.json").read_text())
            self.assertEqual(report["manifest"].pop("ranks"), ranks)
            found = {key: value for key, value in report.items() if not key.startswith(("ns_", "step_us"))}
            answers = answers or found
            self.assertEqual(found, answers)
        self.assertEqual(answers["mismatches"], 0)
        self.assertGreater(answers["blocked"], 10)

    def test_other_commands_run_once(self):
        done = self.succeed(3, "generate", "hexes", "--cells", "2", "-o", "env.ovm")
        self.assertEqual(done.stdout.count("env.ovm: certified"), 1, done.stdout)
        self.assertEqual(self.succeed(2, "--version").stdout, self.succeed(1, "--version").stdout)
        self.assertRegex(self.succeed(1, "--version").stdout, r"mpi +[0-9]")


class Failures(Program):
    def expect_failure(self, ranks, exit_code, message, *words):
        """The message is printed once, with its exit code, and no file is made."""
        before = self.files(self.folder)
        done = self.cellwalk(ranks, *words)
        lines = [line for line in done.stderr.splitlines() if line.startswith("cellwalk: ")]
        self.assertEqual((done.returncode, lines, done.stdout), (exit_code, [f"cellwalk: {message}"], ""), done.stderr)
        self.assertEqual(self.files(self.folder), before)

    def test_every_rank_fails(self):
        (self.folder / "moves.csv").write_text("ax,ay,bx\n")
        self.succeed(1, "generate", "squares", "--cells", "2", "-o", "flat.ovm")
        for ranks in (1, 2, 3):
            self.expect_failure(ranks, 3, "absent.ovm: cannot be opened: check that it exists and may be read", "query", "absent.ovm", "moves.csv",
                      "-o", "out.csv")
            self.expect_failure(ranks, 3, "moves.csv: has no column 'by': its header names ax,ay,bx", "query", "flat.ovm", "moves.csv", "-o",
                      "out.csv")
            self.expect_failure(ranks, 2, "fly is not known here; see cellwalk --help", "fly")

    def test_one_rank_fails(self):
        self.succeed(1, "generate", "squares", "--cells", "2", "-o", "flat.ovm")
        rows = ["0.5,0.5,1.5,0.5"] * 100
        for row in (10, 50, 90):
            broken = rows[:row] + ['"0.5,0.5,1.5,0.5'] + rows[row:]
            (self.folder / "moves.csv").write_text("ax,ay,bx,by\n" + "\n".join(broken) + "\n")
            for ranks in (1, 2, 3):
                self.expect_failure(ranks, 3, f"moves.csv:{row + 2}: a quote is left open", "query", "flat.ovm", "moves.csv", "-o", "out.csv")
        (self.folder / "moves.csv").write_text("ax,ay,bx,by\n" + "\n".join(rows) + "\n")
        for ranks in (1, 2):
            self.expect_failure(ranks, 2, "--row 100: there is no such valid row", "query", "flat.ovm", "moves.csv", "-o", "out.csv",
                                "--row", "100", "--record", "row.json")

    def test_a_pipe_is_an_input(self):
        self.succeed(1, "generate", "squares", "--cells", "2", "-o", "flat.ovm")
        os.mkfifo(self.folder / "moves.pipe")
        self.expect_failure(2, 2, "moves.pipe: is a pipe, which only one process can read: give a file, or /dev/stdin", "query", "flat.ovm",
                            "moves.pipe", "-o", "out.csv")

    def test_output_cannot_be_written(self):
        self.succeed(1, "generate", "squares", "--cells", "2", "-o", "flat.ovm")
        (self.folder / "moves.csv").write_text("ax,ay,bx,by\n0.5,0.5,1.5,0.5\n")
        done = self.cellwalk(2, "query", "flat.ovm", "moves.csv", "-o", "absent/out.csv")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("cellwalk: absent/out.csv: cannot be written"), 1, done.stderr)

    def rank_of(self, starter, rank):
        """The process of a rank, once it runs."""
        wanted = f"OMPI_COMM_WORLD_RANK={rank}".encode()
        for _ in range(200):
            for process in Path("/proc").glob("[0-9]*"):
                try:
                    if int((process / "stat").read_text().rsplit(")", 1)[1].split()[1]) != starter:
                        continue
                    if wanted in (process / "environ").read_bytes().split(b"\0"):
                        return int(process.name)
                except (OSError, ValueError):
                    continue
            time.sleep(0.05)
        self.fail("the rank does not start")

    def kill_rank(self, rank, number, wait_for):
        scene = {**SCENE, "steps": 100000}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        before = self.files(self.folder)
        words = [self.build / "cellwalk", "run", "scene.json", "-o", "out", "--threads", "1"]
        with subprocess.Popen(self.command(2, words), cwd=self.folder, env=self.environment(), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as started:
            victim = self.rank_of(started.pid, rank)
            for _ in range(200):
                if list(self.folder.glob(wait_for)):
                    break
                time.sleep(0.05)
            os.kill(victim, number)
            _, errors = started.communicate(timeout=60)
        self.assertEqual(started.returncode, 128 + number, errors)
        return before, errors

    def test_a_rank_is_killed(self):
        before, errors = self.kill_rank(1, signal.SIGKILL, "out.tmp-*/frames/*00003.vtu")
        self.assertEqual(self.files(self.folder), before)
        self.assertNotIn("cellwalk: ", errors)

    def test_the_first_rank_is_terminated(self):
        before, errors = self.kill_rank(0, signal.SIGTERM, "out.tmp-*/frames/*00003.vtu")
        self.assertEqual(self.files(self.folder), before)
        self.assertNotIn("cellwalk: ", errors)

    def test_a_signal_of_a_batch_system_makes_a_last_checkpoint(self):
        (self.folder / "scene.json").write_text(json.dumps({**SCENE, "steps": 100000}))
        words = [self.build / "cellwalk", "run", "scene.json", "-o", "out", "--threads", "1", "--checkpoint-every", "1000000"]
        kept = self.folder / "out.part" / "checkpoints"
        for number in (signal.SIGUSR1, signal.SIGUSR2):  # mpirun hands them on to all ranks
            with subprocess.Popen(self.command(2, words), cwd=self.folder, env=self.environment(), stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True) as started:
                for _ in range(400):
                    if list(kept.glob("step-*.checkpoint")):
                        break
                    time.sleep(0.05)
                time.sleep(0.2)
                started.send_signal(number)
                _, errors = started.communicate(timeout=60)
            self.assertEqual(started.returncode, 128 + number, errors)
            self.assertGreater(max(int(file.stem[5:]) for file in kept.glob("step-*.checkpoint")), 0)
            shutil.rmtree(self.folder / "out.part")


if __name__ == "__main__":
    main()
