//! Good files, broken.

/// Numbers that readers of numbers stumble over.
const NUMBERS: [&str; 20] = [
    "nan",
    "inf",
    "-inf",
    "-1",
    "0",
    "-0",
    "1e999",
    "-1e999",
    "1e-320",
    "1e12",
    "99999999999",
    "10000000000",
    "18446744073709551616",
    "0.5",
    "360",
    "-90",
    "2147483648",
    "4294967296",
    "1,5",
    "1.5.5",
];

/// The longest input.
const LONGEST: usize = 1 << 18;

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
    let at = random.below(bytes.len());
    match random.below(11) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        1 if !bytes.is_empty() => bytes[at] = random.next() as u8,
        2 => bytes.truncate(at),
        3 => {
            // The start of one file and the end of another.
            bytes.truncate(at);
            bytes.extend_from_slice(&other[random.below(other.len())..]);
        }
        4 | 5 => {
            let number = NUMBERS[random.below(NUMBERS.len())];
            let range = token(bytes, at);
            bytes.splice(range, number.bytes());
        }
        6 => {
            let range = token(bytes, at);
            let copy: Vec<u8> = std::iter::once(b' ').chain(bytes[range.clone()].iter().copied()).collect();
            let copies = 1 << random.below(8);
            bytes.splice(range.end..range.end, copy.repeat(copies));
        }
        7 => drop(bytes.drain(line(bytes, at))),
        8 => {
            let copy = bytes[line(bytes, at)].to_vec();
            bytes.splice(at..at, copy);
        }
        9 => {
            let number = (random.next() as i64 >> random.below(60)).to_string();
            let range = token(bytes, at);
            bytes.splice(range, number.bytes());
        }
        _ => {
            // Whole words, as binary formats have their counts.
            let word = [0u32, 1, 0x7fff_ffff, 0xffff_ffff, 0x8000_0000, 0x7fc0_0000, 1 << 20][random.below(7)].to_le_bytes();
            let end = (at + 4).min(bytes.len());
            bytes.splice(at..end, word);
        }
    }
}

/// The word about a position.
fn token(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    around(bytes, at, u8::is_ascii_whitespace)
}

/// The line about a position, with its end.
fn line(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let range = around(bytes, at, |byte| *byte == b'\n');
    range.start..(range.end + 1).min(bytes.len())
}

fn around(bytes: &[u8], at: usize, ends: impl Fn(&u8) -> bool) -> std::ops::Range<usize> {
    let at = at.min(bytes.len());
    let start = bytes[..at].iter().rposition(&ends).map_or(0, |before| before + 1);
    let end = bytes[at..].iter().position(&ends).map_or(bytes.len(), |length| at + length);
    start..end
}
