#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the scenes of this experiment and records their motions.

usage: make_scenes.py BUILD_DIR OUT [--quick] [--data DIR] [--finer 2,4] [--only REGEX]

OUT receives bodies and surfaces (.off), scenes (.json), environments (.ovm), recorded motions (.trace) and the list
scenes.json. --data: a folder of public meshes; adds the scenes in the aneurysm. --finer: also cells so many times shorter in the
same walls. What exists already is kept. Scenes that need TetGen are left out where the build has none.
"""

import argparse
import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "scripts"))
from make_torus import torus  # noqa: E402

# A path through the default vessel that a catheter of radius 0 can follow: that of data/vessel.json.
VESSEL_PATH = [[0, 0, 0.2], [-1.56, 1.07, 11.49], [1.63, 4.5, 16.5]]
VESSEL = {"generate": "vessel"}
# The trunk of a small vessel, for the quick form.
SMALL_VESSEL = {"generate": "vessel", "generations": 1, "cell_size": 0.4}
SMALL_PATH = [[0, 0, 0.2], [2, 1, 6]]
# A long trunk that bends, and forks twice, for a catheter of twice the length.
LONG_VESSEL = {"generate": "vessel", "length": 16, "generations": 2, "curvature": 1}
# The share of the moves of a catheter pressed into a bend that walls block, at least.
PRESSED = 0.1
GRAVITY = [0, 0, -9.81]
# From one end of the artery of the aneurysm to another.
ARTERY = [[-20.5, -16.5, -14.08], [9.39, 0.48, 5.47]]


def rounded(points):
    """To 12 digits, so that every machine writes the same."""
    return [tuple(round(c, 12) + 0.0 for c in p) for p in points]


def geodesic_sphere(frequency, radius):
    """An icosahedron whose edges are divided `frequency` times, on a sphere: 10 f^2 + 2 vertices."""
    g = (1 + math.sqrt(5)) / 2
    corners = [(-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g), (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1),
               (-g, 0, -1), (-g, 0, 1)]
    triangles = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
                 (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    number, points, faces = {}, [], []

    def at(triangle, i, j):
        # Named by the weights of the corners, so that triangles share the points of their edges.
        weights = {triangle[0]: frequency - i - j, triangle[1]: i, triangle[2]: j}
        key = tuple(sorted((c, w) for c, w in weights.items() if w))
        if key not in number:
            number[key] = len(points)
            p = [sum(w * corners[c][k] for c, w in key) for k in range(3)]
            length = math.sqrt(sum(c * c for c in p))
            points.append(tuple(radius * c / length for c in p))
        return number[key]

    for t in triangles:
        for i in range(frequency):
            for j in range(frequency - i):
                faces.append((at(t, i, j), at(t, i + 1, j), at(t, i, j + 1)))
                if i + j < frequency - 1:
                    faces.append((at(t, i + 1, j), at(t, i + 1, j + 1), at(t, i, j + 1)))
    return points, faces


def box_surface(low, high, parts):
    """The surface of a box, its sides in parts by parts squares of two triangles each."""
    number, points, faces = {}, [], []

    def at(*key):
        if key not in number:
            number[key] = len(points)
            points.append(tuple(low[k] + (high[k] - low[k]) * key[k] / parts for k in range(3)))
        return number[key]

    for axis in range(3):
        u, v = (axis + 1) % 3, (axis + 2) % 3
        for side in (0, parts):
            for i in range(parts):
                for j in range(parts):
                    corners = []
                    for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                        key = [0, 0, 0]
                        key[axis], key[u], key[v] = side, a, b
                        corners.append(at(*key))
                    if side == 0:
                        corners.reverse()
                    faces += [tuple(corners[:3]), (corners[0], corners[2], corners[3])]
    return points, faces


def moved(shape, by):
    points, faces = shape
    return [tuple(c + d for c, d in zip(p, by)) for p in points], faces


def write_off(path, shape):
    points, faces = shape
    lines = ["OFF", f"{len(points)} {len(faces)} 0"]
    lines += [" ".join(f"{c:.12g}" for c in p) for p in rounded(points)]
    lines += [" ".join(map(str, (len(f), *f))) for f in faces]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def quiet(command):
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


class Maker:
    def __init__(self, options):
        self.options = options
        self.out = Path(options.out)
        self.out.mkdir(parents=True, exist_ok=True)
        build = Path(options.build).resolve()
        self.cellwalk = build / "cellwalk"
        self.finer_cells = build / "experiments/06_real_scenes/finer_cells"
        self.list = []

    def has_tetgen(self):
        text = subprocess.run([self.cellwalk, "--version", "--json"], check=True, capture_output=True, text=True).stdout
        return json.loads(text)["parts"]["tetgen"]["present"]

    def file(self, name, make):
        """The name of a file, which `make` writes unless it is there."""
        path = self.out / name
        if not path.exists():
            part = self.out / f"part_{name}"
            make(part)
            part.rename(path)
        return name

    def surface(self, name, shape):
        return self.file(name, lambda path: write_off(path, shape()))

    def imported(self, name, surface, obstacles=()):
        def make(path):
            extra = [x for o in obstacles for x in ("--obstacle", self.out / o)]
            # A surface elsewhere is named by its whole path.
            quiet([self.cellwalk, "import", self.out / surface, *extra, "--quality", "1.5", "-o", path])
        return self.file(name, make)

    def add(self, name, scene, first_step=0, least_blocked=0.0):
        """Records a scene and lists it; `least_blocked`: the share of its moves without which it is refused."""
        if not re.search(self.options.only, name):
            return
        text = json.dumps({"title": name, "output": {"frame_every": 0, "motion_every": 0}, **scene}, indent=1)
        source = self.file(f"{name}.json", lambda path: path.write_text(text, encoding="utf-8"))

        def record(path):
            folder = self.out / f"run_{name}"
            quiet([self.cellwalk, "run", self.out / source, "-o", folder, "--record", path])
            shutil.rmtree(folder)
        trace = self.file(f"{name}.trace", record)
        self.list.append({"name": name, "scene": source, "trace": trace, "first_step": first_step,
                          "least_blocked": least_blocked})
        self.write_list()
        print(f"{name}: {trace}", flush=True)

    def add_finer(self, name, environment, most=math.inf):
        """The same motion among finer cells in the same walls, which scenes in one environment share; `most`: times finer."""
        entry = next((e for e in self.list if e["name"] == name), None)
        if entry is None or not self.finer_cells.exists():
            return
        for times in (n for n in self.options.finer if float(n) <= most):
            cells = self.file(f"{environment}_finer_{times}.ovm",
                              lambda path: quiet([self.finer_cells, self.out / "scenes.json", name, str(times), path]))
            self.list.append({**entry, "name": f"{name}_finer_{times}", "environment": cells})
            self.write_list()
            print(f"{name}_finer_{times}: {cells}", flush=True)

    def write_list(self):
        (self.out / "scenes.json").write_text(json.dumps(self.list, indent=1) + "\n", encoding="utf-8")


def catheter(path, spacing, particles, advance=None):
    result = {"path": path, "spacing": spacing, "particles": particles, "stiffness": 0.8}
    return {**result, "advance": advance} if advance else result


def pressed(path, spacing, particles, twist, degrees=30, **more):
    """A catheter that is naturally curved all along, and turned while it is pushed: so it presses on the walls of each bend."""
    rod = {**catheter(path, spacing, particles, spacing / 4), "steering": "none", "twist": twist, **more}
    return {**rod, "tip": {"length": round((particles - 2) * spacing, 9), "degrees": degrees}}


def soft(file, **more):
    return {"file": file, "material": {"mode": "quadratic", "stiffness": 0.4, "deformation": 0.7}, **more}


def room(maker, frequency, around):
    """A room with three balls and two tori as obstacles."""
    walls = maker.surface("room.off", lambda: box_surface((0, 0, 0), (10, 10, 7), 8))
    ball = lambda: geodesic_sphere(frequency, 1.3)  # noqa: E731
    ring = lambda: torus(around, around // 2, 1.4, 0.5)  # noqa: E731
    places = [("ball_1.off", ball, (2.1, 2.3, 2.2)), ("ball_2.off", ball, (7.6, 2.4, 2.9)), ("ball_3.off", ball, (5.2, 7.9, 1.7)),
              ("ring_1.off", ring, (2.4, 6.9, 3.1)), ("ring_2.off", ring, (7.7, 6.2, 4.4))]
    names = [maker.surface(name, lambda shape=shape, by=by: moved(shape(), by)) for name, shape, by in places]
    return maker.imported("room.ovm", walls, names)


def full(maker):
    sphere = maker.surface("sphere.off", lambda: geodesic_sphere(5, 0.25))
    maker.add("S1a_vessel", {"environment": VESSEL, "catheter": catheter(VESSEL_PATH, 0.2, 110), "steps": 240}, 80)
    for name, radius in (("T1_thick_05", 0.05), ("T2_thick_15", 0.15), ("T3_thick_30", 0.3)):
        maker.add(name, {"environment": VESSEL, "catheter": {**catheter(VESSEL_PATH, 0.2, 110), "radius": radius}, "steps": 240}, 80)
    maker.add("S1b_vessel_fine", {"environment": VESSEL, "catheter": catheter(VESSEL_PATH, 0.05, 440), "steps": 960}, 320)
    maker.add("R1_pressed", {"environment": LONG_VESSEL, "catheter": pressed([[0, 0, 0.2], [0, 0, 4]], 0.2, 200, 0.07), "steps": 800},
              560, PRESSED)
    maker.add_finer("R1_pressed", "long_vessel")
    maker.add("S3_spheres", {"environment": VESSEL, "bodies": [soft(sphere, count=50, seed=3, speed=1)], "restitution": 0.6,
                             "time_step": 0.01, "steps": 180}, 60, 0.01)
    for name in ("S1a_vessel", "S1b_vessel_fine", "S3_spheres"):
        maker.add_finer(name, "vessel")
    if maker.has_tetgen():
        ring = maker.surface("soft_ring.off", lambda: torus(80, 40, 1, 0.35))
        body = soft(ring, position=[5, 4.6, 5.6], velocity=[0.7, 0.4, -1], spin=[0.4, 0.7, 0.2])
        rooms = room(maker, 16, 64)
        maker.add("S4_soft_ring", {"environment": rooms, "bodies": [body], "gravity": GRAVITY, "restitution": 0.5, "friction": 0.1,
                                   "time_step": 0.005, "steps": 400})
        maker.add_finer("S4_soft_ring", "room")
        rigid = maker.surface("rigid_ring.off", lambda: torus(40, 16, 2.2, 0.5))
        maker.add("S5_rigid_ring", {"environment": rooms, "bodies": [{"file": rigid, "position": [5, 4.6, 5.9], "velocity": [0.7, 0.4, -1],
                                                                      "spin": [0.4, 0.7, 0.2]}],
                                    "gravity": GRAVITY, "restitution": 0.5, "friction": 0.1, "time_step": 0.005, "steps": 400})
        maker.add_finer("S5_rigid_ring", "room")
    maker.add("S6_at_rest", {"environment": {"generate": "hexes", "cells": [10, 10, 4], "rotated": 1},
                             "bodies": [soft("sphere.off", scale=2, count=30, seed=5)], "gravity": GRAVITY, "restitution": 0.2,
                             "friction": 0.6, "time_step": 0.01, "steps": 800}, 700)
    maker.add_finer("S6_at_rest", "grid")
    maker.add("S7_many", {"environment": {"generate": "hexes", "cells": [100, 100, 100], "solid": 0.1},
                          "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 10000, "seed": 7, "speed": 2}],
                          "time_step": 0.01, "steps": 30})
    maker.add_finer("S7_many", "large_grid", most=2)
    if maker.options.data and maker.has_tetgen():
        aneurysm(maker, sphere)


def aneurysm(maker, sphere):
    """Scenes in a public mesh of an aneurysm."""
    surface = Path(maker.options.data) / "surface/aneurysm3D_1.off"
    cells = maker.imported("aneurysm.ovm", surface)
    rod = {**catheter(ARTERY, 0.6, 70), "find_route": True}
    maker.add("S2_aneurysm", {"environment": cells, "catheter": rod, "steps": 140}, 50)
    maker.add("S3_aneurysm_spheres", {"environment": cells, "bodies": [soft(sphere, scale=2, count=50, seed=3, speed=2)],
                                      "restitution": 0.6, "time_step": 0.01, "steps": 180}, 60)
    for name, radius in (("T4_aneurysm_05", 0.1), ("T5_aneurysm_15", 0.3), ("T6_aneurysm_30", 0.6)):
        maker.add(name, {"environment": cells, "catheter": {**rod, "radius": radius}, "steps": 140}, 50)
    rod = pressed(ARTERY, 0.7, 150, 0.025, find_route=True)
    maker.add("R2_pressed_aneurysm", {"environment": cells, "catheter": rod, "steps": 500}, 300, PRESSED)
    for name in ("R2_pressed_aneurysm", "S2_aneurysm", "S3_aneurysm_spheres"):
        maker.add_finer(name, "aneurysm")


def quick(maker):
    sphere = maker.surface("sphere.off", lambda: geodesic_sphere(2, 0.3))
    maker.add("S1a_vessel", {"environment": SMALL_VESSEL, "catheter": catheter(SMALL_PATH, 0.2, 30), "steps": 60}, 10)
    maker.add("T1_thick_05", {"environment": SMALL_VESSEL, "catheter": {**catheter(SMALL_PATH, 0.2, 30), "radius": 0.05}, "steps": 60}, 10)
    maker.add("S1b_vessel_fine", {"environment": SMALL_VESSEL, "catheter": catheter(SMALL_PATH, 0.05, 100), "steps": 160}, 60)
    maker.add("R1_pressed", {"environment": SMALL_VESSEL, "catheter": pressed(SMALL_PATH, 0.2, 60, 0.5, 90), "steps": 240}, 160, PRESSED)
    maker.add("S3_spheres", {"environment": SMALL_VESSEL, "bodies": [soft(sphere, count=6, seed=3, speed=1)], "restitution": 0.6,
                             "time_step": 0.02, "steps": 60})
    solid = {"generate": "hexes", "cells": [6, 6, 4], "solid": 0.06, "seed": 3}
    ring = maker.surface("ring.off", lambda: torus(24, 12, 0.8, 0.25))
    thrown = {"gravity": GRAVITY, "restitution": 0.5, "friction": 0.1, "time_step": 0.01, "steps": 80}
    maker.add("S4_soft_ring", {"environment": {**solid, "sheared": 1}, "bodies": [soft(ring, count=1, seed=2, speed=1)], **thrown})
    maker.add("S5_rigid_ring", {"environment": solid, "bodies": [{"file": ring, "count": 1, "seed": 3, "speed": 1}], **thrown})
    maker.add("S6_at_rest", {"environment": {"generate": "hexes", "cells": [4, 4, 3], "rotated": 1},
                             "bodies": [soft(sphere, scale=2, count=4, seed=5)], "gravity": GRAVITY, "restitution": 0.2,
                             "friction": 0.6, "time_step": 0.02, "steps": 200}, 150)
    maker.add("S7_many", {"environment": {"generate": "hexes", "cells": [16, 16, 16], "solid": 0.1},
                          "bodies": [{"shape": "hexahedron", "side": 0.3, "count": 200, "seed": 7, "speed": 2}],
                          "time_step": 0.01, "steps": 20})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("out")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--data")
    parser.add_argument("--finer", type=lambda text: text.split(",") if text else [], default=["2", "4"])
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    (quick if options.quick else full)(Maker(options))


if __name__ == "__main__":
    main()
