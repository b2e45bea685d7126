# SPDX-License-Identifier: LGPL-3.0-or-later
"""Traces of free moves only: vertices that the recorded answers hold in place get their own position as target.

The format is that of docs/formats.md. Whatever else moves meets the same positions as before, since a vertex that is held stays there.
"""
from array import array

BLOCKED_BIT = 1  # of an answer


class Reader:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, code, count):
        values = array(code)
        end = self.at + count * values.itemsize
        if end > len(self.data):
            raise ValueError("the trace is cut short")
        values.frombytes(self.data[self.at:end])
        self.at = end
        return values


def free_moves(data):
    """Of a trace with answers: its bytes, and how many moves are made to stay."""
    if data[:8] not in (b"ECCDTRC2", b"ECCDTRC3", b"ECCDTRC4"):
        raise ValueError("it is no trace, or one of an old format")
    read = Reader(data)
    read.at = 8
    has_radii = data[:8] == b"ECCDTRC4"
    if has_radii or data[:8] == b"ECCDTRC3":
        _, has_grid = read.take("I", 2)
        if has_grid:
            *_, solid = read.take("I", 4)
            read.take("I", solid)
    bodies, steps = read.take("I", 2)
    answers_of_vertex = []  # of all bodies: one, and one for each neighbour
    for _ in range(bodies):
        vertices, edges, faces = read.take("I", 3)
        radii = read.take("I", 1)[0] if has_radii else 0
        of_body = [1] * vertices
        for end in read.take("I", 2 * edges):
            of_body[end] += 1
        read.take("d", radii)
        read.take("I", 3 * faces)
        answers_of_vertex += of_body
    head = data[:read.at]
    size = 3 * len(answers_of_vertex)
    before, targets = read.take("d", (steps + 1) * size), read.take("d", steps * size)
    if read.take("B", 1)[0] != 1:
        raise ValueError("the trace has no answers")
    answers = read.take("B", steps * sum(answers_of_vertex))
    first, held = 0, 0
    for move in range(steps * len(answers_of_vertex)):
        end = first + answers_of_vertex[move % len(answers_of_vertex)]
        if any(answer & BLOCKED_BIT for answer in answers[first:end]):
            targets[3 * move:3 * move + 3] = before[3 * move:3 * move + 3]
            answers[first:end] = array("B", bytes(end - first))
            held += 1
        first = end
    return head + before.tobytes() + targets.tobytes() + b"\1" + answers.tobytes(), held
