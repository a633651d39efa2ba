//! What is known in advance: which zones a comparison's mask names, and how much each value counts.

use super::places::{INNER, STEPS, ZIGZAGS, ZONES};

/// Names of a pixel's values, in the order of the weights.
const A: usize = 0;
const B: usize = 1;
const C: usize = 2;
const D: usize = 3;
const E: usize = 4;
const F: usize = 5;
const G: usize = 6;
const H: usize = 7;
/// Values of a pixel that are always there in level two.
pub(super) const VALUES: usize = 8;

/// Pairs of neighbours that are compared, in quads, and the zone between the two.
const PAIRS: [[([usize; 2], usize); 4]; 2] =
    [[([A, E], 0), ([E, G], 1), ([G, F], 2), ([F, H], 3)], [([C, E], 0), ([H, B], 4), ([H, D], 4), ([D, D], 4)]];

/// The pairs of each quad of comparisons; the last of the second compares a value with itself.
pub(super) const QUADS: [[[usize; 2]; 4]; 2] = {
    let mut quads = [[[0; 2]; 4]; 2];
    let mut place = 0;
    while place < 8 {
        quads[place / 4][place % 4] = PAIRS[place / 4][place % 4].0;
        place += 1;
    }
    quads
};

/// The discontinuity table: by quad and the mask of its comparisons, bits of the zones that hold a discontinuity.
pub(super) const DISCONTINUITIES: [[u32; 16]; 2] = {
    let mut table = [[0; 16]; 2];
    let mut place = 0;
    while place < 2 * 16 * 4 {
        let (quad, mask, pair) = (place / 64, place / 4 % 16, place % 4);
        if mask >> pair & 1 == 1 {
            table[quad][mask] |= 1 << PAIRS[quad][pair].1;
        }
        place += 1;
    }
    table
};

/// Weight of a traced point of a zigzag.
pub(super) const STEP_WEIGHT: f32 = 1.0 / INSIDE as f32;
/// Inner points and those of the zigzags, all of which count alike; the corners together count as one more.
const INSIDE: usize = INNER.len() + ZONES * STEPS + 1;

/// Weights of the values A to H, by the bits of the zones whose zigzags are traced; those of the other zones are interpolated.
pub(super) static WEIGHTS: [f32; VALUES << ZONES] = weights();

const fn weights() -> [f32; VALUES << ZONES] {
    let mut all = [0.0; VALUES << ZONES];
    let mut traced = 0;
    while traced < 1 << ZONES {
        let row = weights_of(traced);
        let mut value = 0;
        while value < VALUES {
            all[traced * VALUES + value] = row[value] as f32;
            value += 1;
        }
        traced += 1;
    }
    all
}

const fn weights_of(traced: usize) -> [f64; VALUES] {
    let point = 1.0 / INSIDE as f64;
    let corner = point / 4.0;
    let mut weights = [corner, corner, corner, corner, point, point, point, point];
    let mut number = 0;
    while number < ZONES * STEPS {
        let (zone, step) = (number / STEPS, number % STEPS);
        if traced >> zone & 1 == 0 {
            let [left, right] = ends(zone, ZIGZAGS[zone][step][1]);
            let way = (ZIGZAGS[zone][step][0] as f64 - zone as f64 / ZONES as f64) * ZONES as f64;
            weights[left] += (1.0 - way) * point;
            weights[right] += way * point;
        }
        number += 1;
    }
    weights
}

/// The values between which a point at height `y` of a zone is interpolated, linearly from left to right.
const fn ends(zone: usize, y: f32) -> [usize; 2] {
    match zone {
        0 => [if y < 0.25 { A } else { C }, E],
        1 => [E, G],
        2 => [G, F],
        3 => [F, H],
        _ => [H, if y > 0.75 { D } else { B }],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_name_the_zones_between_what_differs() {
        assert_eq!(DISCONTINUITIES[0][0b0000], 0);
        assert_eq!(DISCONTINUITIES[0][0b0001], 0b00001);
        assert_eq!(DISCONTINUITIES[0][0b0110], 0b00110);
        assert_eq!(DISCONTINUITIES[0][0b1111], 0b01111);
        assert_eq!(DISCONTINUITIES[1][0b0001], 0b00001);
        assert_eq!(DISCONTINUITIES[1][0b0010], 0b10000);
        assert_eq!(DISCONTINUITIES[1][0b0111], 0b10001);
    }

    #[test]
    fn compared_values_are_neighbours_across_their_zone() {
        let across = |value: usize| match value {
            A | C => 0.0,
            B | D => 1.0,
            inner => INNER[inner - E][0],
        };
        for (pair, zone) in PAIRS.into_iter().flatten().filter(|(pair, _)| pair[0] != pair[1]) {
            let mut ends = pair.map(across);
            ends.sort_by(f32::total_cmp);
            assert!((ends[0] - zone as f32 / 5.0).abs() < 1e-6 && (ends[1] - (zone as f32 + 1.0) / 5.0).abs() < 1e-6);
        }
    }

    #[test]
    fn weights_add_up_to_one() {
        for traced in 0..1 << ZONES {
            let row: f32 = WEIGHTS[traced * VALUES..(traced + 1) * VALUES].iter().sum();
            let steps = (traced as u32).count_ones() * STEPS as u32;
            assert!((row + steps as f32 * STEP_WEIGHT - 1.0).abs() < 1e-6, "{traced}");
        }
    }

    #[test]
    fn interpolation_keeps_a_ramp_across_the_zones() {
        let ramp = [0.0, 1.0, 0.0, 1.0, INNER[0][0], INNER[1][0], INNER[2][0], INNER[3][0]];
        for traced in 0..1 << ZONES {
            let values: f32 = ramp.iter().zip(&WEIGHTS[traced * VALUES..]).map(|(value, weight)| value * weight).sum();
            let zones = ZIGZAGS.iter().enumerate().filter(|(zone, _)| traced >> zone & 1 == 1);
            let steps: f32 = zones.flat_map(|(_, zigzag)| zigzag).map(|[x, _]| x * STEP_WEIGHT).sum();
            assert!((values + steps - 0.5).abs() < 1e-5, "{traced}");
        }
    }
}
