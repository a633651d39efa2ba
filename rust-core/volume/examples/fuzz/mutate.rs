//! Good files, broken.

/// The longest input.
const LONGEST: usize = 1 << 19;

/// Words that readers of counts and distances stumble over.
const WORDS: [u64; 12] = [0, 1, 2, 7, 0x7fff_ffff, 0xffff_ffff, 0x8000_0000, 0x7fc0_0000, 1 << 20, u64::MAX, 1 << 63, 2_000_000_000_000];

/// Random numbers (splitmix64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 up to `end`, which is not reached; 0 for an empty range.
    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

/// One of the seeds after one to eight mutations; few are likelier, as one fault alone gets further.
pub(crate) fn input(seeds: &[Vec<u8>], random: &mut Random) -> Vec<u8> {
    let mut bytes = seeds[random.below(seeds.len())].clone();
    let most = 1 + random.below(8);
    for _ in 0..=random.below(most) {
        let other = &seeds[random.below(seeds.len())];
        mutate(&mut bytes, other, random);
        bytes.truncate(LONGEST);
    }
    bytes
}

fn mutate(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    // Headers are a small part of a file, and the part with the counts.
    let end = if random.below(2) == 0 { bytes.len().min(1024) } else { bytes.len() };
    let at = random.below(end);
    match random.below(8) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        1 if !bytes.is_empty() => bytes[at] = random.next() as u8,
        2 => bytes.truncate(at),
        3 => {
            // The start of one file and the end of another.
            bytes.truncate(at);
            bytes.extend_from_slice(&other[random.below(other.len())..]);
        }
        4 => drop(bytes.drain(at..(at + 1 + random.below(64)).min(bytes.len()))),
        5 => {
            let end = (at + 1 + random.below(1024)).min(bytes.len());
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        _ => {
            let width = [1, 2, 4, 8][random.below(4)];
            let word = WORDS[random.below(WORDS.len())].to_le_bytes();
            let end = (at + width).min(bytes.len());
            bytes.splice(at..end, word[..width].iter().copied());
        }
    }
}
