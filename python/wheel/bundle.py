# SPDX-License-Identifier: LGPL-3.0-or-later
"""Makes a package stand alone: shared libraries that not every Linux has are copied into it, and found there by relative paths."""

import hashlib
import os
import re
import shutil
import subprocess
from pathlib import Path

# Part of every system with a C and C++ runtime, as manylinux defines them (PEP 513, PEP 600). All other libraries are copied.
SYSTEM = re.compile(r"(ld-linux.*|linux-vdso|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s))\.so(\.\d+)*")
FOLDER = "lib"  # of the package


def output(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} failed: {done.stderr.strip()}")
    return done.stdout


def patchelf(*arguments):
    if shutil.which("patchelf") is None:
        raise SystemExit("patchelf, which makes wheels stand alone, is not there: install the package patchelf")
    return output("patchelf", *arguments)


def binaries(folder):
    """The programs, modules and libraries below a folder."""
    for file in sorted(folder.rglob("*")):
        if file.is_file() and not file.is_symlink():
            with file.open("rb") as opened:
                if opened.read(4) == b"\x7fELF":
                    yield file


def libraries_of(file):
    """The shared libraries that a file needs, those of libraries among them: where the loader finds each name."""
    found = {}
    for line in output("ldd", file).splitlines():
        words = line.split()
        if words[1:2] == ["=>"]:
            if words[2] == "not":
                raise SystemExit(f"{file}: the shared library {words[0]} is not found")
            found[words[0]] = Path(words[2])
        else:  # the loader itself, and what the kernel maps
            found[Path(words[0]).name] = Path(words[0])
    return found


def bundle(package):
    """Copies libraries into `package`. Returns the path of each copy below the package, with the file that it was copied from.

    A copy has a name of its own, so that another package in the same process may bring the same library in another version.
    """
    sources = {}
    for file in binaries(package):
        sources.update({name: path for name, path in libraries_of(file).items() if not SYSTEM.fullmatch(name)})
    folder = package / FOLDER
    folder.mkdir(exist_ok=True)
    names = {}
    for name, source in sources.items():
        stem, version = name.split(".so", 1)
        names[name] = f"{stem}-{hashlib.sha256(source.read_bytes()).hexdigest()[:8]}.so{version}"
        shutil.copy(source, folder / names[name])
        os.chmod(folder / names[name], 0o755)
        patchelf("--set-soname", names[name], folder / names[name])
    for file in binaries(package):
        renamed = [name for name in patchelf("--print-needed", file).split() if name in names]
        for name in renamed:  # one by one: patchelf 0.14 forgets some of several changes
            patchelf("--replace-needed", name, names[name], file)
        relative = os.path.relpath(folder, file.parent)
        path = "$ORIGIN" if relative == "." else f"$ORIGIN/{relative}"
        patchelf(*(["--set-rpath", path] if renamed else ["--remove-rpath"]), file)
    return {f"{FOLDER}/{names[name]}": source.resolve() for name, source in sources.items()}
