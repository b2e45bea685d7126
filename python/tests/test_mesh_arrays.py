# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cells to and from the arrays of meshio, VTK and PyVista. Needs Debian's python3-meshio and python3-vtk9: scripts/setup.sh."""

import pathlib
import tempfile
import unittest

import meshio
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

import cellwalk
from cellwalk import Environment

# A hexahedron, and on its sides a pyramid, a wedge and a tetrahedron.
POINTS = numpy.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2],
                      [1, 1, 3], [4, 0, 0], [4, 2, 0], [6, 0, 0], [4, 0, 1]], float)
BLOCKS = [("hexahedron", numpy.array([[0, 1, 2, 3, 4, 5, 6, 7]])), ("pyramid", numpy.array([[4, 5, 6, 7, 8]])),
          ("wedge", numpy.array([[1, 5, 9, 2, 6, 10]])), ("tetra", numpy.array([[9, 11, 10, 12]]))]
FLAT = [8, 0, 1, 2, 3, 4, 5, 6, 7, 5, 4, 5, 6, 7, 8, 6, 1, 9, 5, 2, 10, 6, 4, 9, 11, 10, 12]
TYPES = [12, 14, 13, 10]  # the triangles of VTK's wedges are the other way round
VOLUME = 8 + 4 / 3 + 4 + 2 / 3


def several():
    """Environments of all kinds of cells, some with solid cells and membranes."""
    yield Environment.from_arrays(POINTS, BLOCKS, walls=[[4, 5, 6, 7]], solid=[False, False, True, False])
    yield Environment.generate("hexes", cells=3, solid=0.3, seed=4)
    yield Environment.generate("tets", cells=3, jitter=0.1)
    yield Environment.generate("lattice", cells=3, seed=1)
    yield Environment.generate("room2d")
    yield Environment.generate("squares", cells=3, solid=0.3, seed=1)


def vtk_grid(arrays):
    """A grid as pyvista.UnstructuredGrid(cells, celltypes, points) makes it."""
    points = vtk.vtkPoints()
    at = numpy.zeros((len(arrays.points), 3))
    at[:, :arrays.points.shape[1]] = arrays.points
    points.SetData(numpy_to_vtk(at, deep=True))
    cells = vtk.vtkCellArray()
    cells.ImportLegacyFormat(numpy_to_vtkIdTypeArray(arrays.cells, deep=True))
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.SetCells(numpy_to_vtk(arrays.celltypes, deep=True, array_type=vtk.VTK_UNSIGNED_CHAR), cells)
    return grid


def sizes(grid):
    """The volumes of its cells, areas in the plane."""
    measure = vtk.vtkCellSizeFilter()
    measure.SetInputData(grid)
    measure.Update()
    found = measure.GetOutput().GetCellData()
    return vtk_to_numpy(found.GetArray("Volume")) + vtk_to_numpy(found.GetArray("Area"))


class Arrays(unittest.TestCase):
    def same(self, one, other):
        self.assertEqual(one.certificate, other.certificate)
        self.assertTrue(numpy.array_equal(one.points, other.points))
        for name in ("mean", "solid"):
            self.assertTrue(numpy.array_equal(one.cells()[name], other.cells()[name]), name)
        walls = lambda of: sorted(sorted(row) for row in of.facets()["points"][of.facets()["wall"]].tolist())
        self.assertEqual(walls(one), walls(other))

    def test_there_and_back(self):
        kinds = set()
        for environment in several():
            arrays = environment.to_arrays()
            kinds |= set(arrays.celltypes.tolist())
            self.assertTrue(numpy.array_equal(arrays.points, environment.points))
            self.assertEqual(len(arrays.celltypes), environment.cell_count)
            self.assertEqual(len(arrays.walls), environment.certificate["walls"])
            more = {"walls": arrays.walls, "solid": arrays.solid}
            self.same(environment, Environment.from_arrays(arrays.points, arrays.cells, arrays.celltypes, **more))
            self.same(environment, Environment.from_arrays(arrays.points, arrays.blocks, **more))
        self.assertGreaterEqual(kinds, {5, 9, 10, 12, 13, 14, 42})

    def test_arrays_are_the_callers(self):
        environment = Environment.generate("hexes", cells=2)
        arrays = environment.to_arrays()
        arrays.points[:] = 7
        self.assertEqual(environment.points.max(), 2)
        self.assertEqual((arrays.points.dtype, arrays.cells.dtype, arrays.celltypes.dtype, arrays.solid.dtype, arrays.walls.dtype),
                         (numpy.float64, numpy.int64, numpy.uint8, numpy.bool_, numpy.int64))
        self.assertEqual(repr(arrays), "<cellwalk.MeshArrays of 27 points, 8 cells, 24 walls>")
        with environment.editing():
            self.assertEqual(len(environment.to_arrays().celltypes), 8)

    def test_forms_of_cells(self):
        expected = Environment.from_arrays(POINTS, BLOCKS)
        self.assertAlmostEqual(expected.certificate["volume"], VOLUME)
        self.assertFalse(expected.report["changed"]["flipped"])
        names = {12: "hexahedron", 14: "pyramid", 13: "wedge", 10: "tetra"}
        of_vtk = {code: array if code != 13 else array[:, [0, 2, 1, 3, 5, 4]] for code, (_, array) in zip(TYPES, BLOCKS)}
        for cells in (dict(BLOCKS), tuple(BLOCKS), [list(block) for block in BLOCKS], [(t, a.tolist()) for t, a in BLOCKS],
                      meshio.Mesh(POINTS, BLOCKS).cells, of_vtk, {names[c]: BLOCKS[k][1].astype("u1") for k, c in enumerate(TYPES)}):
            self.same(expected, Environment.from_arrays(POINTS, cells))
        self.same(expected, Environment.from_arrays(POINTS.astype("f4"), FLAT, TYPES))
        self.same(expected, Environment.from_arrays(POINTS, numpy.array(FLAT, "i4"), celltypes=numpy.array(TYPES, "u1")))
        with self.assertRaisesRegex(cellwalk.NotCertifiedError, "cell 2"):  # VTK's order by the name of meshio
            Environment.from_arrays(POINTS, BLOCKS[:2] + [("wedge", of_vtk[13])])

    def test_cells_of_grids_and_prisms(self):
        cube = numpy.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
        self.assertEqual(Environment.from_arrays(cube, [8, *range(8)], [11]).certificate["volume"], 1)
        self.assertEqual(Environment.from_arrays(cube[:4, :2], {8: [range(4)]}).certificate["volume"], 1)
        for n, code in ((5, 15), (6, 16)):
            a = numpy.arange(n) * 2 * numpy.pi / n
            ring = numpy.round(1024 * numpy.stack([numpy.cos(a), numpy.sin(a), 0 * a], axis=1)) / 1024
            prism = Environment.from_arrays(numpy.concatenate([ring, ring + [0, 0, 1]]), [2 * n, *range(2 * n)], [code])
            self.assertEqual((prism.cell_count, prism.certificate["walls"]), (1, n + 2))

    def test_polyhedra_of_any_orientation(self):
        faces = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
        stream = [6] + [number for face in faces for number in [4, *face]]
        for cells, types in (([len(stream), *stream], [42]), ([("polyhedron8", [faces])], None), ({"polyhedron": [faces]}, None)):
            self.assertEqual(Environment.from_arrays(POINTS, cells, types).certificate["volume"], 8)

    def test_the_plane(self):
        square = numpy.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [4, 1, 0]], float)
        for points, cells in ((square[:, :2], [[0, 1, 2, 3], [1, 4, 2, -1]]), (square, [("quad", [[0, 1, 2, 3]]), ("triangle", [[1, 4, 2]])]),
                              (square, [("triangle", [[0, 1, 2], [0, 2, 3], [1, 4, 2]])])):
            environment = Environment.from_arrays(points, cells, walls=[[2, 1]])
            self.assertEqual((environment.dimension, environment.certificate["volume"]), (2, 6))
            self.assertEqual(environment.walk([[1, 1]], [[3, 1]]).time[0], 0.5)
        self.assertEqual(Environment.from_arrays(square, [[0, 1, 2]]).dimension, 2)
        square[3, 2] = 1
        with self.assertRaisesRegex(cellwalk.InputError, r"points\[3\] has z = 1, .*import_mesh\(\) fills it"):
            Environment.from_arrays(square, {"triangle": [[0, 1, 2]]})

    def test_what_is_left_out_is_reported(self):
        blocks = [("vertex", [[0]]), ("triangle", [[4, 5, 8], [0, 1, 2]]), *BLOCKS, ("line", [[0, 1]])]
        environment = Environment.from_arrays(POINTS, blocks)
        self.assertEqual(environment.report["read"]["notes"], ["1 of type line are no cells in 3D: left out",
                         "2 of type triangle are no cells in 3D: left out", "1 of type vertex are no cells in 3D: left out"])
        self.same(environment, Environment.from_arrays(POINTS, BLOCKS))

    def test_walls_and_solid_cells(self):
        for walls in ([[4, 5, 6, 7]], [[7, 4, 6, 5, -1]], [("quad", [[6, 5, 4, 7]])], numpy.array([[4, 5, 6, 7]], "u1")):
            environment = Environment.from_arrays(POINTS, BLOCKS, walls=walls)
            self.assertEqual(environment.walk([[1, 1, 1]], [[1, 1, 2.5]]).time[0], 2 / 3)
        self.assertEqual(Environment.from_arrays(POINTS, BLOCKS).walk([[1, 1, 1]], [[1, 1, 2.5]]).time[0], 1)
        solid = Environment.from_arrays(POINTS, BLOCKS, solid=numpy.array([0, 1, 0, 0], bool))
        self.assertEqual(solid.locate([[1, 1, 2.5]]).status[0], cellwalk.Place.SOLID)

    def test_refusals(self):
        make = Environment.from_arrays
        for error, message, call in (
            (ValueError, r"cells\['tetra'\] has shape \(1, 3\): \(N, 4\) is needed", lambda: make(POINTS, {"tetra": [[0, 1, 2]]})),
            (IndexError, r"cells\['tetra'\]\[0, 3\] is 13: there are 13 points", lambda: make(POINTS, {"tetra": [[0, 1, 2, 13]]})),
            (ValueError, "cells of type tetra10 are not taken: triangle .5., .*polyhedron .42. are", lambda: make(POINTS, {"tetra10": [range(10)]})),
            (ValueError, "cells of type 24 are not taken", lambda: make(POINTS, {24: [range(10)]})),
            (ValueError, "cells: cell 1, of type tetra, is missing: celltypes has more cells", lambda: make(POINTS, [4, 0, 1, 2, 4], [10, 10])),
            (ValueError, "cells goes on after cell 0, the last of celltypes", lambda: make(POINTS, [4, 0, 1, 2, 4, 4], [10])),
            (ValueError, "cells: cell 0, of type tetra, goes beyond their end", lambda: make(POINTS, [4, 0, 1], [10])),
            (ValueError, "cells: cell 0, of type tetra, has 3 points, not 4", lambda: make(POINTS, [3, 0, 1, 2], [10])),
            (ValueError, "cells: cell 0, of type polyhedron, needs the number of its faces", lambda: make(POINTS, [4, 0, 1, 2, 4], [42])),
            (IndexError, "cells: cell 0 names point 99: there are 13 points", lambda: make(POINTS, [4, 0, 1, 2, 99], [10])),
            (ValueError, r"cells has shape \(1, 4\): \(N,\) is needed", lambda: make(POINTS, [[0, 1, 2, 4]], [10])),
            (TypeError, "celltypes must be integers, and is float64", lambda: make(POINTS, [4, 0, 1, 2, 4], [10.0])),
            (TypeError, "each block must be a pair of a type and an array", lambda: make(POINTS, [BLOCKS[0], 7])),
            (ValueError, r"cells has shape \(8,\): \(M, 4\) for tetrahedra.* or with celltypes \(N,\) is needed", lambda: make(POINTS, range(8))),
            (ValueError, r"wall 1 of walls: no cell has the facet \(0 1 8\)", lambda: make(POINTS, BLOCKS, walls=[[4, 5, 8], [0, 1, 8]])),
            (ValueError, r"solid has shape \(3,\): \(4,\), one for each of the cells, is needed", lambda: make(POINTS, BLOCKS, solid=[True] * 3)),
            (TypeError, "solid must be a boolean array, and is int64", lambda: make(POINTS, BLOCKS, solid=[0, 1, 0, 0])),
            (cellwalk.InputError, "there are no cells", lambda: make(POINTS, numpy.zeros((0, 4), int))),
            (cellwalk.NotCertifiedError, "cell 0", lambda: make(POINTS, [[0, 1, 2, 3]])),
            (TypeError, "No constructor", lambda: Environment(POINTS, BLOCKS)),
        ):
            with self.assertRaisesRegex(error, message):
                call()


class Meshio(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_meshes_of_meshio(self):
        for environment in several():
            arrays = environment.to_arrays()
            mesh = meshio.Mesh(arrays.points, arrays.blocks)
            again = Environment.from_arrays(mesh.points, mesh.cells, walls=arrays.walls, solid=arrays.solid)
            self.assertEqual(again.certificate, environment.certificate)

    def test_files_of_meshio(self):
        expected = Environment.from_arrays(POINTS, BLOCKS).certificate
        for name, file_format in (("a.vtu", "vtu"), ("a.vtk", "vtk"), ("a.msh", "gmsh22"), ("a.mesh", "medit")):
            meshio.Mesh(POINTS, BLOCKS).write(self.folder / name, file_format)
            mesh = meshio.read(self.folder / name, file_format.rstrip("2"))
            self.assertEqual(Environment.from_arrays(mesh.points, mesh.cells).certificate, expected, name)
            self.assertEqual(Environment.load(self.folder / name).certificate, expected, name)


class Vtk(unittest.TestCase):
    def test_grids_as_pyvista_makes_them(self):
        for environment in several():
            arrays = environment.to_arrays()
            grid = vtk_grid(arrays)
            self.assertEqual(grid.GetNumberOfCells(), environment.cell_count)
            self.assertAlmostEqual(sizes(grid).sum(), environment.certificate["volume"], 9)
            if 42 in arrays.celltypes:
                continue  # VTK's cells have no faces
            flat, types = vtk.vtkIdTypeArray(), vtk_to_numpy(grid.GetCellTypesArray())
            grid.GetCells().ExportLegacyFormat(flat)
            again = Environment.from_arrays(vtk_to_numpy(grid.GetPoints().GetData()), vtk_to_numpy(flat), types,
                                            walls=arrays.walls, solid=arrays.solid)
            self.assertEqual(again.certificate, environment.certificate)

    def test_saved_for_viewers(self):
        with tempfile.TemporaryDirectory() as folder:
            for environment in several():
                environment.save(pathlib.Path(folder) / "z.vtu")
                reader = vtk.vtkXMLUnstructuredGridReader()
                reader.SetFileName(str(pathlib.Path(folder) / "z.vtu"))
                reader.Update()
                grid, arrays = reader.GetOutput(), environment.to_arrays()
                data = {name: vtk_to_numpy(grid.GetCellData().GetArray(name)) for name in ("cell", "solid", "wall")}
                n = environment.cell_count
                self.assertEqual(data["wall"].tolist(), [0] * n + [1] * (grid.GetNumberOfCells() - n))
                self.assertEqual(data["cell"][:n].tolist(), list(range(n)))
                self.assertTrue((data["solid"][:n] == arrays.solid).all())
                self.assertAlmostEqual(sizes(grid)[:n].sum(), environment.certificate["volume"], 9)
                facets = environment.facets()
                free = ~numpy.append(arrays.solid, True)  # -1, the outside, is not free
                at_free = facets["wall"] & (free[facets["cell"]] | free[facets["neighbour"]])
                self.assertEqual(data["wall"].sum(), numpy.count_nonzero(at_free))
                self.assertEqual(Environment.load(pathlib.Path(folder) / "z.vtu").cell_count, n)

    def test_names_of_files(self):
        environment = Environment.generate("squares", cells=2)
        with tempfile.TemporaryDirectory() as folder:
            for name in ("z", "z.vtk", "z.msh", "z.ovm.gz", "z.txt"):
                path = pathlib.Path(folder) / name
                with self.assertRaisesRegex(cellwalk.UsageError, rf"{name}: environments are saved as OpenVolumeMesh \(\*\.ovm\), compiled .* or for viewers as VTU"):
                    environment.save(path)
                self.assertFalse(path.exists())
            environment.save(bytes(pathlib.Path(folder) / "z.ovm"))
            self.assertEqual(Environment.load(pathlib.Path(folder) / "z.ovm").cell_count, 4)


if __name__ == "__main__":
    unittest.main()
