#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks README.md and all pages of docs/: relative links and their anchors, the commands they name, and what commands print.

usage: test_pages.py ROOT PROGRAM [--long] [OPTIONAL PARTS THAT ARE MISSING ...]
       test_pages.py ROOT PROGRAM --tutorials

- Links lead to files of the repository, and to headings where they have an anchor. docs/README.md leads to all pages.
- `cellwalk COMMAND --option` anywhere, examples in the help included, names a command and options that its --help knows.
- A block ```console is run, page by page in one folder: what stands after `$ ` is a command, what follows is what it prints, where a line of
  `...` stands for any lines. `$ cat FILE` makes FILE of what follows if it is not there; two tutorials have their files in data.
  `$ export NAME=VALUE` holds for the rest of the page. A block after <!-- needs PART PART --> is left out where
  one of these parts is missing; one after <!-- not run --> always. One after <!-- long --> or <!-- long needs PART -->
  is run with --long, and nothing else then. data/ and examples/ are those of the repository, build/release is the
  folder of the program.
- With --tutorials, the pages in docs/tutorials are run and nothing else; no part may be missing.
- A picture that the commands of a page draw, and that the page shows from docs/images, is the one there. For the picture of a run,
  NAME/picture.png, that is gallery_NAME.png, which has half its width and height.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pictures

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"```.*?```|`[^`\n]*`", re.DOTALL)
FOR_SITE = re.compile(r"<!-- site: .*? -->")  # its links lead to what the site alone has (docs/page_filter.py)
CONSOLE = re.compile(r"(?:<!-- ([^>]*?) -->\n+)?```console\n(.*?)```", re.DOTALL)
NAMED = re.compile(r"cellwalk ([a-z]\w*)((?: [^`\n|;&<>]*)?)")
FILES_OF = {"tutorial.md": "data/tutorial", "paper.md": "data/paper"}
FEWEST = {"links": 60, "options": 15, "commands": 8, "pictures": 2}  # so that a test that finds nothing does not pass
FEWEST_LONG = {"commands": 10, "pictures": 10}
FEWEST_TUTORIALS = {"commands": 20, "pictures": 2}


def anchor(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"<!--.*?-->", "", heading)
    text = re.sub(r"[`*_]|\[([^\]]*)\]\([^)]*\)", r"\1", text).strip().lower()
    return re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", text))


def anchors_of(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.DOTALL)
    return {anchor(heading) for heading in re.findall(r"^#+ (.*)$", text, re.MULTILINE)}


def check_links(page, counts):
    for target in LINK.findall(FOR_SITE.sub("", CODE.sub("", page.read_text(encoding="utf-8")))):
        if re.match(r"[a-z]+:", target):
            continue
        counts["links"] += 1
        name, _, fragment = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists():
            yield f"{page.name}: leads to {target}, which does not exist"
        elif fragment and fragment not in anchors_of(file):
            yield f"{page.name}: {target}: there is no such heading"


def check_index(root, pages):
    index = root / "docs" / "README.md"
    linked = {(index.parent / target.partition("#")[0]).resolve() for target in LINK.findall(index.read_text(encoding="utf-8"))}
    for page in pages:
        if page.is_relative_to(index.parent) and page != index and page not in linked:
            yield f"{page.name}: docs/README.md does not lead to it"


class Help:
    def __init__(self, program):
        self.program, self.known = program, {}

    def of(self, words):
        if words not in self.known:
            done = subprocess.run([self.program, *words, "--help"], capture_output=True, text=True)
            self.known[words] = done.stdout if done.returncode == 0 else None
        return self.known[words]


def check_options(name, pieces_of_code, help_texts, counts):
    for code in pieces_of_code:
        for command, rest in NAMED.findall(code.replace("\\\n", " ")):
            help_text = help_texts.of((command,))
            if help_text is None:
                yield f"{name}: cellwalk {command}: there is no such command"
                continue
            kind = re.match(r" ([a-z]\w*)", rest)
            if command == "generate" and kind:
                help_text = help_texts.of((command, kind[1])) or ""
            for option in re.findall(r"(?<=[\s\[])--[a-z][\w-]*", rest):
                counts["options"] += 1
                if option not in help_text and option != "--help":
                    yield f"{name}: cellwalk {command} has no option {option}"


def steps_of(block):
    """(command, lines that it prints) of a block."""
    steps = []
    for line in block.splitlines():
        if line.startswith("$ "):
            steps.append((line[2:], []))
        elif line.startswith("> "):
            steps[-1] = (steps[-1][0] + "\n" + line[2:], steps[-1][1])
        else:
            steps[-1][1].append(line)
    return steps


def is_printed(expected, said):
    pattern = "".join(r"(?:.*\n)*?" if line.strip() == "..." else re.escape(line.rstrip()) + r"[ ]*\n" for line in expected)
    return re.fullmatch(pattern, said) is not None


def prepare(folder, page, root, program):
    """Makes the root of a clone of a folder, as far as pages use it."""
    for name in ("data", "examples"):
        (folder / name).symlink_to(root / name)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(program.parent)
    (folder / "bin").mkdir()
    (folder / "bin" / "python3").symlink_to(sys.executable)
    if page.name in FILES_OF:
        shutil.copytree(root / FILES_OF[page.name], folder, dirs_exist_ok=True)


def pictures_drawn(folder):
    """What was drawn, and the name that docs/images has for it."""
    for drawn in sorted(Path(folder).glob("*.png")):
        yield drawn, drawn.name
    for drawn in sorted(Path(folder).glob("*/picture.png")):
        yield drawn, f"gallery_{drawn.parent.name}.png"


def is_drawn_again(drawn, shown):
    if drawn.name != "picture.png":
        return pictures.same_picture(drawn, shown)
    return pictures.same_pixels(pictures.halved(pictures.read_png(drawn)), pictures.read_png(shown))


def run_blocks(page, root, program, missing, counts, is_long):
    with tempfile.TemporaryDirectory() as folder:
        prepare(Path(folder), page, root, program)
        environment = dict(os.environ, PATH=f"{program.parent}:{folder}/bin:{os.environ['PATH']}")
        for mark, block in CONSOLE.findall(page.read_text(encoding="utf-8")):
            if mark == "not run" or mark.startswith("long") != is_long or missing.intersection(mark.removeprefix("long").strip().removeprefix("needs ").split()):
                continue
            for command, expected in steps_of(block):
                words = shlex.split(command, comments=True)
                if words[0] == "cat" and not Path(folder, words[1]).exists():
                    Path(folder, words[1]).parent.mkdir(parents=True, exist_ok=True)
                    Path(folder, words[1]).write_text("".join(line + "\n" for line in expected))
                    continue
                if words[0] == "export":
                    name, _, value = words[1].partition("=")
                    environment[name] = value.replace("$PWD", folder)
                    continue
                counts["commands"] += 1
                done = subprocess.run(["bash", "-c", command], cwd=folder, env=environment, capture_output=True, text=True)
                if done.returncode != 0 or not is_printed(expected, done.stdout):
                    yield f"{page.name}: $ {command}\n  exit code {done.returncode}, and prints\n{done.stdout}{done.stderr}"
        for drawn, name in pictures_drawn(folder):
            shown = root / "docs" / "images" / name
            if f"images/{name})" in page.read_text(encoding="utf-8"):
                counts["pictures"] += 1
                if not is_drawn_again(drawn, shown):
                    yield f"{page.name}: {shown.name} is not what its command draws: draw it again"


def main():
    root, program, missing = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), set(sys.argv[3:])
    is_long, only_tutorials = "--long" in missing, "--tutorials" in missing
    only_runs = is_long or only_tutorials
    fewest_of = FEWEST_LONG if is_long else FEWEST_TUTORIALS if only_tutorials else FEWEST
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    if only_tutorials:
        pages = sorted((root / "docs" / "tutorials").glob("*.md"))
    help_texts, problems, counts = Help(program), [], dict.fromkeys(fewest_of, 0)
    for page in pages:
        problems += run_blocks(page, root, program, missing, counts, is_long)
        if only_runs:
            continue
        problems += check_links(page, counts)
        problems += check_options(page.name, CODE.findall(page.read_text(encoding="utf-8")), help_texts, counts)
    if not only_runs:
        problems += check_index(root, pages)
    commands = "" if only_runs else help_texts.of(()).partition("Subcommands:")[2]
    for command in re.findall(r"^  (\w+)  ", commands, re.MULTILINE):
        examples = help_texts.of((command,)).partition("Examples:")[2].partition("\n\n")[0].splitlines()
        problems += check_options(f"cellwalk {command} --help", examples, help_texts, counts)
    problems += [f"only {counts[what]} {what} were found" for what, fewest in fewest_of.items() if counts[what] < fewest]
    print("\n".join(problems))
    print(f"pages: {len(pages)} pages, {', '.join(f'{n} {what}' for what, n in counts.items())}, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
