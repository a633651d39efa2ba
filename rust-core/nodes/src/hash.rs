//! Hashes of integers: Bob Jenkins's lookup3 of one to four words (public domain, 2006), which Cycles, OSL and MaterialX use for their noises.

use gonio_simd::{F, Lanes, U};

/// What the three words of state start from, before the number of words times four is added.
const START: u32 = 0xdead_beef + 13;

#[inline(always)]
fn rotate<L: Lanes>(x: U<L>, by: u32) -> U<L> {
    (x << by) | (x >> (32 - by))
}

/// One step: `a ^ b`, less `b` turned.
#[inline(always)]
fn stir<L: Lanes>(a: U<L>, b: U<L>, by: u32) -> U<L> {
    (a ^ b) - rotate(b, by)
}

#[inline(always)]
fn finish<L: Lanes>(mut a: U<L>, mut b: U<L>, mut c: U<L>) -> U<L> {
    c = stir(c, b, 14);
    a = stir(a, c, 11);
    b = stir(b, a, 25);
    c = stir(c, b, 16);
    a = stir(a, c, 4);
    b = stir(b, a, 14);
    stir(c, b, 24)
}

#[inline(always)]
fn start<L: Lanes>(l: L, words: u32) -> U<L> {
    l.u(START.wrapping_add(words << 2))
}

/// The hash of one word.
#[inline(always)]
pub fn hash1<L: Lanes>(l: L, x: U<L>) -> U<L> {
    let s = start(l, 1);
    finish(s + x, s, s)
}

/// The hash of two words.
#[inline(always)]
pub fn hash2<L: Lanes>(l: L, x: U<L>, y: U<L>) -> U<L> {
    let s = start(l, 2);
    finish(s + x, s + y, s)
}

/// The hash of three words.
#[inline(always)]
pub fn hash3<L: Lanes>(l: L, x: U<L>, y: U<L>, z: U<L>) -> U<L> {
    let s = start(l, 3);
    finish(s + x, s + y, s + z)
}

/// The hash of four words.
#[inline(always)]
pub fn hash4<L: Lanes>(l: L, x: U<L>, y: U<L>, z: U<L>, w: U<L>) -> U<L> {
    let s = start(l, 4);
    let (mut a, mut b, mut c) = (s + x, s + y, s + z);
    a = (a - c) ^ rotate(c, 4);
    c += b;
    b = (b - a) ^ rotate(a, 6);
    a += c;
    c = (c - b) ^ rotate(b, 8);
    b += a;
    a = (a - c) ^ rotate(c, 16);
    c += b;
    b = (b - a) ^ rotate(a, 19);
    a += c;
    c = (c - b) ^ rotate(b, 4);
    b += a;
    finish(a + w, b, c)
}

/// A hash as a number in [0, 1]: all bits over the largest word.
#[inline(always)]
pub fn to_unit<L: Lanes>(hash: U<L>) -> F<L> {
    hash.to_float() * (1.0 / u32::MAX as f32)
}
