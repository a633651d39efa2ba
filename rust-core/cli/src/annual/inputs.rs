//! The files of `gonio annual-metrics`, and what its options make of them.

use crate::{
    arguments::{AnnualMetricsOptions, ControlArgument, LightingArguments, SensorArgument, SunPositionArgument, YearArguments},
    file,
};
use gonio::{
    Error, Result,
    annual::{SunPositions, told},
    sky::SkyModel,
};
use gonio_annual::{
    Blinds, Coefficients, Control, Division, ElectricLight, Group, Schedule, Sensor, Year,
    sky::{Model, SkyOptions},
};
use std::path::{Path, PathBuf};

/// The longest files in bytes: weather in steps of a minute, matrices of a building, a schedule.
const LONGEST_WEATHER: u64 = 1 << 30;
const LONGEST_MATRIX: u64 = 1 << 34;
const LONGEST_SCHEDULE: u64 = 1 << 24;

/// A grid's name and its groups of windows.
#[derive(Debug)]
pub(super) struct Named {
    pub(super) name: String,
    pub(super) groups: Vec<Group>,
}

/// What was read.
#[derive(Debug)]
pub(super) struct Inputs {
    pub(super) year: Year,
    pub(super) positions: SunPositions,
    pub(super) schedule: Schedule,
    pub(super) grids: Vec<Named>,
}

impl Inputs {
    pub(super) fn read(options: &AnnualMetricsOptions) -> Result<Self> {
        for (name, files) in
            [("sun-coefficients", &options.sun_coefficients), ("sun-total", &options.sun_total), ("closed", &options.closed)]
        {
            if !files.is_empty() && files.len() != options.coefficients.len() {
                let problem =
                    format!("{} files were found, expected {}, one for each of --coefficients", files.len(), options.coefficients.len());
                return Err(Error::setting(name, problem));
            }
        }
        let weather = weather(&options.year)?;
        let groups = (0..options.coefficients.len()).map(|index| group(options, index)).collect::<Result<Vec<_>>>()?;
        let positions = positions_of(&options.year, &groups)?;
        let (year, schedule) = year(&options.year, positions, &weather)?;
        let names = grid_names(options);
        let grids = if options.groups {
            names.into_iter().take(1).map(|name| Named { name, groups: groups.clone() }).collect()
        } else {
            names.into_iter().zip(groups).map(|(name, group)| Named { name, groups: vec![group] }).collect()
        };
        Ok(Self { year, positions, schedule, grids })
    }
}

/// The bytes of the weather file.
pub(super) fn weather(options: &YearArguments) -> Result<Vec<u8>> {
    file::read(&options.weather, LONGEST_WEATHER, "weather file")
}

/// Where the suns of a stage's year stand.
pub(super) fn positions(options: &YearArguments) -> SunPositions {
    match options.sun_position {
        None | Some(SunPositionArgument::True) => SunPositions::True,
        Some(SunPositionArgument::Radiance) => SunPositions::Radiance,
    }
}

/// Where the suns of coefficients stand: where Radiance has them if columns are suns.
fn positions_of(options: &YearArguments, groups: &[Group]) -> Result<SunPositions> {
    let has_suns = |group: &Group| {
        let of_suns = |direct: &Coefficients| Division::of_count(direct.columns).is_none();
        group.sun.is_some() || group.direct.as_ref().is_some_and(of_suns)
    };
    match options.sun_position {
        _ if !groups.iter().any(has_suns) => Ok(positions(options)),
        None | Some(SunPositionArgument::Radiance) => Ok(SunPositions::Radiance),
        Some(SunPositionArgument::True) => {
            let problem = "true was found, but columns of suns, which gendaymtx places; expected radiance";
            Err(Error::setting("sun-position", problem))
        }
    }
}

/// The weather, and which of its hours are used.
pub(super) fn year(options: &YearArguments, positions: SunPositions, weather: &[u8]) -> Result<(Year, Schedule)> {
    let year = positions.read(&options.weather, weather)?;
    let schedule = schedule(&options.schedule, &year)?;
    Ok((year, schedule))
}

/// What blinds leave of the light, where a share was given.
pub(super) fn share(blinds: Option<f64>) -> Result<Option<f32>> {
    match blinds {
        Some(share) if !(0.0..=1.0).contains(&share) => Err(Error::setting("blinds", format!("{share} was found, expected 0 to 1"))),
        blinds => Ok(blinds.map(|share| share as f32)),
    }
}

/// The lamps beside daylight, where their power was given.
pub(super) fn electric(options: &LightingArguments) -> Option<ElectricLight> {
    options.lighting_power.map(|power_w_m2| ElectricLight {
        power_w_m2,
        target_lx: options.lighting_target,
        control: match options.lighting_control {
            ControlArgument::Dimming => Control::Dimming,
            ControlArgument::Switching => Control::Switching,
        },
        least: options.lighting_least,
        sensor: match options.lighting_sensor {
            SensorArgument::Least => Sensor::Least,
            SensorArgument::Mean => Sensor::Mean,
            SensorArgument::Points => Sensor::Points,
        },
        presence: options.lighting_presence,
        standby_kwh_m2: options.lighting_standby,
    })
}

/// Names of the grids: those of the files without their endings, numbered where they are the same.
pub(super) fn grid_names(options: &AnnualMetricsOptions) -> Vec<String> {
    let stem = |path: &PathBuf| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let stems: Vec<String> = options.coefficients.iter().map(stem).collect();
    let count = if options.groups { 1 } else { stems.len() };
    let is_double = |name: &String| stems.iter().filter(|other| *other == name).count() > 1;
    let name = |(index, name): (usize, &String)| if count > 1 && is_double(name) { format!("{name}_{}", index + 1) } else { name.clone() };
    stems.iter().enumerate().take(count).map(name).collect()
}

fn coefficients(path: &Path) -> Result<Coefficients> {
    Coefficients::read(path, &file::read(path, LONGEST_MATRIX, "matrix")?).map_err(told)
}

fn group(options: &AnnualMetricsOptions, index: usize) -> Result<Group> {
    let of = |files: &[PathBuf]| files.get(index).map(|path| coefficients(path)).transpose();
    let open = coefficients(&options.coefficients[index])?;
    if let Some(factor) = options.factor.filter(|factor| Division::count(*factor) != open.columns) {
        let problem = format!("{} columns, expected {} of -m {factor}, the ground's among them", open.columns, Division::count(factor));
        return Err(Error::Format { path: open.path, line: None, problem });
    }
    let blinds = match of(&options.closed)? {
        Some(closed) => Some(Blinds::Coefficients(closed)),
        None => share(options.blinds)?.map(Blinds::Share),
    };
    Ok(Group { open, direct: of(&options.sun_coefficients)?, sun: of(&options.sun_total)?, scattered: None, blinds, closed: None })
}

/// Hours of every day, such as 8-18, else a file.
pub(super) fn schedule(text: &str, year: &Year) -> Result<Schedule> {
    let hours = text.split_once('-').and_then(|(from, to)| Some((from.trim().parse().ok()?, to.trim().parse().ok()?)));
    let found = match hours {
        Some((from, to)) => Schedule::daily(year, from, to),
        None => {
            let path = Path::new(text);
            if !path.exists() {
                return Err(Error::setting("schedule", format!("'{text}' was found, expected hours such as 8-18, or a file")));
            }
            Schedule::read(path, &file::read(path, LONGEST_SCHEDULE, "schedule")?, year)
        }
    };
    found.map_err(told)
}

/// The sky; its division follows from the coefficients.
pub(super) fn sky(options: &YearArguments) -> Result<SkyOptions> {
    let model = match SkyModel::parse(&options.sky)? {
        SkyModel::Perez => Model::Perez,
        SkyModel::Cie(kind) => Model::Cie(kind),
        SkyModel::HosekWilkie => {
            return Err(Error::setting("sky", "hosek-wilkie knows clear skies alone, expected perez or cie1 to cie16"));
        }
    };
    Ok(SkyOptions { model, ground: options.ground, dew_point_c: options.dew_point, ..SkyOptions::default() })
}
