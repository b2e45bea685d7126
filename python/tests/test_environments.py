# SPDX-License-Identifier: LGPL-3.0-or-later
"""Environments from arrays, recipes and files, and what is said of those that are refused."""

import os
import pathlib
import signal
import tempfile
import threading
import time
import unittest

import numpy

import cellwalk

CUBE = numpy.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
HEXAHEDRON = numpy.array([[0, 1, 3, 2, 4, 5, 7, 6]])


class FromArrays(unittest.TestCase):
    def test_every_shape(self):
        for cells, volume in (
            (HEXAHEDRON, 1.0),
            (numpy.array([[0, 1, 2, 4]]), 1 / 6),
            (numpy.array([[0, 1, 3, 2, 4]]), 1 / 3),
            (numpy.array([[0, 1, 2, 4, 5, 6]]), 1 / 2),
        ):
            environment = cellwalk.Environment.from_arrays(CUBE, cells)
            self.assertAlmostEqual(environment.certificate["volume"], volume)
            self.assertEqual((environment.dimension, environment.cell_count), (3, 1))
        plane = cellwalk.Environment.from_arrays(numpy.array([[0.0, 0], [1, 0], [0, 1]]), numpy.array([[0, 1, 2]], numpy.uint8))
        self.assertEqual((plane.dimension, plane.certificate["volume"]), (2, 0.5))

    def test_points_are_a_view(self):
        environment = cellwalk.Environment.from_arrays(CUBE, HEXAHEDRON)
        self.assertTrue((environment.points == CUBE).all())
        self.assertFalse(environment.points.flags.owndata or environment.points.flags.writeable)

    def test_what_is_split_is_reported(self):
        bent = CUBE.copy()
        bent[7] += 0.25
        environment = cellwalk.Environment.from_arrays(bent, HEXAHEDRON)
        self.assertEqual(environment.report["changed"]["cells_split"], 1)
        self.assertGreater(environment.cell_count, 1)
        with self.assertRaisesRegex(cellwalk.NotCertifiedError, "cell 0"):
            cellwalk.Environment.from_arrays(bent, HEXAHEDRON, split=False)

    def test_cells_that_do_not_conform(self):
        # A hexahedron beside four smaller ones.
        points = [[x, y, z] for x in (0, 2) for y in (0, 2) for z in (0, 2)] + [
            [x, y, z] for x in (2, 3) for y in (0, 1, 2) for z in (0, 1, 2) if x == 3 or y == 1 or z == 1
        ]
        number = {tuple(point): i for i, point in enumerate(points)}

        def box(low, high):
            x, y, z = zip(low, high)
            corners = [(x[i], y[j], z[k]) for k in (0, 1) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))]
            return [number[corner] for corner in corners]

        cells = numpy.array(
            [box((0, 0, 0), (2, 2, 2))] + [box((2, y, z), (3, y + 1, z + 1)) for y in (0, 1) for z in (0, 1)]
        )
        points = numpy.array(points, float)
        for duplicates in ("refuse", "merge"):
            with self.assertRaisesRegex(
                cellwalk.NotCertifiedError, r"cells 0 and 1 share a part of a plane at \(2, 0\.5, 0\.5\) .*the first of 4 such pairs"
            ):
                cellwalk.Environment.from_arrays(points, cells, duplicates=duplicates)
        kept = cellwalk.Environment.from_arrays(points, cells, duplicates="keep")
        self.assertEqual(kept.certificate["components"], 2)
        found = kept.report["changed"]["facing_walls"]
        self.assertEqual(found["overlapping"]["pairs"], 4)
        self.assertEqual(found["overlapping"]["first"]["cells"], [0, 1])
        self.assertEqual(found["near"]["pairs"], 0)

    def test_refusals(self):
        with self.assertRaisesRegex(cellwalk.RowError, r"cells\[0, 3\] is 9: there are 8 points"):
            cellwalk.Environment.from_arrays(CUBE, numpy.array([[0, 1, 2, 9]]))
        with self.assertRaisesRegex(ValueError, r"cells has shape \(1, 7\): \(M, 4\) for tetrahedra.* is needed"):
            cellwalk.Environment.from_arrays(CUBE, numpy.zeros((1, 7), int))
        with self.assertRaisesRegex(TypeError, r"cells must be integers, and is float64 of shape \(1, 4\)"):
            cellwalk.Environment.from_arrays(CUBE, numpy.zeros((1, 4)))
        flat = numpy.array([[0, 1, 2, 3]])
        with self.assertRaises(cellwalk.NotCertifiedError) as caught:
            cellwalk.Environment.from_arrays(CUBE, flat)
        self.assertEqual(caught.exception.code, 4)
        self.assertIsInstance(caught.exception, (cellwalk.Error, ValueError))


class FromRecipes(unittest.TestCase):
    def test_options_are_numbers_flags_and_lists(self):
        environment = cellwalk.Environment.generate("hexes", cells=(2, 3, 4), scale=2, sheared=True)
        self.assertEqual(environment.cell_count, 24)
        self.assertEqual(environment.certificate["volume"], 24 * 8)
        self.assertIn("3D, 24 cells", repr(environment))

    def test_mistakes_name_what_there_is(self):
        with self.assertRaisesRegex(cellwalk.UsageError, "no generator spheres: take one of hexes, tets"):
            cellwalk.Environment.generate("spheres")
        with self.assertRaisesRegex(cellwalk.UsageError, "hexes has no option jitter"):
            cellwalk.Environment.generate("hexes", jitter=0.1)


class FromFiles(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_there_and_back(self):
        for kind in ("lattice", "room2d"):
            path = self.folder / f"{kind}.ovm"
            written = cellwalk.Environment.generate(kind)
            written.save(path)
            read = cellwalk.Environment.load(path)
            self.assertEqual(read.certificate, written.certificate)
            self.assertTrue(numpy.array_equal(read.points, written.points))
            self.assertEqual(read.report["read"]["file"], str(path))

    def test_unreadable_files(self):
        with self.assertRaisesRegex(cellwalk.InputError, "nothing.ovm") as caught:
            cellwalk.Environment.load(self.folder / "nothing.ovm")
        self.assertEqual(caught.exception.code, 3)
        broken = self.folder / "broken.off"
        broken.write_text("OFF\n4 4 0\n0 0 0\n")
        with self.assertRaisesRegex(cellwalk.InputError, "broken.off:"):
            cellwalk.Environment.import_mesh(broken)

    def test_import_of_cells_that_do_not_conform(self):
        hanging = self.folder / "hanging.off"
        hanging.write_text(
            "OFF\n8 3 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n2 1 0\n3 0 0\n3 1 0\n3 2 0\n4 0 1 2 3\n4 1 5 6 4\n4 4 6 7 2\n"
        )
        for conform in ("exact", 1e-9):
            environment = cellwalk.Environment.import_mesh(hanging, conform=conform)
            self.assertEqual(environment.certificate["components"], 1)
            self.assertEqual(environment.report["refined"]["pairs"], 2)
            self.assertEqual(environment.report["refined"]["pieces"], 2)
        with self.assertRaisesRegex(cellwalk.NotCertifiedError, "share a part of a line"):
            cellwalk.Environment.import_mesh(hanging, conform="off")
        for wrong in (2.0, -1e-9, "perhaps"):
            with self.assertRaises(cellwalk.UsageError):
                cellwalk.Environment.import_mesh(hanging, conform=wrong)

    def test_import_as_the_program_does(self):
        torus = os.environ.get("CELLWALK_TORUS")
        if torus is None:  # a build without TetGen says so
            surface = self.folder / "surface.off"
            surface.write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
            with self.assertRaises(cellwalk.UsageError):
                cellwalk.Environment.import_mesh(surface)
            return
        environment = cellwalk.Environment.import_mesh(torus)
        self.assertEqual(environment.report["meshed"]["mesher"], "tetgen")
        self.assertEqual(environment.report["meshed"]["boundary_facets"], 256)
        self.assertEqual(environment.locate(numpy.array([[1.0, 0, 0], [0, 0, 0]])).status.tolist(),
                         [cellwalk.Place.FREE, cellwalk.Place.OUTSIDE])
        open_cube = self.folder / "open.off"
        corners = [(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
        sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2)]
        open_cube.write_text(
            "OFF\n8 5 0\n" + "".join("%d %d %d\n" % p for p in corners) + "".join("4 %d %d %d %d\n" % q for q in sides)
        )
        capped = cellwalk.Environment.import_mesh(open_cube)
        self.assertEqual(capped.certificate["volume"], 1)
        self.assertEqual(capped.report["repaired"]["parts"][0]["name"], "cap_1")
        self.assertIn("cap_1", capped.groups)
        self.assertEqual(cellwalk.Environment.import_mesh(open_cube, inside="solid").certificate["volume"], 1)
        self.assertEqual(cellwalk.Environment.import_mesh(open_cube, inside=(0.5, 0.5, 0.5)).certificate["cells"],
                         cellwalk.Environment.import_mesh(open_cube, inside=[(0.5, 0.5, 0.5)]).certificate["cells"])
        with self.assertRaisesRegex(cellwalk.InputError, "surface is open"):
            cellwalk.Environment.import_mesh(open_cube, strict=True)
        inner = self.folder / "inner.off"
        inner.write_text("OFF\n4 4 0\n1 0 0\n1.1 0 0\n1 0.1 0\n1 0 0.1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n")
        with_obstacle = cellwalk.Environment.import_mesh(torus, obstacles=[inner])
        self.assertEqual(with_obstacle.report["meshed"]["boundary_facets"], 260)
        with self.assertRaisesRegex(cellwalk.UsageError, "mesher takes tetgen, mesh3, not magic"):
            cellwalk.Environment.import_mesh(torus, mesher="magic")

    def test_what_kills_a_mesher_is_an_error(self):
        if os.environ.get("CELLWALK_TORUS") is None:
            self.skipTest("a build without TetGen")
        flat = self.folder / "flat.off"  # a corner at 1e8 beside a unit triangle, on which TetGen crashes
        flat.write_text("OFF\n4 4 0\n0 0 0\n1e8 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
        try:
            self.assertIn("tolerance", cellwalk.Environment.import_mesh(flat).report["meshed"])
        except cellwalk.NotCertifiedError as error:
            self.assertRegex(str(error), "(vertices|facets) [0-9]+ and [0-9]+")
        spike = self.folder / "spike.off"
        spike.write_text("OFF\n8 12 0\n0 0 0\n0 0 1\n0 1 0\n0 1 1\n1 0 0\n1 0 1\n1 1 0\n1 1 1e12\n3 0 1 3\n3 0 3 2\n3 4 6 7\n"
                         "3 4 7 5\n3 0 4 5\n3 0 5 1\n3 2 3 7\n3 2 7 6\n3 0 2 6\n3 0 6 4\n3 1 5 7\n3 1 7 3\n")
        with self.assertRaisesRegex(cellwalk.NotCertifiedError, "spike.off: Mesh_3 .*(vertices|facets) [0-9]+ and [0-9]+"):
            cellwalk.Environment.import_mesh(spike, mesher="mesh3", time_limit=20)

    def fake_mesher(self, script):
        """Plays the helpers by a script."""
        for name in ("cellwalk-tetgen", "cellwalk-mesh3"):
            path = self.folder / name
            path.write_text("#!/bin/sh\n" + script + "\n")
            path.chmod(0o700)
        os.environ["CELLWALK_LIBEXEC"] = str(self.folder)
        self.addCleanup(os.environ.pop, "CELLWALK_LIBEXEC", None)

    def test_meshers_that_misbehave(self):
        torus = os.environ.get("CELLWALK_TORUS")
        if torus is None:
            self.skipTest("a build without TetGen")
        self.fake_mesher("kill -SEGV $$")
        with self.assertRaisesRegex(cellwalk.NotCertifiedError, "TetGen crashed .signal 11, SIGSEGV."):
            cellwalk.Environment.import_mesh(torus)
        self.fake_mesher("sleep 1000")
        with self.assertRaisesRegex(cellwalk.NotCertifiedError, "Mesh_3 did not end within 0.2 s"):
            cellwalk.Environment.import_mesh(torus, mesher="mesh3", time_limit=0.2)

    def test_an_interruption_ends_the_mesher(self):
        torus = os.environ.get("CELLWALK_TORUS")
        if torus is None:
            self.skipTest("a build without TetGen")
        self.fake_mesher("sleep 1000")
        timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))  # that it runs shows that the lock is released
        timer.start()
        start = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            cellwalk.Environment.import_mesh(torus)
        self.assertLess(time.monotonic() - start, 20)
        with self.assertRaises(ChildProcessError):  # none is left
            os.waitpid(-1, os.WNOHANG)


if __name__ == "__main__":
    unittest.main()
