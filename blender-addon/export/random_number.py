# SPDX-License-Identifier: GPL-3.0-or-later
"""Random numbers as Cycles makes them: of an object by its name, where Blender gives none, and of other things by their number."""

import numpy as np

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


def of_word_arrays(first):
    """The same of an array of first words, with a second word of 0."""
    start = (0xDEADBEEF + (2 << 2) + 13) & MASK
    with np.errstate(over="ignore"):
        c = np.full(len(first), start, dtype=np.uint32)
        a, b = c + first.astype(np.uint32), c.copy()
        for bits in ((14, 11, 25), (16, 4, 14)):
            c = (c ^ b) - _rotated_array(b, bits[0])
            a = (a ^ c) - _rotated_array(c, bits[1])
            b = (b ^ a) - _rotated_array(a, bits[2])
        return (c ^ b) - _rotated_array(b, 24)


def _rotated_array(x, bits):
    return (x << np.uint32(bits)) | (x >> np.uint32(32 - bits))
