//! Deep pictures: what of each pixel lies at which depth.
//!
//! Depths that differ by less than a tolerance are one: of a pixel 48 bytes are kept for each of them that a sample met. Coverage is counted in
//! whole numbers, light in steps that add up exactly for all but the brightest pictures, so that order does not matter.

use super::raw::{array, number};
use crate::{camera::sampler::codes, deep::DeepSample, scene::Aov, transport::DeepSums};
use bytemuck::{Pod, Zeroable};
use std::io::{Read, Result, Write};

/// What a whole sample counts.
const WHOLE: f64 = (1_u64 << 24) as f64;
/// Steps of light: sums below 2²⁷ cd/m² are exact.
const STEP: f64 = 1.0 / (1_u64 << 26) as f64;
/// Metres at which files have what is behind all surfaces: compositors do not take infinity.
pub const BEHIND_ALL: f32 = 1e10;
/// What is left open of a pixel counts as nothing below this.
const CLOSED: f64 = 1e-6;
/// Depths of places in the air are one within a sixteenth of an octave.
const SOFT_BITS: u32 = MANTISSA - 4;
/// Bits of a float behind the exponent.
const MANTISSA: u32 = 23;

/// What of a pixel lies at depths that count as one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Pod, Zeroable)]
#[repr(C)]
struct Slab {
    /// The pixel's Morton number.
    code: u32,
    bin: u32,
    nearest: f32,
    farthest: f32,
    /// Samples times [`WHOLE`].
    weight: u64,
    /// Sum of radiance.
    light: [f64; 3],
}

impl Slab {
    fn place(&self) -> (u32, u32) {
        (self.code, self.bin)
    }
    fn take_in(&mut self, other: &Self) {
        self.nearest = self.nearest.min(other.nearest);
        self.farthest = self.farthest.max(other.farthest);
        self.weight += other.weight;
        self.light.iter_mut().zip(other.light).for_each(|(sum, more)| *sum += more);
    }
}

/// The slabs of a tile, sorted by pixel and depth.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Deep {
    slabs: Vec<Slab>,
}

/// How many bits of a depth count for a tolerance.
fn dropped_bits(tolerance: f32) -> u32 {
    let kept = (1.0 / tolerance.clamp(1e-6, 1.0)).log2().ceil() as u32;
    MANTISSA - kept.min(MANTISSA)
}

/// What a block's samples met; `packed` are the zones for which its batches were packed.
pub(super) fn of_block(gathered: &DeepSums, tolerance: f32, packed: u64) -> Deep {
    let (codes, dropped) = (codes(packed), dropped_bits(tolerance));
    let of_air = SOFT_BITS.max(dropped);
    let slabs = gathered.parts.iter().filter_map(|part| {
        let depth = part.depth.clamp(0.0, BEHIND_ALL);
        Some(Slab {
            code: *codes.get(part.slot as usize)?,
            // The bits of positive floats rise as they do, in steps that are equal within an octave. Surfaces and air are apart.
            bin: if part.soft { depth.to_bits() >> of_air << (of_air - dropped + 1) | 1 } else { depth.to_bits() >> dropped << 1 },
            nearest: depth,
            farthest: depth,
            weight: (f64::from(part.coverage) * WHOLE).round().max(0.0) as u64,
            light: part.light.map(|light| (f64::from(light) / STEP).round() * STEP),
        })
    });
    Deep::of(slabs.collect())
}

impl Deep {
    fn of(mut slabs: Vec<Slab>) -> Self {
        slabs.sort_by_key(Slab::place);
        slabs.dedup_by(|next, first| {
            let same = next.place() == first.place();
            if same {
                first.take_in(next);
            }
            same
        });
        Self { slabs }
    }

    /// Adds other slabs of the same tile.
    pub(super) fn add(&mut self, other: &Self) {
        if !other.slabs.is_empty() {
            *self = Self::of([self.slabs.as_slice(), &other.slabs].concat());
        }
    }

    /// The slabs of a pixel, from front to back.
    fn pixel(&self, code: usize) -> &[Slab] {
        let [first, end] = [0, 1].map(|next| self.slabs.partition_point(|slab| slab.code < code as u32 + next));
        &self.slabs[first..end]
    }

    pub(super) fn write(&self, out: &mut impl Write) -> Result<()> {
        out.write_all(&(self.slabs.len() as u32).to_le_bytes())?;
        out.write_all(bytemuck::cast_slice(&self.slabs))
    }

    /// What [`Deep::write`] has written; a length that the input does not have is an error.
    pub(super) fn read(input: &mut impl Read) -> Result<Self> {
        let (count, mut slabs) = (number(input)? as usize, Vec::new());
        while slabs.len() < count {
            // A damaged length must not ask for memory that no file fills.
            slabs.extend(array::<Slab>(input, (count - slabs.len()).min(1 << 16))?);
        }
        Ok(Self { slabs })
    }
}

/// Part of a pixel on its way to a file: its light and coverage as shares of the whole pixel.
#[derive(Clone, Copy, Debug)]
struct Part {
    depth: [f32; 2],
    light: [f64; 3],
    coverage: f64,
}

/// Takes together neighbours that are within the tolerance of each other; a whole sample is `scale` of the pixel.
fn parts(slabs: &[Slab], tolerance: f32, scale: f64, exposure: f64) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::with_capacity(slabs.len() + 1);
    for slab in slabs {
        let (coverage, light) = (slab.weight as f64 / WHOLE * scale, slab.light.map(|light| light * scale * exposure));
        match parts.last_mut() {
            Some(last) if slab.farthest - last.depth[0] <= tolerance * last.depth[0] => {
                last.depth[1] = slab.farthest;
                last.coverage += coverage;
                last.light.iter_mut().zip(light).for_each(|(sum, more)| *sum += more);
            }
            _ => parts.push(Part { depth: [slab.nearest, slab.farthest], light, coverage }),
        }
    }
    // Air begins somewhere within its steps.
    parts.sort_by(|a, b| a.depth[0].total_cmp(&b.depth[0]));
    parts
}

/// Shares light that no depth is known of among the parts, by what they cover: that of light paths, and what denoisers are told apart.
fn spread(parts: &mut Vec<Part>, rest: [f64; 3]) {
    let covered: f64 = parts.iter().map(|part| part.coverage).sum();
    if covered <= 0.0 && parts.is_empty() {
        parts.push(Part { depth: [BEHIND_ALL; 2], light: [0.0; 3], coverage: 0.0 });
    }
    let even = 1.0 / parts.len() as f64;
    for part in parts {
        let share = if covered > 0.0 { part.coverage / covered } else { even };
        part.light.iter_mut().zip(rest).for_each(|(light, rest)| *light += rest * share);
    }
}

/// Shares of a pixel as samples of which each covers a share of what those before it leave open.
fn samples(parts: &[Part], out: &mut Vec<DeepSample>) {
    let (first, mut open) = (out.len(), 1.0_f64);
    for part in parts {
        let by = open.max(CLOSED);
        let light = part.light.map(|light| (light / by) as f32);
        if open <= CLOSED
            && let Some(last) = out[first..].last_mut()
        {
            // Nothing is seen behind it: what there still is came by rounding.
            last.rgba.iter_mut().zip(light).for_each(|(sum, light)| *sum += light * CLOSED as f32);
            continue;
        }
        let alpha = (part.coverage / by).clamp(0.0, 1.0);
        out.push(DeepSample { rgba: [light[0], light[1], light[2], alpha as f32], depth: part.depth });
        open -= part.coverage;
    }
}

/// How a tile's slabs become samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scales {
    /// Share by which depths may differ and be one.
    pub(super) tolerance: f32,
    /// Factor on the colour.
    pub(super) exposure: f32,
}

impl Deep {
    /// Appends the samples of a pixel, which flatten to its colour; a whole sample is `scale` of the pixel.
    pub(super) fn append_samples(&self, code: usize, scale: f64, scales: Scales, flat: &[f32], out: &mut Vec<DeepSample>) {
        let mut parts = parts(self.pixel(code), scales.tolerance, scale, f64::from(scales.exposure));
        if let Some(rest) = rest(&parts, flat) {
            spread(&mut parts, rest);
        }
        samples(&parts, out);
    }
}

/// What the flat pixel has beyond its parts, if that is more than rounding.
fn rest(parts: &[Part], flat: &[f32]) -> Option<[f64; 3]> {
    let mut rest = [0.0; 3];
    let mut matters = false;
    for (channel, (rest, flat)) in rest.iter_mut().zip(flat).enumerate() {
        let known: f64 = parts.iter().map(|part| part.light[channel]).sum();
        *rest = f64::from(*flat) - known;
        matters |= rest.abs() > 1e-5 * f64::from(flat.abs());
    }
    matters.then_some(rest)
}

/// Whether a film's passes ask for a deep picture.
pub(super) fn is_asked(aovs: &[Aov]) -> bool {
    aovs.contains(&Aov::Deep)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{deep::DeepPicture, transport::DeepPart};

    const TOLERANCE: f32 = 1e-3;

    fn part(slot: u32, depth: f32, coverage: f32, light: f32) -> DeepPart {
        DeepPart { slot, depth, coverage, light: [light, 0.5 * light, 0.0], soft: false }
    }

    fn sums(parts: &[DeepPart]) -> DeepSums {
        let mut sums = DeepSums::default();
        sums.parts.extend_from_slice(parts);
        sums
    }

    fn deep(parts: &[DeepPart]) -> Deep {
        of_block(&sums(parts), TOLERANCE, u64::MAX)
    }

    #[test]
    fn slabs_add_up_in_any_order() {
        let all: Vec<DeepPart> = (0..500_u32).map(|i| part(i * 7 % 40, 1.0 + (i * 13 % 5) as f32, 1.0, 0.1 + (i % 9) as f32)).collect();
        let whole = deep(&all);
        let pieces: Vec<Deep> = all.chunks(37).map(deep).collect();
        for order in [pieces.iter().collect::<Vec<_>>(), pieces.iter().rev().collect()] {
            let mut sum = Deep::default();
            order.into_iter().for_each(|piece| sum.add(piece));
            assert_eq!(sum, whole);
        }
        let mut bytes = Vec::new();
        whole.write(&mut bytes).expect("memory");
        assert_eq!(Deep::read(&mut bytes.as_slice()).expect("whole"), whole);
        assert!(Deep::read(&mut &bytes[..bytes.len() - 1]).is_err());
    }

    #[test]
    fn near_depths_are_one() {
        for scale in [0.01_f32, 1.0, 700.0] {
            let at = |factor: f32| part(0, scale * factor, 1.0, 1.0);
            let slabs = deep(&[at(1.0), at(1.0004), at(1.0008), at(1.01), at(1.5)]);
            let found = parts(slabs.pixel(0), TOLERANCE, 0.2, 1.0);
            assert_eq!(found.len(), 3, "{found:?}");
            assert!(found.iter().all(|part| part.depth[1] <= part.depth[0] * (1.0 + TOLERANCE)));
        }
        // However many samples there are, slabs are as many as tolerances.
        let many: Vec<DeepPart> = (0..50_000).map(|i| part(0, 1.0 + i as f32 / 50_000.0, 1.0, 1.0)).collect();
        assert!(deep(&many).slabs.len() <= 1025);
    }

    #[test]
    fn samples_flatten_to_the_sums() {
        let slabs = deep(&[part(0, 1.0, 0.5, 8.0), part(0, 2.0, 1.0, 4.0), part(0, 4.0, 2.0, 2.0), part(0, f32::INFINITY, 0.0, 1.0)]);
        let found = parts(slabs.pixel(0), TOLERANCE, 0.25, 2.0);
        let mut picture = DeepPicture { size: [1, 1], counts: Vec::new(), samples: Vec::new() };
        samples(&found, &mut picture.samples);
        picture.counts.push(picture.samples.len() as u32);
        let [red, green, blue, alpha] = picture.flattened()[..] else { panic!("four channels") };
        let near = |found: f32, expected: f32| assert!((found - expected).abs() < 1e-6, "{found} {expected}");
        near(red, 15.0 * 0.25 * 2.0);
        near(green, 0.5 * red);
        assert_eq!(blue, 0.0);
        near(alpha, 3.5 * 0.25);
        assert_eq!(picture.samples[3].depth, [BEHIND_ALL; 2]);
        near(picture.samples[1].rgba[3], 0.25 / 0.875);
    }

    #[test]
    fn light_of_no_known_depth_is_shared() {
        let slabs = deep(&[part(0, 1.0, 0.25, 1.0), part(0, 2.0, 0.75, 1.0)]);
        let mut found = parts(slabs.pixel(0), TOLERANCE, 1.0, 1.0);
        assert_eq!(rest(&found, &[2.0, 1.0, 0.0]), None);
        let more = rest(&found, &[6.0, 1.0, 0.0]).expect("more");
        spread(&mut found, more);
        assert_eq!(found.iter().map(|part| part.light[0]).collect::<Vec<_>>(), [2.0, 4.0]);
        let mut none = Vec::new();
        spread(&mut none, [1.0; 3]);
        assert_eq!(none[0].depth, [BEHIND_ALL; 2]);
    }
}
