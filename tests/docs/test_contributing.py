#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""The commands of CONTRIBUTING.md and README.md that take too long to be run: scripts, options, presets, targets and tests exist.

usage: test_contributing.py ROOT BUILD_DIR
"""

import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

FEWEST = 12  # commands, so that a page that cannot be read does not pass
BLOCK = re.compile(r"```sh\n(.*?)```", re.DOTALL)
LABELS = {"long", "data"}  # of tests that a build may lack


def commands_of(text):
    for block in BLOCK.findall(text):
        for line in block.splitlines():
            for command in re.split(r"\s&&\s", line.split(" #")[0]):
                words = shlex.split(command)
                while words and ("=" in words[0] or words[0] == "sudo"):
                    words.pop(0)
                if words:
                    yield words


class Build:
    def __init__(self, root, folder):
        presets = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
        self.presets = {kind: {p["name"] for p in presets[f"{kind}Presets"]} for kind in ("configure", "build", "test")}
        self.targets = self.lines("ninja", "-C", folder, "-t", "targets", "all")
        self.targets = {line.split(":")[0] for line in self.targets}
        self.tests = re.findall(r"Test +#\d+: (\S+)", "\n".join(self.lines("ctest", "--test-dir", folder, "-N")))

    @staticmethod
    def lines(*words):
        return subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()

    def flaw(self, words):
        """What is wrong with a command of cmake or ctest, or None."""
        options = dict(zip(words, words[1:]))
        kind = "test" if words[0] == "ctest" else "build" if "--build" in words else "configure"
        preset, target, pattern = options.get("--preset"), options.get("--target"), options.get("-R")
        if preset and preset not in self.presets[kind]:
            return f"there is no {kind} preset {preset}"
        if target and target not in self.targets:
            return f"there is no target {target}"
        if pattern and not any(re.search(pattern, test) for test in self.tests):
            return f"no test has a name like {pattern}"
        return None


def flaw_of_script(root, words, build):
    script = root / words[0]
    if not script.is_file() or not script.stat().st_mode & 0o111:
        return "is not there, or cannot be executed"
    text = script.read_text(encoding="utf-8")
    for word in words[1:]:
        if word.startswith("--") and word not in text:
            return f"has no option {word}"
    options = dict(zip(words, words[1:]))
    if "-L" in options and options["-L"] not in LABELS:
        return f"there is no label {options['-L']}"
    if "--for" in options and not re.search(rf"\b{options['--for']}\b", text):
        return f"has no purpose {options['--for']}"
    if "-R" in options:
        return build.flaw(["ctest", "-R", options["-R"]])
    return None


def flaw(root, words, build):
    if words[0] in ("cmake", "ctest"):
        return build.flaw(words)
    if re.match(r"(\./)?(scripts|paper|experiments)/", words[0]):
        return flaw_of_script(root, words, build)
    return None


def main():
    root, build = Path(sys.argv[1]), Build(Path(sys.argv[1]), sys.argv[2])
    problems, count = [], 0
    for page in ("CONTRIBUTING.md", "README.md"):
        for words in commands_of((root / page).read_text(encoding="utf-8")):
            count += 1
            if what := flaw(root, words, build):
                problems.append(f"{page}: {shlex.join(words)}: {what}")
    if count < FEWEST:
        problems.append(f"only {count} commands can be read")
    for bad in (["cmake", "--preset", "fast"], ["cmake", "--build", "--preset", "dev", "--target", "test_nothing"], ["scripts/none.sh"],
                ["ctest", "--preset", "dev", "-R", "^NoSuchTest"], ["scripts/test.sh", "--no-such-option"]):
        if not flaw(root, bad, build):
            problems.append(f"the check overlooks {shlex.join(bad)}")
    print("\n".join(problems))
    print(f"{count} commands, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
