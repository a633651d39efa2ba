//! A year of daylight glare without pictures (Jones, "Fast climate-based glare analysis and spatial mapping", 2019): the light at an eye by its
//! coefficients, contrast by the sun and by what patches of the sky show of themselves.

use crate::{
    chunk::Chunk,
    division::{Division, dot},
    error::Result,
    evaluate::{Settings, evaluate},
    group::Group,
    metrics::jackknife,
    position_index::position_index,
    schedule::Schedule,
    sky::{Light, Quantity, SkyMatrix, SkyOptions},
    sun::SUN_ANGLE_DEG,
    year::Year,
};
use serde::Serialize;
use std::f64::consts::TAU;

/// Luminance from which on a patch is a source of glare, cd/m², as evalglare and dcglare have it where nothing is said.
const THRESHOLD: f64 = 2000.0;
/// Patches whose centre lies nearer to the plane of the eye than this cosine show nothing of themselves: their index is the greatest.
const LEAST_COSINE: f64 = 0.02;
/// Values that EN 17037 names, the strictest first.
const LIMITS: [f64; 3] = [0.35, 0.40, 0.45];
/// Share of the used time in which a value may be exceeded (EN 17037).
const EXCEEDED: f64 = 0.05;
/// Parts of the range from 0 to 1 that values are counted in.
const BINS: usize = 1000;

/// What an eye sees of the sky with nothing scattering between.
#[derive(Clone, Debug)]
pub struct SkyView {
    /// Unit vector: east, north, up.
    facing: [f64; 3],
    /// By patch: the greatest share of its luminance that is seen anywhere in it.
    share: Vec<f64>,
    /// By patch: the integral over its solid angle of that share squared, over the position index squared, sr.
    strength: Vec<f64>,
}

impl SkyView {
    /// By what patches of a division bring straight to the plane across the line of sight, lx for 1 cd/m², in each of several rounds, each of one place a
    /// patch. `facing` is of length 1.
    pub fn new<'a>(division: &Division, facing: [f64; 3], rounds: impl Iterator<Item = &'a [f32]>) -> Self {
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
        Self { facing, share, strength }
    }

    /// Σ L² ω / P² of a sky's patches that glare, cd²/m⁴ sr.
    fn of_sky(&self, sky: &[f32]) -> f64 {
        let glares = |((luminance, share), _): &((&f32, &f64), &f64)| f64::from(**luminance) * **share >= THRESHOLD;
        let patches = sky.iter().zip(&self.share).zip(&self.strength).filter(glares);
        patches.map(|((luminance, _), strength)| f64::from(*luminance).powi(2) * strength).sum()
    }

    /// The same of the sun's disc, by what it brings straight to the plane across the line of sight, lx.
    fn of_sun(&self, sun: [f64; 3], illuminance: f64) -> f64 {
        let cosine = dot(sun, self.facing);
        if cosine <= 1e-3 || illuminance <= 0.0 {
            return 0.0;
        }
        let disc = TAU * (1.0 - (0.5 * SUN_ANGLE_DEG).to_radians().cos());
        (illuminance / cosine).powi(2) / disc * position_index(Frame::new(self.facing).of(sun)).powi(-2)
    }
}

/// An eye's axes.
struct Frame([[f64; 3]; 3]);

impl Frame {
    /// Upright, looking along a unit vector; straight up or down north is its top.
    fn new(ahead: [f64; 3]) -> Self {
        let top = if ahead[2].abs() > 0.999_999 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        let cross = |a: [f64; 3], b: [f64; 3]| [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let right = cross(ahead, top);
        let length = dot(right, right).sqrt();
        let right = right.map(|part| part / length);
        Self([right, cross(right, ahead), ahead])
    }

    fn of(&self, direction: [f64; 3]) -> [f64; 3] {
        self.0.map(|axis| dot(axis, direction))
    }
}

/// Daylight glare probability (Wienold and Christoffersen 2006) of E_v lx at the eye: 5.87·10⁻⁵ E_v + 0.0918 log₁₀(1 + s / E_v^1.87) + 0.16, at most 1, where
/// s is Σ L² ω / P² over the sources.
pub fn dgp(illuminance: f64, sources: f64) -> f64 {
    let of_sources = if illuminance > 0.0 { sources / illuminance.powf(1.87) } else { 0.0 };
    (5.87e-5 * illuminance + 0.0918 * (1.0 + of_sources).log10() + 0.16).min(1.0)
}

/// The same with Wienold's correction for little light, as evalglare has it below 1000 lx: times e^(0.024 E_v − 4) / (1 + e^(0.024 E_v − 4)).
pub fn dgp_low_light(illuminance: f64, sources: f64) -> f64 {
    let (dgp, exponential) = (dgp(illuminance, sources), (0.024 * illuminance.min(1000.0) - 4.0).exp());
    if illuminance < 1000.0 { dgp * exponential / (1.0 + exponential) } else { dgp }
}

/// The value of an hour: [`dgp_low_light`], 0 in the dark.
fn of_hour(illuminance: f64, sources: f64) -> f64 {
    if illuminance > 0.0 { dgp_low_light(illuminance, sources) } else { 0.0 }
}

/// What a year's glare at an eye comes to.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EyeGlare {
    /// Share of the used time with a DGP above 0.35.
    pub above_035: f64,
    /// Above 0.40.
    pub above_040: f64,
    /// Above 0.45.
    pub above_045: f64,
    /// The value that is exceeded in 5 % of the used time.
    pub dgp_5_percent: f64,
}

impl EyeGlare {
    fn figures(self) -> [f64; 4] {
        [self.above_035, self.above_040, self.above_045, self.dgp_5_percent]
    }

    fn of_figures([above_035, above_040, above_045, dgp_5_percent]: [f64; 4]) -> Self {
        Self { above_035, above_040, above_045, dgp_5_percent }
    }

    /// Which of 0.35, 0.40 and 0.45 are exceeded in no more than 5 % of the used time.
    pub fn keeps(&self) -> [bool; 3] {
        [self.above_035, self.above_040, self.above_045].map(|share| share <= EXCEEDED)
    }

    /// What EN 17037 calls it, by the strictest value that it keeps.
    pub fn level(&self) -> &'static str {
        ["high", "medium", "minimum"].into_iter().zip(self.keeps()).find(|(_, keeps)| *keeps).map_or("below the minimum", |(name, _)| name)
    }
}

/// Counts of an eye's values in the used time.
#[derive(Clone, Debug)]
struct Counted([u32; BINS + 1]);

impl Counted {
    fn add(&mut self, value: f64) {
        self.0[(value * BINS as f64).clamp(0.0, BINS as f64) as usize] += 1;
    }

    /// Of so many used steps; those that were not counted are dark.
    fn glare(&self, used: f64) -> EyeGlare {
        let above = |limit: f64| self.0[(limit * BINS as f64).round() as usize..].iter().map(|count| f64::from(*count)).sum::<f64>() / used;
        let (mut more, mut value) = (0.0, 0.0);
        for bin in (0..=BINS).rev() {
            more += f64::from(self.0[bin]) / used;
            if more > EXCEEDED {
                // The last bin is of all above.
                value = ((bin as f64 + 0.5) / BINS as f64).min(1.0);
                break;
            }
        }
        let [above_035, above_040, above_045] = LIMITS.map(above);
        EyeGlare { above_035, above_040, above_045, dgp_5_percent: value }
    }
}

/// A year of glare at several eyes.
#[derive(Clone, Debug)]
pub struct GlareYear {
    views: Vec<SkyView>,
    steps: usize,
    /// Eyes × steps.
    values: Vec<f32>,
    /// Of all rounds, then without each of them: a count an eye.
    counts: Vec<Vec<Counted>>,
    /// The steps of the last chunk, and the sums over sources in them, eyes × steps: the same of all blocks and without any.
    contrast: (Vec<usize>, Vec<f64>),
}

impl GlareYear {
    /// The year of eyes by what they see of the sky, and a group of windows that has a point for each, the plane across its line of sight. `goes_on` is asked
    /// now and then, and stops the calculation by `false`: then there is no result.
    ///
    /// # Errors
    /// As [`evaluate`].
    pub fn new(
        year: &Year,
        schedule: &Schedule,
        (views, group): (Vec<SkyView>, Group),
        settings: &Settings,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<Option<Self>> {
        let factor = Division::of_count(group.open.columns).map_or(settings.sky.factor, |division| division.factor());
        let sky = SkyOptions { factor, light: Light::WithoutSun, quantity: Quantity::Luminance, ..settings.sky };
        let (sky, steps) = (SkyMatrix::new(year, sky)?, year.steps.len());
        let values = vec![0.0; views.len() * steps];
        let mut found = Self { views, steps, values, counts: Vec::new(), contrast: Default::default() };
        let mut take = |chunk: &Chunk<'_>| {
            found.take(chunk, &sky, schedule, settings.threads);
            goes_on()
        };
        Ok(evaluate(year, schedule, &[group], settings, &mut take)?.map(|_| found))
    }

    /// Takes a chunk of light at the eyes' planes; `sky` has the sky alone, without its sun.
    fn take(&mut self, chunk: &Chunk<'_>, sky: &SkyMatrix<'_>, schedule: &Schedule, threads: usize) {
        let variant = chunk.without.map_or(0, |round| round + 1);
        while self.counts.len() <= variant {
            self.counts.push(vec![Counted([0; BINS + 1]); self.views.len()]);
        }
        if self.contrast.0 != chunk.steps {
            self.contrast = (chunk.steps.to_vec(), self.sources(chunk, sky, threads));
        }
        let count = chunk.steps.len();
        for eye in 0..self.views.len() {
            for (place, step) in chunk.steps.iter().enumerate() {
                let at = eye * count + place;
                let value = of_hour(f64::from(chunk.total[at]), self.contrast.1[at]);
                if schedule.is_used(*step) {
                    self.counts[variant][eye].add(value);
                }
                if variant == 0 {
                    self.values[eye * self.steps + step] = value as f32;
                }
            }
        }
    }

    /// Σ L² ω / P² of sky and sun, eyes × steps.
    fn sources(&self, chunk: &Chunk<'_>, sky: &SkyMatrix<'_>, threads: usize) -> Vec<f64> {
        let (columns, count) = (sky.columns(chunk.steps, threads), chunk.steps.len());
        let patches = columns.len() / count.max(1);
        let sum = |(eye, view): (usize, &SkyView)| {
            let of_step = |(place, step): (usize, &usize)| {
                let direct = chunk.direct.map_or(0.0, |direct| f64::from(direct[eye * count + place]));
                let sun = view.of_sun(sky.year().steps[*step].sun.direction(), direct);
                view.of_sky(&columns[place * patches..][..patches]) + sun
            };
            chunk.steps.iter().enumerate().map(of_step).collect::<Vec<f64>>()
        };
        self.views.iter().enumerate().flat_map(sum).collect()
    }

    /// Values of an eye by step.
    pub fn values(&self, eye: usize) -> &[f32] {
        &self.values[eye * self.steps..][..self.steps]
    }

    /// All values, eyes × steps.
    pub fn all_values(&self) -> &[f32] {
        &self.values
    }

    /// The figures of each eye and their standard errors, where light came in rounds.
    pub fn glare(&self, schedule: &Schedule) -> Vec<(EyeGlare, Option<EyeGlare>)> {
        let used = schedule.count() as f64;
        let of_eye = |eye: usize| {
            let by_variant: Vec<[f64; 4]> = self.counts.iter().map(|counts| counts[eye].glare(used).figures()).collect();
            let whole = by_variant.first().map_or(EyeGlare::of_figures([0.0; 4]), |figures| EyeGlare::of_figures(*figures));
            let without = by_variant.get(1..).filter(|without| without.len() > 1);
            let error = |without: &[[f64; 4]], figure: usize| jackknife(&without.iter().map(|figures| figures[figure]).collect::<Vec<_>>());
            (whole, without.map(|without| EyeGlare::of_figures(std::array::from_fn(|figure| error(without, figure)))))
        };
        (0..self.views.len()).map(of_eye).collect()
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
        let view = SkyView { facing: [0.0, 1.0, 0.0], share: Vec::new(), strength: Vec::new() };
        let disc = TAU * (1.0 - (0.5 * SUN_ANGLE_DEG).to_radians().cos());
        let sun = [0.0, 0.6, 0.8];
        // 1e9 cd/m² through glass of 0.5.
        let seen = 0.5e9 * disc * 0.6;
        let weight = position_index([0.0, 0.8, 0.6]).powi(-2);
        assert!((view.of_sun(sun, seen) / (0.25e18 * disc * weight) - 1.0).abs() < 1e-9);
        assert_eq!(view.of_sun([0.0, -0.6, 0.8], 100.0), 0.0);
    }

    #[test]
    fn values_are_wienolds() {
        assert!((dgp(3000.0, 0.0) - 0.3361).abs() < 1e-9);
        assert!((dgp(3000.0, 3000_f64.powf(1.87) * 9.0) - 0.4279).abs() < 1e-9);
        assert!((of_hour(3000.0, 0.0) - 0.3361).abs() < 1e-9);
        assert!(of_hour(100.0, 1e9) < 0.2 && of_hour(0.0, 1e9) == 0.0);
    }

    #[test]
    fn shares_and_levels_are_of_the_used_time() {
        let mut counted = Counted([0; BINS + 1]);
        (0..6).for_each(|_| counted.add(0.42));
        (0..94).for_each(|_| counted.add(0.30));
        let found = counted.glare(100.0);
        assert_eq!(found.figures()[..3], [0.06, 0.06, 0.0]);
        assert!((found.dgp_5_percent - 0.4205).abs() < 1e-9);
        assert_eq!(found.level(), "minimum");
        assert_eq!(counted.glare(200.0).level(), "high");
    }
}
