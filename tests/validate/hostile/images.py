"""Images that claim what they do not hold, in every format that is read: bombs, absurd sizes, loops, broken tables."""

import struct
import zlib


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width, height, body=b"", extra=b"", depth=8, colour=2, interlace=0):
    header = struct.pack(">IIBBBBB", width, height, depth, colour, 0, 0, interlace)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + extra + chunk(b"IDAT", body) + chunk(b"IEND", b"")


def zeros(count):
    """So many zeros, packed a thousandfold."""
    packer, block = zlib.compressobj(9), bytes(1 << 20)
    packed = b"".join(packer.compress(block) for _ in range(count >> 20))
    return packed + packer.compress(bytes(count & ((1 << 20) - 1))) + packer.flush()


def tiff(width, height, bits=8, extra=()):
    entries = [
        (256, 4, 1, width),
        (257, 4, 1, height),
        (258, 3, 1, bits),
        (259, 3, 1, 1),
        (262, 3, 1, 1),
        (273, 4, 1, 8),
        (277, 3, 1, 1),
        (278, 4, 1, height),
        (279, 4, 1, 4),
        *extra,
    ]
    table = b"".join(struct.pack("<HHII", *entry) for entry in sorted(entries))
    return b"II*\0" + struct.pack("<IH", 8, len(entries)) + table + struct.pack("<I", 0)


def tga(*numbers, body=b""):
    return struct.pack("<BBBHHBHHHHBB", *numbers) + body


def bmp(offset, width, height, bits, colours=0, body=b""):
    return b"BM" + struct.pack("<IHHI", 100, 0, 0, offset) + struct.pack("<IiiHHIIiiII", 40, width, height, 1, bits, 0, 0, 0, 0, colours, colours) + body


def dds(width, height, levels, kind):
    head = struct.pack("<IIIIIII", 124, 0x1007, height, width, 2**31, 0, levels)
    return b"DDS " + head + b"\0" * 44 + struct.pack("<II", 32, 4) + kind + b"\0" * 40


def exr(window, channels=None, tiles=None, version=2, body=b"\0" * 64):
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    box = struct.pack("<iiii", *window)
    if channels is None:
        channels = exr_channel(b"R") + b"\0"
    out = struct.pack("<II", 20000630, version | (0x200 if tiles else 0))
    out += attribute(b"channels", b"chlist", channels) + attribute(b"compression", b"compression", b"\3")
    out += attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box) + attribute(b"lineOrder", b"lineOrder", b"\0")
    out += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
    out += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
    if tiles:
        out += attribute(b"tiles", b"tiledesc", struct.pack("<IIB", *tiles))
    return out + b"\0" + body


def exr_channel(name, sampling=1):
    return name + b"\0" + struct.pack("<IBxxxII", 1, 0, sampling, sampling)


SMALL = zlib.compress(b"\0" * 14)
RADIANCE = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n"
AVIF = b"\0\0\0\x1cftypavif\0\0\0\0avifmif1miaf"
GIF = b"GIF89a"

# Made when they are wanted: some take seconds.
IMAGES = {
    "bomb_16k.png": lambda: png(16384, 16384, zeros(16384 * (16384 * 3 + 1))),
    "bomb_60k_grey.png": lambda: png(60000, 60000, zeros(60000 * 60001), colour=0),
    "iccp_bomb.png": lambda: png(2, 2, SMALL, chunk(b"iCCP", b"x\0\0" + zeros(1 << 30))),
    "ztxt_bomb.png": lambda: png(2, 2, SMALL, chunk(b"zTXt", b"x\0\0" + zeros(1 << 30))),
    "wide.png": lambda: png(2**31 - 1, 1, SMALL),
    "tall.png": lambda: png(1, 2**31 - 1, SMALL),
    "frames.png": lambda: png(2, 2, SMALL, chunk(b"acTL", struct.pack(">II", 2**31 - 1, 0))),
    "interlaced.png": lambda: png(2**20, 2**20, depth=16, colour=6, interlace=1),
    "absurd.tif": lambda: tiff(2**32 - 1, 2**32 - 1),
    "big.tif": lambda: tiff(60000, 60000),
    "loop.tif": lambda: b"II*\0" + struct.pack("<IHI", 8, 0, 8),
    "tiled.tif": lambda: tiff(1000, 1000, extra=[(322, 4, 1, 2**32 - 16), (323, 4, 1, 2**32 - 16), (324, 4, 1, 8), (325, 4, 1, 4)]),
    "bits.tif": lambda: tiff(4, 4, bits=65535),
    "count.tif": lambda: b"II*\0" + struct.pack("<IHHHIII", 8, 1, 273, 4, 2**32 - 1, 8, 0),
    "bigtiff.tif": lambda: b"II+\0" + struct.pack("<HHQ", 8, 0, 2**63) + b"\0" * 32,
    "absurd.tga": lambda: tga(0, 0, 2, 0, 0, 0, 0, 0, 65535, 65535, 32, 0),
    "map.tga": lambda: tga(255, 1, 9, 65535, 65535, 255, 0, 0, 65535, 65535, 8, 0, body=b"\xff" * 300),
    "runs.tga": lambda: tga(0, 0, 10, 0, 0, 0, 0, 0, 30000, 30000, 24, 0, body=b"\xff\0\0\0" * 1000),
    "absurd.bmp": lambda: bmp(54, 2**31 - 1, -(2**31), 24),
    "palette.bmp": lambda: bmp(2**32 - 1, 100, 100, 8, 2**32 - 1, b"\0" * 40),
    "absurd.gif": lambda: (
        GIF
        + struct.pack("<HHBBB", 65535, 65535, 0xF7, 0, 0)
        + b"\0" * 768
        + b","
        + struct.pack("<HHHHB", 65535, 65535, 65535, 65535, 0)
        + b"\x08\xff"
        + b"\xff" * 255
        + b"\0;"
    ),
    "lzw.gif": lambda: GIF + struct.pack("<HHBBB", 4, 4, 0, 0, 0) + b"," + struct.pack("<HHHHB", 0, 0, 4, 4, 0) + b"\xff\x01\xff\0;",
    "absurd.webp": lambda: b"RIFF" + struct.pack("<I", 2**32 - 1) + b"WEBPVP8X" + struct.pack("<I", 10) + b"\x10\0\0\0" + b"\xff" * 6,
    "lossless.webp": lambda: b"RIFF" + struct.pack("<I", 30) + b"WEBPVP8L" + struct.pack("<I", 12) + b"\x2f\xff\xff\xff\xff" + b"\0" * 8,
    "absurd.dds": lambda: dds(2**32 - 1, 2**32 - 1, 30, b"DXT1"),
    "zero.dds": lambda: dds(0, 0, 2**31, b"DXT5"),
    "absurd.hdr": lambda: RADIANCE + b"EXPOSURE=0\nEXPOSURE=nan\n\n-Y 999999999999999999999 +X 5\n",
    "runs.hdr": lambda: RADIANCE + b"\n-Y 32000 +X 32000\n" + b"\x02\x02\x7d\x00" + b"\xff\x01" * 4000,
    "endless_head.hdr": lambda: b"#?RADIANCE\n" + b"x=y\n" * 2_000_000,
    "negative.hdr": lambda: RADIANCE + b"\n-Y -4 +X -4\n" + b"\0" * 64,
    "absurd.exr": lambda: exr((-(2**31), -(2**31), 2**31 - 1, 2**31 - 1)),
    "reversed.exr": lambda: exr((10, 10, 0, 0)),
    "large.exr": lambda: exr((0, 0, 49999, 49999)),
    "tile_of_nothing.exr": lambda: exr((0, 0, 99, 99), tiles=(0, 0, 0)),
    "large_tile.exr": lambda: exr((0, 0, 99, 99), tiles=(2**32 - 1, 2**32 - 1, 2)),
    "sampling.exr": lambda: exr((0, 0, 99, 99), exr_channel(b"R", 0) + b"\0"),
    "channels.exr": lambda: exr((0, 0, 9, 9), b"".join(exr_channel(b"c%d" % number) for number in range(200000)) + b"\0"),
    "deep.exr": lambda: exr((0, 0, 9, 9), version=2 | 0x800),
    "parts.exr": lambda: exr((0, 0, 9, 9), version=2 | 0x1000),
    "offsets.exr": lambda: exr((0, 0, 9, 9), body=struct.pack("<Q", 2**63) * 10),
    "absurd.jpg": lambda: b"\xff\xd8\xff\xc0\x00\x11\x08\xff\xff\xff\xff\x03\x01\x22\x00\x02\x11\x01\x03\x11\x01\xff\xd9",
    "comments.jpg": lambda: b"\xff\xd8\xff\xfe\xff\xff" + b"x" * 65533 + b"\xff\xd9",
    "broken.avif": lambda: AVIF + b"\0\0\x10\0meta" + b"\xff" * 200,
    "size.avif": lambda: AVIF + struct.pack(">I", 1) + b"meta" + struct.pack(">Q", 2**63) + b"\xff" * 200,
}
