//! What stands at the top of the page: which project, where, when.

use crate::{
    arguments::ReportOptions,
    words::{HeadWords, Words},
};
use gonio_page::fill;
use pyo3::prelude::*;

/// The page's title and the lines below it, each with its name.
#[derive(Debug)]
pub(crate) struct Head {
    pub(crate) title: String,
    pub(crate) facts: Vec<(String, String)>,
}

impl Head {
    /// What the options say, else the stage's name, the place of `--sun` and today.
    pub(super) fn new(options: &ReportOptions, today: String, words: &Words) -> Self {
        let (path, say) = (&options.stage.stage, &words.head);
        let name = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
        let facts = [
            (&say.project, options.project.clone()),
            (&say.place, place(options, words)),
            (&say.sun_and_sky, sun_and_sky(options, say)),
            (&say.date, Some(options.date.clone().unwrap_or(today))),
            (&say.model, Some(name(path.file_name()))),
            (&say.program, Some(fill(&say.calculated, &[("version", env!("CARGO_PKG_VERSION"))]))),
        ];
        let facts = facts.into_iter().filter_map(|(name, fact)| Some((name.clone(), fact?))).collect();
        Self { title: options.title.clone().unwrap_or_else(|| name(path.file_stem())), facts }
    }
}

/// The place in words, else that of `--sun`.
fn place(options: &ReportOptions, words: &Words) -> Option<String> {
    let of_sun = || {
        let mut parts = options.daylight.sun.as_ref()?.splitn(3, ',').map(|part| words.numbers.form(part.trim()));
        Some(fill(&words.head.coordinates, &[("latitude", &parts.next()?), ("longitude", &parts.next()?)]))
    };
    options.place.clone().or_else(of_sun)
}

/// When the sun and the sky are those of, and of what kind.
fn sun_and_sky(options: &ReportOptions, say: &HeadWords) -> Option<String> {
    let time = options.daylight.sun.as_ref()?.splitn(3, ',').nth(2)?.trim();
    Some(fill(&say.time_and_sky, &[("time", time), ("sky", &options.daylight.sky)]))
}

/// The day by the machine's clock, year first (ISO 8601).
pub(crate) fn today(py: Python<'_>) -> PyResult<String> {
    py.import("datetime")?.getattr("date")?.call_method0("today")?.call_method0("isoformat")?.extract()
}
