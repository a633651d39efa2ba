//! Numbers in blocks of sixteen, each block as many bits a number as its largest one needs (frame of reference coding).

/// Numbers of a block.
const BLOCK: usize = 16;
/// Bytes behind the last block that [`unpack`] may look at.
pub(super) const MARGIN: usize = 72;
/// Numbers of a block that come with one 64-bit word, where they have 8 bits or fewer.
const HALF: usize = BLOCK / 2;

/// Bytes of the blocks' widths: half a byte a block for numbers of 8 bits, else a byte.
fn heads(blocks: usize, bits: u32) -> usize {
    if bits == 8 { blocks.div_ceil(2) } else { blocks }
}

fn width(block: &[u32]) -> u32 {
    u32::BITS - block.iter().fold(0, |all, number| all | number).leading_zeros()
}

/// Bytes that numbers of at most `bits` bits take.
pub(super) fn packed_bytes(numbers: &[u32], bits: u32) -> usize {
    let data: u32 = numbers.chunks(BLOCK).map(|block| 2 * width(block)).sum();
    heads(numbers.len().div_ceil(BLOCK), bits) + data as usize
}

/// Appends numbers of at most `bits` bits.
pub(super) fn pack(numbers: &[u32], bits: u32, out: &mut Vec<u8>) {
    let first = out.len();
    out.resize(first + heads(numbers.len().div_ceil(BLOCK), bits), 0);
    for (place, block) in numbers.chunks(BLOCK).enumerate() {
        let width = width(block);
        if bits == 8 {
            out[first + place / 2] |= (width as u8) << (4 * (place % 2));
        } else {
            out[first + place] = width as u8;
        }
        pack_block(block, width, out);
    }
}

fn pack_block(block: &[u32], width: u32, out: &mut Vec<u8>) {
    let end = out.len() + 2 * width as usize;
    let (mut waiting, mut count) = (0_u64, 0);
    for number in block {
        waiting |= u64::from(*number) << count;
        count += width;
        while count >= 8 {
            out.push(waiting as u8);
            waiting >>= 8;
            count -= 8;
        }
    }
    if count > 0 {
        out.push(waiting as u8);
    }
    // A block that is not full takes the room of one that is.
    out.resize(end, 0);
}

/// Fills `numbers` from bytes that [`pack`] wrote and that go on for [`MARGIN`] more; how many bytes those were, `None` where they cannot be
/// such bytes.
pub(super) fn unpack(bytes: &[u8], bits: u32, numbers: &mut [u32]) -> Option<usize> {
    let first = heads(numbers.len().div_ceil(BLOCK), bits);
    let heads = bytes.get(..first)?;
    let mut at = first;
    for (place, block) in numbers.chunks_mut(BLOCK).enumerate() {
        let width = if bits == 8 { u32::from(heads[place / 2] >> (4 * (place % 2)) & 15) } else { u32::from(heads[place]) };
        if width > bits {
            return None;
        }
        let window: &[u8; MARGIN] = bytes.get(at..at + MARGIN)?.try_into().ok()?;
        unpack_block(window, width, block);
        at += 2 * width as usize;
    }
    Some(at)
}

#[inline]
fn unpack_block(window: &[u8; MARGIN], width: u32, block: &mut [u32]) {
    let word = |at: usize| {
        let mut word = [0; 8];
        word.copy_from_slice(&window[at..at + 8]);
        u64::from_le_bytes(word)
    };
    let mask = ((1_u64 << width) - 1) as u32;
    if width == 0 {
        block.fill(0);
    } else if width <= 8 && block.len() == BLOCK {
        let (low, high) = block.split_at_mut(HALF);
        let words = [word(0), word(width as usize)];
        for place in 0..HALF {
            let shift = place as u32 * width;
            low[place] = (words[0] >> shift) as u32 & mask;
            high[place] = (words[1] >> shift) as u32 & mask;
        }
    } else {
        for (place, number) in block.iter_mut().enumerate() {
            let bit = place * width as usize;
            *number = (word(bit / 8) >> (bit % 8)) as u32 & mask;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_every_width_come_back() {
        for bits in [8_u32, 16, 32] {
            for count in [1_usize, 15, 16, 17, 31, 100, 4096] {
                // Widths from none to all bits, block by block.
                let numbers: Vec<u32> = (0..count as u32)
                    .map(|i| {
                        let width = (i / 16).wrapping_mul(7) % (bits + 1);
                        i.wrapping_mul(0x9e37_79b9) & ((1_u64 << width) - 1) as u32
                    })
                    .collect();
                let mut bytes = vec![9];
                pack(&numbers, bits, &mut bytes);
                assert_eq!(bytes.len() - 1, packed_bytes(&numbers, bits));
                let end = bytes.len() - 1;
                bytes.resize(bytes.len() + MARGIN, 0xff);
                let mut again = vec![7; count];
                assert_eq!(unpack(&bytes[1..], bits, &mut again), Some(end));
                assert!(again == numbers, "{bits} bits, {count}");
            }
        }
    }
}
