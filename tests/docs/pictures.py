#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Compares pictures that the program draws with those of the documentation.

usage: pictures.py DRAWN SMALL    makes a picture of half the width and height, as the gallery has them
"""

import struct
import sys
import zlib
from pathlib import Path

# Where another compiler rounds the camera otherwise, few bytes of pixels may differ by more than that of 255.
SHARE_OF_PIXELS, DIFFERENCE = 1e-3, 24
SIGNATURE = b"\x89PNG\r\n\x1a\n"


def read_png(path):
    """Width, height and rows of a PNG as the library writes it: RGB, each row as differences from the one above."""
    data = path.read_bytes()
    assert data[:8] == SIGNATURE, path
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


def write_png(path, width, rows):
    """Writes a picture as read_png() reads it."""
    packed, above = bytearray(), bytes(3 * width)
    for row in rows:
        packed += b"\2" + bytes((a - b) & 255 for a, b in zip(row, above))
        above = row
    data = SIGNATURE
    for kind, body in ((b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 2, 0, 0, 0)),
                       (b"IDAT", zlib.compress(bytes(packed), 9)), (b"IEND", b"")):
        data += struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    path.write_bytes(data)


def halved(picture):
    """A picture of half the width and height: each pixel is the mean of four, rounded down to an even number, which saves bytes."""
    width, height, rows = picture
    small = []
    for upper, lower in zip(rows[0:height - 1:2], rows[1:height:2]):
        sums = [a + b for a, b in zip(upper, lower)]
        small.append(bytes((sums[i] + sums[i + 3]) // 8 * 2 for x in range(0, 6 * (width // 2), 6) for i in (x, x + 1, x + 2)))
    return width // 2, len(small), small


def same_picture(path, other):
    """Whether two pictures look the same."""
    return same_pixels(read_png(path), read_png(other))


def same_pixels(picture, other):
    width, height, rows = picture
    other_width, other_height, other_rows = other
    if (width, height) != (other_width, other_height):
        return False
    differ = sum(1 for a, b in zip(rows, other_rows) if a != b for x, y in zip(a, b) if abs(x - y) > DIFFERENCE)
    return differ < SHARE_OF_PIXELS * width * height


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    half = halved(read_png(Path(sys.argv[1])))
    write_png(Path(sys.argv[2]), half[0], half[2])
