#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Looks at every source by itself: a build in batches hides what a source forgets to include, a plain one does not.

    scripts/check_sources.py [FOLDER ...]      only sources in these folders of the project

Nothing is optimised or written; it takes a second or two a source. What build/release, where there is one, compiles by itself anyway is left out.
"""
import concurrent.futures
import json
import os
import pathlib
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/sources"
RELEASE = ROOT / "build/release"


def entries(build):
    commands = build / "compile_commands.json"
    return json.loads(commands.read_text()) if commands.exists() else []


def configure():
    """A build of the sources one by one, of which only the list of commands is used."""
    command = ["cmake", "--preset", "release", "-B", str(BUILD), "-DCMAKE_UNITY_BUILD=OFF", "-DCMAKE_CXX_COMPILER_LAUNCHER="]
    configured = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if configured.returncode != 0:
        sys.exit(configured.stdout + configured.stderr)


def commands(folders):
    """The sources of the project in these folders, and how the compiler is called for each, without an output."""
    for entry in entries(BUILD):
        source = pathlib.Path(entry["file"])
        generated = source.is_relative_to(ROOT / "build")
        if generated or not any(source.is_relative_to(folder) for folder in folders):
            continue
        words = shlex.split(entry["command"])
        at = words.index("-o")
        yield source, words[:at] + words[at + 2:]


def complaint(command):
    done = subprocess.run([*command[1], "-fsyntax-only"], cwd=BUILD, capture_output=True, text=True)
    return done.stderr if done.returncode != 0 or " warning: " in done.stderr else ""


def main(names):
    folders = [(ROOT / name).resolve() for name in names or ["."]]
    configure()
    alone = {entry["file"] for entry in entries(RELEASE)}
    sources = [command for command in commands(folders) if str(command[0]) not in alone]
    if not sources:
        sys.exit(f"sources: there is none in {', '.join(names)}")
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for (source, _), said in zip(sources, pool.map(complaint, sources)):
            if said:
                bad += 1
                print(f"sources: {source.relative_to(ROOT)} by itself:\n{said}", file=sys.stderr)
    if bad > 0:
        sys.exit(f"sources: {bad} of {len(sources)} do not stand alone")
    print(f"sources: each of {len(sources)} compiles by itself")


if __name__ == "__main__":
    main(sys.argv[1:])
