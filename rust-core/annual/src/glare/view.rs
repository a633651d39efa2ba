//! What eyes see of the sky with nothing scattering between.

use crate::{
    coefficients::Coefficients,
    division::{Division, dot},
    error::{AnnualError, Result},
    group::{Blinds, Group},
    position_index::position_index,
    sun::SUN_ANGLE_DEG,
};
use std::f64::consts::TAU;

/// Luminance from which on a patch is a source of glare, cd/m², as evalglare and dcglare have it where nothing is said.
pub(super) const THRESHOLD: f64 = 2000.0;
/// Patches whose centre lies nearer to the plane of the eye than this cosine show nothing of themselves: their index is the greatest.
const LEAST_COSINE: f64 = 0.02;

/// What an eye sees of the sky with nothing scattering between.
#[derive(Clone, Debug)]
pub(super) struct SkyView {
    /// By patch: the greatest share of its luminance that is seen anywhere in it.
    share: Vec<f64>,
    /// By patch: the integral over its solid angle of that share squared, over the position index squared, sr.
    strength: Vec<f64>,
}

impl SkyView {
    /// By what patches of a division bring straight to the plane across the line of sight, lx for 1 cd/m², in each of several rounds, each of one place a
    /// patch. `facing` is of length 1.
    fn new<'a>(division: &Division, facing: [f64; 3], rounds: impl Iterator<Item = &'a [f32]>) -> Self {
        let patches = division.patches();
        let frame = Frame::new(facing);
        let weights: Vec<Option<[f64; 2]>> = patches
            .iter()
            .enumerate()
            .map(|(number, patch)| {
                let direction = patch.direction();
                let cosine = dot(direction, facing);
                (number > 0 && cosine > LEAST_COSINE)
                    .then(|| [cosine * patch.solid_angle, position_index(frame.of(direction)).powi(-2) * patch.solid_angle])
            })
            .collect();
        let (mut share, mut strength, mut count) = (vec![0.0; patches.len()], vec![0.0; patches.len()], 0);
        for round in rounds {
            count += 1;
            for (patch, (found, weight)) in round.iter().zip(&weights).enumerate() {
                let Some([projected, weighed]) = weight else { continue };
                let seen = (f64::from(*found) / projected).clamp(0.0, 1.0);
                share[patch] = f64::max(share[patch], seen);
                strength[patch] += seen * seen * weighed;
            }
        }
        strength.iter_mut().for_each(|strength| *strength /= f64::from(count.max(1)));
        Self { share, strength }
    }

    /// Σ L² ω / P² of a sky's patches that glare, cd²/m⁴ sr.
    pub(super) fn of_sky(&self, sky: &[f32]) -> f64 {
        let glares = |((luminance, share), _): &((&f32, &f64), &f64)| f64::from(**luminance) * **share >= THRESHOLD;
        let patches = sky.iter().zip(&self.share).zip(&self.strength).filter(glares);
        patches.map(|((luminance, _), strength)| f64::from(*luminance).powi(2) * strength).sum()
    }

    /// The same through what leaves a share of the light.
    fn dimmed(&self, by: f64) -> Self {
        Self {
            share: self.share.iter().map(|share| share * by).collect(),
            strength: self.strength.iter().map(|strength| strength * by * by).collect(),
        }
    }
}

/// Σ L² ω / P² of the sun's disc before an eye, by what it brings straight to the plane across the line of sight, lx.
pub(super) fn of_sun(facing: [f64; 3], sun: [f64; 3], illuminance: f64) -> f64 {
    let cosine = dot(sun, facing);
    if cosine <= 1e-3 || illuminance <= 0.0 {
        return 0.0;
    }
    let disc = TAU * (1.0 - (0.5 * SUN_ANGLE_DEG).to_radians().cos());
    (illuminance / cosine).powi(2) / disc * position_index(Frame::new(facing).of(sun)).powi(-2)
}

/// What eyes see through a group of windows, one view an eye.
#[derive(Clone, Debug)]
pub(super) struct GroupViews {
    pub(super) open: Vec<SkyView>,
    /// With blinds closed; none where there are none.
    pub(super) closed: Option<Vec<SkyView>>,
}

impl GroupViews {
    /// By what a group's windows bring to the planes across the eyes' lines of sight.
    ///
    /// # Errors
    /// Coefficients that do not tell scattered light apart.
    pub(super) fn new(division: &Division, facings: &[[f64; 3]], group: &Group) -> Result<Self> {
        let missing = || AnnualError::setting("scattered", "coefficients of scattered light are missing: they tell what is seen straight");
        let views = |all: &Coefficients, scattered: &Coefficients| {
            // What is not scattered comes straight from the patches.
            let straight = |(all, scattered): (&Vec<f32>, &Vec<f32>)| all.iter().zip(scattered).map(|(a, b)| (a - b).max(0.0)).collect();
            let rounds: Vec<Vec<f32>> = all.blocks.iter().zip(&scattered.blocks).map(straight).collect();
            let patches = division.patches().len();
            let of_eye = |eye: usize| rounds.iter().map(move |round| round.get(eye * patches..(eye + 1) * patches).unwrap_or_default());
            facings.iter().enumerate().map(|(eye, facing)| SkyView::new(division, *facing, of_eye(eye))).collect::<Vec<_>>()
        };
        let open = views(&group.open, group.scattered.as_ref().ok_or_else(missing)?);
        let closed = match &group.blinds {
            None => None,
            Some(Blinds::Share(share)) => Some(open.iter().map(|view| view.dimmed(f64::from(*share))).collect()),
            Some(Blinds::Traced { all, scattered, .. }) => Some(views(all, scattered)),
            Some(Blinds::Coefficients(_)) => return Err(missing()),
        };
        Ok(Self { open, closed })
    }
}

/// An eye's axes.
pub(super) struct Frame([[f64; 3]; 3]);

impl Frame {
    /// Upright, looking along a unit vector; straight up or down north is its top.
    pub(super) fn new(ahead: [f64; 3]) -> Self {
        let top = if ahead[2].abs() > 0.999_999 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let cross = |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let right = cross(ahead, top);
        let length = dot(right, right).sqrt();
        let right = right.map(|part| part / length);
        Self([right, cross(right, ahead), ahead])
    }

    /// A direction as the eye has it: right, up, ahead.
    pub(super) fn of(&self, direction: [f64; 3]) -> [f64; 3] {
        self.0.map(|axis| dot(axis, direction))
    }

    /// The direction that the eye has as right, up, ahead.
    pub(super) fn from(&self, seen: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| (0..3).map(|axis| self.0[axis][i] * seen[axis]).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_open_sky_is_all_seen() {
        let division = Division::new(1).expect("Tregenza's");
        let facing = [0.0, 1.0, 0.0];
        let rounds: Vec<f32> =
            division.patches().iter().map(|patch| (dot(patch.direction(), facing).max(0.0) * patch.solid_angle) as f32).collect();
        let view = SkyView::new(&division, facing, std::iter::once(rounds.as_slice()));
        let bright = vec![3000.0; 146];
        let ahead: f64 = division
            .patches()
            .iter()
            .skip(1)
            .filter(|patch| dot(patch.direction(), facing) > LEAST_COSINE)
            .map(|patch| {
                let [east, north, up] = patch.direction();
                patch.solid_angle / position_index([east, up, north]).powi(2)
            })
            .sum();
        assert!((view.of_sky(&bright) / (9e6 * ahead) - 1.0).abs() < 1e-5);
        assert_eq!(view.of_sky(&vec![1999.0; 146]), 0.0);
    }

    #[test]
    fn the_sun_counts_by_its_light_at_the_eye() {
        let facing = [0.0, 1.0, 0.0];
        let disc = TAU * (1.0 - (0.5 * SUN_ANGLE_DEG).to_radians().cos());
        let sun = [0.0, 0.6, 0.8];
        // 1e9 cd/m² through glass of 0.5.
        let seen = 0.5e9 * disc * 0.6;
        let weight = position_index([0.0, 0.8, 0.6]).powi(-2);
        assert!((of_sun(facing, sun, seen) / (0.25e18 * disc * weight) - 1.0).abs() < 1e-9);
        assert_eq!(of_sun(facing, [0.0, -0.6, 0.8], 100.0), 0.0);
    }
}
