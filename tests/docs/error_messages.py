# SPDX-License-Identifier: LGPL-3.0-or-later
"""Finds the texts of errors in the sources: the longest fixed part of each message."""

import re
from pathlib import Path

CALL = re.compile(r"\b(?:fail|refuse|damaged|Error|refuse_row|explain|throw_at)\s*\(")
LITERAL = re.compile(r'"((?:\\.|[^"\\\n])*)"')
HOLE = re.compile(r"\{[^{}]*\}")
SHORTEST = 9  # letters: shorter parts of messages say nothing by themselves


def calls(text):
    """The arguments of each call that throws or reports an error."""
    for match in CALL.finditer(text):
        depth, i, quoted = 1, match.end(), False
        while depth > 0 and i < len(text):
            c = text[i]
            if quoted:
                i += c == "\\"
                quoted = c != '"'
            elif c == '"':
                quoted = True
            else:
                depth += (c == "(") - (c == ")")
            i += 1
        yield match.start(), text[match.end():i - 1]


def unescaped(literal):
    return literal.replace('\\"', '"').replace("\\\\", "\\").replace("\\n", "\n")


def fixed_part(arguments):
    """The longest piece of the message that is the same every time, or None."""
    joined = re.sub(r'"\s*\n?\s*"', "", arguments)
    pieces = []
    for literal in LITERAL.findall(joined):
        pieces += HOLE.split(unescaped(literal))
    longest = max(pieces, key=len, default="").strip(" :;,'\"()")
    return longest if len(longest) >= SHORTEST else None


def messages(root):
    """(file, line, fixed part) of every error in src/."""
    for path in sorted(Path(root, "src").rglob("*")):
        if path.suffix not in {".h", ".cpp"}:
            continue
        text = path.read_text(encoding="utf-8")
        for offset, arguments in calls(text):
            part = fixed_part(arguments)
            if part:
                yield path.relative_to(root), text.count("\n", 0, offset) + 1, part
