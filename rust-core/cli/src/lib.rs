//! The `gonio` command.

mod annual;
mod arguments;
mod autocrop;
mod bench;
mod bsdf;
mod by_wavelength;
mod channel;
mod checkpoint;
mod client_page;
mod compare;
mod completion;
mod daylight;
mod denoise;
mod dim;
mod drawing;
mod explain;
mod eyes;
mod falsecolor;
mod farm;
mod file;
mod file_name;
mod foreign;
mod frames;
mod glare;
mod goniometer;
mod ifc;
mod info;
mod interrupt;
mod lamps_in_view;
mod light_numbers;
mod light_words;
mod map;
mod measure;
mod merge;
mod messages;
mod norms;
mod output;
mod photometry;
mod products;
mod progress;
mod radiance;
mod rating_words;
mod reading;
mod relight;
mod render;
mod report;
mod road;
mod sensor;
mod sequence;
mod share;
mod snapshot;
mod spectrum;
mod stage;
mod sunlight;
mod vector;
mod verdict;
mod view;
mod view_out;
mod volume;
mod wavelengths;
mod words;

pub use farm::farm_scene;
pub use road::road_figures;
pub use view::{Viewed, view_scene};

use arguments::{Arguments, Command};
use clap::Parser;
use gonio::Error;
use interrupt::INTERRUPTED;
use messages::{check_printed, say};
use pyo3::Python;
use std::{io::ErrorKind, sync::atomic::Ordering};

/// Exit status of a run that was interrupted.
const INTERRUPTED_STATUS: i32 = 130;
/// Exit status for a command line that cannot be understood.
const USAGE_STATUS: i32 = 2;

/// Runs the command with its arguments, the program's name first; gives the exit status.
pub fn run(py: Python<'_>, arguments: Vec<String>) -> i32 {
    let translated = match foreign::translate(&arguments) {
        Ok(translated) => translated,
        Err(error) => {
            say(&format!("error: {error}"));
            return USAGE_STATUS;
        }
    };
    let arguments = translated.words;
    let parsed = match Arguments::try_parse_from(&arguments) {
        Ok(parsed) => parsed,
        Err(error) => return not_parsed(&error),
    };
    INTERRUPTED.store(false, Ordering::Relaxed);
    if parsed.command.hears_signals() {
        interrupt::install()
    } else {
        interrupt::leave_to_system()
    }
    if let Command::Render(options) = &parsed.command
        && !options.quiet
    {
        translated.notes.iter().for_each(|note| say(note));
    }
    let result = match parsed.command {
        Command::Render(mut options) => {
            options.settle();
            match options.farm.dask {
                Some(_) => farm::render(py, &mut options, &arguments),
                None => render::render(py, &options, &INTERRUPTED),
            }
        }
        Command::View(options) => view::view(py, &options, &arguments),
        Command::Merge(options) => py.detach(|| merge::merge(&options)),
        Command::Info(options) => info::info(py, &options, &INTERRUPTED),
        Command::Compare(options) => compare::compare(&options),
        Command::Relight(options) => py.detach(|| relight::relight(&options)),
        Command::Photometry(options) => photometry::photometry(&options),
        Command::Spectrum(options) => spectrum::spectrum(&options),
        Command::Sunlight(options) => sunlight::sunlight(py, &options, &INTERRUPTED),
        Command::ViewOut(options) => view_out::view_out(py, &options, &INTERRUPTED),
        Command::Sensor(options) => py.detach(|| sensor::sensor(&options)),
        Command::Bsdf(options) => bsdf::bsdf(py, &options, &INTERRUPTED),
        Command::Measure(options) => measure::measure(py, &options, &INTERRUPTED),
        Command::Emergency(options) => norms::emergency(py, &options, &INTERRUPTED),
        Command::Sports(options) => norms::sports(py, &options, &INTERRUPTED),
        Command::Zones(options) => norms::zones(py, &options, &INTERRUPTED),
        Command::Dim(options) => dim::dim(py, &options, &INTERRUPTED),
        Command::Goniometer(options) => goniometer::goniometer(py, &options, &INTERRUPTED),
        Command::Map(options) => map::map(py, &options, &INTERRUPTED),
        Command::Falsecolor(options) => py.detach(|| falsecolor::falsecolor(&options)),
        Command::Report(options) => report::report(py, &options, &INTERRUPTED),
        Command::Share(options) => client_page::share(py, &options, &INTERRUPTED),
        Command::Road(options) => py.detach(|| road::road(&options, &INTERRUPTED)),
        Command::Verdict(options) => verdict::verdict(py, &options, &INTERRUPTED),
        Command::Annual(options) => annual::trace::annual(py, &options, &INTERRUPTED),
        Command::AnnualGlare(options) => annual::glare::annual_glare(py, &options, &INTERRUPTED),
        Command::AnnualMetrics(options) => py.detach(|| annual::annual_metrics(&options, &INTERRUPTED)),
        Command::Glare(options) => py.detach(|| glare::glare(&options)),
        Command::Bench(options) => py.detach(|| bench::bench(&options, &INTERRUPTED)),
        Command::Completion(options) => completion::completion(&options),
    };
    status_of(result)
}

/// The process's status; what went wrong is said.
fn status_of(result: gonio::Result<i32>) -> i32 {
    match result.and_then(|status| check_printed().map(|()| status)) {
        Ok(status) => status,
        Err(Error::Cancelled) => {
            say("interrupted");
            INTERRUPTED_STATUS
        }
        Err(error) => {
            say(&format!("error: {error}"));
            1
        }
    }
}

/// Says why a command line is not followed; gives the process's status. Help and version are errors of status 0 to clap. Who closed a pipe wants no more.
fn not_parsed(error: &clap::Error) -> i32 {
    match error.print() {
        Err(lost) if lost.kind() != ErrorKind::BrokenPipe && !error.use_stderr() => {
            say(&format!("error: standard output: {lost}"));
            1
        }
        _ => error.exit_code(),
    }
}
