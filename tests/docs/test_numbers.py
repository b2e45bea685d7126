#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the measured numbers of README.md and of all pages of docs/ against their sources, which tests/docs/numbers/PAGE.txt names.

usage: test_numbers.py ROOT

A number looks measured if it has a unit, is the count of something that is tried out, is written with a comma for thousands, or stands in a table
(LOOKS_MEASURED, CELL). Numbers in code and in addresses are none. numbers/README.txt and numbers/docs/... have an entry for each of them:

    takes {13.7} to {20.8} ns
      experiments/01_figure_8/README.md: | `cellwalk_triangle` | {13.7} | 16.7 | 17.9 | {20.8} |

The first line is a piece of the page, with its numbers in braces. The lines below are pieces of sources, from which these numbers follow: each is
the one in the same place, or is computed as a line `= a / 1000, a + b` says, in which a, b, c, ... are the numbers of the sources. It may
have fewer digits; then it has to be the rounded one. A piece stands in its file exactly once, on a page within a paragraph, an item of a list or a
table; white space does not count.

Other entries have no source. If their pieces have no braces, they are for all other numbers of the paragraph, item or table:

    | 0.05 | 1.9 us |
      measured: bench_radius      (the page is the record of a run: its section names this program, script or test, which exists)
    {48} bytes per vertex and step
      given: two points of three doubles      (nothing was measured, for this reason; without braces for tables only)

An entry that covers no number is an error, as is a number in the braces of two entries. A page that leads to the results need not repeat them:
prefer a link to an entry.
"""

import functools
import re
import sys
from pathlib import Path

REGISTRY = "tests/docs/numbers/"
NUMBER = r"\d+(?:[,']\d{3})*(?:\.\d+)?(?:\^\d+)?"
UNIT = (r"ns|us|µs|ms|s|seconds?|min|minutes?|h|hours?|%|per cent|percent|[kKMG]i?B|bytes?|times|fold|thousand|millions?|instructions?|"
        r"moves|walks|sweeps|motions|contacts|escapes|jobs|changes|replacements|questions|queries")
LOOKS_MEASURED = re.compile(
    rf"(?<![\w.^/-]){NUMBER}(?:(?:,| to| and| or|, and| of)? {NUMBER})* ?\**(?:{UNIT})(?!\w)|"
    rf"(?<![\w.^/-]){NUMBER}(?: to {NUMBER})? of (?:\w+ )?\d+,\d{{3}}|\b\d{{1,3}}(?:,\d{{3}})+")
CELL = re.compile(rf"(?:[\s*();,/~-]|\bto\b|\band\b|\bof\b|(?:{UNIT})(?!\w)|{NUMBER})+")


class Block:
    """A paragraph, an item of a list, or a table: its text in one line, and the places of its numbers that look measured."""

    def __init__(self, lines, section):
        self.section, self.is_table = section, lines[0].startswith("|")
        self.text = squeeze("\n".join(lines))
        self.measured = sorted(measured(self.text, self.is_table))


def squeeze(text):
    return re.sub(r"\s+", " ", text).strip()


def hidden(text):
    """The text without code and addresses, of the same length."""
    return re.sub(r"`[^`]*`|\]\([^)]*\)|https?:\S*", lambda match: "`" * len(match[0]), text)


def measured(text, is_table):
    text, spans = hidden(text), set()
    for match in LOOKS_MEASURED.finditer(text):
        spans |= {number.span() for number in re.compile(NUMBER).finditer(text, *match.span())}
    if is_table:
        for cell in re.finditer(r"[^|]+", text):
            if CELL.fullmatch(cell[0]):
                spans |= {number.span() for number in re.compile(NUMBER).finditer(text, *cell.span())}
    return spans


def blocks_of(page):
    """The blocks of a page, without code in fences and comments."""
    page = re.sub(r"<!--.*?-->", "", page, flags=re.DOTALL)
    blocks, lines, section, in_code = [], [], [], False

    def close():
        if lines:
            blocks.append(Block(lines, section))
        lines.clear()

    for line in page.splitlines():
        if line.startswith("#") and not in_code:
            close()
            section = []
        section.append(line)
        if line.lstrip().startswith("```"):
            close()
            in_code = not in_code
        elif in_code or not line.strip() or line.startswith("#"):
            close()
        else:
            if re.match(r"\s*(?:[-*]|\d+\.) ", line) or line.startswith("|") != bool(lines and lines[0].startswith("|")):
                close()
            lines.append(line)
    close()
    return blocks


class Piece:
    """A piece of a file, and the places of numbers in braces in it."""

    def __init__(self, text):
        parts = re.split(rf"\{{({NUMBER})\}}", squeeze(text))
        self.text, self.numbers = "", []
        for index, part in enumerate(parts):
            if index % 2:
                self.numbers.append((len(self.text), len(self.text) + len(part)))
            self.text += part

    def values(self):
        return [self.text[start:end] for start, end in self.numbers]

    def starts_in(self, text):
        """Where it stands in a text, and not within a longer word or number."""
        before = r"(?<![\w.])" if self.text[:1].isalnum() else ""
        after = r"(?!\w|[.,]\d)" if self.text[-1:].isalnum() else ""
        return [match.start() for match in re.finditer(before + re.escape(self.text) + after, text)]


class Entry:
    def __init__(self, name, line, text):
        self.where, self.page = f"{name}:{line}", name.removeprefix(REGISTRY).removesuffix(".txt") + ".md"
        self.piece, self.sources, self.formula, self.measured_by, self.given = Piece(text), [], None, None, None

    def add(self, text):
        kind, _, rest = text.partition(": ")
        if text.startswith("= "):
            self.formula = text[2:]
        elif kind == "measured":
            self.measured_by = rest
        elif kind == "given":
            self.given = rest
        else:
            self.sources.append((kind, Piece(rest)))


def entries_of(files):
    entries = []
    for name in sorted(name for name in files if name.startswith(REGISTRY)):
        for line, text in enumerate(files[name].splitlines(), 1):
            if text.startswith(" "):
                entries[-1].add(text.strip())
            elif text and not text.startswith("# "):
                entries.append(Entry(name, line, text))
    return entries


def value(number):
    base, _, power = re.sub("[,']", "", number).partition("^")
    return float(base) ** float(power or 1)


def is_rounded(number, exact):
    """Whether a number as written is a value, rounded to as many digits."""
    digits = len(number.partition(".")[2])
    return abs(value(number) - exact) <= 0.5000001 * 10.0**-digits


def computed(entry, numbers):
    if entry.formula is None:
        return numbers
    names = {chr(ord("a") + index): number for index, number in enumerate(numbers)}
    names |= {"min": min, "max": max, "round": round, "__builtins__": {}}
    return [eval(part, names) for part in re.split(r",(?![^(]*\))", entry.formula)]


class Checker:
    """Of the texts of files by their names: the pages, their sources, and the entries."""

    def __init__(self, files, has_program):
        self.files, self.has_program, self.problems = files, has_program, []
        self.pages = {name: blocks_of(text) for name, text in files.items() if name == "README.md" or name.startswith("docs/")}
        self.covered = {name: {} for name in self.pages}
        # Those for what is left of a block come last.
        for entry in sorted(entries_of(files), key=lambda entry: not entry.piece.numbers):
            self.problems += [f"{entry.where}: {problem}" for problem in self.check(entry)]
        self.problems += [f"{name}: {text}: this number has no entry" for name, text in self.left()]

    def check(self, entry):
        if entry.page not in self.pages:
            yield f"there is no page {entry.page}"
            return
        places = [(block, start) for block in self.pages[entry.page] for start in entry.piece.starts_in(block.text)]
        if len(places) != 1:
            yield f"{entry.page} has this piece {len(places)} times: {entry.piece.text}"
            return
        block, start = places[0]
        named = [(start + first, start + last) for first, last in entry.piece.numbers]
        if bool(entry.sources) + bool(entry.measured_by) + bool(entry.given) != 1:
            yield "has to have sources, or `measured:` or `given:` with a reason"
        elif entry.sources:
            yield from self.cover(entry, block, named)
            yield from self.compare(entry)
        else:
            yield from self.cover(entry, block, named or block.measured)
            if entry.given and not named and not block.is_table:
                yield "has to have its numbers in braces"
            if entry.measured_by and entry.measured_by not in squeeze("\n".join(block.section)):
                yield f"{entry.page}: the section does not name {entry.measured_by}"
            if entry.measured_by and not self.has_program(entry.measured_by):
                yield f"there is no {entry.measured_by}"

    def cover(self, entry, block, spans):
        covered = self.covered[entry.page].setdefault(id(block), set())
        if not spans or covered.issuperset(spans):
            yield "covers no number that no other entry covers"
        elif entry.piece.numbers and covered.intersection(spans):
            yield "covers numbers of another entry"
        covered |= set(spans)

    def compare(self, entry):
        numbers = []
        for name, piece in entry.sources:
            found = len(piece.starts_in(without_marks(self.files.get(name, ""))))
            if found != 1:
                yield f"{name} has this piece {found} times: {piece.text}"
                return
            numbers += [value(number) for number in piece.values()]
        expected, given = computed(entry, numbers), entry.piece.values()
        if len(expected) != len(given):
            yield f"{len(given)} numbers of the page, {len(expected)} of the sources"
        for number, exact in zip(given, expected):
            if not is_rounded(number, exact):
                yield f"{entry.page} has {number}, the source {exact:g}: {entry.piece.text}"

    def left(self):
        """The numbers that look measured and that no entry covers, with the text around each group of them."""
        for name, blocks in self.pages.items():
            for block in blocks:
                spans = [span for span in block.measured if span not in self.covered[name].get(id(block), ())]
                last = -100
                for start, end in spans:
                    if start > last + 40:
                        yield name, f"..{block.text[max(0, start - 40):end + 40]}.."
                        last = end


def without_marks(text):
    """The text of a page or a source file in one line, without the marks of comments."""
    return squeeze(re.sub(r"\n\s*(?:///?|#) ", "\n ", text))


def has_program(root, name):
    """Whether the repository has a script, a folder, a source, a program or a suite of tests of this name, or a command of the program."""
    if name.startswith("cellwalk "):
        return f"\n## {name.split()[1]}\n" in (root / "docs/commands.md").read_text(encoding="utf-8")
    suite = re.compile(rf"\bTEST\w*\({re.escape(name)},|_test\({re.escape(name.removeprefix('test_'))}\b")
    sources = [path for folder in ("tests", "experiments") for end in ("*.cpp", "CMakeLists.txt") for path in (root / folder).rglob(end)]
    return (root / name).exists() or any(path.stem == name or suite.search(path.read_text(encoding="utf-8")) for path in sources)


# What the test has to find in a small repository.
ENTRIES = REGISTRY + "docs/a.txt"
FILES = {
    "docs/a.md": """# A page

It takes 3.5 to 16.1 us in 10^6 cells, 7.5 % less than before.

## Measured

By `bench_b`, 12 walks.

| | ns |
|---|---|
| one | 5 |
""",
    "b.md": "The median\nis 3,500 ns, or at least 16.12 us. A hundred of 80 are left, before 86.5.",
    ENTRIES: """
takes {3.5} to {16.1} us
  b.md: The median is {3,500} ns, or at least {16.12} us.
  = a / 1000, b
{7.5} % less
  b.md: of {80} are left, before {86.5}
  = 100 * (b - a) / b
By `bench_b`
  measured: bench_b
| one |
  given: an example
"""}
FAULTS = [  # what happens, a file, a piece of it, what stands there instead, and what is said
    ("nothing", "b.md", "", "", ""),
    ("a number of the page", "docs/a.md", "16.1 us", "16.2 us", "0 times"),
    ("a digit before a number of the page", "docs/a.md", "7.5 %", "17.5 %", "0 times"),
    ("a digit after a number of the source", "b.md", "86.5.", "86.53.", "0 times"),
    ("a number of the source", "b.md", "3,500", "3,600", "0 times"),
    ("a number of the source, in its entry too", ("b.md", ENTRIES), "3,500", "3,600", "docs/a.md has 3.5, the source 3.6"),
    ("a number of the page, in its entry too", ("docs/a.md", ENTRIES), "16.1", "16.2", "docs/a.md has 16.2, the source 16.12"),
    ("a number that others are computed from", ("b.md", ENTRIES), "80", "79", "docs/a.md has 7.5, the source 8.67"),
    ("a number without its source", ENTRIES, "= a / 1000, b", "= a / 1000", "2 numbers of the page, 1 of the sources"),
    ("the source", "b.md", None, None, "0 times"),
    ("the sentence of the source", "b.md", "The median", "The mean", "0 times"),
    ("the sentence of the source, twice", "b.md", "", "The median is 3,500 ns, or at least 16.12 us. ", "2 times"),
    ("a new number", "docs/a.md", "before.", "before, and 5 GB.", "has no entry"),
    ("a new number in a table", "docs/a.md", "## Measured", "| | |\n|---|---|\n| two | 6 |\n\n## Measured", "has no entry"),
    ("a new paragraph beside one that was measured", "docs/a.md", "| | ns", "Of 1,000 tries none failed.\n\n| | ns", "has no entry"),
    ("the command, in another section", "docs/a.md", "By `bench_b`, 12", "By `bench_b`:\n\n## Other\n\n12", "has no entry"),
    ("a command of another section", ENTRIES, "given: an example", "measured: bench_a", "does not name bench_a"),
    ("a program", ENTRIES, "", "", "there is no bench_b"),
    ("a page", "docs/a.md", None, None, "there is no page docs/a.md"),
    ("a number that an entry is for", "docs/a.md", "| 5 |", "| x |", "covers no number"),
    ("the reason", ENTRIES, "  given: an example\n", "", "with a reason"),
    ("a reason for all numbers of a paragraph", ENTRIES, "measured: bench_b", "given: an example", "in braces"),
    ("two entries for a number", ENTRIES, "{7.5}", "{7.5} % less\n  given: twice\n{7.5}", "covers no number"),
    ("an entry more for two numbers", ENTRIES, "{7.5}", "to {16.1} us in {10^6}\n  given: twice\n{7.5}", "numbers of another entry"),
]


def faults_that_pass():
    for what, where, old, new, said in FAULTS:
        files = dict(FILES)
        for name in [where] if isinstance(where, str) else where:
            if old is None:
                del files[name]
            elif old not in files[name]:
                yield f"self-test: {what}: {name} does not have {old}"
            else:
                files[name] = files[name].replace(old, new, 1)
        problems = Checker(files, lambda name: what != "a program").problems
        if not (any(said in problem for problem in problems) if said else not problems):
            yield f"self-test: {what}: {problems or 'it passes'}"


def main():
    root = Path(sys.argv[1]).resolve()
    # The reference of the Python module is made of its docstrings.
    pages = [root / "README.md", *sorted(page for page in (root / "docs").rglob("*.md") if page.name != "python_reference.md")]
    files = {str(path.relative_to(root)): path.read_text(encoding="utf-8") for path in [*pages, *(root / REGISTRY).rglob("*.txt")]}
    for entry in entries_of(files):
        files |= {name: (root / name).read_text(encoding="utf-8") for name, _ in entry.sources if (root / name).is_file()}
    has = functools.cache(lambda name: has_program(root, name))
    problems = Checker(files, has).problems
    longer = {name: text + "\n\nIt takes 4.2 ns." if root / name in pages else text for name, text in files.items()}
    found = len(Checker(longer, has).problems) - len(problems)
    problems += faults_that_pass()
    if found != len(pages):
        problems.append(f"self-test: of {len(pages)} numbers that are new, one a page, {found} are found")
    print("\n".join(problems))
    print(f"numbers: {len(pages)} pages, {len(problems)} problems")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
