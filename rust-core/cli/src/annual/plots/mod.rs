//! A grid's year as plots: figures on the plan, the mean of the points over days and hours, useful daylight point by point; glare at an eye.

mod glare;
mod lattice;
mod layout;
mod times;

use crate::{file::put, words::Words};
pub(super) use glare::glare;
use gonio::Result;
use gonio_annual::{Grid, GridErrors, Point};
use gonio_page::{
    fill,
    plot::{Band, Bands, Carpet, Head, Map, Scale},
};
pub(crate) use layout::{Cells, Layout};
use std::path::{Path, PathBuf};
pub(crate) use times::Times;

/// Edges of the classes of per cents, hours of direct sun (250 are LM-83's), daylight factors, and lux (100, 300 and 3000 are those of useful daylight).
const PERCENTS: &[f64] = &[0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0];
const HOURS: &[f64] = &[0.0, 50.0, 100.0, 150.0, 200.0, 250.0, 300.0, 400.0, 600.0, 1000.0];
const FACTORS: &[f64] = &[0.0, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0];
const LUX: &[f64] = &[0.0, 100.0, 200.0, 300.0, 500.0, 750.0, 1000.0, 2000.0, 3000.0, 5000.0, 10_000.0];
/// Colours of the bands of useful daylight, from the darkest hours on: apart for those too who do not tell red from green.
const BANDS: [&str; 4] = ["#3d4a5c", "#7fb2d6", "#2a9d6f", "#f0b13c"];

/// A grid's year, and where its points lie, if that is a plan.
pub(crate) struct Plots<'a> {
    pub(crate) name: &'a str,
    pub(crate) grid: &'a Grid,
    pub(crate) layout: Option<&'a Layout>,
    pub(crate) words: &'a Words,
}

/// A figure on the plan.
struct Figure {
    key: &'static str,
    edges: &'static [f64],
    unit: &'static str,
    decimals: usize,
    of: fn(&Point) -> Option<f64>,
}

/// The files that a grid's plots may have.
pub(super) fn paths(folder: &Path, name: &str) -> Vec<PathBuf> {
    FIGURES.iter().map(|figure| figure.key).chain(["year", "bands"]).map(|key| path(folder, name, key)).collect()
}

fn path(folder: &Path, name: &str, key: &str) -> PathBuf {
    folder.join(format!("{name}_{key}.svg"))
}

const FIGURES: [Figure; 4] = [
    Figure { key: "da_300", edges: PERCENTS, unit: "%", decimals: 0, of: |point| Some(100.0 * point.da_300) },
    Figure { key: "udi_100_3000", edges: PERCENTS, unit: "%", decimals: 0, of: |point| Some(100.0 * point.udi_100_3000) },
    Figure { key: "hours_direct_1000", edges: HOURS, unit: "h", decimals: 0, of: |point| point.hours_direct_1000 },
    Figure { key: "daylight_factor", edges: FACTORS, unit: "%", decimals: 1, of: |point| Some(point.daylight_factor) },
];

impl Plots<'_> {
    /// All plots with their names; those on the plan where there is one, figures where they are known.
    pub(crate) fn all(&self, times: &Times, means: &[f32]) -> Vec<(&'static str, String)> {
        let maps = FIGURES.iter().filter_map(|figure| Some((figure.key, self.map(figure)?)));
        maps.chain([("year", self.carpet(times, means)), ("bands", self.bands())]).collect()
    }

    /// Writes all of them; gives the files.
    pub(super) fn write(&self, folder: &Path, times: &Times, means: &[f32]) -> Result<Vec<PathBuf>> {
        let written = |(key, svg): (&str, String)| {
            let path = path(folder, self.name, key);
            put(&path, svg.as_bytes()).map(|()| path)
        };
        self.all(times, means).into_iter().map(written).collect()
    }

    fn titled(&self, template: &str) -> String {
        fill(template, &[("grid", self.name)])
    }

    /// Standard errors of the points in words; nothing where there are none.
    fn errors(&self, of: impl Fn(&Point) -> f64, unit: &str) -> Option<String> {
        let errors = &self.grid.standard_errors.as_ref()?.points;
        let most = errors.iter().map(of).fold(0.0, f64::max);
        // Straight light has no noise.
        (most > 0.0)
            .then(|| fill(&self.words.year.error_of_points, &[("error", &format!("{}\u{a0}{unit}", self.words.numbers.short(most)))]))
    }

    fn map(&self, figure: &Figure) -> Option<String> {
        let layout = self.layout?;
        let of_points: Vec<Option<f64>> = self.grid.points.iter().map(figure.of).collect();
        if of_points.iter().all(Option::is_none) {
            return None;
        }
        let (title, mean) = self.told(figure.key);
        let lines = mean.into_iter().chain(self.errors(|point| (figure.of)(point).unwrap_or(0.0), figure.unit)).collect();
        let is_open = figure.edges != PERCENTS;
        Some(
            Map {
                head: Head { title, lines },
                size: layout.cells.size,
                spacing: layout.spacing,
                values: &layout.cells.spread(&of_points),
                scale: &Scale::new(figure.edges, is_open, figure.unit),
                decimals: figure.decimals,
            }
            .svg(self.words.numbers),
        )
    }

    /// A figure's title, and what all points have together.
    fn told(&self, key: &str) -> (String, Option<String>) {
        let (say, grid) = (&self.words.year, self.grid);
        let value = |template: &str, factor: f64, value: f64, error: fn(&GridErrors) -> f64| {
            let error = grid.standard_errors.as_ref().map_or(f64::NAN, |errors| factor * error(errors));
            Some(fill(template, &[("value", &self.words.figure(factor * value, error, "%"))]))
        };
        match key {
            "da_300" => (self.titled(&say.autonomy), value(&say.mean_of_points, 100.0, grid.da_300, |errors| errors.da_300)),
            "udi_100_3000" => {
                (self.titled(&say.useful), value(&say.mean_of_points, 100.0, grid.udi_100_3000, |errors| errors.udi_100_3000))
            }
            "hours_direct_1000" => {
                let exposed =
                    grid.ase_1000_250.and_then(|share| value(&say.exposed, 100.0, share, |errors| errors.ase_1000_250.unwrap_or(0.0)));
                (self.titled(&say.direct), exposed)
            }
            _ => {
                let median = value(&say.median_of_points, 1.0, grid.median_daylight_factor, |errors| errors.median_daylight_factor);
                (self.titled(&say.factor), median)
            }
        }
    }

    fn carpet(&self, times: &Times, means: &[f32]) -> String {
        let (say, grid) = (&self.words.year, self.grid);
        let error = grid.standard_errors.as_ref().map_or(f64::NAN, |errors| errors.mean_lx);
        let mean = fill(&say.carpet_mean, &[("value", &self.words.figure(grid.mean_lx, error, "lx"))]);
        Carpet {
            head: Head { title: self.titled(&say.carpet), lines: vec![mean, say.carpet_lines.clone()] },
            values: means,
            a_day: times.a_day(),
            months: times.months(&say.months),
            sun: &times.sunrise_sunset_h,
            scale: &Scale::new(LUX, true, "lx"),
        }
        .svg(self.words.numbers)
    }

    /// Shares of the used hours by illuminance, from the darkest point to the brightest.
    fn bands(&self) -> String {
        let say = &self.words.year;
        let of: [fn(&Point) -> f64; 4] =
            [|point| point.udi_below_100, |point| point.udi_100_300, |point| point.udi_300_3000, |point| point.udi_above_3000];
        let mut points: Vec<&Point> = self.grid.points.iter().collect();
        points.sort_by(|a, b| a.mean_lx.total_cmp(&b.mean_lx));
        let band = |number: usize| Band {
            name: say.bands_names[number].clone(),
            colour: BANDS[number],
            shares: points.iter().map(|point| of[number](point)).collect(),
        };
        let errors = self.errors(|point| of.iter().map(|of| 100.0 * of(point)).fold(0.0, f64::max), "%");
        Bands {
            head: Head { title: self.titled(&say.bands), lines: errors.into_iter().collect() },
            bands: (0..BANDS.len()).map(band).collect(),
            points: say.bands_points.clone(),
        }
        .svg(self.words.numbers)
    }
}
