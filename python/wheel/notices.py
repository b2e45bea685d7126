# SPDX-License-Identifier: LGPL-3.0-or-later
"""Writes down what a wheel holds besides Cellwalk: each library with its version and licence, and the texts of the licences."""

import re
import shutil
import subprocess
from pathlib import Path

# Bundled libraries by the first part of their names. One that is not listed here goes into no wheel.
BUNDLED = {
    "libfmt": ("fmt", "MIT"),
    "libgmp": ("GMP", "LGPL-3.0-or-later OR GPL-2.0-or-later"),
    "libmpfr": ("MPFR", "LGPL-3.0-or-later"),
    "libtbb": ("oneTBB", "Apache-2.0"),
    "libtet": ("TetGen", "AGPL-3.0-or-later"),
    "libz": ("zlib", "Zlib"),
}
# Not among the texts of Debian.
AGPL = Path(__file__).resolve().parents[2] / "COPYING.AGPL"
# What is compiled in and has a licence that must go with it, each with a file that it comes with. (Boost's need not.)
COMPILED = [
    ("CGAL", "LGPL-3.0-or-later", "/usr/include/CGAL/version.h"),
    ("CLI11", "BSD-3-Clause", "/usr/include/CLI/CLI.hpp"),
    ("Eigen", "MPL-2.0", "/usr/include/eigen3/Eigen/Core"),
    ("JSON for Modern C++", "MIT", "/usr/include/nlohmann/json.hpp"),
    ("pybind11", "BSD-3-Clause", "/usr/include/pybind11/pybind11.h"),
    ("xxHash", "BSD-2-Clause", "/usr/include/xxhash.h"),
]
SHARED_TEXT = re.compile(r"/usr/share/common-licenses/([\w.-]*\w)")


def printed(*command):
    """The output of a command of Debian; nothing where there is none."""
    if shutil.which(command[0]) is None:
        return ""
    return subprocess.run(command, capture_output=True, text=True).stdout


def packages_of(files):
    """The Debian package that each of the files comes from, where one does."""
    # Packages may list what lies in /usr/lib as /lib.
    names = {name: file for file in map(str, files) for name in (file, file.removeprefix("/usr"))}
    owners = re.findall(r"^([\w.+-]+)(?::\w+)?: (.+)$", printed("dpkg-query", "-S", *names), re.MULTILINE)
    return {names[name]: package for package, name in owners if name in names}


def copy_texts(package, folder):
    """Copies the copyright file of a package, and the licences that it refers to."""
    text = Path("/usr/share/doc", package, "copyright").read_text(encoding="utf-8", errors="replace")
    (folder / f"{package}.txt").write_text(text, encoding="utf-8")
    for name in set(SHARED_TEXT.findall(text)):
        shared = Path("/usr/share/common-licenses", name)
        if shared.is_file():
            (folder / f"{name}.txt").write_bytes(shared.read_bytes())


def write_notices(folder, bundled, *, licence, meshing, three):
    """Writes README.txt and the texts. `bundled`: copies with their sources; `three`: the folder of three.js, or None."""
    folder.mkdir(parents=True)
    parts = []
    for copy, source in sorted(bundled.items()):
        stem = re.match(r"lib[a-z]+", Path(copy).name)[0]
        if stem not in BUNDLED:
            raise SystemExit(f"{source}: is in no list of libraries for wheels; add it to {Path(__file__).name} with its licence")
        parts.append((*BUNDLED[stem], source, copy))
    parts += [(name, terms, file, "compiled in") for name, terms, file in COMPILED]
    lines = [f"Cellwalk in this wheel is under {licence}; the texts are in the folder dist-info of the wheel.", "",
             "Libraries in it, with the Debian packages whose sources they were built from:", ""]
    packages = packages_of(file for _, _, file, _ in parts)
    for name, terms, file, place in parts:
        if name == "CGAL" and meshing:
            terms = "LGPL-3.0-or-later, and GPL-3.0-or-later for what makes meshes"
        package = packages.get(str(file))
        origin = printed("dpkg-query", "-W", "-f", "${source:Package} ${source:Version}", package) if package else ""
        lines.append(f"{name}: {terms}; {place}{f'; {origin}; {package}.txt' if origin else ''}")
        if origin:
            copy_texts(package, folder)
        if terms.startswith("AGPL"):
            shutil.copy(AGPL, folder / "AGPL-3.0.txt")
    if three is not None:
        shutil.copy(three / "LICENSE", folder / "three.js.txt")
        lines.append("three.js: MIT; in the page of cellwalk view; three.js.txt")
    (folder / "README.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
