#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes an animation of a scene from the program's own pictures: docs/images/pulse.webp is that of data/pulse.json.

usage: animate.py SCENE.json OUT.webp [--program build/release/cellwalk] [--steps 240] [--every 4] [--width 640] [--jobs N] [--frames DIR]

A frame is the picture of a run that ends at its step, so that the scene runs once a frame: five minutes for 60 frames of pulse.json on two cores.
--frames keeps the frames as PNG files. Needs the packages python3-pil, python3-numpy and fonts-dejavu-core (scripts/setup.sh --for peers).
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy
from PIL import Image, ImageDraw, ImageFont

FONTS = Path("/usr/share/fonts/truetype/dejavu")
PICTURE = {"width": 1920, "height": 1200}  # of the program; frames are cut out of it and made smaller
CAPTION_SHARE = 0.06  # the program's caption is below this share of the height
DIFFERENCE = 8  # of a component, from which on a pixel is not background
MARGIN = 24  # pixels of the program's picture round what is drawn
CAPTION_HEIGHT, LEGEND_GAP = 46, 18  # pixels of a frame
SECONDS_A_FRAME, SECONDS_AT_END = 0.08, 1.5
QUALITY = 82
TEXT, QUIET = "#1e293b", "#475569"
LEGEND = (("catheter", "#1a4587"), ("particle", "#0d8580"), ("contact and its normal", "#f59414"))


def run_to(step, options, folder):
    """The picture of the scene at a step, and how many contacts there were: of bodies with walls, and of walls that push bodies."""
    out = folder / f"run_{step:04}"
    subprocess.run([options.program, "run", options.scene, "-o", out, "--steps", str(step), "--threads", "1", "--set", f"output.picture={json.dumps(PICTURE)}",
                    "--set", "output.frame_every=0", "--set", "output.motion_every=0"],
                   check=True, stdout=subprocess.DEVNULL)
    report = json.loads((out / "run.json").read_text())
    picture = Image.open(out / "picture.png").convert("RGB")
    contacts = sum(report["contacts"].values())
    pushes = report.get("walls", {}).get("counts", {}).get("pushes", 0)
    return picture, contacts, pushes, report["manifest"]["scene"].get("title", "")


def drawn_box(pictures):
    """What is drawn in any of the pictures: the background has one colour in each row, that of the left edge."""
    seen = None
    for picture in pictures:
        pixels = numpy.asarray(picture).astype(int)
        mask = (abs(pixels - pixels[:, :1]) > DIFFERENCE).any(axis=2)
        seen = mask if seen is None else seen | mask
    seen[int((1 - CAPTION_SHARE) * seen.shape[0]):] = False
    rows, columns = numpy.nonzero(seen.any(axis=1))[0], numpy.nonzero(seen.any(axis=0))[0]
    if len(rows) == 0:
        sys.exit("animate.py: nothing is drawn")
    height, width = seen.shape
    return (max(0, columns[0] - MARGIN), max(0, rows[0] - MARGIN), min(width, columns[-1] + MARGIN),
            min(int((1 - CAPTION_SHARE) * height), rows[-1] + MARGIN))


def write_caption(frame, title, step, contacts, pushes, width, top):
    """The title and the legend on the left, the counts on the right, in the strip below the picture."""
    draw = ImageDraw.Draw(frame)
    bold = ImageFont.truetype(str(FONTS / "DejaVuSans-Bold.ttf"), 13)
    plain = ImageFont.truetype(str(FONTS / "DejaVuSans.ttf"), 12)
    draw.text((10, top + 4), title, font=bold, fill=TEXT)
    x = 10
    for name, colour in LEGEND:
        draw.ellipse((x, top + 27, x + 8, top + 35), fill=colour)
        draw.text((x + 12, top + 24), name, font=plain, fill=QUIET)
        x += 12 + draw.textlength(name, font=plain) + LEGEND_GAP
    for line, text in enumerate((f"step {step}", f"{contacts} contacts, {pushes:,} pushes by walls")):
        draw.text((width - 10 - draw.textlength(text, font=plain), top + 4 + 20 * line), text, font=plain, fill=QUIET)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scene")
    parser.add_argument("out", type=Path)
    parser.add_argument("--program", default="build/release/cellwalk")
    parser.add_argument("--steps", type=int, default=240)
    parser.add_argument("--every", type=int, default=4)
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--frames", type=Path)
    options = parser.parse_args()

    steps = range(options.every, options.steps + 1, options.every)
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.jobs) as pool:
        runs = list(pool.map(lambda step: run_to(step, options, Path(folder)), steps))
    box = drawn_box([picture for picture, *_ in runs])
    height = round(options.width * (box[3] - box[1]) / (box[2] - box[0]))
    frames = []
    for step, (picture, contacts, pushes, title) in zip(steps, runs):
        small = picture.crop(box).resize((options.width, height), Image.LANCZOS)
        frame = Image.new("RGB", (options.width, height + CAPTION_HEIGHT), small.getpixel((0, height - 1)))
        frame.paste(small, (0, 0))
        write_caption(frame, title, step, contacts, pushes, options.width, height)
        frames.append(frame)
        if options.frames:
            options.frames.mkdir(parents=True, exist_ok=True)
            frame.save(options.frames / f"frame_{step:04}.png")
    durations = [round(1000 * SECONDS_A_FRAME)] * (len(frames) - 1) + [round(1000 * SECONDS_AT_END)]
    frames[0].save(options.out, save_all=True, append_images=frames[1:], duration=durations, loop=0, quality=QUALITY, method=6)
    print(f"{options.out}: {len(frames)} frames of {frames[0].width} x {frames[0].height}, {options.out.stat().st_size:,} bytes")


if __name__ == "__main__":
    main()
