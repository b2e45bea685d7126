#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Times the same moves of particles from Python and from C++, round by round in turns, and prints the ratio.

usage: compare.py MOVES_PROGRAM [--moves N] [--rounds N] [--cells N]

One thread each; processor time, so that other load on the machine counts less. Python calls Particles.move, which allocates its results; C++ fills arrays that it has. Ends with an error if what
came out differs.
"""

import argparse
import statistics
import subprocess
import sys
import tempfile
import time

import numpy

import cellwalk


def points(rng, count, cells, step):
    """Starts in space-filling order of unit cubes, as bodies lie, and two sets of targets about them."""
    starts = rng.uniform(0.25, cells - 0.25, (count, 3))
    cubes = starts.astype(numpy.int64)
    starts = starts[numpy.lexsort((cubes[:, 0], cubes[:, 1], cubes[:, 2]))]
    return numpy.concatenate([starts] + [starts + rng.uniform(-step, step, starts.shape) for _ in range(2)])


def compare(program, count, rounds, cells, step):
    """Medians of nanoseconds a move: of Python, of C++; and the share of rows that met a wall."""
    environment = cellwalk.Environment.generate("tets", cells=cells, jitter=0.1)
    table = points(numpy.random.default_rng(1), count, cells, step)
    particles = cellwalk.Particles(environment, table[:count])
    python, cpp = [], []
    contacts = crossings = 0
    with tempfile.NamedTemporaryFile() as file:
        table.tofile(file.name)
        with subprocess.Popen([program, str(cells), file.name], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              text=True) as other:
            for i in range(2 * rounds + 2):
                targets = table[(1 + i % 2) * count:(2 + i % 2) * count]
                start = time.process_time()
                motions = particles.move(targets, threads=1)
                seconds = time.process_time() - start
                other.stdin.write("\n")
                other.stdin.flush()
                line = other.stdout.readline()
                if i >= 2:  # the first two go to the targets' neighbourhood, and find the pages
                    python.append(seconds * 1e9 / count)
                    cpp.append(float(line))
                contacts += len(motions.contacts)
                crossings += motions.counts["crossings"]
            other.stdin.close()
            outcome = [int(word) for word in other.stdout.read().split()]
    if outcome != [contacts, crossings, int(particles.cells.sum())]:
        sys.exit(f"compare.py: Python and C++ differ: {[contacts, crossings, int(particles.cells.sum())]}, {outcome}")
    return statistics.median(python), statistics.median(cpp), contacts / (count * (2 * rounds + 2))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="the C++ program python_moves")
    parser.add_argument("--moves", type=int, default=10**6)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--cells", type=int, default=25)
    parser.add_argument("--most", type=float, help="fail if a ratio is above this")
    options = parser.parse_args()
    print(f"{options.moves} moves in {6 * options.cells ** 3} tetrahedra, ns a move, medians of {2 * options.rounds} rounds")
    print("step    Python       C++   ratio  contacts")
    worst = 0
    for step in (0.01, 0.1, 1.0):
        python, cpp, contacts = compare(options.program, options.moves, options.rounds, options.cells, step)
        worst = max(worst, python / cpp)
        print(f"{step:<6} {python:7.1f}   {cpp:7.1f}   {python / cpp:5.3f}   {100 * contacts:.2f} %")
    if options.most and worst > options.most:
        sys.exit(f"compare.py: Python takes {worst:.2f} times as long, more than {options.most}")


if __name__ == "__main__":
    main()
