"""Reads the OpenEXR files that vegard writes, to compare numbers with: scan lines of 32-bit floats, zip or none.

The layout is that of "OpenEXR File Layout" (openexr.com); nothing of vegard's or of OpenEXR's code has a part in it.
"""

import struct
import zlib

import numpy as np


def _attributes(data, at):
    found = {}
    while data[at] != 0:
        end = data.index(0, at)
        name = data[at:end].decode()
        at = data.index(0, end + 1) + 1
        (size,) = struct.unpack_from("<i", data, at)
        found[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return found, at + 1


def _channel_names(packed):
    names, at = [], 0
    while packed[at] != 0:
        end = packed.index(0, at)
        names.append(packed[at:end].decode())
        kind, _, across, down = struct.unpack_from("<iIii", packed, end + 1)
        assert kind == 2 and across == down == 1, "another kind of channel than 32-bit floats"
        at = end + 1 + 16
    return names


def _unpacked(block, size):
    """Of a zip block: bytes are differences, and all first halves stand before all second ones."""
    if len(block) == size:
        return block
    steps = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    steps[1:] -= 128
    apart = np.cumsum(steps).astype(np.uint8)
    together = np.empty(size, np.uint8)
    half = (size + 1) // 2
    together[0::2], together[1::2] = apart[:half], apart[half:]
    return together.tobytes()


def read(file):
    """{channel name: (height, width) float32}"""
    data = file.read_bytes()
    magic, version = struct.unpack_from("<II", data, 0)
    assert magic == 20000630 and version & ~0xFF in (0, 0x400), "no single-part file of scan lines"
    attributes, at = _attributes(data, 8)
    left, top, right, bottom = struct.unpack("<4i", attributes["dataWindow"])
    width, height = right - left + 1, bottom - top + 1
    names = _channel_names(attributes["channels"])
    compression = attributes["compression"][0]
    rows_of_block = {0: 1, 2: 1, 3: 16}[compression]
    picture = {name: np.empty((height, width), np.float32) for name in names}
    for first in range(0, height, rows_of_block):
        (offset,) = struct.unpack_from("<Q", data, at + 8 * (first // rows_of_block))
        y, length = struct.unpack_from("<ii", data, offset)
        rows = min(rows_of_block, height - (y - top))
        block = _unpacked(data[offset + 8 : offset + 8 + length], 4 * rows * width * len(names))
        values = np.frombuffer(block, "<f4").reshape(rows, len(names), width)
        for c, name in enumerate(names):
            picture[name][y - top : y - top + rows] = values[:, c]
    return picture
