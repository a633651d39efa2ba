//! Bright surfaces before eyes: luminances of directions by coefficients, and which of them glare.

use super::view::{Frame, THRESHOLD};
use crate::{
    chunk::Chunk,
    division::Division,
    error::Result,
    evaluate::{Settings, evaluate},
    group::Group,
    position_index::position_index,
    schedule::Schedule,
    year::Year,
};

/// The division of the half of all directions that an eye sees, whose zenith is its line of sight: 577 of them.
const FACTOR: u32 = 2;

/// A direction before an eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sight {
    /// Unit vector: east, north, up.
    pub direction: [f64; 3],
    /// Its part of the directions over the square of its position index, sr.
    pub weight: f64,
}

/// The directions before an eye that looks along a unit vector: a place in each part of an even division.
pub fn sights(facing: [f64; 3]) -> Vec<Sight> {
    let (frame, division) = (Frame::new(facing), Division::new(FACTOR));
    let parts = division.iter().flat_map(|division| (1..division.patches().len()).map(move |part| (division, part)));
    let sight = |(division, part): (&Division, usize)| {
        // Places of a sequence that fills squares evenly (Roberts 2018), lest stripes fall in step with the division.
        let within = [0.754_877_666_246_69, 0.569_840_290_998_05].map(|step: f64| (0.5 + part as f64 * step).fract());
        let seen = division.place(part, within)?;
        let weight = division.patches()[part].solid_angle / position_index(seen).powi(2);
        Some(Sight { direction: frame.from(seen), weight })
    };
    parts.filter_map(sight).collect()
}

/// What eyes see of surfaces.
#[derive(Clone, Debug)]
pub struct Surfaces {
    /// Weights of the [`sights`] of an eye after the other, as many for each.
    pub weights: Vec<f64>,
    /// Luminance by scattered light of each of them, cd/m² for a patch of 1 cd/m², by the groups of windows of the eyes; in three independent estimates or more.
    pub windows: Vec<Group>,
}

/// Σ L² ω / P² of surfaces that glare, eyes × steps: of all estimates, and without each of them.
#[derive(Clone, Debug, Default)]
pub(super) struct SurfaceSources {
    whole: Vec<f64>,
    without: Vec<Vec<f64>>,
}

impl SurfaceSources {
    /// The sources of a year by windows whose blinds are closed as schedules say.
    ///
    /// # Errors
    /// As [`evaluate`].
    pub(super) fn new(
        year: &Year,
        (surfaces, windows, eyes): (&Surfaces, &[Group], usize),
        settings: &Settings,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Option<Self>> {
        let estimates = windows.first().map_or(0, |group| group.open.blocks.len());
        let empty = || vec![0.0; eyes * year.steps.len()];
        let mut found = Self { whole: empty(), without: (0..estimates).map(|_| empty()).collect() };
        let mut parts: Vec<Vec<f32>> = Vec::new();
        let mut take = |chunk: &Chunk<'_>| {
            if chunk.without.is_none() {
                parts.clear();
            }
            parts.push(chunk.total.to_vec());
            if parts.len() == estimates + 1 {
                found.add(year.steps.len(), chunk.steps, (&surfaces.weights, eyes), &parts);
            }
            goes_on()
        };
        let always = Schedule::daily(year, 0.0, 24.0)?;
        Ok(evaluate(year, &always, windows, settings, &mut take)?.map(|_| found))
    }

    /// Adds some steps: `parts` are luminances of all estimates and without each, directions × steps.
    fn add(&mut self, of_year: usize, steps: &[usize], (weights, eyes): (&[f64], usize), parts: &[Vec<f32>]) {
        let (count, each) = (self.without.len() as f64, weights.len() / eyes.max(1));
        let mut estimates = vec![0.0; self.without.len()];
        for (row, weight) in weights.iter().enumerate() {
            for (place, step) in steps.iter().enumerate() {
                let at = row * steps.len() + place;
                let mean = f64::from(parts[0][at]);
                if mean < THRESHOLD {
                    continue;
                }
                let of = |without: &Vec<f32>| count * mean - (count - 1.0) * f64::from(without[at]);
                estimates.iter_mut().zip(&parts[1..]).for_each(|(estimate, without)| *estimate = of(without));
                let (sum, squares) = (count * mean, estimates.iter().map(|estimate| estimate * estimate).sum::<f64>());
                // Products of different estimates are squares without the noise of either.
                let square = |sum: f64, squares: f64, count: f64| weight * (sum * sum - squares) / (count * (count - 1.0));
                let at = row / each * of_year + step;
                self.whole[at] += square(sum, squares, count);
                for (without, estimate) in self.without.iter_mut().zip(&estimates) {
                    without[at] += square(sum - estimate, squares - estimate * estimate, count - 1.0);
                }
            }
        }
    }

    /// The sum at a place of eyes × steps; without a round of other estimates, of so many, as their jackknife takes it.
    pub(super) fn at(&self, place: usize, without: Option<(usize, usize)>) -> f64 {
        let whole = self.whole.get(place).copied().unwrap_or(0.0);
        let estimates = self.without.len();
        let other = |(round, rounds): (usize, usize)| {
            let without = self.without.get(round * estimates / rounds)?;
            // Each estimate is left out in several rounds: that their spread is that of a jackknife over estimates.
            let shrink = ((estimates as f64 - 1.0) / (rounds as f64 - 1.0)).sqrt();
            Some(whole + shrink * (without[place] - whole))
        };
        without.and_then(other).unwrap_or(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::division::dot;

    #[test]
    fn sights_fill_the_half_before_an_eye() {
        let facing = [0.6, 0.0, 0.8];
        let found = sights(facing);
        assert_eq!(found.len(), 577);
        assert!(
            found.iter().all(|sight| dot(sight.direction, facing) > 0.0 && (dot(sight.direction, sight.direction) - 1.0).abs() < 1e-12)
        );
        // The weights of an even half: their sum by a fine grid of directions.
        let fine = |frame: Frame| -> f64 {
            let (rings, turns) = (400, 800);
            let cell = std::f64::consts::FRAC_PI_2 / f64::from(rings) * std::f64::consts::TAU / f64::from(turns);
            let of = |(ring, turn): (i32, i32)| {
                let angle = (f64::from(ring) + 0.5) * std::f64::consts::FRAC_PI_2 / f64::from(rings);
                let around = (f64::from(turn) + 0.5) * std::f64::consts::TAU / f64::from(turns);
                let seen = [angle.sin() * around.cos(), angle.sin() * around.sin(), angle.cos()];
                angle.sin() * cell / position_index(frame.of(frame.from(seen))).powi(2)
            };
            (0..rings).flat_map(|ring| (0..turns).map(move |turn| (ring, turn))).map(of).sum()
        };
        let sum: f64 = found.iter().map(|sight| sight.weight).sum();
        assert!((sum / fine(Frame::new(facing)) - 1.0).abs() < 0.01, "{sum}");
    }

    #[test]
    fn squares_have_no_bias_by_noise() {
        let mut found = SurfaceSources { whole: vec![0.0; 1], without: vec![vec![0.0; 1]; 4] };
        // Estimates 2000, 4000, 6000 and 8000: pairs of them have a mean product of 23.33 million, the square of their mean is 25.
        let estimates = [2000.0, 4000.0, 6000.0, 8000.0_f32];
        let parts: Vec<Vec<f32>> =
            std::iter::once(vec![5000.0]).chain(estimates.iter().map(|without| vec![(20_000.0 - without) / 3.0])).collect();
        found.add(1, &[0], (&[2.0], 1), &parts);
        let pairs = |chosen: &[f64]| {
            let all = chosen
                .iter()
                .enumerate()
                .flat_map(|(i, a)| chosen.iter().enumerate().filter(move |(j, _)| *j != i).map(move |(_, b)| a * b));
            2.0 * all.sum::<f64>() / (chosen.len() * (chosen.len() - 1)) as f64
        };
        assert!((found.at(0, None) / pairs(&[2e3, 4e3, 6e3, 8e3]) - 1.0).abs() < 1e-6);
        assert!((found.without[1][0] / pairs(&[2e3, 6e3, 8e3]) - 1.0).abs() < 1e-6);
        let round = found.at(0, Some((5, 16)));
        assert!((round - found.whole[0] - 0.2_f64.sqrt() * (found.without[1][0] - found.whole[0])).abs() < 1e-3);
        // Below the threshold there is no source.
        let dim: Vec<Vec<f32>> = vec![vec![1999.0]; 5];
        let before = found.whole[0];
        found.add(1, &[0], (&[2.0], 1), &dim);
        assert!((found.whole[0] - before).abs() < 1e-9);
    }
}
