#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Counts the links of a folder of HTML pages, and names those that lead to no page or to no place in it. Links to other sites are not followed.

usage: check_links.py DIR

Exit code 1 if there is one.
"""

import sys
from collections import defaultdict
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag, urlsplit


class Page(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.places.update(v for k, v in attrs if k == "id" or (tag == "a" and k == "name"))
        for name in ("href", "src"):
            if values.get(name):
                self.links.append(values[name])


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = Path(sys.argv[1]).resolve()
    pages = {path: Page(path.read_text(encoding="utf-8", errors="replace")) for path in sorted(folder.rglob("*.html"))}
    count, dead = 0, defaultdict(list)
    for path, page in pages.items():
        for link in page.links:
            if urlsplit(link).scheme or link.startswith("//"):
                continue
            count += 1
            name, place = urldefrag(link)
            target = (path.parent / unquote(name.partition("?")[0])).resolve() if name else path
            if not target.is_file() or (place and target in pages and unquote(place) not in pages[target].places):
                dead[link].append(path.relative_to(folder))
    for link, where in sorted(dead.items()):
        print(f"{where[0]}: leads nowhere: {link}" + (f" ({len(where)} times)" if len(where) > 1 else ""), file=sys.stderr)
    print(f"{count:,} links in {len(pages):,} pages, {sum(map(len, dead.values()))} dead")
    return 1 if dead else 0


if __name__ == "__main__":
    sys.exit(main())
