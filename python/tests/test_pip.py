# SPDX-License-Identifier: LGPL-3.0-or-later
"""pip wheel . : the wheel stands alone, says under which licence it is, and works away from the sources.

CELLWALK_BUILD_DIR: a build tree to take; without it, pip configures one of its own, as it does by default, without meshing.
"""

import email
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TREE = os.environ.get("CELLWALK_BUILD_DIR")
CLEAN = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
PIP = ("-m", "pip", "--no-cache-dir", "--disable-pip-version-check")
# In the names of whatever CGAL has under the GPL and meshing uses.
GPL_NAMES = re.compile(rb"Polygon_mesh_processing|AABB_tree|Delaunay_triangulation_[23]|Triangulation_data_structure")


def run(*command, **more):
    done = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, env={**CLEAN, **more})
    if done.returncode != 0:
        raise AssertionError(f"{command}:\n{done.stdout}{done.stderr}")
    return done.stdout


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        offline = ("--no-index", "--no-deps")
        run(*PIP, "wheel", "--no-build-isolation", *offline, "--wheel-dir", cls.folder.name, ROOT)
        [cls.file] = Path(cls.folder.name).glob("*.whl")
        cls.site = Path(cls.folder.name) / "site"
        run(*PIP, "install", *offline, "--target", cls.site, cls.file)
        cls.package = cls.site / "cellwalk"
        # What is taken has a default: no meshing.
        cls.built = json.loads((Path(TREE) / "python" / "wheel.json").read_text()) if TREE else {"meshing": False}
        with zipfile.ZipFile(cls.file) as wheel:
            cls.names = wheel.namelist()
            [metadata] = [name for name in cls.names if name.endswith(".dist-info/METADATA")]
            cls.metadata = email.message_from_bytes(wheel.read(metadata))

    def test_metadata_name_the_licence(self):
        is_meshing = self.built["meshing"]
        self.assertEqual(self.metadata["Name"], "cellwalk-ccd")
        version = run("-c", "import cellwalk; print(cellwalk.__version__)", PYTHONPATH=str(self.site)).strip()
        self.assertEqual(self.metadata["Version"], version + ("+meshing" if is_meshing else ""))
        licence = self.metadata["License-Expression"] or self.metadata["License"]
        self.assertEqual(licence, "GPL-3.0-or-later AND AGPL-3.0-or-later" if is_meshing else "LGPL-3.0-or-later")
        self.assertTrue(self.metadata["Requires-Dist"].startswith("numpy"))
        texts = {Path(name).name for name in self.names}
        self.assertLessEqual({"LICENSE", "COPYING.GPL"} | ({"AGPL-3.0.txt"} if is_meshing else set()), texts)
        self.assertRegex(self.file.name, r"^cellwalk_ccd-[\d.]+(\+meshing)?-cp(\d+)-cp\2-(manylinux_2_\d+|linux)_\w+\.whl$")

    def test_a_wheel_without_meshing_has_nothing_under_the_gpl(self):
        is_meshing = self.built["meshing"]
        for name in ("bin/cellwalk", next(self.package.glob("_cellwalk*.so")).name):
            found = GPL_NAMES.search((self.package / name).read_bytes())
            self.assertEqual(bool(found), is_meshing, name)
        # Nor a mesher, nor what VTK reads.
        self.assertEqual(any("/libexec/cellwalk/cellwalk-" in name for name in self.names), is_meshing)
        self.assertEqual(any(name.startswith("cellwalk/lib/libtet-") for name in self.names), is_meshing)
        self.assertEqual([name for name in self.names if "vtk" in name.lower()], [])
        self.assertLess(self.file.stat().st_size, 20e6)

    def test_bundled_libraries_are_listed_with_their_licences(self):
        listed = (self.package / "licenses" / "README.txt").read_text(encoding="utf-8")
        libraries = [name.removeprefix("cellwalk/") for name in self.names if name.startswith("cellwalk/lib/")]
        self.assertGreaterEqual(len(libraries), 4)
        for library in libraries:
            self.assertRegex(listed, rf"(?m)^.+: \S.*; {re.escape(library)};")
            self.assertRegex(library, r"-[0-9a-f]{8}\.so", "the name is its own")
        for text in re.findall(r"; ([\w.+-]+\.txt)$", listed, re.MULTILINE):
            self.assertIn(f"cellwalk/licenses/{text}", self.names)
        self.assertEqual("TetGen" in listed, self.built["meshing"])

    def test_it_works_where_it_was_installed(self):
        said = run(ROOT / "python" / "tests" / "use_wheel.py", "meshing" if self.built["meshing"] else "plain", PYTHONPATH=str(self.site))
        self.assertIn("works", said)
        program = subprocess.run([self.package / "bin" / "cellwalk", "--version"], capture_output=True, text=True, check=True)
        self.assertEqual(program.stdout, run("-m", "cellwalk", "--version", PYTHONPATH=str(self.site)))


class Program(unittest.TestCase):
    def test_the_module_is_the_program(self):
        said = subprocess.run([sys.executable, "-m", "cellwalk", "fly"], capture_output=True, text=True)
        self.assertEqual(said.returncode, 2, "exit codes are those of the program")
        self.assertEqual(said.stderr, "cellwalk: fly is not known here; see cellwalk --help\n")


if __name__ == "__main__":
    unittest.main()
