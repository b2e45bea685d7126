# SPDX-License-Identifier: LGPL-3.0-or-later
"""Edits at random, among bodies and particles: a program in C++ makes the same ones, says the same of each, and ends with the same environment."""

import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

import cellwalk

PROGRAM = os.environ["CELLWALK_EDIT_SCRIPT"]


def half_solid(environment, height):
    """Cells below a height are filled."""
    cells = environment.cells()
    with environment.editing() as edits:
        assert edits.fill(cells[cells["mean"][:, -1] < height]).made.all()
    return environment


def text(numbers):
    return " ".join(repr(x) for x in numpy.asarray(numbers).ravel().tolist())


class Recorder:
    """Makes edits at random in Python, and notes them with what came of them."""

    def __init__(self, environment, edits, rng):
        self.environment, self.edits, self.rng = environment, edits, rng
        self.script, self.said, self.tally = [], [], {}

    def note(self, kind, arguments, answer, made):
        self.script.append(f"{kind} {arguments}")
        self.said.append(answer)
        counts = self.tally.setdefault(kind, [0, 0])
        counts[made] += 1

    def pick(self, table):
        return table[self.rng.integers(len(table))]

    def change(self, kind):
        of_facets = kind in ("open", "close")
        row = self.pick(self.environment.facets() if of_facets else self.environment.cells())
        done = getattr(self.edits, kind)([row])
        held = "".join(f" ({int(h['is_particle'])} {h['owner']} {h['body']} {h['feature']})" for h in done.held_by)
        self.note(kind, f"{row['cell']} {row['facet']}" if of_facets else str(row["cell"]),
                  f"{int(done.made[0])} '{done.reasons[0]}'{held}", int(done.made[0]))

    def replaced(self, kind, arguments, done):
        point = -1 if done.point is None else done.point
        cells = "".join(f" {c}" for c in done.cells)
        self.assert_equal(bool(done), done.made)
        self.note(kind, arguments, f"{int(done.made)} '{done.reason}' {point}{cells}", int(done.made))

    def edge(self):
        u, v = self.rng.permutation(self.pick(self.environment.cells())["points"])[:2].tolist()
        return u, v

    def place_in(self, points):
        weights = self.rng.dirichlet(numpy.ones(len(points)))
        return weights @ self.environment.points[points]

    def replace(self, kind):
        if kind == "insert_point":
            row = self.pick(self.environment.cells())
            x = self.place_in(row["points"])
            self.replaced(kind, f"{row['cell']} {text(x)}", self.edits.insert_point(row, x))
        elif kind == "flip":
            row = self.pick(self.environment.facets())
            self.replaced(kind, f"{row['cell']} {row['facet']}", self.edits.flip(row))
        elif kind == "split_edge":
            u, v = self.edge()
            x = 0.5 * (self.environment.points[u] + self.environment.points[v])
            self.replaced(kind, f"{u} {v} {text(x)}", self.edits.split_edge(u, v, x))
        elif kind == "split_vertex":
            cells = self.environment.cells()
            solid = cells[cells["solid"]]
            if len(solid) == 0:
                return
            row = self.pick(solid)
            vertex = int(self.rng.choice(row["points"]))
            x = 0.75 * self.environment.points[vertex] + 0.25 * row["mean"]
            self.replaced(kind, f"{vertex} 1 {row['cell']} {text(x)}", self.edits.split_vertex(vertex, [row], x))
        else:
            u, v = self.edge()
            self.replaced(kind, f"{u} {v}", getattr(self.edits, kind)(u, v))

    def relax(self):
        in_use = numpy.unique(self.environment.cells()["points"])
        points = self.rng.choice(in_use, 6, replace=False)
        done = self.edits.relax(points, good_enough=0.6, most_operations=5)
        self.assert_equal(done.operations, done.smoothed + done.flipped + done.edges_removed + done.split + done.collapsed)
        self.note("relax", f"6 {text(points)} 0.6 5",
                  f"{done.smoothed} {done.flipped} {done.edges_removed} {done.split} {done.collapsed} {done.tried} {done.rounds} "
                  f"{c_hex(done.least_before)} {c_hex(done.least_after)}", int(done.operations > 0))

    def cut(self, blade, by, **how):
        done = self.edits.cut(blade, opening=0.05, snap=0.25, **how)
        made = "".join(f" ({p['point']} {p['between'][0]} {p['between'][1]} {c_hex(p['share'])})" for p in done.points)
        self.note("cut", f"{len(blade)} {text(blade)} 0.05 0.25 {by}",
                  f"{done.edges} {done.split} {done.snapped} {done.refused} {done.facets} {done.opened} {done.rim} {done.held}{made}",
                  int(done.opened > 0))


def c_hex(x):
    """As printf writes %a: without zeros at the end."""
    mantissa, exponent = float(x).hex().split("p")
    return (mantissa.rstrip("0").rstrip(".") if "." in mantissa else mantissa) + "p" + exponent


class AsInCpp(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def compare(self, seed, environment, bodies, particles, blades, steps):
        rng = numpy.random.default_rng(seed)
        environment.save(self.folder / "before.ovm")
        environment = cellwalk.Environment.load(self.folder / "before.ovm", duplicates="keep")
        lines = [f"body {text(b)}" for b in bodies] + [f"particles {text(p)}" for p in particles]
        placed = [cellwalk.Body(environment, b, numpy.array([[i, i + 1] for i in range(len(b) - 1)])) for b in bodies]
        swarms = [cellwalk.Particles(environment, p) for p in particles]
        with environment.editing(bodies=placed, particles=swarms) as edits:
            recorder = Recorder(environment, edits, rng)
            recorder.assert_equal = self.assertEqual
            replacements = ["insert_point", "flip", "split_edge", "collapse", "split_vertex"] + ["remove_edge"] * (environment.dimension == 3)
            for _ in range(steps):
                kind = rng.integers(3)
                if kind == 0:
                    recorder.change(rng.choice(["open", "close", "excavate", "fill"]))
                elif kind == 1:
                    recorder.replace(rng.choice(replacements))
                elif rng.random() < 0.2:
                    recorder.relax()
            for blade, by, how in blades:
                recorder.cut(blade, by, **how)
        for body in placed:
            body.validate()
        environment.save(self.folder / "python.ovm")
        anew = cellwalk.Environment.load(self.folder / "python.ovm", duplicates="keep").certificate
        for key, value in environment.certificate.items():
            self.assertAlmostEqual(anew[key], value, 9, key)
        ran = subprocess.run([PROGRAM, "before.ovm", "cpp.ovm"], cwd=self.folder, input="\n".join(lines + recorder.script) + "\n",
                             check=True, capture_output=True, text=True, timeout=300)
        said = ran.stdout.splitlines()
        for line, expected, answer in zip(recorder.script, said, recorder.said):
            self.assertEqual(answer, expected, line)
        self.assertEqual(len(said), len(recorder.said))
        self.assertEqual((self.folder / "python.ovm").read_bytes(), (self.folder / "cpp.ovm").read_bytes())
        return recorder.tally

    def check_tallies(self, tallies):
        total = {}
        for tally in tallies:
            for kind, (refused, made) in tally.items():
                known = total.setdefault(kind, [0, 0])
                known[0] += refused
                known[1] += made
        for kind, (refused, made) in total.items():
            self.assertGreater(made, 0, (kind, total))
            self.assertTrue(refused or kind not in ("open", "close", "fill", "flip", "split_edge", "collapse", "remove_edge"), (kind, total))

    def test_in_3d(self):
        tallies = []
        for seed in range(6):
            environment = half_solid(cellwalk.Environment.generate("tets", cells=(3, 3, 3), jitter=0.1, seed=seed + 1), 1.2)
            inside = environment.locate(PLACES).status == cellwalk.Place.FREE
            free = PLACES[inside]
            bodies = [numpy.stack([x, x + [0.4, 0.0, 0.0]]) for x in free if x[0] < 2.5 and x[2] > 1.8]
            polygon = numpy.array([[1.6, -1.0, -1.0], [1.6, 4.0, -1.0], [1.6, 4.0, 4.0], [1.6, -1.0, 4.0]])
            line = numpy.array([[-1.0, 1.4, 1.0], [4.0, 1.4, 1.1]])
            blades = [(polygon, "polygon", {}), (line, "sweep 0.0 0.1 2.5", {"sweep": (0, 0.1, 2.5)}),
                      (polygon + 0.3, "pieces 2 0 1 2 0 2 3", {"pieces": numpy.array([[0, 1, 2], [0, 2, 3]])})]
            tallies.append(self.compare(seed, environment, bodies, [free[3:6], free[6:]], blades[seed % 3:][:1], 150))
        self.check_tallies(tallies)

    def test_in_2d(self):
        tallies = []
        for seed in range(6):
            environment = half_solid(cellwalk.Environment.generate("triangles", cells=(5, 5), jitter=0.1, seed=seed + 1), 2)
            places = PLACES[:, :2].copy() * 1.5
            free = places[environment.locate(places).status == cellwalk.Place.FREE]
            bodies = [numpy.stack([x, x + [0.4, 0.0]]) for x in free if x[0] < 4.5 and x[1] > 2.8]
            line = numpy.array([[-1.0, 2.3], [6.0, 2.4]])
            blades = [(line, "polygon", {}), (line, "pieces 1 0 1", {"pieces": numpy.array([[0, 1]])})]
            tallies.append(self.compare(seed, environment, bodies, [free[3:6], free[6:]], blades[seed % 2:][:1], 150))
        self.check_tallies(tallies)


PLACES = numpy.random.default_rng(5).uniform(0.1, 2.9, (24, 3))

if __name__ == "__main__":
    unittest.main()
