# SPDX-License-Identifier: LGPL-3.0-or-later
"""Cellwalk with Dask: motions of points, answered in chunks by the workers of a cluster.

usage: dask_moves.py [--moves N] [--chunk N] [--workers N] [--scheduler ADDRESS]

A million motions and two workers on this machine, unless told otherwise: --moves 100000000 takes longer, but no more memory. The answers
depend neither on the workers nor on their number.
"""

import argparse
import zlib

import cellwalk
import numpy
from distributed import Client, LocalCluster, as_completed


## [answer]
def answer(environment, first, count, low, high):
    """Answers the motions from number `first` on; each chunk has random numbers of its own."""
    rng = numpy.random.default_rng(first)
    starts = rng.uniform(low, high, size=(count, 3))
    targets = starts + rng.normal(scale=0.05, size=(count, 3)) * (high - low)
    motions = environment.walk(starts, targets, threads=1)
    status = numpy.bincount(motions.status, minlength=len(cellwalk.Status))
    return first, status, zlib.crc32(motions.status.tobytes() + motions.cell.tobytes() + motions.contacts.tobytes())
## [answer]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--moves", type=int, default=1_000_000)
    parser.add_argument("--chunk", type=int, default=100_000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--scheduler", help="of a cluster that runs already; otherwise one is started here")
    given = parser.parse_args()

    environment = cellwalk.Environment.generate("hexes", cells=(20, 20, 20), solid=0.1, seed=1)
    low, high = environment.points.min(axis=0), environment.points.max(axis=0)
    with Client(given.scheduler) if given.scheduler else LocalCluster(
        n_workers=given.workers, threads_per_worker=1, dashboard_address=None
    ) as cluster, Client(cluster) if not given.scheduler else cluster as client:
        # Each worker gets the environment once, as a pickle.
        [world] = client.scatter([environment], broadcast=True)
        chunks = [(first, min(given.chunk, given.moves - first)) for first in range(0, given.moves, given.chunk)]
        waiting = iter(chunks)

        def submit():
            first, count = next(waiting, (None, 0))
            return [] if first is None else [client.submit(answer, world, first, count, low, high, pure=False)]

        # A few chunks a worker are under way, however many there are in all.
        running = as_completed([future for _ in range(4 * given.workers) for future in submit()])
        found = {}
        for future in running:
            first, status, checksum = future.result()
            found[first] = (status, checksum)
            for more in submit():
                running.add(more)

    status = sum(status for status, _ in found.values())
    checksum = 0
    for first in sorted(found):
        checksum = zlib.crc32(found[first][1].to_bytes(4, "little"), checksum)
    print(f"{given.moves} motions in {len(chunks)} chunks")
    for code in cellwalk.Status:
        if status[code]:
            print(f"{code.name.lower():>8} {status[code]}")
    print(f"checksum of all answers {checksum:08x}")


if __name__ == "__main__":
    main()
