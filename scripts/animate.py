#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes the animation of README, docs/images/aorta.webp, from an import and a run of a scene: a surface with faults is repaired and filled with cells,
a catheter is pushed in, and the walls beat.

usage: animate.py data/aorta.json docs/images/aorta.webp [--program build/release/cellwalk] [--jobs N] [--frames DIR] [--every N]

The scene imports a surface (.off), has a catheter with a radius, and walls with a pulsation. All that is drawn, and all numbers in captions, come from files that the
program writes: the report of `import` and its environment, the recording and the tables of `run`. --frames keeps the frames as PNG files; --every draws
each N-th frame only, to look at. Needs the packages python3-pil, python3-numpy and fonts-dejavu-core (scripts/setup.sh --for peers).
"""

import argparse
import csv
import gzip
import json
import multiprocessing
import os
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from types import SimpleNamespace

import numpy
from PIL import Image, ImageDraw, ImageFont

from render import Camera, Drawing, Material, frame_of, render

FONTS = Path("/usr/share/fonts/truetype/dejavu")
WIDTH, HEIGHT = 640, 500
PICTURE = 396             # pixels of the width; beside it is the text
TEXT_TOP, FADE = 24, 28
SECONDS_A_FRAME, SECONDS_OF_START, SECONDS_AT_END = 0.08, 0.9, 1.0
REPAIR, FILL, PUSH, NEAR, BEAT = 14, 24, 42, 8, 26  # frames
CLOSE_UP = 0.46           # of the height of the whole
CONTACT_STEPS = 10        # whose contacts are shown
QUALITY = 80
BACKGROUND_TOP, BACKGROUND_BOTTOM = (1.0, 1.0, 1.0), (0.86, 0.89, 0.93)

# Those of the program's pictures (src/drawing/bodies.cpp, src/cli/import_picture.cpp).
WALL, CATHETER, CONTACT = (0.80, 0.37, 0.33), (0.10, 0.27, 0.53), (0.96, 0.58, 0.08)
GIVEN, OPEN_EDGE, CAP = (0.86, 0.88, 0.91), (0.86, 0.08, 0.10), (0.10, 0.38, 0.80)
TURNED, LINE = (0.55, 0.22, 0.70), (0.25, 0.29, 0.36)
CELLS = ((0.62, 0.80, 0.88), (0.36, 0.63, 0.78), (0.16, 0.42, 0.62))
OUTWARD, INWARD = (0.90, 0.16, 0.20), (0.28, 0.42, 0.78)  # of walls that have moved
WALL_OPACITY, WALL_RIM = 0.10, 0.60
TEXT, QUIET, PALE = "#1e293b", "#475569", "#a3afc0"


def read_off(path):
    words = path.read_text().split()
    n, m = int(words[1]), int(words[2])
    points = numpy.array(words[4:4 + 3 * n], float).reshape(-1, 3)
    return points, numpy.array(words[4 + 3 * n:4 + 3 * n + 4 * m], int).reshape(-1, 4)[:, 1:]


def read_cells(path):
    """Points, tetrahedra and the triangles of each group of facets, of an .ovm file."""
    text = path.read_text()
    tables = {}
    for name in ("Vertices", "Edges", "Faces", "Polyhedra"):
        count, rest = re.search(rf"^{name}\n(\d+)\n((?:[-\d].*\n)*)", text, re.MULTILINE).groups()
        tables[name] = numpy.array(rest.split(), float).reshape(int(count), -1)
    ends = tables["Edges"].astype(int)
    halves = tables["Faces"].astype(int)[:, 1:]
    loops = ends[halves >> 1, halves & 1]
    corners = loops[tables["Polyhedra"].astype(int)[:, 1:] >> 1].reshape(len(tables["Polyhedra"]), -1)
    corners.sort(axis=1)
    first = numpy.concatenate([numpy.ones((len(corners), 1), bool), corners[:, 1:] != corners[:, :-1]], axis=1)
    return tables["Vertices"], corners[first].reshape(-1, 4)


def read_motion(path):
    """The recording of a run (docs/formats.md): walls at the start, and the places of all points in each frame."""
    data = gzip.decompress(path.read_bytes())
    size = int.from_bytes(data[8:12], "little")
    head, at = json.loads(data[12:12 + size]), 12 + size

    def take(kind, count):
        nonlocal at
        part = numpy.frombuffer(data, kind, count, at)
        at += part.nbytes
        return part

    points = take("<f8", 3 * head["points"]).reshape(-1, 3)
    if head["walls_change"] or (take("<u4", head["walls"]) != 3).any():
        sys.exit("animate.py: walls are to be triangles that stay")
    walls = take("<u4", head["wall_corners"]).reshape(-1, 3).astype(int)
    take("<u4", head["floor"] + head["floor_corners"] + 2 * head["lines"] + 2 * head["edges"] + 3 * head["faces"])
    moving = head["particles"] + sum(body["vertices"] for body in head["bodies"])
    values = 3 * (moving + head["points"])
    low, unit = numpy.array(head["lower"]), (numpy.array(head["upper"]) - head["lower"]) / 65535
    places, frames = [], []
    for record in range(head["records"]):
        folded = take("u1", values).astype(int) | take("u1", values).astype(int) << 8
        expected = 0 if record == 0 else places[-1] if record == 1 else 2 * places[-1] - places[-2]
        places = [*places[-1:], (expected + ((folded >> 1) ^ -(folded & 1))) & 0xffff]
        frames.append((low[:, None] + unit[:, None] * places[-1].reshape(3, -1)).T)
        take("u1", 4 * moving + len(head["bodies"]))
    return SimpleNamespace(head=head, walls=walls, start=points, frames=frames, moving=moving)


def rows(path):
    with open(path, newline="") as file:
        return [(int(row["step"]), [float(row[k]) for k in "xyz"], [float(row[k]) for k in ("nx", "ny", "nz")], row["body"]) for row in csv.DictReader(file)]


def work(options, folder):
    """Imports the surface of the scene and runs it. All that the animation shows."""
    scene = json.loads(re.sub(r"//.*", "", options.scene.read_text()))
    surface = options.scene.parent / scene["environment"]["import"]
    quality = ["--quality", str(scene["environment"]["quality"])] if "quality" in scene["environment"] else []
    ran = lambda *words: subprocess.run([options.program, *map(str, words)], check=True, stdout=subprocess.DEVNULL)
    ran("import", surface, *quality, "-o", folder / "environment.ovm", "--json", folder / "import.json")
    ran("run", options.scene, "-o", folder / "run", "--set", "output.frame_every=0", "--set", "output.motion_every=1", "--set", "output.picture=false")
    story = SimpleNamespace(scene=scene, report=json.loads((folder / "import.json").read_text()), run=json.loads((folder / "run" / "run.json").read_text()))
    story.points, story.triangles = read_off(surface)
    story.places, story.cells = read_cells(folder / "environment.ovm")
    story.motion = read_motion(folder / "run" / "motion.gz")
    story.contacts, story.pushes = rows(folder / "run" / "contacts.csv"), rows(folder / "run" / "walls.csv")
    return story


def boundary(places, cells):
    """The walls of tetrahedra, their corners counterclockwise seen from outside."""
    p = places[cells]
    flip = numpy.einsum("ij,ij->i", numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]) < 0
    cells = numpy.where(flip[:, None], cells[:, [0, 2, 1, 3]], cells)
    facets = cells[:, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]].reshape(-1, 3)
    _, index, counts = numpy.unique(numpy.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    return facets[index[counts == 1]]


def prepare(story):
    """What of the surface is open, turned, or closed by a cap; the camera."""
    edges = numpy.sort(story.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    edges, counts = numpy.unique(edges, axis=0, return_counts=True)
    story.open_edges = edges[counts == 1]
    story.walls = boundary(story.places, story.cells)
    key = lambda triangle: tuple(numpy.roll(triangle, -numpy.lexsort(triangle.T[::-1])[0], axis=0).ravel())
    as_walls = {key(t) for t in story.places[story.walls]}
    story.turned = numpy.array([key(t[::-1]) in as_walls for t in story.points[story.triangles]])
    border = {tuple(p) for p in story.points[numpy.unique(story.open_edges)]}
    caps = lambda places, walls: numpy.array([tuple(p) in border for p in places])[walls].all(axis=1)
    story.is_cap = caps(story.places, story.walls)
    story.is_cap_in_run = caps(story.motion.start, story.motion.walls)
    story.middles = story.places[story.cells].mean(axis=1)
    story.steps = len(story.motion.frames) - 1
    start = story.motion.start
    n = numpy.cross(*(start[story.motion.walls[:, k]] - start[story.motion.walls[:, 0]] for k in (1, 2)))
    sums = numpy.zeros_like(start)
    for k in range(3):
        numpy.add.at(sums, story.motion.walls[:, k], n)
    story.outward = sums / numpy.maximum(numpy.linalg.norm(sums, axis=1), 1e-300)[:, None]
    story.amplitude = story.scene["walls"]["pulsation"]["amplitude"]
    toward = story.scene["output"]["picture"]["toward"]
    camera = Camera((0, 0, 0), toward, 1)
    right, up, _ = frame_of(camera)
    across, along = story.points.dot(right), story.points.dot(up)
    middle = story.points.mean(axis=0)
    for axis, values in ((right, across), (up, along)):
        middle = middle + ((values.min() + values.max()) / 2 - middle.dot(axis)) * axis
    height = 1.09 * max(numpy.ptp(along), numpy.ptp(across) * HEIGHT / PICTURE)
    story.camera = Camera(middle, toward, height, shift=((PICTURE - WIDTH) / 2 / HEIGHT, 0))
    tips = [[c[1] for c in story.contacts if c[3]] or [story.points.mean(axis=0)]][0]
    story.focus = numpy.median(numpy.array(tips), axis=0)
    return story


def grey(opacity=1.0):
    return Material(GIVEN, opacity, line=LINE, line_opacity=0.35)


def draw_surface(drawing, story, repaired):
    """The surface as it is given, and what an import makes of it, as `repaired` goes from 0 to 1."""
    if repaired < 1:
        drawing.add_surface(story.points, story.triangles[~story.turned], grey())
        mixed = tuple(numpy.array(TURNED) + repaired * (numpy.array(GIVEN) - TURNED))
        drawing.add_flat(story.points[story.triangles[story.turned]], Material(mixed, line=LINE))
        fault = Material(OPEN_EDGE, 1 - repaired)
        for a, b in story.points[story.open_edges]:
            drawing.add_tube(numpy.array([a, b]), 0.7, fault, 6)
        for change in story.report["repaired"]["changes"]:
            for place in change["places"] if change["step"] == "cut" else []:
                drawing.add_ball(numpy.array(place), 0.9, fault, 8)
    else:
        drawing.add_surface(story.places, story.walls[~story.is_cap], grey())
    drawing.add_flat(story.places[story.walls[story.is_cap]], Material(CAP, repaired, line=LINE, line_opacity=0.4 * repaired))


def draw_filling(drawing, story, share):
    """Cells appear at a plane that rises. Below it walls are as in the run, above it as given."""
    low, high = story.places[:, 2].min(), story.places[:, 2].max()
    thickness = 0.16 * (high - low)
    plane = low + share * (high - low + thickness)
    heights = story.places[story.walls][:, :, 2].mean(axis=1)
    for is_cap in (False, True):
        drawing.add_surface(story.places, story.walls[(story.is_cap == is_cap) & (heights > plane)], Material(CAP if is_cap else GIVEN, line=LINE, line_opacity=0.35))
    below = heights <= plane
    drawing.add_surface(story.places, story.walls[below & ~story.is_cap], Material(WALL, WALL_OPACITY, WALL_RIM))
    drawing.add_flat(story.places[story.walls[below & story.is_cap]], Material(WALL, 2 * WALL_OPACITY))
    behind = (plane - story.middles[:, 2]) / thickness
    for number, colour in enumerate(CELLS):
        chosen = (behind > 0) & (behind < 1) & (numpy.arange(len(behind)) % len(CELLS) == number)
        size = 0.85 * numpy.sqrt(1 - behind[chosen])[:, None, None]
        corners = story.middles[chosen][:, None] + size * (story.places[story.cells[chosen]] - story.middles[chosen][:, None])
        drawing.add_flat(corners[:, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]].reshape(-1, 3, 3), Material(colour))


def draw_run(drawing, story, step):
    """Walls, reddened where they are farther out than at the start and blue where they are farther in; the catheter; contacts of the last steps."""
    places = story.motion.frames[step]
    points = places[story.motion.moving:]
    out = numpy.clip(((points - story.motion.start) * story.outward).sum(axis=1) / story.amplitude, -1, 1)
    is_cap = story.is_cap_in_run
    drawing.add_surface(points, story.motion.walls[~is_cap], Material(WALL, WALL_OPACITY, WALL_RIM, low=INWARD, high=OUTWARD, shade_opacity=0.13), out)
    drawing.add_flat(points[story.motion.walls[is_cap]], Material(WALL, 2 * WALL_OPACITY))
    line = places[:story.motion.moving]
    line = line[numpy.concatenate([[True], numpy.linalg.norm(numpy.diff(line, axis=0), axis=1) > 1e-3])]
    radius = story.scene["catheter"]["radius"]
    if len(line) > 1:
        drawing.add_tube(line, radius, Material(CATHETER))
    drawing.add_ball(line[0], radius, Material(CATHETER))
    seen = []
    for at, place, normal, body in reversed(story.contacts + story.pushes):
        if not (step - CONTACT_STEPS < at <= step and body) or any(numpy.linalg.norm(numpy.array(place) - p) < 3.5 for p in seen):
            continue
        seen.append(numpy.array(place))
        drawing.add_ball(numpy.array(place), 0.9, Material(CONTACT), 10)
        drawing.add_arrow(numpy.array(place), normal, 12, 0.42, Material(CONTACT))


def counted(n, one, many=None):
    return f"{n:,} {one if n == 1 else many or one + 's'}"


def texts(story, act, step):
    """What stands beside the picture: titles with lines, and which of them is shown now."""
    changes = {change["step"]: change["count"] for change in story.report["repaired"]["changes"]}
    caps = sum(part["kind"] == "cap" for part in story.report["repaired"]["parts"])
    faults = [counted(caps, "hole"), counted(changes.get("turned", 0), "turned triangle"), counted(changes.get("cut", 0), "crossing pair")]
    contacts = sum(c[0] <= step and bool(c[3]) for c in story.contacts)
    pushes = sum(c[0] <= step and bool(c[3]) for c in story.pushes)
    cells, seconds = story.report["certificate"]["cells"], step * story.scene["time_step"]
    return [
        ("1  Import", [[f"{len(story.triangles):,} triangles with", *faults],
                       ["repaired:", counted(caps, "cap"), *(f"{t}" for t in faults[1:])],
                       ["filled with", f"{cells:,} cells,", "certified exactly"]][min(act, 2)]),
        ("2  Push", [f"a catheter of {2 * story.scene['catheter']['radius']:g} mm", f"{seconds:.2f} s", counted(contacts, "contact")]),
        ("3  Beat", [f"walls move {story.amplitude:g} mm", f"{seconds:.2f} s", f"pushed {pushes:,} times", "red: out, blue: in"]),
    ], 0 if act <= 2 else act - 2


def write_texts(image, story, act, step):
    draw = ImageDraw.Draw(image)
    bold, plain = (ImageFont.truetype(str(FONTS / name), size) for name, size in (("DejaVuSans-Bold.ttf", 25), ("DejaVuSans.ttf", 20)))
    blocks, now = texts(story, act, step)
    for number, (title, lines) in enumerate(blocks):
        y = TEXT_TOP + number * (HEIGHT - TEXT_TOP) // len(blocks)
        draw.text((PICTURE, y), title, font=bold, fill=TEXT if number == now else PALE)
        for row, line in enumerate(lines if number == now else []):
            draw.text((PICTURE, y + 36 + 27 * row), line, font=plain, fill=QUIET)


def frames_of(story):
    """Each frame: the act, its share, and the step of the run."""
    period = round(story.scene["walls"]["pulsation"]["period"] / story.scene["time_step"])
    beat = story.steps - round(1.3 * period)
    frames = [(0, 0, 0)] + [(1, (k + 1) / REPAIR, 0) for k in range(REPAIR)] + [(2, (k + 1) / FILL, 0) for k in range(FILL)]
    frames += [(3, 0, round(beat * (k + 1) / PUSH)) for k in range(PUSH)]
    return frames + [(4, min(1, (k + 1) / NEAR), round(beat + (story.steps - beat) * (k + 1) / (NEAR + BEAT))) for k in range(NEAR + BEAT)]


def draw_frame(frame):
    act, share, step = frame
    drawing, camera = Drawing(), STORY.camera
    if act < 2:
        draw_surface(drawing, STORY, min(1, 1.6 * share))
    elif act == 2:
        draw_filling(drawing, STORY, share)
    else:
        draw_run(drawing, STORY, step)
    if act == 4:
        eased = share * share * (3 - 2 * share)
        camera = Camera(camera.target + eased * (STORY.focus - camera.target), camera.toward, camera.height * CLOSE_UP**eased, shift=camera.shift)
    down = ((numpy.arange(HEIGHT) + 0.5) / HEIGHT)[:, None, None]
    background = numpy.broadcast_to(numpy.array(BACKGROUND_TOP) + down * (numpy.array(BACKGROUND_BOTTOM) - BACKGROUND_TOP), (HEIGHT, WIDTH, 3))
    pixels = render(drawing, camera, WIDTH, HEIGHT, background)
    fade = numpy.clip((PICTURE - 6 - numpy.arange(WIDTH)) / FADE, 0, 1)[:, None]
    pixels = background + fade * (pixels - background)
    image = Image.fromarray((255 * numpy.clip(pixels, 0, 1) + 0.5).astype(numpy.uint8))
    write_texts(image, STORY, act, step)
    return image


def main():
    global STORY  # of the processes that draw
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--program", default="build/release/cellwalk")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--frames", type=Path)
    parser.add_argument("--every", type=int, default=1)
    options = parser.parse_args()

    with tempfile.TemporaryDirectory() as folder:
        STORY = prepare(work(options, Path(folder)))
    animate(options)


def animate(options):
    frames = frames_of(STORY)[::options.every]
    with ProcessPoolExecutor(options.jobs, multiprocessing.get_context("fork")) as pool:
        images = list(pool.map(draw_frame, frames))
    if options.frames:
        options.frames.mkdir(parents=True, exist_ok=True)
        for number, image in enumerate(images):
            image.save(options.frames / f"frame_{number * options.every:03}.png")
    durations = [round(1000 * SECONDS_A_FRAME)] * len(images)
    durations[0], durations[-1] = round(1000 * SECONDS_OF_START), round(1000 * SECONDS_AT_END)
    images[0].save(options.out, save_all=True, append_images=images[1:], duration=durations, loop=0, quality=QUALITY, method=6)
    print(f"{options.out}: {len(images)} frames of {WIDTH} x {HEIGHT}, {sum(durations) / 1000:.1f} s, {options.out.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
