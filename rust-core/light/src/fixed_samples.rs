//! Fixed light samples, the same at all points, where noise is worse than a step in a half-shadow: every light at the same places of it, or, where
//! lights are many, the same strata of light selection.

use super::context::LightSampleContext;
use super::light_bounds::LightBounds;
use super::row::{ROW, field, flag};
use super::sample::LightSample;
use super::table::{LightSampler, LightTable, MOST_EXHAUSTIVE};
use gonio_simd::{F, Lanes, M};

/// Strata of light selection where lights are too many to ask each.
const STRATA: u32 = 64;

/// One of a fixed number of light samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedLightSample {
    /// The light, or none where `u_light` selects it.
    light: Option<u32>,
    /// Number in [0, 1) that selects a light.
    u_light: f32,
    /// Place on the light, in [0, 1)².
    place: [f32; 2],
    /// The sample's share in the mean of all that are of its light.
    pub share: f32,
}

impl FixedLightSample {
    /// Whether the sample before is of the same light.
    pub fn follows(&self, before: Option<&Self>) -> bool {
        self.light.is_some() && before.is_some_and(|before| before.light == self.light)
    }
}

impl LightTable {
    /// The samples that each point takes, light by light: `samples` of each light that has an extent, one of the others. Beyond 64 lights
    /// 64 samples of any.
    pub fn fixed_samples(&self, samples: u32) -> Vec<FixedLightSample> {
        if matches!(self.sampler, LightSampler::Tree(_)) {
            let share = 1.0 / STRATA as f32;
            return (0..STRATA)
                .map(|i| FixedLightSample { light: None, u_light: (i as f32 + 0.5) * share, place: place(i, STRATA), share })
                .collect();
        }
        let mut all = Vec::new();
        for (light, row) in self.rows.chunks_exact(ROW).enumerate() {
            let flags = row[field::FLAGS].to_bits();
            let count = match flags & (flag::LIT | flag::DELTA) {
                flag::LIT => samples,
                both if both & flag::LIT != 0 => 1,
                _ => 0,
            };
            let share = 1.0 / count.max(1) as f32;
            all.extend((0..count).map(|i| FixedLightSample { light: Some(light as u32), u_light: 0.0, place: place(i, count), share }));
        }
        debug_assert!(all.len() <= MOST_EXHAUSTIVE * samples.max(1) as usize);
        all
    }

    /// Where some of a sample's light may arrive, at points.
    #[inline(always)]
    pub fn reaches<L: Lanes>(&self, l: L, fixed: &FixedLightSample, from: &LightSampleContext<L>) -> M<L> {
        match fixed.light {
            Some(light) => {
                let importance = LightBounds::splat(l, &self.rows[light as usize * ROW..][..ROW]).importance(l, from.position, from.normal);
                importance.gt(0.0) & self.sees(l, from.receiver, l.u(light))
            }
            None => l.m(true),
        }
    }

    /// A fixed sample seen from a point: [`Self::sample_li`] with its numbers.
    #[inline(always)]
    pub fn sample_fixed<L: Lanes>(&self, l: L, fixed: &FixedLightSample, from: &LightSampleContext<L>) -> LightSample<L> {
        let place: [F<L>; 2] = [l.f(fixed.place[0]), l.f(fixed.place[1])];
        match fixed.light {
            Some(light) => self.sample_li_of(l, (l.u(light), l.f(1.0)), from, &place),
            None => self.sample_li(l, None, from, l.f(fixed.u_light), &place),
        }
    }
}

/// The i-th of `count` points, in the middles of the cells of a (0, k, 2)-net for powers of two (Hammersley).
fn place(i: u32, count: u32) -> [f32; 2] {
    let cells = count.next_power_of_two();
    let reversed = if cells > 1 { i.reverse_bits() >> (32 - cells.trailing_zeros()) } else { 0 };
    [(i as f32 + 0.5) / count as f32, (reversed as f32 + 0.5) / cells as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_fill_every_row_and_column_once() {
        for count in [1, 2, 4, 8, 16, 64] {
            for axis in 0..2 {
                let mut cells: Vec<u32> = (0..count).map(|i| (place(i, count)[axis] * count as f32) as u32).collect();
                cells.sort_unstable();
                assert_eq!(cells, (0..count).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn places_of_any_number_are_inside() {
        assert!((1..=64).flat_map(|count| (0..count).flat_map(move |i| place(i, count))).all(|x| (0.0..1.0).contains(&x)));
    }
}
