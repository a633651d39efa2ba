//! What stands at the top of the page: which project, where, when.

use crate::arguments::ReportOptions;
use pyo3::prelude::*;

/// The page's title and the lines below it, each with its name.
#[derive(Debug)]
pub(crate) struct Head {
    pub(crate) title: String,
    pub(crate) facts: Vec<(&'static str, String)>,
}

impl Head {
    /// What the options say, else the stage's name, the place of `--sun` and today.
    pub(super) fn new(options: &ReportOptions, today: String) -> Self {
        let path = &options.stage.stage;
        let name = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
        let mut facts: Vec<(&'static str, String)> = Vec::new();
        facts.extend(options.project.clone().map(|project| ("Project", project)));
        facts.extend(place(options).map(|place| ("Place", place)));
        facts.extend(sun_and_sky(options).map(|time| ("Sun and sky", time)));
        facts.push(("Date", options.date.clone().unwrap_or(today)));
        facts.push(("Model", name(path.file_name())));
        facts.push(("Calculated by", format!("gonio {}, path tracing", env!("CARGO_PKG_VERSION"))));
        Self { title: options.title.clone().unwrap_or_else(|| name(path.file_stem())), facts }
    }
}

/// The place in words, else that of `--sun`.
fn place(options: &ReportOptions) -> Option<String> {
    let of_sun = || {
        let mut parts = options.daylight.sun.as_ref()?.splitn(3, ',');
        Some(format!("{}° north, {}° east", parts.next()?.trim(), parts.next()?.trim()))
    };
    options.place.clone().or_else(of_sun)
}

/// When the sun and the sky are those of, and of what kind.
fn sun_and_sky(options: &ReportOptions) -> Option<String> {
    let time = options.daylight.sun.as_ref()?.splitn(3, ',').nth(2)?.trim().to_owned();
    Some(format!("{time}, {} sky", options.daylight.sky))
}

/// The day by the machine's clock, year first (ISO 8601).
pub(crate) fn today(py: Python<'_>) -> PyResult<String> {
    py.import("datetime")?.getattr("date")?.call_method0("today")?.call_method0("isoformat")?.extract()
}
