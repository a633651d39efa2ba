//! A year of daylight glare without pictures (Jones, "Fast climate-based glare analysis and spatial mapping", 2019): the light at an eye by its
//! coefficients, contrast by the sun and by what patches of the sky show of themselves.

mod dgp;
mod figures;
mod surfaces;
mod view;

pub use dgp::{dgp, dgp_low_light};
pub use figures::EyeGlare;
pub use surfaces::{Sight, Surfaces, sights};

use crate::{
    chunk::Chunk,
    division::Division,
    error::{AnnualError, Result},
    evaluate::{Settings, closed_steps, evaluate},
    group::Group,
    metrics::jackknife,
    schedule::Schedule,
    sky::{Light, Quantity, SkyMatrix, SkyOptions},
    year::Year,
};
use dgp::of_hour;
use figures::Counted;
use surfaces::SurfaceSources;
use view::{GroupViews, of_sun};

/// Eyes whose year is rated.
#[derive(Clone, Debug)]
pub struct Eyes {
    /// Where they look: unit vectors east, north, up.
    pub facings: Vec<[f64; 3]>,
    /// What groups of windows bring to the planes across their lines of sight, a point an eye: with scattered light told apart, and direct light of suns.
    pub windows: Vec<Group>,
    /// What the same groups bring to the points of a floor, whose direct sun closes blinds; empty where schedules alone do.
    pub floor: Vec<Group>,
    /// What of surfaces is seen through the same groups; `None` where these count in the light at the eyes alone.
    pub surfaces: Option<Surfaces>,
}

impl Eyes {
    /// By group of windows, the steps in which direct sun on the floor and schedules close its blinds; none where schedules alone do.
    fn closed(&self, year: &Year, settings: &Settings, goes_on: &dyn Fn() -> bool) -> Result<Option<Vec<Vec<bool>>>> {
        if !self.floor.is_empty() {
            return closed_steps(year, &self.floor, settings, goes_on);
        }
        let is_left = self.windows.iter().any(|group| group.blinds.is_some() && group.closed.is_none());
        let problem = "direct sun closes them, but there are no points of a floor that could tell";
        if is_left { Err(AnnualError::setting("blinds", problem)) } else { Ok(Some(Vec::new())) }
    }
}

/// Windows whose blinds are closed in these steps, where any are named.
fn operated(year: &Year, windows: &[Group], closed: &[Vec<bool>]) -> Result<Vec<Group>> {
    if closed.is_empty() {
        return Ok(windows.to_vec());
    }
    let never = Vec::new();
    let group = |(number, group): (usize, &Group)| group.clone().closed_in(year, closed.get(number).unwrap_or(&never));
    windows.iter().enumerate().map(group).collect()
}

/// A year of glare at several eyes.
#[derive(Clone, Debug)]
pub struct GlareYear {
    facings: Vec<[f64; 3]>,
    /// By group of windows.
    views: Vec<GroupViews>,
    surfaces: SurfaceSources,
    /// Independent estimates of the light at the eyes' planes.
    rounds: usize,
    /// By group of windows, used hours with its blinds closed; empty where there are no blinds.
    closed_hours: Vec<f64>,
    steps: usize,
    /// Eyes × steps.
    values: Vec<f32>,
    /// Of all rounds, then without each of them: a count an eye.
    counts: Vec<Vec<Counted>>,
    /// The steps of the last chunk, and the sums over sources in them, eyes × steps: the same of all blocks and without any.
    contrast: (Vec<usize>, Vec<f64>),
}

impl GlareYear {
    /// The year of eyes. `goes_on` is asked now and then, and stops the calculation by `false`: then there is no result.
    ///
    /// # Errors
    /// As [`evaluate`], and blinds that nothing closes.
    pub fn new(year: &Year, schedule: &Schedule, eyes: &Eyes, settings: &Settings, goes_on: &dyn Fn() -> bool) -> Result<Option<Self>> {
        let Some(closed) = eyes.closed(year, settings, goes_on)? else { return Ok(None) };
        let windows = operated(year, &eyes.windows, &closed)?;
        let surfaces = match &eyes.surfaces {
            None => Some(SurfaceSources::default()),
            Some(surfaces) => {
                let windows = operated(year, &surfaces.windows, &closed)?;
                SurfaceSources::new(year, (surfaces, &windows, eyes.facings.len()), settings, goes_on)?
            }
        };
        let Some(surfaces) = surfaces else { return Ok(None) };
        let division = windows.first().and_then(|group| Division::of_count(group.open.columns));
        let division = division.ok_or_else(|| AnnualError::setting("coefficients", "there are none of a division of the sky"))?;
        let views = windows.iter().map(|group| GroupViews::new(&division, &eyes.facings, group)).collect::<Result<Vec<_>>>()?;
        let sky = SkyOptions { factor: division.factor(), light: Light::WithoutSun, quantity: Quantity::Luminance, ..settings.sky };
        let (sky, steps) = (SkyMatrix::new(year, sky)?, year.steps.len());
        let values = vec![0.0; eyes.facings.len() * steps];
        let (facings, rounds) = (eyes.facings.clone(), windows.first().map_or(1, |group| group.open.blocks.len()));
        let mut found = Self {
            facings,
            views,
            surfaces,
            rounds,
            closed_hours: Vec::new(),
            steps,
            values,
            counts: Vec::new(),
            contrast: Default::default(),
        };
        let mut take = |chunk: &Chunk<'_>| {
            found.take(chunk, &sky, schedule, settings.threads);
            goes_on()
        };
        let Some(grid) = evaluate(year, schedule, &windows, settings, &mut take)? else { return Ok(None) };
        // Blinds that never close were taken away.
        let has_blinds = eyes.windows.iter().any(|group| group.blinds.is_some());
        found.closed_hours = if grid.closed_hours.is_empty() && has_blinds { vec![0.0; windows.len()] } else { grid.closed_hours };
        Ok(Some(found))
    }

    /// Takes a chunk of light at the eyes' planes; `sky` has the sky alone, without its sun.
    fn take(&mut self, chunk: &Chunk<'_>, sky: &SkyMatrix<'_>, schedule: &Schedule, threads: usize) {
        let variant = chunk.without.map_or(0, |round| round + 1);
        while self.counts.len() <= variant {
            self.counts.push(vec![Counted::none(); self.facings.len()]);
        }
        if self.contrast.0 != chunk.steps {
            self.contrast = (chunk.steps.to_vec(), self.sources(chunk, sky, threads));
        }
        let count = chunk.steps.len();
        for eye in 0..self.facings.len() {
            for (place, step) in chunk.steps.iter().enumerate() {
                let at = eye * count + place;
                let surfaces = self.surfaces.at(eye * self.steps + step, chunk.without.map(|round| (round, self.rounds)));
                let value = of_hour(f64::from(chunk.total[at]), (self.contrast.1[at] + surfaces).max(0.0));
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
        let of_eye = |(eye, facing): (usize, &[f64; 3])| {
            let of_step = |(place, step): (usize, &usize)| {
                let column = &columns[place * patches..][..patches];
                let through = |(number, views): (usize, &GroupViews)| {
                    let is_closed = chunk.closed.get(number).and_then(|closed| closed.get(place)).is_some_and(|closed| *closed);
                    let views = views.closed.as_ref().filter(|_| is_closed).unwrap_or(&views.open);
                    views[eye].of_sky(column)
                };
                let seen = chunk.sun.map_or(0.0, |sun| f64::from(sun[eye * count + place]));
                let sun = of_sun(*facing, sky.year().steps[*step].sun.direction(), seen);
                self.views.iter().enumerate().map(through).sum::<f64>() + sun
            };
            chunk.steps.iter().enumerate().map(of_step).collect::<Vec<f64>>()
        };
        self.facings.iter().enumerate().flat_map(of_eye).collect()
    }

    /// By group of windows, used hours with its blinds closed; empty where there are no blinds.
    pub fn closed_hours(&self) -> &[f64] {
        &self.closed_hours
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
        (0..self.facings.len()).map(of_eye).collect()
    }
}
