//! Rays that fall on the window from a patch of directions: even over the window and in projected solid angle, so that all carry the same flux.

use super::place::Place;
use crate::transport::{LIGHT_BATCH, RayTable};
use gonio_formats::bsdf::Basis;

/// Steps of a sequence that fills four dimensions evenly: powers of 1/g, where g⁵ = g + 1, in units of 2⁻⁶⁴.
///
/// Lanes follow paths by digital nets; a sequence of another kind keeps where a path starts and how it goes on apart.
const STEPS: [u64; 4] = [0xdb4f_0b91_75ae_2165, 0xbbe0_5633_03a4_615f, 0xa0f2_ec75_a1fe_1575, 0x89e1_8285_7d9e_d689];

/// Where light comes from: an incident patch, and whether it is one of the front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Incident {
    pub(super) patch: usize,
    pub(super) from_front: bool,
}

/// Adds a patch's batch to the table: the rays that follow on its batches before.
pub(super) fn add_batch(table: &mut RayTable, place: &Place, basis: &Basis, incident: Incident, batch: u64, seed: u32) {
    let shift = shift(incident, seed);
    let first = batch * LIGHT_BATCH as u64;
    for number in first..first + LIGHT_BATCH as u64 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| unit(shift[k].wrapping_add(STEPS[k].wrapping_mul(number))));
        let from = basis.incident_direction(incident.patch, [c, d], incident.from_front);
        let [start, along] = place.incoming([a, b], from);
        for k in 0..3 {
            table.origin[k].push(start[k] as f32);
            table.direction[k].push(along[k] as f32);
            table.flux[k].push(1.0);
        }
    }
}

/// 64 bits as a number in [0, 1).
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 * 2.0_f64.powi(-53)
}

/// Where a patch's sequence starts.
fn shift(incident: Incident, seed: u32) -> [u64; 4] {
    let place = incident.patch as u64 * 2 + u64::from(incident.from_front);
    [0, 1, 2, 3].map(|k| mixed((u64::from(seed) << 32) ^ (place << 2 | k)))
}

/// Bits of chance (SplitMix64: Steele, Lea and Flood 2014).
fn mixed(number: u64) -> u64 {
    let mut x = number.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_powers_of_one_number() {
        let g = 1.167_303_978_261_418_7_f64;
        assert!((g.powi(5) - g - 1.0).abs() < 1e-14);
        for (k, step) in STEPS.iter().enumerate() {
            assert!(
                (unit(*step) - g.powi(-(k as i32 + 1))).abs() < 1e-14,
                "{k}: {:#x}",
                (g.powi(-(k as i32 + 1)) * 2.0_f64.powi(64)) as u64
            );
        }
    }

    #[test]
    fn sequences_fill_the_square_evenly() {
        let start = shift(Incident { patch: 7, from_front: true }, 3);
        for k in 0..4 {
            let below = (0..4096_u64).filter(|i| unit(start[k].wrapping_add(STEPS[k].wrapping_mul(*i))) < 0.3).count();
            assert!((below as f64 - 0.3 * 4096.0).abs() < 6.0, "{k}: {below}");
        }
        assert_ne!(start, shift(Incident { patch: 7, from_front: false }, 3));
    }
}
