#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A filter for Doxygen, which reads pages otherwise than GitHub does: python3 docs/page_filter.py PAGE, in the root of the repository.

- README.md becomes the first page; those of folders are pages like others. Its headings are not sections, which would come before all pages in the tree.
- Headings get labels, since Doxygen knows those of GitHub neither within a page nor from another one. A label that is not there is a
  warning, so links are checked here too.
- <!-- site: TEXT --> is TEXT on the site, if that has the page of a run (scripts/docs.sh), to which such texts lead.
- Pictures are named from the root, where Doxygen looks for them.
- Links to public headers lead to their pages. Other files of the repository are in the folder files/ of the site, as text (scripts/docs.sh
  copies those to which a page leads); folders have no page, so what leads to them is plain text.
"""

import os
import re
import sys
from pathlib import Path

PICTURE = re.compile(r"(!\[[^\]]*\]\()([^)\s:]+)\)")
LINK = re.compile(r"(?<!!)\]\(([^)\s#]*\.md)?#([\w-]+)\)")
FILE = re.compile(r"(?<!!)\[((?:[^\[\]]|`[^`]*`)*)\]\(([^)\s#:@]+)\)")
FOR_SITE = re.compile(r"<!-- site: (.*?) -->")
LIVE = "live/"  # of the site
HAS_LIVE = Path("build/docs/live/aorta.html").exists()
HEADERS = "include/"


def anchor(heading):
    """The anchor that GitHub gives a heading."""
    text = re.sub(r"<!--.*?-->", "", heading)
    text = re.sub(r"[`*_]|\[([^\]]*)\]\([^)]*\)", r"\1", text).strip().lower()
    return re.sub(r" ", "-", re.sub(r"[^\w\- ]", "", text))


def label(page, name):
    """One that no other page has."""
    return f"{re.sub(r'[^a-zA-Z0-9]', '-', os.path.normpath(page))}-{name}"


def filtered(page, text):
    def link(match):
        target = os.path.join(os.path.dirname(page), match[1]) if match[1] else page
        return f"](#{label(target, match[2])})"

    def file(match):
        path = os.path.normpath(os.path.join(os.path.dirname(page), match[2]))
        if path.endswith(".md") or match[2].startswith(LIVE):
            return match[0]
        if os.path.isdir(path):
            return match[1]
        if path.startswith(HEADERS):
            return f"[{match[1]}](@ref {path.removeprefix(HEADERS)})"
        return f"[{match[1]}](files/{path}{'' if path.endswith('.webp') else '.txt'})"

    def picture(match):
        return f"{match[1]}{os.path.normpath(os.path.join(os.path.dirname(page), match[2]))})"

    lines, in_code, is_first = [], False, True
    for line in text.split("\n"):
        if line.startswith("```"):
            in_code = not in_code
        heading = re.match(r"(#{1,4}) (.*)$", line)
        if is_first and heading:  # the title of the page, which has a label
            line += " {#mainpage}" if page == "README.md" else ""
        elif heading and not in_code:
            name = label(page, anchor(heading[2]))
            line = f"@anchor {name}\n<h2>{heading[2]}</h2>\n" if page == "README.md" else f"{line.rstrip()} {{#{name}}}"
        is_first = is_first and not heading
        if not in_code:
            line = FOR_SITE.sub(r"\1" if HAS_LIVE else "", PICTURE.sub(picture, FILE.sub(file, LINK.sub(link, line))))
        lines.append(line)
    return "\n".join(lines)


if __name__ == "__main__":
    print(filtered(os.path.relpath(sys.argv[1]), Path(sys.argv[1]).read_text(encoding="utf-8")), end="")
