#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Small meshes with known faults, to test the audit without public data.

usage: make_faulty.py DIR     writes meshes and their sources.json into DIR
"""

import hashlib
import json
import sys
from pathlib import Path

CUBE = [(x, y, z) for z in (0, 2) for y in (0, 2) for x in (0, 2)]
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
CUBE_TRIANGLES = [t for a, b, c, d in SIDES for t in ((a, b, c), (a, c, d))]
TETRAHEDRA = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]  # of the cube


def shifted(points, by):
    return [tuple(x + d for x, d in zip(p, by)) for p in points]


def off(points, triangles):
    lines = [f"OFF\n{len(points)} {len(triangles)} 0", *(" ".join(map(str, p)) for p in points), *("3 " + " ".join(map(str, t)) for t in triangles)]
    return "\n".join(lines) + "\n"


def two(by):
    return off(CUBE + shifted(CUBE, by), CUBE_TRIANGLES + [tuple(v + 8 for v in t) for t in CUBE_TRIANGLES])


def gmsh(points, cells, kind):
    nodes = [f"{i + 1} {x} {y} {z}" for i, (x, y, z) in enumerate(points)]
    elements = [f"{i + 1} {kind} 2 0 1 " + " ".join(str(v + 1) for v in c) for i, c in enumerate(cells)]
    return "\n".join(["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)), *nodes, "$EndNodes",
                      "$Elements", str(len(elements)), *elements, "$EndElements"]) + "\n"


def surfaces():
    yield "whole.off", off(CUBE, CUBE_TRIANGLES)
    yield "open.off", off(CUBE, CUBE_TRIANGLES[2:])
    yield "doubled.off", off(CUBE, CUBE_TRIANGLES + CUBE_TRIANGLES[:1])
    yield "turned.off", off(CUBE, [CUBE_TRIANGLES[0][::-1], *CUBE_TRIANGLES[1:]])
    yield "flat.off", off([*CUBE, (1, 0, 0)], [*CUBE_TRIANGLES, (0, 8, 1)])
    yield "crossing.off", two((1, 1, 1))
    yield "overlapping.off", two((1, 0, 0))
    yield "at_an_edge.off", two((2, 2, 0))
    # Two facets at a common edge, one folded onto the other.
    yield "folded.off", off([(0, 0, 0), (2, 0, 0), (0, 2, 0), (1, 1, 0), (1, 0, 2)], [(0, 1, 2), (1, 0, 3), (0, 2, 4), (1, 4, 2), (0, 4, 3), (1, 3, 4)])


def meshes():
    yield "tetrahedra.msh", gmsh(CUBE, TETRAHEDRA, 4)
    yield "inverted.msh", gmsh(CUBE, [(0, 3, 1, 7), *TETRAHEDRA[1:]], 4)
    yield "flat.msh", gmsh([*CUBE, (1, 1, 0)], [*TETRAHEDRA, (0, 8, 3, 1)], 4)
    yield "twisted.msh", gmsh([*CUBE[:7], (2, 2, 3)], [(0, 1, 3, 2, 4, 5, 7, 6)], 5)
    yield "three_at_a_facet.msh", gmsh([*CUBE, (1, 3, 1)], [*TETRAHEDRA, (3, 0, 7, 8)], 4)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    sources = []

    def add(group, name, text, **more):
        (folder / name).write_text(text)
        sources.append({"name": name, "group": group, "path": name, "sha256": hashlib.sha256(text.encode()).hexdigest(), **more})

    for name, text in surfaces():
        add("surfaces", name, text)
    for name, text in meshes():
        add("cells", name, text)
    # In the open cube, doubled and turned: through the open side, and back through a wall.
    line = [(-2, 2, 3), (-2, 2, 2), (-2, 2, 2), (-0.5, 2, 2), (-2, 2, 1), (-2, 2, -1), (-2, 2, -3), (3, 2, -3), (3, 2, 2), (-2, 2, 2.5)]
    states = "T= 0\n  X= 0 0 0 1 0 0\nT= 1\n  X= " + " ".join(str(x) for p in line for x in p) + "\n"
    add("end states", "open.scn.reference", states, vessel="open.off", turns=[["z", 90]], scale=2, radius=1.5, contact_distance=0.5)
    nodes = f"1 {len(CUBE)}\n" + "".join(f"{i + 1} {x}.0 {y}.0 {z}.0\n" for i, (x, y, z) in enumerate(CUBE))
    (folder / "node_cube.dat").write_text(nodes)
    add("cells", "elem_cube.dat", f"1 {len(TETRAHEDRA)}\n" + "".join(f"{i + 1} " + " ".join(str(v + 1) for v in t) + " 1\n" for i, t in enumerate(TETRAHEDRA)),
        nodes={"path": "node_cube.dat", "sha256": hashlib.sha256(nodes.encode()).hexdigest()})
    (folder / "sources.json").write_text(json.dumps(sources))


if __name__ == "__main__":
    main()
