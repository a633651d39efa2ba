//! The section of a year of daylight: what `gonio annual -o` found.

mod kept;

use super::html::Page;
use crate::{annual::plots::Plots, words::Words};
use gonio::Result;
use gonio_annual::{GridErrors, Method};
use gonio_page::fill;
use kept::{KeptGrid, Year};
use std::path::PathBuf;

/// Years of daylight, from folders.
#[derive(Debug, Default)]
pub(super) struct Years(Vec<Year>);

impl Years {
    pub(super) fn read(folders: &[PathBuf]) -> Result<Self> {
        folders.iter().map(|folder| Year::read(folder)).collect::<Result<_>>().map(Self)
    }

    /// A section for each.
    pub(super) fn write(&self, words: &Words, page: &mut Page) {
        self.0.iter().for_each(|year| write(year, words, page));
    }

    /// What was not as their stages ask.
    pub(super) fn warnings(&self) -> Vec<String> {
        self.0.iter().flat_map(Year::warnings).collect()
    }
}

fn write(year: &Year, words: &Words, page: &mut Page) {
    let say = &words.year;
    page.section(&say.title);
    page.paragraph(&weather(year, words));
    year.doubts.iter().for_each(|doubt| page.note(&fill(&say.doubt, &[("doubt", doubt)])));
    page.table(&say.columns, &year.grids.iter().map(|kept| row(kept, words)).collect::<Vec<_>>(), &[]);
    page.note(&say.note);
    for kept in &year.grids {
        closed(kept, words).iter().chain(&electric(kept, words)).for_each(|line| page.paragraph(line));
    }
    page.part(&say.provision);
    page.table(&say.provision_columns, &year.grids.iter().flat_map(|kept| provision(kept, words)).collect::<Vec<_>>(), &[]);
    page.note(&say.provision_note);
    for kept in &year.grids {
        let plots = Plots { name: &kept.name, grid: &kept.grid, layout: kept.layout.as_ref(), words };
        plots.all(&year.times, &kept.means).iter().for_each(|(_, svg)| page.plot(svg));
    }
    page.note(&say.no_certificate);
}

fn weather(year: &Year, words: &Words) -> String {
    let [latitude, longitude] = [year.latitude_deg, year.longitude_deg].map(|degrees| words.numbers.form(&degrees.to_string()));
    let hours = year.grids.first().map_or(0.0, |kept| kept.grid.used_hours);
    let values = [
        ("place", if year.place.trim().is_empty() { words.year.nameless.as_str() } else { &year.place }),
        ("latitude", &latitude),
        ("longitude", &longitude),
        ("file", &year.file()),
        ("schedule", &year.schedule),
        ("hours", &words.numbers.form(&hours.to_string())),
    ];
    fill(&words.year.weather, &values)
}

fn row(KeptGrid { name, grid, .. }: &KeptGrid, words: &Words) -> Vec<String> {
    let errors = grid.standard_errors.as_ref();
    let figure = |value: f64, factor: f64, unit: &str, of: fn(&GridErrors) -> f64| {
        words.figure(factor * value, errors.map_or(f64::NAN, |errors| factor * of(errors)), unit)
    };
    let exposure = |share: f64| figure(share, 100.0, "%", |errors| errors.ase_1000_250.unwrap_or(0.0));
    vec![
        name.clone(),
        grid.points.len().to_string(),
        figure(grid.sda_300_50, 100.0, "%", |errors| errors.sda_300_50),
        grid.ase_1000_250.map_or_else(|| words.year.not_known.clone(), exposure),
        figure(grid.udi_100_3000, 100.0, "%", |errors| errors.udi_100_3000),
        figure(grid.da_300, 100.0, "%", |errors| errors.da_300),
        figure(grid.cda_300, 100.0, "%", |errors| errors.cda_300),
        figure(grid.median_daylight_factor, 1.0, "%", |errors| errors.median_daylight_factor),
        figure(grid.mean_lx, 1.0, "lx", |errors| errors.mean_lx),
    ]
}

/// A line for each method.
fn provision(KeptGrid { name, grid, .. }: &KeptGrid, words: &Words) -> [Vec<String>; 2] {
    let (say, found, errors) = (&words.year, &grid.en17037, grid.standard_errors.as_ref().map(|errors| &errors.en17037));
    let line = |told: String, method: &Method, errors: Option<[f64; 4]>| {
        let level = say.levels[method.level as usize].clone();
        let error = |number: usize| errors.map_or(f64::NAN, |errors| 100.0 * errors[number]);
        let shares = method.area_100_300_500_750.iter().enumerate();
        let shares = shares.map(|(number, share)| words.figure(100.0 * share, error(number), "%"));
        [name.clone(), told, level].into_iter().chain(shares).collect()
    };
    let outside = fill(&say.by_factor, &[("lux", &format!("{:.0}", found.median_diffuse_lx))]);
    [
        line(say.hourly.clone(), &found.hourly, errors.map(|errors| errors.hourly.area_100_300_500_750)),
        line(outside, &found.daylight_factor, errors.map(|errors| errors.daylight_factor.area_100_300_500_750)),
    ]
}

/// How long blinds are closed, where there are any.
fn closed(KeptGrid { name, grid, groups, .. }: &KeptGrid, words: &Words) -> Option<String> {
    let told = |(number, hours): (usize, &f64)| {
        let hours = fill(&words.year.closed_hours, &[("hours", &format!("{hours:.0}"))]);
        groups.get(number).map_or_else(|| hours.clone(), |group| format!("{group} {hours}"))
    };
    let told: Vec<String> = grid.closed_hours.iter().enumerate().map(told).collect();
    (!told.is_empty()).then(|| fill(&words.year.closed, &[("grid", name), ("groups", &told.join(", "))]))
}

/// Energy of the lamps beside daylight, where it was asked for.
fn electric(KeptGrid { name, grid, .. }: &KeptGrid, words: &Words) -> Option<String> {
    let found = grid.electric.as_ref()?;
    let errors = grid.standard_errors.as_ref().and_then(|errors| errors.electric.as_ref());
    let leni = words.figure(found.leni_kwh_m2, errors.map_or(f64::NAN, |errors| errors.leni_kwh_m2), "kWh/m²");
    let without = words.figure(found.leni_without_daylight_kwh_m2, f64::NAN, "kWh/m²");
    let error = errors.and_then(|errors| errors.daylight_dependency).unwrap_or(f64::NAN);
    let dependency = words.figure(found.daylight_dependency.unwrap_or(0.0), error, "");
    let hours = format!("{:.0}", found.daylight_hours);
    let values = [("grid", name.as_str()), ("leni", &leni), ("without", &without), ("dependency", &dependency), ("hours", &hours)];
    Some(fill(&words.year.electric, &values))
}
