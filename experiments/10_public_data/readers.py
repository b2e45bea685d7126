# SPDX-License-Identifier: LGPL-3.0-or-later
"""Reads what is judged: surfaces (OBJ, STL, OFF) by some lines of their own, meshes of cells by meshio, those of MMC as text."""

import gzip
from pathlib import Path

import numpy


def read_bytes(path):
    data = Path(path).read_bytes()
    return gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data


def joined(points, triangles):
    """Equal points as one, numbered as they come; what was left out of polygons is no longer seen."""
    points = numpy.asarray(points, dtype=float) + 0.0
    _, first, inverse = numpy.unique(points, axis=0, return_index=True, return_inverse=True)
    rank = numpy.argsort(numpy.argsort(first))
    return points[numpy.sort(first)], rank[inverse.reshape(-1)][numpy.asarray(triangles, dtype=numpy.int64).reshape(-1, 3)]


def fans(polygons):
    return [(p[0], p[i], p[i + 1]) for p in polygons for i in range(1, len(p) - 1)]


def read_obj(data):
    points, polygons = [], []
    for line in data.decode("utf-8", "replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(x) for x in words[1:4]])
        elif words[:1] == ["f"]:
            numbers = [int(w.split("/")[0]) for w in words[1:]]
            polygons.append([n - 1 if n > 0 else len(points) + n for n in numbers])
    return joined(points, fans(polygons))


def read_stl(data):
    if data[:5] == b"solid" and b"facet" in data[:1000]:
        points = [[float(x) for x in line.split()[1:4]] for line in data.decode().splitlines() if line.split()[:1] == ["vertex"]]
    else:
        count = int.from_bytes(data[80:84], "little")
        record = numpy.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
        points = numpy.frombuffer(data, record, count, 84)["corners"].reshape(-1, 3).astype(float)
    return joined(points, numpy.arange(len(points)).reshape(-1, 3))


def read_off(data):
    words = " ".join(line.partition("#")[0] for line in data.decode().splitlines()).split()
    count, faces, at = int(words[1]), int(words[2]), 4
    points = numpy.array(words[at:at + 3 * count], dtype=float).reshape(-1, 3)
    at += 3 * count
    polygons = []
    for _ in range(faces):
        size = int(words[at])
        polygons.append([int(w) for w in words[at + 1:at + 1 + size]])
        at += 1 + size
    return joined(points, fans(polygons))


SURFACES = {".obj": read_obj, ".stl": read_stl, ".off": read_off}


def read_surface(path):
    """The points, each once, and the triangles: polygons as the fans of their first corners."""
    return SURFACES[Path(str(path).removesuffix(".gz")).suffix.lower()](read_bytes(path))


def read_mmc(nodes, elements):
    """The nodes and the tetrahedra of a mesh of MMC: a line of two numbers, then a number, and three coordinates or four nodes and more, a line."""
    points = numpy.loadtxt(nodes, skiprows=1)[:, 1:4]
    return points, {"tetra": numpy.loadtxt(elements, skiprows=1).astype(numpy.int64)[:, 1:5] - 1}


GMSH = {4: "tetra", 5: "hexahedron", 6: "wedge", 7: "pyramid"}


def read_gmsh(lines):
    """Gmsh's versions 1, which meshio does not read, and 2, as text."""
    is_first = lines[0].strip() == "$NOD"
    start = lines.index("$NOD" if is_first else "$Nodes")
    nodes = [line.split() for line in lines[start + 2:start + 2 + int(lines[start + 1])]]
    number = {words[0]: i for i, words in enumerate(nodes)}
    start = lines.index("$ELM" if is_first else "$Elements")
    cells = {}
    for words in (line.split() for line in lines[start + 2:start + 2 + int(lines[start + 1])]):
        kind = GMSH.get(int(words[1]))
        if kind:
            corners = words[5:] if is_first else words[3 + int(words[2]):]
            cells.setdefault(kind, []).append([number[w] for w in corners])
    return numpy.array([words[1:4] for words in nodes], dtype=float), {k: numpy.array(rows) for k, rows in cells.items()}


def read_cells(path):
    """The points, and the corners of the cells by kind, in the order of VTK."""
    head = Path(path).read_bytes()[:40].split()
    if head[:1] == [b"$NOD"] or head[:2] == [b"$MeshFormat", b"2.2"]:
        return read_gmsh([line.strip() for line in Path(path).read_text().splitlines()])
    import meshio

    mesh = meshio.read(path)
    cells = {}
    for block in mesh.cells:
        if block.type in FACETS:
            cells.setdefault(block.type, []).append(numpy.asarray(block.data, dtype=numpy.int64))
    points = numpy.asarray(mesh.points, dtype=float)
    return points, {kind: numpy.concatenate(blocks) for kind, blocks in cells.items()}


# The corners of the facets of each kind of cell, seen from outside in counterclockwise order.
FACETS = {
    "tetra": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
    "wedge": [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
    "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
}
