#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Runs clang-tidy, by the rules of .clang-tidy, on the sources of the library and the program; any finding is a failure.

    scripts/check_tidy.py [FOLDER ...]      only sources in these folders of the project; src where none is named

Sources are looked at in batches, those of a layer together: most of the time goes into the headers of CGAL, which a batch needs once.
"""
import collections
import concurrent.futures
import json
import os
import re
import shutil
import subprocess
import sys

import check_sources
from check_sources import ROOT

BATCHES = ROOT / "build/tidy"


def batches(folders):
    """Sources of a layer that the compiler is called for in the same way, and how it is called."""
    together = collections.defaultdict(list)
    for source, command in check_sources.commands(folders):
        layer = source.relative_to(ROOT).parts[:2]
        together[layer, tuple(word for word in command if word != str(source))].append(source)
    return [(command, sorted(sources, key=instantiates_no_class)) for (_, command), sources in together.items()]


def instantiates_no_class(source):
    return "\ntemplate class " not in source.read_text(encoding="utf-8")


def findings(number, command, sources):
    """Looks at the sources together, those first that instantiate classes: other sources instantiate members of these again."""
    folder = BATCHES / str(number)
    folder.mkdir(parents=True)
    batch = folder / "batch.cpp"
    batch.write_text("".join(f'#include "{source}"\n' for source in sources))
    entry = {"directory": str(check_sources.BUILD), "file": str(batch), "arguments": [*command, str(batch)]}
    (folder / "compile_commands.json").write_text(json.dumps([entry]))
    # Warnings of gcc, which clang does not know, are no findings.
    tidy = ["clang-tidy", "-p", str(folder), "--quiet", f"--config-file={ROOT / '.clang-tidy'}",
            "--extra-arg=-Wno-unknown-warning-option", str(batch)]
    done = subprocess.run(tidy, capture_output=True, text=True)
    return "" if done.returncode == 0 else done.stdout or done.stderr


def main(names):
    if shutil.which("clang-tidy") is None:
        sys.exit("tidy: clang-tidy is missing; scripts/setup.sh --for ci installs it")
    check_sources.configure()
    shutil.rmtree(BATCHES, ignore_errors=True)
    folders = [(ROOT / name).resolve() for name in names or ["src"]]
    chosen = list(batches(folders))
    if not chosen:
        sys.exit(f"tidy: there is no source in {', '.join(names)}")
    chosen.sort(key=lambda batch: -len(batch[1]))  # the longest first, so that processors end together
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        said = "".join(pool.map(findings, range(len(chosen)), *zip(*chosen)))
    if said:
        print(said.replace(f"{ROOT}/", ""), file=sys.stderr)
        sys.exit(f"tidy: {len(set(re.findall(r'^.* (?:error|warning): .*$', said, re.MULTILINE)))} findings")
    print(f"tidy: {sum(len(sources) for _, sources in chosen)} sources in {len(chosen)} batches, without a finding")


if __name__ == "__main__":
    main(sys.argv[1:])
