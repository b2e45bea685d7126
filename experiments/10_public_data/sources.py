# SPDX-License-Identifier: LGPL-3.0-or-later
"""The files of the audit: where they come from, and where they are."""

import hashlib
import json
from pathlib import Path

SOURCES = Path(__file__).resolve().parent / "sources.json"


def read_sources(path=SOURCES):
    return json.loads(Path(path).read_text())


def files_of(source):
    """Name, path at the origin, and SHA-256 of each file of a mesh: one, or elements and nodes."""
    files = [(source["name"], source["path"], source["sha256"])]
    if "nodes" in source:
        files.append((Path(source["nodes"]["path"]).name, source["nodes"]["path"], source["nodes"]["sha256"]))
    return files


def index(*folders):
    """The files in folders by their SHA-256, whatever their names."""
    return {hashlib.sha256(path.read_bytes()).hexdigest(): path
            for folder in folders for path in sorted(Path(folder).rglob("*")) if path.is_file()}
