# SPDX-License-Identifier: LGPL-3.0-or-later
"""pip install . : the package works away from the sources, and has the program. CELLWALK_BUILD_DIR: a build tree to take."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


class Pip(unittest.TestCase):
    def test_an_installed_package_works(self):
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder) / "site"
            clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}

            def run(*command, **more):
                result = subprocess.run(command, capture_output=True, text=True, cwd=folder, env={**clean, **more})
                self.assertEqual(result.returncode, 0, f"{command}:\n{result.stdout}{result.stderr}")
                return result.stdout

            run(sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-index", "--no-deps", "--no-cache-dir",
                "--disable-pip-version-check", "--target", str(site), str(ROOT))
            here = {"PYTHONPATH": str(site)}
            said = run(sys.executable, "-c",
                       "import cellwalk; e = cellwalk.Environment.generate('squares', cells=(3, 3)); e.save('e.cellwalk'); "
                       "print(cellwalk.__file__, len(e.cells()))", **here)
            self.assertEqual(said.split(), [str(site / "cellwalk" / "__init__.py"), "9"])
            (Path(folder) / "t.off").write_text("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n")
            # A build without meshers has none in the package either.
            run(sys.executable, "-c", "import cellwalk; cellwalk.build_features()['tetgen'] and cellwalk.Environment.import_mesh('t.off')",
                **here)
            helpers = [path.name for path in (site / "cellwalk").glob("libexec/cellwalk/*")]
            self.assertEqual("True" in run(sys.executable, "-c", "import cellwalk; print(cellwalk.build_features()['tetgen'])", **here),
                             "cellwalk-tetgen" in helpers)
            program = [sys.executable, "-m", "cellwalk"]
            self.assertRegex(run(*program, "check", "e.cellwalk", **here), r"cells +9 ")
            self.assertEqual(run(str(site / "cellwalk" / "bin" / "cellwalk"), "--version"), run(*program, "--version", **here))
            self.assertIn("dist-info", " ".join(p.name for p in site.iterdir()))

    def test_the_module_is_the_program(self):
        said = subprocess.run([sys.executable, "-m", "cellwalk", "fly"], capture_output=True, text=True)
        self.assertEqual(said.returncode, 2, "exit codes are those of the program")
        self.assertEqual(said.stderr, "cellwalk: fly is not known here; see cellwalk --help\n")


if __name__ == "__main__":
    unittest.main()
