#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs every row of tests/cli/errors/README.md and compares exit code and message; checks that the page names every error of the sources.

usage: test_errors.py ROOT PROGRAM [OPTIONAL PARTS THAT ARE MISSING ...]      parts: meshing vtk viewer python
"""

import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from error_messages import messages  # noqa: E402

SPAN = re.compile(r"(`{1,2})(?! )(.*?)(?<!`)\1(?!`)")
ESCAPE = re.compile(rb"\\(x[0-9a-f]{2}|.)", re.DOTALL)
FEWEST_ROWS = 300  # so that a page that cannot be read does not pass
PROCESSES = 2


def cells_of(row):
    return [cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|", row)[1:-1]]


def spans_of(cell):
    return [text for _, text in SPAN.findall(cell)]


def bytes_of(text):
    """The content of a file as the page writes it."""
    def byte(match):
        escape = match[1]
        return b"\n" if escape == b"n" else bytes([int(escape[1:], 16)]) if escape[:1] == b"x" and len(escape) == 3 else escape
    return ESCAPE.sub(byte, text.encode())


def read_page(text):
    """(commands that make the common files, rows, the page's text without escapes)."""
    base = re.search(r"```sh\n(.*?)```", text, re.DOTALL)[1]
    rows, part = [], None
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("#"):
            part = re.search(r"<!-- needs (\w+) -->", line)
        if re.match(r"\| [1-5] \|", line) and len(cells_of(line)) == 4:
            code, message, files, command = cells_of(line)
            names, said = spans_of(files), spans_of(message)[0].strip()
            needs = {part[1]} if part else set()
            if ", .mesh, .unv, polyMesh (OpenFOAM), .vtk" in said:  # all formats that are read, which a build without these parts tells otherwise
                needs |= {"vtk"}
            rows.append({"line": number, "code": int(code), "message": said, "needs": needs,
                         "files": list(zip(names[::2], names[1::2])), "command": spans_of(command)[0]})
    return base, rows, text.replace("\\|", "|")


def run_row(row, base, environment):
    """What is wrong with a row, or None."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(base, folder, dirs_exist_ok=True)
        for name, content in row["files"]:
            Path(folder, name).write_bytes(bytes_of(content))
        done = subprocess.run(["bash", "-c", row["command"]], cwd=folder, env=environment, capture_output=True, timeout=60)
        said = done.stderr.decode(errors="replace")
        expected = f"cellwalk: {row['message']}\n"
        if done.returncode != row["code"] or said != expected:
            return f"{row['command']}: exit code {done.returncode}, of {row['code']}\n  said     {said}  expected {expected}"
        left = [path.name for path in Path(folder).rglob("*") if path.name.endswith(".tmp") or ".tmp-" in path.name]
        return f"{row['command']}: left {left}" if left else None


def main():
    root, program, missing = Path(sys.argv[1]), Path(sys.argv[2]), set(sys.argv[3:])
    base_commands, rows, page = read_page((root / "tests/cli/errors/README.md").read_text(encoding="utf-8"))
    problems = []
    if len(rows) < FEWEST_ROWS:
        problems.append(f"only {len(rows)} rows can be read")
    unknown = {(part, f"{file}:{line}") for file, line, part in messages(root) if part not in page}
    problems += [f"{where}: tests/cli/errors/README.md does not name '{part}'" for part, where in sorted(unknown)]
    rows = [row for row in rows if not row["needs"] & missing]

    environment = dict(os.environ, PATH=f"{program.parent}:{os.environ['PATH']}", LC_ALL="C.UTF-8")
    with tempfile.TemporaryDirectory() as base:
        subprocess.run(["bash", "-e", "-c", base_commands], cwd=base, env=environment, check=True, stdout=subprocess.DEVNULL)
        with concurrent.futures.ThreadPoolExecutor(PROCESSES) as pool:
            answers = pool.map(lambda row: run_row(row, base, environment), rows)
            problems += [f"tests/cli/errors/README.md:{row['line']}: {answer}" for row, answer in zip(rows, answers) if answer]
    print("\n".join(problems))
    print(f"errors: {len(rows)} rows run, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
