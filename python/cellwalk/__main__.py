# SPDX-License-Identifier: LGPL-3.0-or-later
"""python -m cellwalk: the program, with all its commands. `python -m cellwalk --help` lists them."""

import os
import shutil
import sys
from pathlib import Path
from typing import NoReturn, Optional

HERE = Path(__file__).resolve().parent
# In the package that pip makes, and in a build tree.
PLACES = [HERE / "bin" / "cellwalk", HERE.parents[1] / "cellwalk"]


def program() -> Optional[str]:
    """The path of the program, or None."""
    for place in PLACES:
        if place.is_file() and os.access(place, os.X_OK):
            return str(place)
    return shutil.which("cellwalk")


def main() -> NoReturn:
    found = program()
    if found is None:
        sys.exit("cellwalk: the program is not there: install the package cellwalk, or the module by pip")
    os.execv(found, [found, *sys.argv[1:]])


if __name__ == "__main__":
    main()
