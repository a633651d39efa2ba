//! A 64-bit digest of bytes, which tells scenes and damaged files apart; no protection against malice.

use std::io::{Read, Result, Write};

/// Odd, with bits as if thrown (the fractional part of the golden ratio).
const FACTOR: u64 = 0x9e37_79b9_7f4a_7c15;

/// Takes bytes in pieces of any length; the same bytes give the same number.
#[derive(Clone, Copy, Debug, Default)]
pub struct Digest {
    state: u64,
    length: u64,
    /// Bytes that do not yet fill a word, the first one lowest.
    pending: u64,
}

impl Digest {
    /// Adds bytes.
    pub fn add(&mut self, mut bytes: &[u8]) {
        while !self.length.is_multiple_of(8)
            && let Some((first, rest)) = bytes.split_first()
        {
            self.add_byte(*first);
            bytes = rest;
        }
        let (words, rest) = bytes.as_chunks();
        words.iter().for_each(|word| self.mix(u64::from_le_bytes(*word)));
        self.length += 8 * words.len() as u64;
        rest.iter().for_each(|byte| self.add_byte(*byte));
    }

    /// The number so far.
    pub fn value(&self) -> u64 {
        let mut last = Self { ..*self };
        last.mix(self.pending);
        last.mix(self.length);
        last.state
    }

    fn add_byte(&mut self, byte: u8) {
        self.pending |= u64::from(byte) << (8 * (self.length % 8));
        self.length += 1;
        if self.length.is_multiple_of(8) {
            self.mix(self.pending);
            self.pending = 0;
        }
    }

    /// Multiplies to 128 bits and folds them.
    fn mix(&mut self, word: u64) {
        let product = u128::from(self.state ^ word ^ FACTOR) * u128::from(FACTOR | 1);
        self.state = (product as u64 ^ (product >> 64) as u64).wrapping_add(FACTOR);
    }
}

/// Passes bytes on and takes their digest.
#[derive(Debug)]
pub struct Digesting<T> {
    /// Where bytes go or come from.
    pub inner: T,
    /// Of all bytes so far.
    pub digest: Digest,
}

impl<T> Digesting<T> {
    /// Nothing passed yet.
    pub fn new(inner: T) -> Self {
        Self { inner, digest: Digest::default() }
    }
}

impl<T: Write> Write for Digesting<T> {
    fn write(&mut self, bytes: &[u8]) -> Result<usize> {
        let written = self.inner.write(bytes)?;
        self.digest.add(&bytes[..written]);
        Ok(written)
    }
    fn flush(&mut self) -> Result<()> {
        self.inner.flush()
    }
}

impl<T: Read> Read for Digesting<T> {
    fn read(&mut self, bytes: &mut [u8]) -> Result<usize> {
        let read = self.inner.read(bytes)?;
        self.digest.add(&bytes[..read]);
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_do_not_matter_and_every_bit_does() {
        let bytes: Vec<u8> = (0..100).map(|i| (i * 37) as u8).collect();
        let of = |pieces: &[&[u8]]| {
            let mut digest = Digest::default();
            pieces.iter().for_each(|piece| digest.add(piece));
            digest.value()
        };
        let whole = of(&[&bytes]);
        for cut in 0..100 {
            assert_eq!(of(&[&bytes[..cut], &bytes[cut..]]), whole);
            assert_ne!(of(&[&bytes[..cut]]), whole);
        }
        for bit in 0..800 {
            let mut other = bytes.clone();
            other[bit / 8] ^= 1 << (bit % 8);
            assert_ne!(of(&[&other]), whole);
        }
        assert_ne!(of(&[&[0]]), of(&[&[0, 0]]));
    }
}
