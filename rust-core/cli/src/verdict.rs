//! `gonio verdict`.

use super::{
    arguments::VerdictOptions,
    file::{check_ending, check_targets, ending, print_path, put, read},
    messages::print,
    report::today,
};
use gonio::{Error, Result};
use gonio_verdict::{Language, Measured, PdfError, Requirements, Sheet, Verdict, VerdictError, json, lines, page, pdf};
use pyo3::Python;
use std::{
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

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
        put(output, &drawn(options, output, &sheet, date, interrupted)?)?;
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

/// The bytes of the sheet's file.
fn drawn(options: &VerdictOptions, output: &Path, sheet: &Sheet, date: &str, interrupted: &AtomicBool) -> Result<Vec<u8>> {
    let language = Language::CODES.iter().find(|(code, _)| *code == options.language).map_or(Language::English, |(_, language)| *language);
    let html = page(sheet, language, date);
    if ending(output) != "pdf" {
        return Ok(html.into_bytes());
    }
    let stopped = || interrupted.load(Ordering::Relaxed);
    pdf(&html, &stopped).map_err(|error| match error {
        PdfError::Stopped => Error::Cancelled,
        error => Error::setting("output", error.to_string()),
    })
}
