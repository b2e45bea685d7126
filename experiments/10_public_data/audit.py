#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Judges public meshes, and imports each of them twice: as --strict, and with repairs. Writes audit.csv, and
imports.csv: what depends on the meshers.

usage: audit.py PROGRAM OUT DATA... [--only NAME] [--sources FILE] [--times]

  PROGRAM   cellwalk
  OUT       a folder for the tables, and for environments and reports, in OUT/imports
  DATA      folders in which the files of sources.json are looked for, by their SHA-256; what is not there is left out, and said
  --only NAME     this mesh alone
  --sources FILE  which meshes; by default sources.json of this folder
  --times         with seconds of processor time of each import
"""

import argparse
import csv
import json
import resource
import subprocess
import sys
from pathlib import Path

from judge import cell_faults, surface_faults
from readers import read_cells, read_mmc, read_surface
from sources import SOURCES, files_of, index, read_sources

OUTCOMES = {0: "imported", 3: "refused", 4: "not certified"}


def write_vtk(path, points, tetrahedra):
    """A mesh of tetrahedra as Cellwalk reads it."""
    with open(path, "w", encoding="utf-8") as out:
        out.write(f"# vtk DataFile Version 3.0\ntetrahedra\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(points)} double\n")
        out.writelines(" ".join(repr(float(x)) for x in p) + "\n" for p in points)
        out.write(f"CELLS {len(tetrahedra)} {5 * len(tetrahedra)}\n")
        out.writelines("4 " + " ".join(map(str, t)) + "\n" for t in tetrahedra)
        out.write(f"CELL_TYPES {len(tetrahedra)}\n" + "10\n" * len(tetrahedra))


def judge(source, paths, folder):
    """What is wrong with a mesh, and the file to import."""
    if source["group"] != "cells":
        return surface_faults(*read_surface(paths[0])), paths[0]
    if "nodes" not in source:
        try:
            mesh = read_cells(paths[0])
        except (ValueError, IndexError):
            return {"cells": 0, "cannot be read": 1}, paths[0]
        return cell_faults(*mesh), paths[0]
    points, cells = read_mmc(paths[1], paths[0])
    converted = folder / (paths[0].stem + ".vtk")
    write_vtk(converted, points, cells["tetra"])
    return cell_faults(points, cells), converted


def imported(program, path, folder, *options):
    """The outcome of an import: exit code, report or message, and seconds of processor time."""
    stem = path.name + ("_strict" if options else "")
    report = folder / (stem + ".json")
    report.unlink(missing_ok=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "import", path, *options, "-o", folder / (stem + ".ovm"), "--json", report],
                          capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in OUTCOMES:
        sys.exit(f"audit.py: {path}: exit code {done.returncode}\n{done.stderr}")
    lines = done.stderr.strip().splitlines()
    message = lines[0].replace(f"{path}: ", "").removeprefix("cellwalk: ") if done.returncode and lines else ""
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.returncode, json.loads(report.read_text()) if done.returncode == 0 else {}, message, seconds


def changes_of(report):
    """What an import changed, in a line."""
    found = [f"{c['step']} {c['count']}" for c in report.get("repaired", {}).get("changes", []) if c["step"] != "regions"]
    kinds = [p["kind"] for p in report.get("repaired", {}).get("parts", [])]
    found += [f"{kind}s {kinds.count(kind)}" for kind in sorted(set(kinds))]
    changed = report.get("changed", {})
    found += [f"{name} {changed[key]}" for name, key in (("merged points", "merged_points"), ("cells split", "cells_split")) if changed.get(key)]
    return "; ".join(found)


def row_of(source, faults, strict, repaired):
    code, _, message, _ = strict
    code_repaired, report, message_repaired, _ = repaired
    certificate = report.get("certificate", {})
    return {
        "name": source["name"],
        "group": source["group"],
        "faults": "; ".join(f"{k} {v}" for k, v in faults.items() if v and k not in ("points", "triangles", "cells", "boundary facets")),
        "size": faults.get("triangles", faults.get("cells")),
        "strict": OUTCOMES[code],
        "strict_message": message,
        "repaired": OUTCOMES[code_repaired],
        "changes": changes_of(report),
        "message": message_repaired,
        "components": certificate.get("components", ""),
        "free_volume": f"{certificate['free_volume']:.6g}" if certificate else "",
    }


def import_row(name, strict, repaired, is_timed):
    report = repaired[1]
    return {
        "name": name,
        "cells": report.get("certificate", {}).get("cells", ""),
        "moved": f"{report['repaired']['moved']:.1e}" if "repaired" in report else "",
        "strict_seconds": f"{strict[3]:.2f}" if is_timed else "",
        "seconds": f"{repaired[3]:.2f}" if is_timed else "",
    }


def write_csv(path, rows):
    with open(path, "w", newline="", encoding="utf-8") as out:
        table = csv.DictWriter(out, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("out", type=Path)
    parser.add_argument("data", type=Path, nargs="+")
    parser.add_argument("--only")
    parser.add_argument("--sources", default=SOURCES)
    parser.add_argument("--times", action="store_true")
    options = parser.parse_args()
    there = index(*options.data)
    folder = options.out / "imports"
    folder.mkdir(parents=True, exist_ok=True)
    rows, imports, missing = [], [], []
    for source in read_sources(options.sources):
        if source["group"] == "end states" or options.only not in (None, source["name"]):
            continue
        paths = [there.get(sha256) for _, _, sha256 in files_of(source)]
        if None in paths:
            missing.append(source["name"])
            continue
        faults, path = judge(source, paths, folder)
        strict, repaired = imported(options.program, path, folder, "--strict"), imported(options.program, path, folder)
        rows.append(row_of(source, faults, strict, repaired))
        imports.append(import_row(source["name"], strict, repaired, options.times))
        print(f"{source['name']}: {rows[-1]['faults'] or 'no fault'}; strict: {rows[-1]['strict']}; {rows[-1]['repaired']}", flush=True)
    if missing:
        print(f"not there: {', '.join(missing)}")
    if not rows:
        sys.exit("audit.py: none of the files of sources.json is there; download.py DIR gets most of them")
    write_csv(options.out / "audit.csv", rows)
    write_csv(options.out / "imports.csv", imports)


if __name__ == "__main__":
    main()
