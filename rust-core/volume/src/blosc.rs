//! Chunks of Blosc 1: a header of 16 bytes, then blocks that may be shuffled and split into streams.
//!
//! Source: the README of its chunk format, in the project c-blosc.

use crate::inflate::inflate;

const SHUFFLED: u8 = 0x1;
const COPIED: u8 = 0x2;
const BIT_SHUFFLED: u8 = 0x4;
const NOT_SPLIT: u8 = 0x10;

/// Blocks of fewer elements, and elements of more bytes, are never split into streams.
const LEAST_TO_SPLIT: usize = 128;
const MOST_SPLITS: usize = 16;

struct Chunk<'a> {
    bytes: &'a [u8],
    flags: u8,
    element: usize,
    block: usize,
}

/// Unpacks a chunk that holds just as many bytes as `to` has room for.
pub(crate) fn unpack(bytes: &[u8], to: &mut [u8]) -> Result<(), String> {
    let header = bytes.first_chunk::<16>().ok_or("a Blosc chunk of less than 16 bytes")?;
    let word = |at: usize| u32::from_le_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]) as usize;
    let [_, _, flags, element, ..] = *header;
    let (size, block) = (word(4), word(8));
    if size != to.len() {
        return Err(format!("a Blosc chunk of {size} bytes, expected {}", to.len()));
    }
    if size == 0 {
        return Ok(());
    }
    if flags & COPIED != 0 {
        let copied = bytes.get(16..16 + size).ok_or("a Blosc chunk that is cut off")?;
        to.copy_from_slice(copied);
        return Ok(());
    }
    if block == 0 || element == 0 {
        return Err("a Blosc chunk with blocks or elements of no bytes".into());
    }
    if flags & BIT_SHUFFLED != 0 {
        return Err("Blosc with shuffled bits is not read; save the grid with OpenVDB's own compression".into());
    }
    let chunk = Chunk { bytes, flags, element: element.into(), block };
    let mut plain = vec![0; if flags & SHUFFLED != 0 { block.min(size) } else { 0 }];
    for (index, part) in to.chunks_mut(block).enumerate() {
        chunk.block(index, part, &mut plain)?;
    }
    Ok(())
}

impl Chunk<'_> {
    fn word(&self, at: usize) -> Result<usize, String> {
        let bytes = self.bytes.get(at..).and_then(|rest| rest.first_chunk::<4>()).ok_or("a Blosc chunk that is cut off")?;
        Ok(u32::from_le_bytes(*bytes) as usize)
    }

    fn block(&self, index: usize, to: &mut [u8], plain: &mut [u8]) -> Result<(), String> {
        let start = self.word(16 + 4 * index)?;
        if self.flags & SHUFFLED == 0 || self.element == 1 {
            return self.streams(start, to);
        }
        let size = to.len();
        self.streams(start, &mut plain[..size])?;
        unshuffle(&plain[..size], to, self.element);
        Ok(())
    }

    /// The streams of a block: one for each byte of an element, or one.
    fn streams(&self, start: usize, to: &mut [u8]) -> Result<(), String> {
        let whole = to.len() == self.block;
        let split = self.flags & NOT_SPLIT == 0 && whole && self.element <= MOST_SPLITS && self.block / self.element >= LEAST_TO_SPLIT;
        let count = if split { self.element } else { 1 };
        if !to.len().is_multiple_of(count) {
            return Err("a Blosc block that does not split into its streams".into());
        }
        let mut at = start;
        let part = to.len() / count;
        for stream in to.chunks_exact_mut(part) {
            let size = self.word(at)?;
            let packed = self.bytes.get(at + 4..).and_then(|rest| rest.get(..size)).ok_or("a Blosc stream that is cut off")?;
            self.stream(packed, stream)?;
            at += 4 + size;
        }
        Ok(())
    }

    fn stream(&self, packed: &[u8], to: &mut [u8]) -> Result<(), String> {
        if packed.len() == to.len() {
            to.copy_from_slice(packed);
            return Ok(());
        }
        let size = match self.flags >> 5 {
            1 => lz4_flex::block::decompress_into(packed, to).map_err(|error| format!("LZ4: {error}"))?,
            3 => return inflate(packed, to),
            other => {
                let name = ["BloscLZ", "LZ4", "Snappy", "zlib", "Zstandard"].get(usize::from(other)).unwrap_or(&"an unknown packer");
                return Err(format!("Blosc with {name} is not read; save the grid with OpenVDB's own compression"));
            }
        };
        if size != to.len() {
            return Err(format!("an LZ4 stream of {size} bytes, expected {}", to.len()));
        }
        Ok(())
    }
}

/// The first bytes of all elements come first, then the second ones; what makes no whole element stays as it is.
fn unshuffle(from: &[u8], to: &mut [u8], element: usize) {
    let count = from.len() / element;
    let (body, rest) = from.split_at(count * element);
    if count > 0 {
        for (byte, plane) in body.chunks_exact(count).enumerate() {
            to[byte..].iter_mut().step_by(element).zip(plane).for_each(|(to, from)| *to = *from);
        }
    }
    to[count * element..].copy_from_slice(rest);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(flags: u8, element: u8, size: u32, block: u32, blocks: &[&[u8]]) -> Vec<u8> {
        let mut bytes = vec![2, 1, flags, element];
        [size, block, 0].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
        let mut start = 16 + 4 * blocks.len();
        for block in blocks {
            bytes.extend((start as u32).to_le_bytes());
            start += 4 + block.len();
        }
        for block in blocks {
            bytes.extend((block.len() as u32).to_le_bytes());
            bytes.extend(*block);
        }
        bytes
    }

    #[test]
    fn shuffled_elements_with_a_rest() {
        let mut to = [0; 8];
        unpack(&chunk(0x21, 3, 8, 8, &[&[1, 4, 2, 5, 3, 6, 7, 8]]), &mut to).unwrap();
        assert_eq!(to, [1, 2, 3, 4, 5, 6, 7, 8]);
    }

    #[test]
    fn blocks_of_lz4_and_the_last_shorter() {
        let plain = [7u8; 24];
        let packed: Vec<Vec<u8>> = plain.chunks(16).map(lz4_flex::block::compress).collect();
        let parts: Vec<&[u8]> = packed.iter().map(Vec::as_slice).collect();
        let mut to = [0; 24];
        unpack(&chunk(0x30, 4, 24, 16, &parts), &mut to).unwrap();
        assert_eq!(to, plain);
    }

    #[test]
    fn other_packers_are_named() {
        let problem = unpack(&chunk(0x90, 4, 8, 8, &[&[1, 2]]), &mut [0; 8]).unwrap_err();
        assert!(problem.contains("Zstandard"), "{problem}");
    }
}
