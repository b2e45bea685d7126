# SPDX-License-Identifier: LGPL-3.0-or-later
"""What pip builds: CMake compiles the extension module, the program, the modules of readers and the meshers, into the package `cellwalk`.

The build tree is build/pip, or the one that CELLWALK_BUILD_DIR names; CMAKE_ARGS has further arguments for the former.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).resolve().parent
TARGETS = ["cellwalk_python", "cellwalk_cli", "cellwalk_readers"]


def version():
    return re.search(r"project\(cellwalk VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]


def run(*command):
    print(shlex.join(map(str, command)), flush=True)
    subprocess.run(command, check=True)


def build_tree():
    """The build tree, configured."""
    chosen = os.environ.get("CELLWALK_BUILD_DIR")
    if chosen:
        return Path(chosen).resolve()
    tree = ROOT / "build" / "pip"
    run("cmake", "-S", ROOT, "-B", tree, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
        "-DCELLWALK_BUILD_TESTS=OFF", "-DCELLWALK_BUILD_EXPERIMENTS=OFF", "-DCELLWALK_WITH_PYTHON=ON",
        f"-DPython3_EXECUTABLE={sys.executable}", *shlex.split(os.environ.get("CMAKE_ARGS", "")))
    return tree


class Build(build_ext):
    """Puts _cellwalk beside the Python files, the program into bin/, modules and meshers where both look for them."""

    def run(self):
        if self.inplace:
            raise SystemExit("cellwalk cannot be installed in editable mode: use PYTHONPATH=BUILD/python of a build tree instead")
        tree = build_tree()
        run("cmake", "--build", tree, "--parallel", "--target", *TARGETS)
        package = Path(self.build_lib) / "cellwalk"
        package.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            run("cmake", "--install", tree, "--prefix", folder, "--component", "python")
            [module] = Path(folder).rglob("_cellwalk*.so")
            shutil.copy2(module, package)
        for component in ("tools", "readers", "meshers"):
            run("cmake", "--install", tree, "--prefix", package.resolve(), "--component", component)


(ROOT / "build").mkdir(exist_ok=True)
setup(
    version=version(),
    packages=["cellwalk", "cellwalk.catheter"],
    package_dir={"cellwalk": "python/cellwalk"},
    package_data={"cellwalk": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("cellwalk._cellwalk", [])],
    cmdclass={"build_ext": Build},
    options={"egg_info": {"egg_base": "build"}, "build": {"build_base": "build/setuptools"}},
)
