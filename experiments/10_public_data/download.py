#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Downloads the public meshes of the audit that lie in repositories on GitHub, in the version that was judged. Nothing is downloaded twice.

usage: download.py DIR

Files that come with packages of Debian are named at the end: libcgal-demo has them in data.tar.gz, gmsh-doc as aneurysm_data.stl.gz.
"""

import hashlib
import sys
import urllib.parse
import urllib.request
from pathlib import Path

from sources import files_of, index, read_sources


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    there = index(folder)
    for source in read_sources():
        for name, path, sha256 in files_of(source):
            if sha256 in there:
                continue
            if "repository" not in source:
                print(f"{name}: in the package {source['package']} {source['version']}, as {path}")
                continue
            url = f"https://raw.githubusercontent.com/{source['repository']}/{source['commit']}/{urllib.parse.quote(path)}"
            try:
                with urllib.request.urlopen(url, timeout=60) as answer:
                    data = answer.read()
            except OSError as error:
                sys.exit(f"download.py: {url}: {error}")
            if hashlib.sha256(data).hexdigest() != sha256:
                sys.exit(f"download.py: {url}: not the file that was judged")
            (folder / name).write_bytes(data)
            print(f"{name}: {len(data):,} bytes, {source['repository']}, licence: {source['licence']}")


if __name__ == "__main__":
    main()
