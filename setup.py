# SPDX-License-Identifier: LGPL-3.0-or-later
"""What pip builds: CMake compiles the extension module and the program into the package `cellwalk`, which then stands alone: the shared
libraries that both need are in it.

The wheel is under the LGPL and makes no meshes, unless CMAKE_ARGS says -DCELLWALK_WITH_MESHING=ON: then it is under the GPL, has the
meshers too, and its version ends in +meshing. Files that VTK reads are left to builds from source: VTK would double the size of the wheel.

The build tree is build/pip, or the one that CELLWALK_BUILD_DIR names; CMAKE_ARGS has further arguments for the former.
"""

import json
import os
import platform
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import setuptools
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "python" / "wheel"))
from bundle import bundle  # noqa: E402
from notices import write_notices  # noqa: E402

OPTIONS = {
    "CMAKE_BUILD_TYPE": "Release", "CMAKE_UNITY_BUILD": "ON", "CELLWALK_BUILD_TESTS": "OFF", "CELLWALK_BUILD_EXPERIMENTS": "OFF",
    "CELLWALK_WITH_PYTHON": "ON", "CELLWALK_WITH_MESHING": "OFF", "CELLWALK_WITH_VTK": "OFF", "CELLWALK_WITH_MPI": "OFF",
    "Python3_EXECUTABLE": sys.executable,
}


def run(*command):
    print(shlex.join(map(str, command)), flush=True)
    if shutil.which(command[0]) is None:
        raise SystemExit(f"{command[0]}, by which Cellwalk is built, is not there: scripts/setup.sh installs what a build needs")
    subprocess.run(command, check=True)


def build_tree():
    """The build tree, configured, and what it says of itself (python/CMakeLists.txt)."""
    tree = ROOT / "build" / "pip"
    if chosen := os.environ.get("CELLWALK_BUILD_DIR"):
        tree = Path(chosen).resolve()
    else:
        run("cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", *(f"-D{name}={value}" for name, value in OPTIONS.items()),
            *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    try:
        built = json.loads((tree / "python" / "wheel.json").read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise SystemExit(f"{tree}: is no build tree with the Python module: configure one with -DCELLWALK_WITH_PYTHON=ON") from None
    if built["meshing"] and not built["tetgen"]:
        raise SystemExit("a wheel with meshing has TetGen, which is not there: install the package libtet1.5-dev")
    return tree, built


class Build(build_ext):
    """Puts _cellwalk beside the Python files, the program into bin/, the meshers where both look for them, and libraries into lib/."""

    def run(self):
        if self.inplace:
            raise SystemExit("cellwalk cannot be installed in editable mode: use PYTHONPATH=BUILD/python of a build tree instead")
        run("cmake", "--build", TREE, "--parallel", "--target", "cellwalk_python", "cellwalk_cli")
        package = Path(self.build_lib).resolve() / "cellwalk"
        for left in ("bin", "lib", "libexec", "licenses"):  # by another build
            shutil.rmtree(package / left, ignore_errors=True)
        package.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            run("cmake", "--install", TREE, "--strip", "--prefix", folder, "--component", "python")
            [module] = Path(folder).rglob("_cellwalk*.so")
            shutil.copy2(module, package)
        for component in ("tools", "meshers"):
            run("cmake", "--install", TREE, "--strip", "--prefix", package, "--component", component)
        shutil.rmtree(package / "share")  # the licence, which dist-info has
        three = TREE / "viewer" / "node_modules" / "three"
        write_notices(package / "licenses", bundle(package), licence=LICENCE, meshing=BUILT["meshing"],
                      three=three if BUILT["viewer"] else None)


def platform_tag():
    """Any Linux with the C library of this one, or a later one."""
    libc, version = platform.libc_ver()
    if sys.platform != "linux" or libc != "glibc":
        return None
    return f"manylinux_{version.replace('.', '_')}_{platform.machine()}"


(ROOT / "build").mkdir(exist_ok=True)
TREE, BUILT = build_tree()
LICENCE = "GPL-3.0-or-later AND AGPL-3.0-or-later" if BUILT["meshing"] else "LGPL-3.0-or-later"
# A field of metadata 2.4 (PEP 639), where setuptools writes it.
licence_field = "license_expression" if int(setuptools.__version__.split(".")[0]) >= 77 else "license"
# pybind11 reads the arrays of NumPy 2 from 2.12 on.
reads_numpy_2 = tuple(map(int, BUILT["pybind11"].split(".")[:2])) >= (2, 12)
setup(
    version=BUILT["version"] + ("+meshing" if BUILT["meshing"] else ""),
    **{licence_field: LICENCE},
    install_requires=["numpy>=1.21" if reads_numpy_2 else "numpy>=1.21,<2"],
    packages=["cellwalk", "cellwalk.catheter"],
    package_dir={"cellwalk": "python/cellwalk"},
    package_data={"cellwalk": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("cellwalk._cellwalk", [])],
    cmdclass={"build_ext": Build},
    options={"egg_info": {"egg_base": "build"}, "build": {"build_base": "build/setuptools"},
             "bdist_wheel": {"plat_name": platform_tag()} if platform_tag() else {}},
)
