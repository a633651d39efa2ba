//! `gonio verdict`.

use super::{
    arguments::VerdictOptions,
    file::{check_ending, check_targets, print_path, put, read},
    messages::print,
    report::{as_file, today},
};
use gonio::{Error, Result};
use gonio_page::Language;
use gonio_verdict::{Measured, Requirements, Sheet, Verdict, VerdictError, json, lines, page};
use pyo3::Python;
use std::{path::PathBuf, sync::atomic::AtomicBool};

/// Endings of a sheet's file.
const ENDINGS: &[&str] = &["html", "htm", "pdf"];
/// The longest files that are read.
const LONGEST: u64 = 1 << 30;
/// The status where nothing is missed, but something is within the error.
const UNSETTLED: i32 = 3;

/// Judges the requirements and writes what was asked for; the status says whether all are met.
pub(super) fn verdict(py: Python<'_>, options: &VerdictOptions, interrupted: &AtomicBool) -> Result<i32> {
    if let Some(output) = &options.output {
        check_ending("output", output, ENDINGS)?;
        check_targets([output])?;
    }
    let date = options.date.clone().map_or_else(|| today(py).map_err(|error| Error::Internal(error.to_string())), Ok)?;
    py.detach(|| run(options, &date, interrupted))
}

fn run(options: &VerdictOptions, date: &str, interrupted: &AtomicBool) -> Result<i32> {
    let own = read(&options.requirements, LONGEST, "file of requirements")?;
    let file = |path: &PathBuf| Ok((path.clone(), read(path, LONGEST, "JSON of a measurement")?));
    let files = options.measured.iter().map(file).collect::<Result<Vec<_>>>()?;
    let sheet = judged(options, &own, &files).map_err(|VerdictError { path, error }| Error::in_file(&path, &error))?;
    if let Some(output) = &options.output {
        let html = page(&sheet, Language::of_code(&options.language), date);
        put(output, &as_file(html, output, interrupted)?)?;
    }
    if options.json {
        print(&json(&sheet).to_string());
    } else {
        lines(&sheet).iter().for_each(|line| print(line));
        options.output.iter().for_each(|path| print_path(path));
    }
    Ok(match sheet.verdict() {
        Verdict::Met => 0,
        Verdict::WithinError => UNSETTLED,
        Verdict::NotMet | Verdict::NotMeasured => 1,
    })
}

fn judged(options: &VerdictOptions, own: &[u8], files: &[(PathBuf, Vec<u8>)]) -> std::result::Result<Sheet, VerdictError> {
    let requirements = Requirements::read(own, &options.requirements)?;
    Sheet::new(requirements, own, Measured::read(files)?)
}
