# SPDX-License-Identifier: LGPL-3.0-or-later
"""Traces of free moves only: vertices that the recorded answers hold in place get their own position as target.

The formats are those of docs/formats.md. Whatever else moves meets the same positions as before, since a vertex that is held stays there.
"""
from array import array

VERTICES = 8  # of a body in a grid
SEGMENT_BITS = 0b1111  # of its answer: the way of the vertex, and its three edges
BLOCKED_BIT = 1  # of an answer about any body


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


def free_moves_in_grid(data):
    """Of a trace ECCDTRC1: its bytes, and how many moves are made to stay."""
    read = Reader(data)
    read.at = 8
    _, _, _, bodies, steps, obstacles = read.take("I", 6)
    read.take("I", 2 + 6 + obstacles + obstacles % 2)  # the seed, three numbers and the obstacles
    head = data[:read.at]
    size = 3 * VERTICES * bodies
    start, targets = read.take("d", size), read.take("d", steps * size)
    answers = read.take("B", steps * bodies * VERTICES)
    now, held = array("d", start), 0
    for move, answer in enumerate(answers):
        at, of_body = 3 * move, 3 * move % size
        if answer & SEGMENT_BITS:
            targets[at:at + 3] = now[of_body:of_body + 3]
            answers[move] = 0
            held += 1
        else:
            now[of_body:of_body + 3] = targets[at:at + 3]
    return head + start.tobytes() + targets.tobytes() + answers.tobytes(), held


def free_moves_of_bodies(data):
    """The same of a trace ECCDTRC2 with answers."""
    read = Reader(data)
    read.at = 8
    bodies, steps = read.take("I", 2)
    answers_of_vertex = []  # of all bodies: one, and one for each neighbour
    for _ in range(bodies):
        vertices, edges, faces = read.take("I", 3)
        of_body = [1] * vertices
        for end in read.take("I", 2 * edges):
            of_body[end] += 1
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


def free_moves(data):
    """Of a trace of either format."""
    magic = data[:8]
    if magic == b"ECCDTRC1":
        return free_moves_in_grid(data)
    if magic == b"ECCDTRC2":
        return free_moves_of_bodies(data)
    raise ValueError("it is no trace")
