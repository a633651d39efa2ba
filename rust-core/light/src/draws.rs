//! Fixed draws for all points alike, where noise is worse than a step in a half-shadow: every light at the same places of it, or, where lights are
//! many, the same strata of their choice.

use super::choice::{Choice, Estimate, WEIGHED};
use super::row::{ROW, field, flag};
use super::sample::LightSample;
use super::table::LightTable;
use gonio_simd::{F, Lanes, M, Vec3};

/// Strata of the choice where lights are too many to ask each.
const STRATA: u32 = 64;

/// One of a fixed number of draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Draw {
    /// The light, or none where `choice` chooses it.
    light: Option<u32>,
    /// Number in [0, 1) that chooses.
    choice: f32,
    /// Place on the light, in [0, 1)².
    place: [f32; 2],
    /// The draw's share in the mean of all that are of its light.
    pub share: f32,
}

impl Draw {
    /// Whether the draw before is of the same light.
    pub fn follows(&self, before: Option<&Self>) -> bool {
        self.light.is_some() && before.is_some_and(|before| before.light == self.light)
    }
}

impl LightTable {
    /// The draws that each point takes, light by light: `samples` of each light that has an extent, one of the others. Beyond 64 lights
    /// 64 draws of any.
    pub fn draws(&self, samples: u32) -> Vec<Draw> {
        if matches!(self.choice, Choice::Tree(_)) {
            let share = 1.0 / STRATA as f32;
            return (0..STRATA).map(|i| Draw { light: None, choice: (i as f32 + 0.5) * share, place: place(i, STRATA), share }).collect();
        }
        let mut draws = Vec::new();
        for (light, row) in self.rows.chunks_exact(ROW).enumerate() {
            let flags = row[field::FLAGS].to_bits();
            let count = match flags & (flag::LIT | flag::DELTA) {
                flag::LIT => samples,
                both if both & flag::LIT != 0 => 1,
                _ => 0,
            };
            let share = 1.0 / count.max(1) as f32;
            draws.extend((0..count).map(|i| Draw { light: Some(light as u32), choice: 0.0, place: place(i, count), share }));
        }
        debug_assert!(draws.len() <= WEIGHED * samples.max(1) as usize);
        draws
    }

    /// Where some of a draw's light may arrive.
    #[inline(always)]
    pub fn reaches<L: Lanes>(&self, l: L, draw: &Draw, p: Vec3<L>, n: Vec3<L>) -> M<L> {
        match draw.light {
            Some(light) => Estimate::splat(l, &self.rows[light as usize * ROW..][..ROW]).illuminance(l, p, n).gt(0.0),
            None => l.m(true),
        }
    }

    /// A draw seen from point `p` with normal `n`: [`Self::sample`] with the draw's numbers.
    #[inline(always)]
    pub fn take<L: Lanes>(&self, l: L, draw: &Draw, p: &Vec3<L>, n: &Vec3<L>) -> LightSample<L> {
        let place: [F<L>; 2] = [l.f(draw.place[0]), l.f(draw.place[1])];
        match draw.light {
            Some(light) => self.sample_chosen(l, (l.u(light), l.f(1.0)), p, n, &place),
            None => self.sample(l, None, p, n, l.f(draw.choice), &place),
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
