//! What camera rays met at which depth, and the light that their samples brought, for deep pictures.
//!
//! Contributions know their slot, not their depth. A slot has one sample in a batch, so what a batch adds to it is that sample's.

use gonio_camera::sampler::BATCH;
use gonio_simd::{Column, F, Lanes, M, Rgb, U};

/// What a sample brings from some depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeepPart {
    /// Slot of the pixel.
    pub slot: u32,
    /// Metres; infinite behind all surfaces.
    pub depth: f32,
    /// Share of the sample that is covered there.
    pub coverage: f32,
    /// Radiance.
    pub light: [f32; 3],
    /// Whether it is one place of many along a ray, which files may join more coarsely.
    pub soft: bool,
}

/// A first surface, a part of one that lets light pass, or a place of the air.
#[derive(Clone, Copy, Debug)]
struct Met {
    slot: u32,
    depth: f32,
    share: f32,
    soft: bool,
}

/// The parts of a block's samples; empty where no deep picture is wanted.
#[derive(Debug, Default)]
pub struct DeepSums {
    /// Batch after batch, by slot.
    pub parts: Vec<DeepPart>,
    /// Of the batch under way.
    met: Vec<Met>,
    /// Light of the batch whose depth is known by itself, which covers nothing.
    sent: Vec<DeepPart>,
    /// Radiance and coverage of all slots before it.
    before: [Vec<f32>; 4],
}

impl DeepSums {
    /// Makes room where a deep picture is wanted.
    pub fn prepare(&mut self, wanted: bool) {
        let room = if wanted { BATCH } else { 0 };
        self.before.iter_mut().for_each(|column| column.resize(room, 0.0));
    }

    pub(crate) fn clear(&mut self) {
        self.parts.clear();
        self.met.clear();
        self.sent.clear();
        self.before.iter_mut().for_each(|column| column.fill(0.0));
    }

    /// Notes what the chosen lanes met.
    #[inline(always)]
    pub fn add<L: Lanes>(&mut self, slot: U<L>, depth: F<L>, share: F<L>, chosen: M<L>, soft: bool) {
        let (slots, depths, shares) = (slot.to_array(), depth.to_array(), share.to_array());
        let mut bits = chosen.bits();
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize;
            self.met.push(Met { slot: slots[lane], depth: depths[lane], share: shares[lane], soft });
            bits &= bits - 1;
        }
    }

    /// Notes light of the chosen lanes that comes from a depth without covering what is behind it.
    #[inline(always)]
    pub fn add_light<L: Lanes>(&mut self, slot: U<L>, depth: F<L>, light: Rgb<L>, chosen: M<L>) {
        let (slots, depths) = (slot.to_array(), depth.to_array());
        let [red, green, blue] = [light.r.to_array(), light.g.to_array(), light.b.to_array()];
        let mut bits = chosen.bits();
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize;
            let light = [red[lane], green[lane], blue[lane]];
            self.sent.push(DeepPart { slot: slots[lane], depth: depths[lane], coverage: 0.0, light, soft: true });
            bits &= bits - 1;
        }
    }

    /// Shares out what a batch has added to the radiance and the coverage of each slot among what its sample met.
    pub fn settle(&mut self, radiance: &[Column; 3], alpha: &Column) {
        if self.before[3].is_empty() {
            return;
        }
        let [red, green, blue] = radiance;
        let now = [red, green, blue, alpha];
        self.met.sort_unstable_by(|a, b| (a.slot, a.depth).partial_cmp(&(b.slot, b.depth)).unwrap_or(std::cmp::Ordering::Equal));
        self.sent.sort_unstable_by_key(|part| part.slot);
        let (mut rest, mut sent) = (self.met.as_slice(), self.sent.as_slice());
        for slot in 0..BATCH as u32 {
            let here = rest.iter().take_while(|met| met.slot == slot).count();
            let (met, behind) = rest.split_at(here);
            rest = behind;
            let mut more = [0, 1, 2, 3].map(|channel| now[channel][slot as usize] - self.before[channel][slot as usize]);
            let (of_slot, others) = sent.split_at(sent.iter().take_while(|part| part.slot == slot).count());
            sent = others;
            of_slot.iter().for_each(|part| (0..3).for_each(|channel| more[channel] -= part.light[channel]));
            self.parts.extend_from_slice(of_slot);
            if here > 0 || more.iter().any(|value| *value != 0.0) {
                share_out(slot, met, more, &mut self.parts);
            }
        }
        self.before.iter_mut().zip(now).for_each(|(before, now)| before.copy_from_slice(&now[..BATCH]));
        self.met.clear();
        self.sent.clear();
    }
}

/// Parts of a sample that brought `light` and coverage.
fn share_out(slot: u32, met: &[Met], [red, green, blue, covered]: [f32; 4], parts: &mut Vec<DeepPart>) {
    let shares: f32 = met.iter().map(|met| met.share).sum();
    // What is behind all surfaces covers where lights at infinity do, and takes coverage away that clear glass leaves open.
    let beyond = if covered > shares * (1.0 + 1e-5) { covered - shares } else { 0.0 };
    let all = shares + beyond;
    let part = |depth: f32, share: f32, coverage: f32, soft: bool| DeepPart {
        slot,
        depth,
        coverage,
        light: [red, green, blue].map(|light| light * share),
        soft,
    };
    if all <= 0.0 {
        parts.push(part(f32::INFINITY, 1.0, 0.0, false));
        return;
    }
    let kept = if covered < shares { covered.max(0.0) / shares } else { 1.0 };
    parts.extend(met.iter().filter(|met| met.share > 0.0).map(|met| part(met.depth, met.share / all, met.share * kept, met.soft)));
    if beyond > 0.0 {
        parts.push(part(f32::INFINITY, beyond / all, beyond, false));
    }
}
