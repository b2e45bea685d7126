#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The gate of instructions: its traces of free moves, its comparison, and all of it with programs that only say what they are told."""
import contextlib
import io
import json
import os
import pathlib
import struct
import sys
import tempfile
import unittest
import unittest.mock

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))
import check_instructions as gate  # noqa: E402
import free_moves  # noqa: E402


def doubles(*values):
    return struct.pack(f"<{len(values)}d", *values)


def trace_of_bodies(answers):
    """Two bodies: an edge, and a vertex. Vertices are at x = 0, 1, 2, and go to y = 1 in the first step and 2 in the second."""
    head = b"ECCDTRC2" + struct.pack("<2I", 2, 2) + struct.pack("<3I2I", 2, 1, 0, 0, 1) + struct.pack("<3I", 1, 0, 0)
    before = b"".join(doubles(*(x for v in range(3) for x in (v, step, 0.5))) for step in range(3))
    targets = b"".join(doubles(*(x for v in range(3) for x in (v, step + 1, 0.5))) for step in range(2))
    return head + before + targets + b"\1" + bytes(answers)


class FreeMoves(unittest.TestCase):
    def test_what_is_held_of_bodies_stays_where_the_trace_has_it(self):
        # Of a step: vertex 0, its neighbour, vertex 1, its neighbour, vertex 2. Bit 1 is the triangle, and holds nothing.
        answers = [0, 1, 0, 2, 0, 1, 2, 0, 0, 1]
        data = trace_of_bodies(answers)
        free, held = free_moves.free_moves(data)
        self.assertEqual(held, 3)
        self.assertEqual(free[-10:], bytes([0, 0, 0, 2, 0, 0, 0, 0, 0, 0]))
        targets = struct.unpack("<18d", free[-11 - 18 * 8:-11])
        self.assertEqual([targets[3 * i + 1] for i in range(6)], [0, 1, 1, 1, 2, 1])
        self.assertEqual(free[:-11 - 18 * 8], data[:-11 - 18 * 8])

    def test_a_grid_is_left_as_it_is(self):
        plain = trace_of_bodies([0, 1, 0, 2, 0, 1, 2, 0, 0, 1])
        for head in (struct.pack("<2I", 1, 0), struct.pack("<9I", 0, 1, 2, 2, 2, 3, 1, 2, 7)):
            head = b"ECCDTRC3" + head
            free, held = free_moves.free_moves(head + plain[8:])
            self.assertEqual((free, held), (head + free_moves.free_moves(plain)[0][8:], 3))

    def test_what_is_no_whole_trace_is_refused(self):
        for data in (b"ECCDTRC1" + bytes(99), trace_of_bodies([0] * 10)[:-1], b"ECCDTRC3" + struct.pack("<6I", 1, 1, 2, 2, 2, 1)):
            with self.assertRaises(ValueError):
                free_moves.free_moves(data)


def counted(**instructions):
    return {scene: {"moves": 100, "instructions": n} for scene, n in instructions.items()}


class Comparison(unittest.TestCase):
    def judge(self, now, expected):
        row = expected and {"build": {"compiler": "x"}, "scenes": expected}
        lines, *found = gate.compare(now, expected)
        return "\n".join(lines), *gate.verdict({"compiler": "x"}, row, *found)

    def test_two_percent_more_are_allowed_and_no_more(self):
        for instructions, code in ((10200, 0), (10201, 1), (9800, 0), (9000, 0)):
            table, _, found = self.judge(counted(scene=instructions), counted(scene=10000))
            self.assertEqual(found, code, instructions)
            self.assertIn(f"{instructions / 100:.2f}    100.00", table)

    def test_the_scene_that_takes_more_is_named(self):
        table, said, _ = self.judge(counted(a=10000, b=11000), counted(a=10000, b=10000))
        self.assertIn("+10.0 %", table)
        self.assertIn("b: over 2 % more than expected", said)
        self.assertNotIn("a:", said)

    def test_less_is_worth_an_update(self):
        self.assertIn("a: over 2 % less than expected. Keep that: ", self.judge(counted(a=9000), counted(a=10000))[1])

    def test_instructions_a_move_count(self):
        now = {"a": {"moves": 200, "instructions": 20000}}
        self.assertEqual(self.judge(now, counted(a=10000))[2], 0)

    def test_a_scene_without_an_entry_fails(self):
        _, said, code = self.judge(counted(a=1, b=1), counted(a=1))
        self.assertEqual(code, 1)
        self.assertIn("b: not in the table", said)

    def test_without_a_row_it_says_that_nothing_was_compared(self):
        _, said, code = self.judge(counted(a=1), None)
        self.assertEqual(code, 0)
        self.assertIn("NOT COMPARED: the table has no row for this build (compiler x)", said)

    def test_update_changes_the_row_of_the_build_only(self):
        table = {"rows": [{"build": {"c": 1}, "scenes": counted(a=1)}, {"build": {"c": 2}, "scenes": counted(a=2)}]}
        table = gate.update(table, {"c": 1}, counted(a=3))
        self.assertEqual(gate.row_of(table, {"c": 1})["scenes"], counted(a=3))
        self.assertEqual(gate.row_of(table, {"c": 2})["scenes"], counted(a=2))
        self.assertEqual(len(table["rows"]), 2)
        self.assertIsNone(gate.row_of(table, {"c": 3}))


# Programs that take the place of the real ones: a trace of one step, whose replay is free, and a count from the environment's file.
CELLWALK = """#!/usr/bin/python3 -IS
import json, pathlib, sys
words = sys.argv[1:]
told = json.loads(pathlib.Path({told!r}).read_text())
if words[0] == "--version":
    print(json.dumps({{"compiler": "cc 1", "flags": "-O3", "parts": {{"cgal": {{"version": "5"}}}}}}))
elif "--record" in words:
    pathlib.Path(words[words.index("--record") + 1]).write_bytes(bytes.fromhex({trace!r}))
elif words[0] == "replay":
    report = {{"mismatches": told["mismatches"], "moves": 100, "blocked": 0}}
    pathlib.Path(words[words.index("--json") + 1]).write_text(json.dumps(report))
"""
MAKE_TRACES = """#!/usr/bin/python3 -IS
import pathlib, sys
pathlib.Path(sys.argv[1]).write_bytes(bytes.fromhex({trace!r}))
"""
VALGRIND = """#!/usr/bin/python3 -IS
import json, os, pathlib, sys
assert "GLIBC_TUNABLES" in os.environ and "HOME" not in os.environ
told = json.loads(pathlib.Path({told!r}).read_text())
out = [word.partition("=")[2] for word in sys.argv if word.startswith("--callgrind-out-file=")]
pathlib.Path(out[0]).write_text("events: Ir\\nsummary: %d\\n" % told["instructions"])
if "-o" in sys.argv:
    folder = pathlib.Path(sys.argv[sys.argv.index("-o") + 1])
    folder.mkdir()
    (folder / "run.json").write_text(json.dumps({{"body_counts": {{"moves": 100, "contacts": told["contacts"]}}}}))
"""


class Whole(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        root = pathlib.Path(self.folder.name)
        self.build, self.table, self.told, tools = root / "build", root / "table.json", root / "told.json", root / "tools"
        told = str(self.told)
        self.program(self.build / "cellwalk", CELLWALK.format(told=told, trace=trace_of_bodies([0] * 10).hex()))
        self.program(self.build / "experiments/01_figure_8/make_traces", MAKE_TRACES.format(trace=trace_of_bodies([0] * 10).hex()))
        self.program(tools / "valgrind", VALGRIND.format(told=told))
        path = os.environ["PATH"]
        self.addCleanup(lambda: os.environ.update(PATH=path))
        os.environ["PATH"] = f"{tools}:{path}"
        one = unittest.mock.patch.dict(gate.SCENES, {"figure_8": gate.SCENES["figure_8"]}, clear=True)
        one.start()
        self.addCleanup(one.stop)

    @staticmethod
    def program(path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def run_gate(self, instructions, *options, mismatches=0, contacts=1):
        self.told.write_text(json.dumps({"instructions": instructions, "mismatches": mismatches, "contacts": contacts}))
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            code = gate.main(["--build", str(self.build), "--table", str(self.table), *options])
        return code, out.getvalue()

    def test_an_update_is_what_the_next_run_expects(self):
        code, said = self.run_gate(1000)
        self.assertEqual((code, "NOT COMPARED" in said), (0, True), said)
        self.assertFalse(self.table.exists(), "nothing is written without --update")
        self.assertEqual(self.run_gate(1000, "--update")[0], 0)
        scenes = json.loads(self.table.read_text())["rows"][0]["scenes"]
        self.assertEqual(scenes["figure_8 triangle"], {"moves": 100, "instructions": 1000})
        self.assertEqual(self.run_gate(1020)[0], 0)
        code, said = self.run_gate(1030)
        self.assertEqual(code, 1)
        self.assertIn("steps of a catheter: over 2 % more than expected", said)
        self.assertEqual(self.run_gate(1030, "--update")[0], 0)
        self.assertEqual(self.run_gate(1030)[0], 0)

    def test_every_scene_is_counted(self):
        unittest.mock.patch.stopall()
        self.run_gate(1000, "--update")
        self.assertEqual(len(json.loads(self.table.read_text())["rows"][0]["scenes"]),
                         len(gate.SCENES) * len(gate.SWEEPS) + len(gate.STEPS))

    def test_what_counts_nothing_fails(self):
        code, said = self.run_gate(0)
        self.assertEqual(code, 1)
        self.assertIn("no instruction was counted in cellwalk::Body_replay::step() or", said)

    def test_other_answers_fail(self):
        code, said = self.run_gate(1000, mismatches=3)
        self.assertEqual(code, 1)
        self.assertIn("0 moves are not free, 3 answers differ from those of the trace", said)

    def test_steps_without_contacts_fail(self):
        code, said = self.run_gate(1000, contacts=0)
        self.assertEqual(code, 1)
        self.assertIn("steps of a catheter: there is no contact", said)

    def test_a_missing_program_is_named(self):
        (self.build / "experiments/01_figure_8/make_traces").unlink()
        code, said = self.run_gate(1000)
        self.assertEqual(code, 1)
        self.assertIn("make_traces is not there: cmake --build", said)

    def test_valgrind_is_necessary(self):
        os.environ["PATH"] = str(self.build)
        code, said = self.run_gate(1000)
        self.assertEqual(code, 1)
        self.assertIn("valgrind is not there: scripts/setup.sh --for ci", said)


class Table(unittest.TestCase):
    def test_every_row_has_every_scene(self):
        table = json.loads((ROOT / "tests/instructions/expected.json").read_text())
        self.assertGreater(len(table["rows"]), 0)
        names = {f"{name} {sweep}" for name in gate.SCENES for sweep in gate.SWEEPS} | set(gate.STEPS)
        for row in table["rows"]:
            self.assertEqual(set(row["scenes"]), names)
            self.assertEqual(set(row["build"]), {"compiler", "flags", "cgal", "libc", "machine", "avx2"})


if __name__ == "__main__":
    unittest.main()
