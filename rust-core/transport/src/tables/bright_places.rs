//! Bright places: cells of a grid on whose surfaces light falls straight from lights, far more than elsewhere (a candle under its flame, a shade).
//!
//! Camera paths seldom meet such a place after they were scattered, and find much when they do. So light paths carry its light on to what the camera
//! sees, by a share that both sides know of each cell.

use gonio_simd::{F, Lanes, M, PADDING, U, Vec3};
use std::collections::HashMap;

/// Flux that fell straight from lights, cell by cell.
#[derive(Clone, Debug)]
pub struct DirectFlux {
    /// Cells a metre.
    scale: f32,
    cells: HashMap<[i32; 3], f64>,
    total: f64,
}

/// The share of the light from each bright cell that light paths carry on.
#[derive(Clone, Debug, Default)]
pub struct BrightPlaces {
    scale: f32,
    /// Hashes of cells, in slots by their last bits; no cell has 0.
    keys: Vec<u32>,
    shares: Vec<f32>,
}

/// Cells along the radius of the scene.
const CELLS: f64 = 128.0;
/// A place is bright where its irradiance is so many times the mean over all surfaces.
const BRIGHT: f64 = 8.0;
/// Smaller shares are none.
const LEAST_SHARE: f64 = 0.1;
/// Where cells begin, in cells: surfaces at round coordinates are not to lie on borders.
const OFFSET: [f32; 3] = [0.381_966, 0.236_068, 0.145_898];
/// Factors of the coordinates, and of their mix.
const FACTORS: [u32; 3] = [0x9e37_79b1, 0x85eb_ca77, 0xc2b2_ae3d];
const MIX: u32 = 0x2c1b_3c6d;

impl DirectFlux {
    /// None yet, in a scene of some radius, metres.
    pub fn new(radius: f64) -> Self {
        Self { scale: (CELLS / radius.max(f64::MIN_POSITIVE)) as f32, cells: HashMap::new(), total: 0.0 }
    }

    /// Adds flux (mean of R, G, B) that arrived at a place, rebased world space.
    pub fn add(&mut self, position: [f32; 3], flux: f64) {
        let cell = [0, 1, 2].map(|axis| (position[axis] * self.scale + OFFSET[axis]).floor() as i32);
        *self.cells.entry(cell).or_default() += flux;
        self.total += flux;
    }

    /// The bright places among them; `share` is the part of a path in all that were traced, `area` about that of the scene's surfaces.
    pub fn bright_places(&self, share: f64, area: f64) -> BrightPlaces {
        let of_cell = f64::from(self.scale).powi(2) * share;
        let bright = (self.total * share / area.max(f64::MIN_POSITIVE) * BRIGHT).max(f64::MIN_POSITIVE);
        let carried = |flux: f64| {
            let square = (flux * of_cell / bright).powi(2);
            if square.is_finite() { square / (square + 1.0) } else { 1.0 }
        };
        let chosen: Vec<(u32, f32)> = self
            .cells
            .iter()
            .map(|(cell, flux)| (hash(*cell), carried(*flux)))
            .filter(|(_, share)| *share >= LEAST_SHARE)
            .map(|(key, share)| (key, share as f32))
            .collect();
        if chosen.is_empty() {
            return BrightPlaces::default();
        }
        let slots = (4 * chosen.len()).next_power_of_two().max(PADDING);
        let mut places = BrightPlaces { scale: self.scale, keys: vec![0; slots], shares: vec![0.0; slots] };
        for (key, share) in chosen {
            let slot = key as usize & (slots - 1);
            // Of two cells in one slot the brighter stays, whatever the order.
            if (share, key) > (places.shares[slot], places.keys[slot]) {
                (places.keys[slot], places.shares[slot]) = (key, share);
            }
        }
        places
    }
}

impl BrightPlaces {
    /// Whether there is none.
    #[inline(always)]
    pub(crate) fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// Share of the light straight from lights that light paths carry on from chosen points.
    #[inline(always)]
    pub(crate) fn carried_on<L: Lanes>(&self, position: Vec3<L>, chosen: M<L>) -> F<L> {
        let l = position.x.lanes();
        let x = (position.x * self.scale + OFFSET[0]).floor().to_i32();
        let y = (position.y * self.scale + OFFSET[1]).floor().to_i32();
        let z = (position.z * self.scale + OFFSET[2]).floor().to_i32();
        let key = mixed((x * FACTORS[0]) ^ (y * FACTORS[1]) ^ (z * FACTORS[2]));
        let slot = (key & (self.keys.len() as u32 - 1)).keep_if(chosen);
        let known = chosen & l.gather_integers(&self.keys, slot).eq(key);
        l.gather(&self.shares, slot).keep_if(known)
    }
}

#[inline(always)]
fn mixed<L: Lanes>(h: U<L>) -> U<L> {
    let h = (h ^ (h >> 15)) * MIX;
    (h ^ (h >> 13)).max(1)
}

/// The same of one cell.
fn hash(cell: [i32; 3]) -> u32 {
    let [x, y, z] = [0, 1, 2].map(|axis| (cell[axis] as u32).wrapping_mul(FACTORS[axis]));
    let h = x ^ y ^ z;
    let h = (h ^ (h >> 15)).wrapping_mul(MIX);
    (h ^ (h >> 13)).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_simd::{Execution, dispatch};

    #[test]
    fn both_sides_know_the_same_share() {
        let mut flux = DirectFlux::new(20.0);
        for number in 0..4000 {
            let x = (number % 63) as f32 * 0.05 - 1.5;
            flux.add([x, 0.0, (number / 63) as f32 * 0.05 - 1.5], 1.0);
        }
        let spot = [0.3, 0.2, -0.7];
        (0..4000).for_each(|_| flux.add(spot, 1.0));
        let places = flux.bright_places(1.0 / 8000.0, 20.0);
        dispatch!(Execution::best(), l => {
            let at = |p: [f32; 3]| places.carried_on(Vec3::splat(l, p), l.m(true)).to_array()[0];
            assert!(at(spot) > 0.99 && at([0.301, 0.2001, -0.701]) > 0.99);
            assert_eq!((at([0.5, 0.0, 0.5]), at([9.0, 1.0, 3.0])), (0.0, 0.0));
            assert_eq!(places.carried_on(Vec3::splat(l, spot), l.m(false)).to_array()[0], 0.0);
        });
        assert!(DirectFlux::new(1.0).bright_places(1.0, 1.0).is_empty());
    }
}
