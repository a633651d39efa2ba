//! The sun spread over the patches nearest to it, as `gendaymtx` does.

use super::Conditions;
use crate::division::{Division, dot};

/// Most patches that share the sun.
pub(super) const MOST: usize = 4;

/// Adds the sun to a column: its illuminance is shared out by nearness among `count` patches.
pub(super) fn add_sun(division: &Division, centres: &[[f64; 3]], now: &Conditions, count: usize, column: &mut [f32]) {
    let sun = now.sun.direction();
    let mut nearest = [(-1.0, 0); MOST];
    let nearest = &mut nearest[..count];
    for (patch, centre) in centres.iter().enumerate().skip(1) {
        let cosine = dot(*centre, sun);
        if let Some(place) = nearest.iter().position(|(other, _)| cosine > *other) {
            nearest[place..].rotate_right(1);
            nearest[place] = (cosine, patch);
        }
    }
    let weight = |cosine: f64| 1.0 / (1.002 - cosine);
    let total: f64 = nearest.iter().map(|(cosine, _)| weight(*cosine)).sum();
    for (cosine, patch) in nearest.iter() {
        let share = weight(*cosine) / total;
        column[*patch] += (share * now.direct_normal / division.patches()[*patch].solid_angle) as f32;
    }
}
