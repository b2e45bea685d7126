# SPDX-License-Identifier: LGPL-3.0-or-later
"""Tables of experiments: rows of CSV files, and Markdown."""

import csv
import math

# The kernels that experiments 02 and 05 compare.
EXACT = ["exact", "exact_signs", "adaptive", "epick", "lazy", "rational"]
ROUNDED = ["double", "simple_cartesian", "double_16u", "double_1e-9", "long_double", "double_double", "float"]
OF_EXPERIMENT_02 = {"adaptive", "epick", "simple_cartesian", "long_double", "double_double"}  # 05 has those of `cellwalk query`


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


def interval(failures, trials):
    """The 95 % confidence interval of a probability, as confidence_interval() of confidence.h has it."""
    if failures == 0:
        return 0.0, min(1.0, 3 / trials)
    if failures == trials:
        return 1 - min(1.0, 3 / trials), 1.0
    z, share = 1.959964, failures / trials
    centre, half = share + z * z / (2 * trials), z * math.sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials))
    return max(0.0, (centre - half) / (1 + z * z / trials)), min(1.0, (centre + half) / (1 + z * z / trials))


def per_million(failures, trials):
    """With its 95 % interval."""
    low, high = (f"{1e6 * x:,.0f}" if 1e6 * x >= 10 or x == 0 else f"{1e6 * x:.2g}" for x in interval(failures, trials))
    value = 1e6 * failures / trials
    return f"{value:,.0f} ({low} to {high})" if value >= 10 else f"{value:.2g} ({low} to {high})"


def table(header, lines, names=1):
    """A table in Markdown; all columns but the first ones, which hold names, are flush right."""
    rule = ["---"] * names + ["---:"] * (len(header) - names)
    return "\n".join("| " + " | ".join(map(str, cells)) + " |" for cells in [header, rule, *lines]) + "\n"
