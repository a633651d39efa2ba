//! Cryptomattes: how much of each pixel things of a name cover.
//!
//! Every name that a sample of a pixel met is kept, so that there is no table to overflow; 16 bytes each. Shares are counted in whole numbers, which
//! add up to the same bits in any order: by threads, blocks, parts or after a checkpoint.

use super::raw::{array, number};
use crate::{
    camera::sampler::codes,
    scene::MatteKind,
    transport::{MatteSums, Met},
};
use bytemuck::{Pod, Zeroable};
use std::{
    cmp::Reverse,
    io::{Read, Result, Write},
};

/// What a whole sample counts.
const WHOLE: f64 = (1_u64 << 24) as f64;

/// What things of a name cover of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Pod, Zeroable)]
#[repr(C)]
pub(super) struct Cover {
    /// The pixel's Morton number.
    code: u32,
    /// Value of the name.
    name: u32,
    /// Samples times [`WHOLE`].
    weight: u64,
}

impl Cover {
    fn place(&self) -> (u32, u32) {
        (self.code, self.name)
    }
}

/// The covers of a tile by one kind of name, sorted by pixel and name, each pair once.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Matte {
    covers: Vec<Cover>,
}

/// The mattes of the kinds that a block's passes show; `packed` are the zones for which its batches were packed.
pub(super) fn of_block(kinds: &[MatteKind], gathered: &MatteSums, packed: u64) -> Vec<Matte> {
    if kinds.is_empty() {
        return Vec::new();
    }
    let codes = codes(packed);
    let covers = |kind: &MatteKind| {
        let cover = |met: &Met| {
            let weight = (f64::from(met.share) * WHOLE).round() as u64;
            codes.get(met.slot as usize).map(|code| Cover { code: *code, name: met.names[*kind as usize], weight })
        };
        Matte::of(gathered.met.iter().filter_map(cover).collect())
    };
    kinds.iter().map(covers).collect()
}

impl Matte {
    fn of(mut covers: Vec<Cover>) -> Self {
        covers.sort_unstable_by_key(Cover::place);
        covers.dedup_by(|next, first| {
            let same = next.place() == first.place();
            first.weight += if same { next.weight } else { 0 };
            same
        });
        Self { covers }
    }

    /// Adds other covers of the same tile.
    pub(super) fn add(&mut self, other: &Self) {
        let mut sums = Vec::with_capacity(self.covers.len().max(other.covers.len()));
        let (mut own, mut more) = (self.covers.iter().peekable(), other.covers.iter().peekable());
        loop {
            let next = match (own.peek(), more.peek()) {
                (Some(a), Some(b)) if a.place() == b.place() => Cover { weight: a.weight + b.weight, ..**a },
                (Some(a), Some(b)) => {
                    if a.place() < b.place() {
                        **a
                    } else {
                        **b
                    }
                }
                (Some(one), None) | (None, Some(one)) => **one,
                (None, None) => break,
            };
            own.next_if(|cover| cover.place() == next.place());
            more.next_if(|cover| cover.place() == next.place());
            sums.push(next);
        }
        self.covers = sums;
    }

    /// Two ranks of a pixel: the names that cover most of it, by their values, and their shares; a whole sample is `scale` of the pixel.
    /// `ranked` is room that pixels share.
    pub(super) fn ranks(&self, code: usize, layer: u8, scale: f64, ranked: &mut Vec<Cover>) -> [f32; 4] {
        let [first, end] = [0, 1].map(|next| self.covers.partition_point(|cover| cover.code < code as u32 + next));
        ranked.clear();
        ranked.extend_from_slice(&self.covers[first..end]);
        ranked.sort_unstable_by_key(|cover| (Reverse(cover.weight), cover.name));
        let mut ranks = [0.0; 4];
        for (pair, cover) in ranks.chunks_exact_mut(2).zip(&ranked[ranked.len().min(2 * usize::from(layer))..]) {
            pair[0] = f32::from_bits(cover.name);
            pair[1] = (cover.weight as f64 / WHOLE * scale) as f32;
        }
        ranks
    }

    pub(super) fn write(&self, out: &mut impl Write) -> Result<()> {
        out.write_all(&(self.covers.len() as u32).to_le_bytes())?;
        out.write_all(bytemuck::cast_slice(&self.covers))
    }

    /// What [`Matte::write`] has written; a length that the input does not have is an error.
    pub(super) fn read(input: &mut impl Read) -> Result<Self> {
        let (count, mut covers) = (number(input)? as usize, Vec::new());
        while covers.len() < count {
            // A damaged length must not ask for memory that no file fills.
            covers.extend(array::<Cover>(input, (count - covers.len()).min(1 << 16))?);
        }
        Ok(Self { covers })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn met(slot: u32, name: u32, share: f32) -> Met {
        Met { slot, names: [name, 0, 0], share }
    }

    fn matte(met: &[Met]) -> Matte {
        of_block(&[MatteKind::Object], &MatteSums { met: met.to_vec() }, u64::MAX).swap_remove(0)
    }

    #[test]
    fn covers_add_up_in_any_order() {
        let all: Vec<Met> = (0..500_u32).map(|i| met(i * 7 % 40, i * 13 % 5, 0.1 + (i % 9) as f32 * 0.1)).collect();
        let whole = matte(&all);
        let parts: Vec<Matte> = all.chunks(37).map(matte).collect();
        for order in [parts.iter().collect::<Vec<_>>(), parts.iter().rev().collect()] {
            let mut sum = Matte::default();
            order.into_iter().for_each(|part| sum.add(part));
            assert_eq!(sum, whole);
        }
        assert!(whole.covers.windows(2).all(|pair| pair[0].place() < pair[1].place()));
    }

    #[test]
    fn bytes_come_back() {
        let whole = matte(&[met(3, 1, 1.0), met(3, 2, 0.5), met(9, 1, 0.25)]);
        let mut bytes = Vec::new();
        whole.write(&mut bytes).expect("memory");
        assert_eq!(Matte::read(&mut bytes.as_slice()).expect("whole"), whole);
        assert!(Matte::read(&mut &bytes[..bytes.len() - 1]).is_err());
    }

    #[test]
    fn packed_zones_go_back_to_their_pixels() {
        // Zone 2 alone: all 64 runs of a batch are its samples.
        let sums = MatteSums { met: vec![met(5, 1, 1.0), met(64 + 5, 1, 1.0)] };
        let packed = of_block(&[MatteKind::Object], &sums, 1 << 2).swap_remove(0);
        assert_eq!(packed.covers, [Cover { code: 2 * 64 + 5, name: 1, weight: 2 << 24 }]);
    }
}
