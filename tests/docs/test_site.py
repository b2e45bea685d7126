#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks what makes the documentation site out of Doxygen's: the index of pages, the filter of pages, and colours, which are those of the pictures.

usage: test_site.py ROOT
"""

import json
import re
import sys
import tempfile
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "docs")]
import index_pages
import page_filter

PAGE = """<div><div class="title">Bodies with a radius: the theory </div></div><div class="contents"><div class="textblock"><p>Ropes are thick.</p>
<h1><a class="anchor" id="near"></a>
The nearest wall</h1><p>Gymnasium, gymnasium &amp; slit<code>_share</code>.</p><script>var nothing;</script></div></div><p>footer</p>"""
OTHER = '<div><div class="title">Start</div></div><div class="contents"><p>One gymnasium, and a rope.</p></div>'
LISTED = '<div class="directory"><a href="radius.html">Bodies</a><a href="start.html">Start</a></div>'
LETTERS = "abcdefghijklmnopqrstuvwxyz"


def rows_of(file):
    """The rows of a file of Doxygen's search, ours and its own."""
    text = re.sub(r"/\*.*?\*/", "", file.read_text(encoding="utf-8")).partition("=")[2].rpartition(";")[0]
    return json.loads(re.sub(r",(\s*\])", r"\1", text.replace("'", '"')))


def check_index():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "search").mkdir()
        for page, text in (("radius.html", PAGE), ("start.html", OTHER), ("pages.html", LISTED)):
            (folder / page).write_text(text, encoding="utf-8")
        (folder / "search" / "searchdata.js").write_text(f'var indexSectionsWithContent =\n{{\n  0: "{LETTERS}"\n}};\n', encoding="utf-8")
        for number, letter in enumerate(LETTERS):
            (folder / "search" / f"all_{number:x}.js").write_text(f"var searchData=\n[\n  ['{letter}name_0',['{letter}name',['../x.html',1,'x']]]\n];\n", encoding="utf-8")
        first = index_pages.index(folder)
        before = {file.name: file.read_text(encoding="utf-8") for file in (folder / "search").iterdir()}
        yield first == index_pages.index(folder) and before == {file.name: file.read_text(encoding="utf-8") for file in (folder / "search").iterdir()}, "a second time changes nothing"
        yield first[0] == 2, "two pages"
        found = {}
        for file in (folder / "search").glob("all_*.js"):
            for key, row in rows_of(file):
                found.setdefault(key.rpartition("_")[0], []).append(row)
        targets = lambda key: [target[0] for row in found.get(key, []) for target in row[1:]]
        yield targets("gymnasium") == ["../radius.html#near", "../start.html"], "the section that has a word most often comes first"
        yield targets("radius_3a_20the_20theory") == ["../radius.html"], "titles are found from each of their words on"
        yield targets("wall") == ["../radius.html#near"], "headings, too"
        yield "../radius.html#near" in targets("slit_5fshare") or "../radius.html#near" in targets("slit"), "words of code"
        yield not targets("nothing") and not targets("footer"), "scripts, and what stands outside of the page, are not found"
        yield targets("gname") == ["../x.html"], "names are found as before"


def check_filter():
    page_filter.HAS_LIVE = True
    text = page_filter.filtered("README.md", "# Title\n\n## A part\n\n<!-- site: [Replay](live/run.html) -->\n")
    yield "## " not in text and "<h2>A part</h2>" in text and "@anchor README-md-a-part" in text, "README has no sections"
    yield "[Replay](live/run.html)" in text and "<!--" not in text, "what is for the site is shown there"
    page_filter.HAS_LIVE = False
    yield "Replay" not in page_filter.filtered("README.md", "<!-- site: [Replay](live/run.html) -->\n"), "and is left out where there is no such page"
    yield "## A part {#docs-x-md-a-part}" in page_filter.filtered("docs/x.md", "# Title\n\n## A part\n"), "other pages have sections"


def check_colours():
    number = r"([\d.]+)"
    bodies = (ROOT / "src/drawing/bodies.cpp").read_text(encoding="utf-8")
    css = (ROOT / "docs/site.css").read_text(encoding="utf-8")
    viewer = (ROOT / "viewer/src/colours.js").read_text(encoding="utf-8")
    animation = (ROOT / "scripts/animate.py").read_text(encoding="utf-8")
    for name in ("wall", "catheter", "particle", "contact", "body"):
        parts = re.search(rf"m\.(?:environment\.)?{name} = drawing\.add_material\(\{{\{{{number}, {number}, {number}", bodies).groups()
        colour = "#" + "".join(f"{int(255 * float(part)):02x}" for part in parts)
        near = lambda other: all(abs(int(colour[i:i + 2], 16) - int(other[i:i + 2], 16)) <= 1 for i in (1, 3, 5))
        yield near(re.search(rf"--{name}: (#\w+);", css)[1]), f"site.css: {name} is {colour}"
        if name != "body":
            yield near(re.search(rf"\b{name}: '(#\w+)'", viewer)[1]), f"viewer/src/colours.js: {name} is {colour}"
        if name not in ("body", "particle"):
            yield f"({', '.join(parts)})" in animation, f"animate.py: {name} is {parts}"


def main():
    results = [*check_index(), *check_filter(), *check_colours()]
    failed = [what for ok, what in results if not ok]
    print("\n".join(f"not so: {what}" for what in failed))
    print(f"site: {len(results)} checks, {len(failed)} failed")
    return 1 if failed or len(results) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
