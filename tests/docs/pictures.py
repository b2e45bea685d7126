# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compares pictures that the program draws with those of the documentation."""

import struct
import zlib

# Where another compiler rounds the camera otherwise, few bytes of pixels may differ by more than that of 255.
SHARE_OF_PIXELS, DIFFERENCE = 1e-3, 24


def read_png(path):
    """Width, height and rows of a PNG as the library writes it: RGB, each row as differences from the one above."""
    data = path.read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", path
    chunks, at = {}, 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0] == zlib.crc32(kind + body), path
        chunks[kind] = body
        at += 12 + size
    width, height = struct.unpack(">II", chunks[b"IHDR"][:8])
    packed = zlib.decompress(chunks[b"IDAT"])
    stride, above, rows = 3 * width + 1, bytes(3 * width), []
    for y in range(height):
        row = packed[y * stride:(y + 1) * stride]
        assert row[0] == 2, path
        above = bytes((a + b) & 255 for a, b in zip(row[1:], above))
        rows.append(above)
    return width, height, rows


def same_picture(path, other):
    """Whether two pictures look the same."""
    width, height, rows = read_png(path)
    other_width, other_height, other_rows = read_png(other)
    if (width, height) != (other_width, other_height):
        return False
    differ = sum(1 for a, b in zip(rows, other_rows) if a != b for x, y in zip(a, b) if abs(x - y) > DIFFERENCE)
    return differ < SHARE_OF_PIXELS * width * height
