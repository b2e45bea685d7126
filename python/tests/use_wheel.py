# SPDX-License-Identifier: LGPL-3.0-or-later
"""Uses Cellwalk where a wheel was installed: what it has to do, and to refuse. Needs nothing of the repository, and no compiler.

usage: use_wheel.py plain|meshing      which of the two wheels it is
"""

import doctest
import os
import re
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import cellwalk

# Of the C and C++ runtimes, which every system has (PEP 513).
SYSTEM = re.compile(r"(ld-linux.*|linux-vdso|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s))\.so(\.\d+)*")
BUNDLED = re.compile(r"lib(gmp|mpfr|tbb|fmt|tet)\b")
PACKAGE = Path(cellwalk.__file__).resolve().parent
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
TRIANGLES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]


def check(is_right, *what):
    if not is_right:
        sys.exit(f"use_wheel.py: {' '.join(map(str, what))}")


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, command, done.stderr)
    return done.stdout


def refusal(call, *arguments):
    """The message of the error that a call raises."""
    try:
        call(*arguments)
    except cellwalk.Error as error:
        return str(error)
    return ""


def check_libraries():
    """Nothing comes from outside, neither for files of the package nor in this process."""
    files = [file for file in PACKAGE.rglob("*") if file.is_file() and file.read_bytes()[:4] == b"\x7fELF"]
    check({"cellwalk", "lib"} <= {file.name if file.name == "cellwalk" else file.parent.name for file in files}, "files:", files)
    inside = 0
    for file in files:
        for line in run("ldd", file).splitlines():
            name, _, place = line.partition(" => ")
            if place and Path(place.split(" (")[0]).resolve().is_relative_to(PACKAGE):
                inside += 1
            else:
                check(SYSTEM.fullmatch(Path(name.split()[0]).name), file, "needs from outside:", line)
    check(inside > len(files), "only", inside, "libraries are found in the package")
    mapped = {line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if "/" in line}
    check(any(BUNDLED.match(Path(name).name) for name in mapped), "no bundled library is loaded")
    for name in mapped:
        check(not BUNDLED.match(Path(name).name) or Path(name).is_relative_to(PACKAGE), "loaded from outside:", name)


def check_program(is_meshing):
    version = run(sys.executable, "-m", "cellwalk", "--version")
    check(version.startswith(f"cellwalk {cellwalk.__version__}\n"), version)
    for part in ("meshing", "tetgen"):
        check(re.search(rf"^  {part} +{'yes' if is_meshing else 'no'} ", version, re.MULTILINE), part, version)
        check(cellwalk.build_features()[part] == is_meshing, part)
    run(sys.executable, "-m", "cellwalk", "generate", "vessel", "--generations", "1", "-o", "vessel.ovm")
    check(" cells" in run(sys.executable, "-m", "cellwalk", "check", "vessel.ovm"), "check")


def check_files(is_meshing):
    """Cells are read by both, closed surfaces are filled by the wheel with meshing only, and files of VTK are refused."""
    off = "OFF\n4 4 0\n" + "".join("%d %d %d\n" % corner for corner in CORNERS) + "".join("3 %d %d %d\n" % t for t in TRIANGLES)
    Path("t.off").write_text(off)
    facets = b"".join(struct.pack("<12fH", 0, 0, 0, *(x for i in t for x in CORNERS[i]), 0) for t in TRIANGLES)
    Path("t.stl").write_bytes(bytes(80) + struct.pack("<I", len(TRIANGLES)) + facets)
    for name in ("t.off", "t.stl"):
        if is_meshing:
            check(cellwalk.Environment.import_mesh(name).cell_count == 1, name)
        else:
            message = refusal(cellwalk.Environment.import_mesh, name)
            check("cannot mesh a surface" in message and "meshing" in message, name, "is refused by", repr(message))
    environment = cellwalk.Environment.import_mesh("vessel.ovm")
    environment.save("vessel.vtu")
    message = refusal(cellwalk.Environment.import_mesh, "vessel.vtu")
    check("VTK" in message, "vessel.vtu is refused by", repr(message))


def main():
    kind = sys.argv[1]
    check(kind in ("plain", "meshing"), kind)
    tried = doctest.testmod(cellwalk)
    check(tried.attempted and not tried.failed, tried)
    check_libraries()
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        check_program(kind == "meshing")
        check_files(kind == "meshing")
        os.chdir("/")
    print(f"use_wheel: {kind} works")


if __name__ == "__main__":
    main()
