//! Tables of measured materials as Python describes them.

use crate::error::setting;
use gonio_formats::{
    FormatError,
    bsdf::{Axis, Channels, Coordinates, Hemispheres, Mode},
};
use pyo3::{prelude::*, types::PyDict};

/// What is wrong with a table.
pub(crate) fn wrong(error: &FormatError) -> PyErr {
    setting("table", error.to_string())
}

/// What axes mean, by their names, and the axes, whose angles are in degrees.
pub(crate) fn axes(
    axes: &Bound<'_, PyDict>,
    periods: Option<&Bound<'_, PyDict>>,
    nearest: &[String],
) -> PyResult<(Coordinates, Vec<Axis>)> {
    let named: Vec<(String, Vec<f64>)> =
        axes.iter().map(|(name, knots)| Ok((name.extract()?, knots.extract()?))).collect::<PyResult<_>>()?;
    let names: Vec<&str> = named.iter().map(|(name, _)| name.as_str()).collect();
    let Some(coordinates) = Coordinates::ALL.into_iter().find(|kind| kind.axis_names() == names) else {
        let known: Vec<String> = Coordinates::ALL.iter().map(|kind| kind.axis_names().join(", ")).collect();
        return Err(setting("axes", format!("{} were found, expected {}", names.join(", "), known.join("; or "))));
    };
    let mut found = Vec::new();
    for (name, knots) in &named {
        let period = periods.map(|periods| periods.get_item(name)).transpose()?.flatten();
        let mode = match period {
            Some(period) => Mode::Periodic { period: period.extract::<f64>()?.to_radians() },
            None if nearest.contains(name) => Mode::Nearest,
            None => Mode::Linear,
        };
        let axis = Axis::new(knots.iter().map(|x| x.to_radians()).collect(), mode);
        found.push(axis.map_err(|error| setting(name, error.to_string()))?);
    }
    check_names(periods, nearest, &names)?;
    Ok((coordinates, found))
}

/// Refuses words about axes that there are not.
fn check_names(periods: Option<&Bound<'_, PyDict>>, nearest: &[String], names: &[&str]) -> PyResult<()> {
    let mut about: Vec<String> = nearest.to_vec();
    if let Some(periods) = periods {
        about.extend(periods.keys().extract::<Vec<String>>()?);
    }
    match about.iter().find(|name| !names.contains(&name.as_str())) {
        Some(name) => Err(setting("axes", format!("'{name}' was found, expected one of {}", names.join(", ")))),
        None => Ok(()),
    }
}

/// What `count` values of `cells` cells are.
pub(crate) fn channels(count: usize, cells: usize, wavelengths: Option<Vec<f64>>, xyz: bool) -> PyResult<Channels> {
    let each = count / cells.max(1);
    match wavelengths {
        Some(wavelengths) => Channels::bands(wavelengths).map_err(|error| wrong(&error)),
        None if each == 3 && xyz => Ok(Channels::Xyz),
        None if each == 3 => Ok(Channels::Rgb),
        None if each == 1 && !xyz => Ok(Channels::Luminance),
        None => Err(setting("values", format!("{count} for {cells} cells, expected 1 or 3 each, or wavelengths"))),
    }
}

/// The pair of hemispheres with that name.
pub(crate) fn side(name: &str) -> PyResult<Hemispheres> {
    Hemispheres::from_name(name).ok_or_else(|| {
        let known: Vec<&str> = Hemispheres::ALL.into_iter().map(Hemispheres::name).collect();
        setting("side", format!("'{name}' was found, expected {}", known.join(", ")))
    })
}

/// Names of channels.
pub(crate) fn channel_names(channels: &Channels) -> Vec<String> {
    match channels {
        Channels::Luminance => vec!["Y".into()],
        Channels::Rgb => ["R", "G", "B"].map(String::from).to_vec(),
        Channels::Xyz => ["X", "Y", "Z"].map(String::from).to_vec(),
        Channels::Bands { wavelengths_nm } => wavelengths_nm.iter().map(|w| format!("{w} nm")).collect(),
    }
}
