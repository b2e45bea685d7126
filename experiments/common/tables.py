# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of experiments: rows of CSV files, and Markdown."""

import csv

# The kernels that experiments 02 and 05 compare.
EXACT = ["exact", "exact_signs", "lazy", "rational"]
ROUNDED = ["double", "double_1e-9", "double_1e-6", "float"]


def read_rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def read_rows_if_any(path):
    """No rows where there is no file: times, say, of a run that took none."""
    return read_rows(path) if path.exists() else []


def unique(values):
    """Each value once, in the order of the first ones."""
    return list(dict.fromkeys(values))


def share(count, total):
    """In per cent."""
    return "0" if int(count) == 0 else f"{100 * int(count) / int(total):.3g} %"


def table(header, lines, names=1):
    """A table in Markdown; all columns but the first ones, which hold names, are flush right."""
    rule = ["---"] * names + ["---:"] * (len(header) - names)
    return "\n".join("| " + " | ".join(map(str, cells)) + " |" for cells in [header, rule, *lines]) + "\n"
