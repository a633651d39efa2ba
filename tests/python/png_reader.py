"""PNG files as arrays."""

import struct
import zlib

import numpy as np


def png(path):
    """Pixels (height, width, 4) and the chunks of a PNG file."""
    data, at, chunks = path.read_bytes(), 8, {}
    while at < len(data):
        (length,), kind = struct.unpack(">I", data[at : at + 4]), data[at + 4 : at + 8]
        body = data[at + 8 : at + 8 + length]
        assert struct.unpack(">I", data[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + body)
        chunks[kind] = chunks.get(kind, b"") + body
        at += 12 + length
    width, height, depth = struct.unpack(">IIB", chunks[b"IHDR"][:9])
    size, rows = 4 * depth // 8, zlib.decompress(chunks[b"IDAT"])
    line = np.frombuffer(rows, np.uint8).reshape(height, 1 + width * size)
    pixels = np.zeros((height, width * size), np.uint8)
    for y in range(height):
        pixels[y] = unfiltered(line[y, 0], line[y, 1:], pixels[y - 1] if y else np.zeros(width * size, np.uint8), size)
    return pixels.view(">u2" if depth == 16 else np.uint8).reshape(height, width, 4), chunks


def unfiltered(kind, line, above, size):
    """A row of a PNG file without its filter."""
    row = np.zeros(len(line), int)
    for x, value in enumerate(line.astype(int)):
        left, up, corner = (row[x - size] if x >= size else 0), int(above[x]), (int(above[x - size]) if x >= size else 0)
        paeth = min((left, up, corner), key=lambda each: abs(left + up - corner - each))
        row[x] = (value + (0, left, up, (left + up) // 2, paeth)[kind]) % 256
    return row.astype(np.uint8)
