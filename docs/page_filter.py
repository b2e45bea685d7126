#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""A filter for Doxygen: writes code spans of a page as HTML, since Doxygen takes backslashes and quotes in them for its own."""

import re
import sys
from pathlib import Path

SPECIAL = str.maketrans({c: f"&#{ord(c)};" for c in "&<>\\\"'@#%$*_~`"})


def html(match):
    return f"<code>{match[2].replace(chr(92) + '|', '&#124;').translate(SPECIAL).replace('&#38;#124;', '&#124;')}</code>"


text = Path(sys.argv[1]).read_text(encoding="utf-8")
print("\n".join(re.sub(r"(`{1,2})(?! )(.*?)(?<!`)\1(?!`)", html, line) if line.startswith("| ") else line
                for line in text.split("\n")), end="")
