# SPDX-License-Identifier: GPL-3.0-or-later
"""Random numbers as Cycles makes them: of an object by its name, where Blender gives none, and of other things by their number."""

MASK = 0xFFFFFFFF


def _rotated(x, bits):
    return ((x << bits) | (x >> (32 - bits))) & MASK


def of_name(name):
    """A number of 32 bits: the name's bytes as digits to base 37, scrambled with a second word of 0."""
    word = 0
    for byte in name.encode():
        word = (word * 37 + byte) & MASK
    return of_words(word, 0)


def of_words(first, second=None):
    """One or two words scrambled by the last mix of Jenkins' lookup3."""
    count = 1 if second is None else 2
    start = (0xDEADBEEF + (count << 2) + 13) & MASK
    a, b, c = (start + first) & MASK, (start + (second or 0)) & MASK, start
    for bits in ((14, 11, 25), (16, 4, 14)):
        c = ((c ^ b) - _rotated(b, bits[0])) & MASK
        a = ((a ^ c) - _rotated(c, bits[1])) & MASK
        b = ((b ^ a) - _rotated(a, bits[2])) & MASK
    return ((c ^ b) - _rotated(b, 24)) & MASK
