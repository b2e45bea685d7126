#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Adds the pages to the search of a site by Doxygen, which finds names, and pages by the beginning of their titles.

usage: index_pages.py HTML_DIR

- Titles and headings are found from each of their words on: "radius: the theory" finds "Bodies with a radius: the theory".
- Each word of a page is found, and leads to the sections that have it, those that have it most often first.

What is added stands before the names in the files of Doxygen's own search (search/all_*.js), which the browser loads by the first letter of a search.
Those that were added before are replaced.
"""

import html
import json
import re
import sys
from collections import Counter, defaultdict
from html.parser import HTMLParser
from pathlib import Path

MOST_SECTIONS = 8      # that a word leads to
MOST_PAGES = 0.6       # a word that more of all pages have says nothing
SHORTEST = 3           # letters of a word that is searched for
WORD = re.compile(r"[^\W_]\w*")
BEGIN, END = "/* pages */\n", "/* names */\n"


class Page(HTMLParser):
    """The title of a page, its sections as (anchor, heading), and how often each has each word."""

    def __init__(self, text):
        super().__init__()
        self.title, self.sections, self.words = "", [("", "")], [Counter()]
        self.depth, self.in_title, self.heading, self.skip = 0, False, None, None
        self.feed(text)
        self.title = " ".join(self.title.split())
        self.sections[0] = ("", self.title)

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        if tag == "div":
            self.in_title = self.in_title or values.get("class") == "title"
            if self.depth > 0 or values.get("class") == "contents":
                self.depth += 1
        elif tag in ("script", "style", "svg"):
            self.skip = self.skip or tag
        elif self.depth > 0 and re.fullmatch(r"h[1-4]", tag):
            self.heading = [None, ""]
        elif self.heading and tag == "a" and values.get("class") == "anchor":
            self.heading[0] = values.get("id")

    def handle_endtag(self, tag):
        if tag == "div":
            self.in_title = False
            self.depth = max(0, self.depth - 1)
        elif tag == self.skip:
            self.skip = None
        elif self.heading and re.fullmatch(r"h[1-4]", tag):
            if self.heading[0]:
                self.sections.append((self.heading[0], " ".join(self.heading[1].split())))
                self.words.append(Counter())
            self.heading = None

    def handle_data(self, data):
        if self.skip:
            return
        if self.in_title:
            self.title += data
        elif self.heading:
            self.heading[1] += data
        elif self.depth > 0:
            self.words[-1].update(WORD.findall(data.lower()))


def key_of(text):
    """As convertToId() of Doxygen's search.js writes a search."""
    return "".join(c if re.match(r"[a-z0-9\u0080-\uffff]", c) else f"_{ord(c):02x}" for c in text.lower())


def entries(pages):
    """(what is searched for, what is shown, [(address, what stands beside it)]), headings first."""
    found = []
    for name, page in pages.items():
        for anchor, heading in page.sections:
            seen = set()
            for match in WORD.finditer(heading):
                word = match[0].lower()
                is_title = not anchor and match.start() == 0  # which Doxygen has
                if not (is_title or word in seen or len(word) < SHORTEST):
                    found.append((heading[match.start():], heading, [(f"{name}#{anchor}" if anchor else name, "" if not anchor else page.title)]))
                seen.add(word)
    places = defaultdict(list)
    for name, page in pages.items():
        for (anchor, heading), words in zip(page.sections, page.words):
            where = f"{page.title}: {heading}" if anchor else page.title
            for word, count in words.items():
                places[word].append((-count, name, f"{name}#{anchor}" if anchor else name, where))
    for word in sorted(places):
        if len(word) < SHORTEST or len({name for _, name, *_ in places[word]}) > max(MOST_SECTIONS, MOST_PAGES * len(pages)):
            continue
        best = sorted(places[word])[:MOST_SECTIONS]
        found.append((word, f"{word}, in pages", [(address, where) for _, _, address, where in best]))
    return found


def index(folder):
    """Adds to the search of a folder; returns the numbers of pages and of entries."""
    listed = re.findall(r'href="([^"#]+\.html)"', (folder / "pages.html").read_text(encoding="utf-8").partition('class="directory"')[2])
    pages = {name: Page((folder / name).read_text(encoding="utf-8")) for name in dict.fromkeys(["index.html", *listed]) if (folder / name).is_file()}
    data = (folder / "search" / "searchdata.js").read_text(encoding="utf-8")
    letters = re.search(r'0: "([^"]*)"', data)[1]
    lines = defaultdict(list)
    for number, (searched, shown, targets) in enumerate(entries(pages)):
        letter = searched[0].lower()
        if letter in letters:
            row = [html.escape(shown), *([f"../{address}", 1, html.escape(where)] for address, where in targets)]
            lines[letter].append("  " + json.dumps([f"{key_of(searched)}_p{number}", row]) + ",\n")
    for letter, added in lines.items():
        file = folder / "search" / f"all_{letters.index(letter):x}.js"
        text = re.sub(f"{re.escape(BEGIN)}.*{re.escape(END)}", "", file.read_text(encoding="utf-8"), flags=re.DOTALL)
        head, bracket, rest = text.partition("[\n")
        file.write_text(f"{head}{bracket}{BEGIN}{''.join(added)}{END}{rest}", encoding="utf-8")
    return len(pages), sum(map(len, lines.values()))


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    pages, added = index(Path(sys.argv[1]))
    if pages < 2 or added == 0:
        sys.exit(f"index_pages.py: {sys.argv[1]} has no pages")
    print(f"search finds {pages} pages by {added:,} words and headings")


if __name__ == "__main__":
    main()
