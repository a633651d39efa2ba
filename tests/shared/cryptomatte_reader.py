"""A reader of cryptomattes of its own, written after Psyop's specification 1.2: numpy, and OpenEXR for the file."""

import json
import struct

import numpy as np


def murmur3(text):
    """MurmurHash3_x86_32 with seed 0 of a text's UTF-8."""
    data, mask = text.encode("utf-8"), 0xFFFFFFFF

    def mixed(word):
        word = word * 0xCC9E2D51 & mask
        return ((word << 15 | word >> 17) & mask) * 0x1B873593 & mask

    value, whole = 0, len(data) // 4 * 4
    for (word,) in struct.iter_unpack("<I", data[:whole]):
        value ^= mixed(word)
        value = ((value << 13 | value >> 19) & mask) * 5 + 0xE6546B64 & mask
    if data[whole:]:
        value ^= mixed(int.from_bytes(data[whole:], "little"))
    value ^= len(data)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35), (16, 1)):
        value = (value ^ value >> shift) * factor & mask
    return value


def identifier(name):
    """The 32 bits that pixels hold for a name."""
    return ordinary(murmur3(name))


def ordinary(value):
    """A hash as the bits of a float that is neither denormal nor infinite nor NaN."""
    exponent = value >> 23 & 255
    return value ^ (1 << 23) if exponent in (0, 255) else value


def checked_manifests(header, are_ids=True):
    """By layer's name, the names and their identifiers, from a header's texts; wrong metadata fails. Cycles lists hashes in place of
    identifiers, and before 5.0 others for letters beyond ASCII: not `are_ids`.
    """
    manifests = {}
    for key, name in header.items():
        if not (key.startswith("cryptomatte/") and key.endswith("/name")):
            continue
        code = key.split("/")[1]
        assert code == f"{murmur3(name):08x}"[:7]
        assert header[f"cryptomatte/{code}/hash"] == "MurmurHash3_32"
        assert header[f"cryptomatte/{code}/conversion"] == "uint32_to_float32"
        manifest = json.loads(header[f"cryptomatte/{code}/manifest"])
        for thing, digits in manifest.items():
            assert digits == f"{identifier(thing):08x}" or not are_ids
        manifests[name] = {thing: ordinary(int(digits, 16)) for thing, digits in manifest.items()}
    return manifests


def coverage(layers, wanted):
    """How much of each pixel an identifier covers; `layers` are arrays (height, width, 4) of identifier and coverage, twice."""
    total = np.zeros(layers[0].shape[:2], np.float32)
    for layer in layers:
        for rank in (0, 2):
            bits = np.ascontiguousarray(layer[..., rank]).view(np.uint32)
            total += np.where(bits == wanted, layer[..., rank + 1], 0.0)
    return total


def read(path):
    """The manifests of a file, and the layers of each matte by its name."""
    import OpenEXR

    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = {name: channel.pixels.copy() for name, channel in file.channels().items()}
    manifests = checked_manifests(header_texts(path))
    layers = {}
    for name in manifests:
        count = sum(channel.startswith(name) and channel.endswith(".r") for channel in channels)
        layers[name] = [np.stack([channels[f"{name}{number:02}.{c}"] for c in "rgba"], axis=-1) for number in range(count)]
        assert all(layer.dtype == np.float32 for layer in layers[name])
    return manifests, layers


def header_texts(path):
    """The text attributes of a file of one part, read from its bytes."""
    with open(path, "rb") as file:
        data = file.read(1 << 20)
    assert data[:4] == bytes([0x76, 0x2F, 0x31, 0x01])
    texts, at = {}, 8
    while data[at]:
        name, at = _word(data, at)
        kind, at = _word(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        if kind == "string":
            texts[name] = data[at + 4 : at + 4 + size].decode("utf-8")
        at += 4 + size
    return texts


def _word(data, at):
    end = data.index(0, at)
    return data[at:end].decode("ascii"), end + 1
