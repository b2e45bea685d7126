# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs programs alone and by mpirun, in folders of their own.

usage of the scripts that use it: test_NAME.py BUILD_DIR [MPIRUN]      without MPIRUN the tests are skipped
"""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

SKIPPED = 77  # an exit code that CTest knows


class RanksCase(unittest.TestCase):
    build = None
    mpirun = None

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    @classmethod
    def command(cls, ranks, words):
        """A command line of several ranks; of 1, without mpirun."""
        words = [str(word) for word in words]
        if ranks == 1:
            return words
        return [cls.mpirun, "--oversubscribe", "--quiet", "-n", str(ranks), *words]

    @staticmethod
    def environment():
        """Open MPI refuses neither root nor a machine without ssh, uses memory only, and does not bind ranks to processors."""
        return {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_plm": "isolated",
                "OMPI_MCA_hwloc_base_binding_policy": "none", "OMPI_MCA_btl": "self,vader",
                "OMPI_MCA_btl_vader_single_copy_mechanism": "none"}

    def run_ranks(self, ranks, words, folder=None, **how):
        return subprocess.run(self.command(ranks, words), cwd=folder or self.folder, env=self.environment(), capture_output=True,
                              text=True, timeout=300, **how)

    @staticmethod
    def files(folder):
        """The bytes of all files, by name."""
        return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def main():
    """Runs the tests of the script that calls it."""
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    if len(sys.argv) < 3:
        print("skipped: this build lacks MPI; install libboost-mpi-dev, libopenmpi-dev and openmpi-bin, and configure again")
        sys.exit(SKIPPED)
    RanksCase.build = Path(sys.argv[1]).resolve()
    RanksCase.mpirun = sys.argv[2]
    unittest.main(argv=sys.argv[:1])
