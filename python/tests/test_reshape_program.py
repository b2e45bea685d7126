# SPDX-License-Identifier: LGPL-3.0-or-later
"""Environment.reshape() and `cellwalk deform` make the same moves among the same bodies, and say the same of each."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

import cellwalk
from cellwalk import Feature, MoveEnd

PROGRAM = os.environ["CELLWALK_PROGRAM"]


class AsTheProgram(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def deform(self, environment, points, targets, bodies, at_contact):
        environment.save(self.folder / "before.ovm")
        names = "point,x,y,z"[: 5 + 2 * environment.dimension]
        rows = [",".join([str(p), *map(repr, x.tolist())]) for p, x in zip(points, targets)]
        (self.folder / "moves.csv").write_text("\n".join([names, *rows, ""]))
        command = [PROGRAM, "deform", "before.ovm", "moves.csv", "--report", "report.csv", "--at-contact", at_contact]
        command += ["-o", "after.ovm"] if at_contact != "test" else []
        for body in bodies:
            command += ["--body", body]
        subprocess.run(command, cwd=self.folder, check=True, capture_output=True, timeout=120)
        with open(self.folder / "report.csv", newline="") as file:
            return list(csv.DictReader(file))

    def compare(self, environment, body_files, at_contact, rng):
        """Moves of all points at walls by a little; those that would make a cell flat are left out, since the program tries them once only."""
        low, high = environment.points.min(axis=0), environment.points.max(axis=0)
        sides = ((environment.points == low) | (environment.points == high)).any(axis=1)
        points = rng.permutation(numpy.flatnonzero(sides))
        inwards = 0.5 * (low + high) - environment.points[points]
        targets = environment.points[points] + inwards * rng.uniform(0.0, 0.25, (len(points), 1))
        bodies = [cellwalk.Body.read(environment, self.folder / name) for name in body_files]
        rows = self.deform(environment, points, targets, body_files, at_contact)
        self.assertNotIn("cell", {row["status"] for row in rows})
        moves = environment.reshape(points, targets, bodies=bodies, at_contact=at_contact, most_rounds=1)
        self.assertEqual([MoveEnd(end).name.lower() for end in moves.end], [row["status"] for row in rows])
        after = cellwalk.Environment.load(self.folder / ("before.ovm" if at_contact == "test" else "after.ovm"))
        self.assertEqual(after.points.tobytes(), environment.points.tobytes())
        told = {row["row"]: row for row in moves.contacts}
        for i, row in enumerate(rows):
            axes = "xyz"[: environment.dimension]
            self.assertEqual([float(row[a]) for a in axes], moves.position[i].tolist())
            self.assertTrue(numpy.isnan(moves.time[i]) if row["time"] == "" else float(row["time"]) == moves.time[i])
            self.assertEqual(row["kind"] != "", i in told)
            if i in told:
                hit = told[i]
                self.assertEqual((row["kind"], row["body"], row["feature"], row["number"], row["cell"]),
                                 (Feature(hit["kind"]).name.lower(), str(hit["owner"]),
                                  ("vertex", "edge", "face")[hit["body"]], str(hit["feature"]), str(hit["cell"])))
                self.assertEqual([float(row["n" + a]) for a in axes], hit["normal"].tolist())
                self.assertEqual([float(row["c" + a]) for a in axes], hit["point"].tolist())
                self.assertEqual(hit["corners"][0], points[i])
        for body in bodies:
            body.validate()
        self.assertEqual(moves.counts["pushes"] > 0, at_contact == "push")
        return [row["status"] for row in rows]

    def test_in_3d(self):
        (self.folder / "wire.csv").write_text(
            "x,y,z\n0.2,0.2,0.1\n2.1,0.1,0.15\n3.8,1.8,0.1\n0.4,1.85,1.8\n0.15,0.2,1.9\n3.7,0.15,1.85\n3.9,1.9,0.2\n")
        (self.folder / "tetrahedron.off").write_text(
            "OFF\n4 4 0\n0.2 0.2 1.2\n0.9 0.3 1.8\n0.3 1.8 1.7\n0.2 1.1 1.9\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
        for at_contact in ("stop", "hold", "push", "test"):
            environment = cellwalk.Environment.generate("hexes", cells=(4, 2, 2), simplicial=True)
            ends = self.compare(environment, ["wire.csv", "tetrahedron.off"], at_contact, numpy.random.default_rng(7))
            self.assertGreater(ends.count("contact"), 5 if at_contact != "push" else -1)
            self.assertGreater(ends.count("reached"), 10)

    def test_in_2d(self):
        (self.folder / "bar.csv").write_text("x,y\n0.2,0.2\n3.8,0.15\n3.8,3.8\n0.15,3.85\n")
        for at_contact in ("stop", "hold", "push", "test"):
            environment = cellwalk.Environment.generate("squares", cells=(4, 4), simplicial=True)
            ends = self.compare(environment, ["bar.csv"], at_contact, numpy.random.default_rng(3))
            self.assertGreater(ends.count("contact"), 5 if at_contact != "push" else -1)
            self.assertGreater(ends.count("reached"), 5)


if __name__ == "__main__":
    unittest.main()
