//! The `gonio` command.

mod arguments;
mod autocrop;
mod bench;
mod bsdf;
mod channel;
mod checkpoint;
mod compare;
mod completion;
mod daylight;
mod denoise;
mod drawing;
mod explain;
mod falsecolor;
mod farm;
mod file;
mod file_name;
mod foreign;
mod frames;
mod glare;
mod goniometer;
mod info;
mod interrupt;
mod lamps_in_view;
mod light_numbers;
mod light_words;
mod map;
mod measure;
mod merge;
mod output;
mod photometry;
mod products;
mod progress;
mod radiance;
mod relight;
mod render;
mod report;
mod sequence;
mod share;
mod snapshot;
mod view;

pub use farm::farm_scene;
pub use view::{Viewed, view_scene};

use arguments::{Arguments, Command};
use clap::Parser;
use gonio::{Diagnostic, Error, Severity};
use pyo3::Python;
use std::{
    io,
    path::Path,
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
};

/// Set by the first Ctrl-C, and by signals that ask to end.
static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What went wrong with standard output.
static LOST: Mutex<Option<io::Error>> = Mutex::new(None);

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
        Err(error) => {
            // Help and version are errors of status 0 to clap; if printing fails there is nobody to tell.
            let _ = error.print();
            return error.exit_code();
        }
    };
    INTERRUPTED.store(false, Ordering::Relaxed);
    interrupt::install();
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
        Command::Bsdf(options) => bsdf::bsdf(py, &options, &INTERRUPTED),
        Command::Measure(options) => measure::measure(py, &options, &INTERRUPTED),
        Command::Goniometer(options) => goniometer::goniometer(py, &options, &INTERRUPTED),
        Command::Map(options) => map::map(py, &options, &INTERRUPTED),
        Command::Falsecolor(options) => py.detach(|| falsecolor::falsecolor(&options)),
        Command::Report(options) => report::report(py, &options, &INTERRUPTED),
        Command::Glare(options) => py.detach(|| glare::glare(&options)),
        Command::Bench(options) => py.detach(|| bench::bench(&options, &INTERRUPTED)),
        Command::Completion(options) => completion::completion(&options),
    };
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

/// A line on standard error.
fn say(line: &str) {
    use std::io::Write;
    // Messages may quote a broken file's bytes, which must not break the line.
    let line: String = line.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect();
    // A closed standard error leaves nobody to tell.
    let _ = writeln!(std::io::stderr(), "gonio: {line}");
}

/// A line on standard output; one that is lost is told at the end. Who closed a pipe wants no more.
fn print(line: &str) {
    use std::io::Write;
    if let Err(error) = writeln!(std::io::stdout(), "{line}")
        && error.kind() != std::io::ErrorKind::BrokenPipe
    {
        *LOST.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }
}

/// Says what became of standard output, where lines of it were lost.
fn check_printed() -> gonio::Result<()> {
    let lost = LOST.lock().unwrap_or_else(PoisonError::into_inner).take();
    lost.map_or(Ok(()), |error| Err(Error::io(Path::new("standard output"), error)))
}

/// Lists what is not as asked: warnings line by line, at most `most`, and how many more there are.
fn list(diagnostics: &[Diagnostic], most: usize) {
    let warnings: Vec<_> = diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Warning).collect();
    for warning in warnings.iter().take(most) {
        say(&format!("warning: {warning}"));
    }
    if warnings.len() > most {
        say(&format!("{} more warnings; --verbose lists them all", warnings.len() - most));
    }
}
