# SPDX-License-Identifier: GPL-3.0-or-later
"""The random number of an object: Blender gives one to instances only, for others Cycles takes it from the name."""

MASK = 0xFFFFFFFF


def _rotated(x, bits):
    return ((x << bits) | (x >> (32 - bits))) & MASK


def of_name(name):
    """A number of 32 bits: the name's bytes as digits to base 37, scrambled by the last mix of Jenkins' lookup3 with a second word of 0."""
    word = 0
    for byte in name.encode():
        word = (word * 37 + byte) & MASK
    start = (0xDEADBEEF + (2 << 2) + 13) & MASK
    a, b, c = (start + word) & MASK, start, start
    for bits in ((14, 11, 25), (16, 4, 14)):
        c = ((c ^ b) - _rotated(b, bits[0])) & MASK
        a = ((a ^ c) - _rotated(c, bits[1])) & MASK
        b = ((b ^ a) - _rotated(a, bits[2])) & MASK
    return ((c ^ b) - _rotated(b, 24)) & MASK
