//! What the command says: results on standard output, all else on standard error.

use super::arguments::StageArguments;
use gonio::{Diagnostic, Error, Severity};
use gonio_formats::tame;
use serde_json::{Value, json};
use std::{
    io::{self, Write},
    path::Path,
    sync::{Mutex, PoisonError},
};

/// Warnings listed without `--verbose`.
pub(super) const MOST_WARNINGS: usize = 20;

/// What went wrong with standard output.
static LOST: Mutex<Option<io::Error>> = Mutex::new(None);

/// A line on standard error.
pub(super) fn say(line: &str) {
    // Messages may quote a broken file's bytes, which must not break the line.
    let line = tame(line);
    // A closed standard error leaves nobody to tell.
    let _ = writeln!(io::stderr(), "gonio: {line}");
}

/// A line on standard output; one that is lost is told at the end. Who closed a pipe wants no more.
pub(super) fn print(line: &str) {
    if let Err(error) = writeln!(io::stdout(), "{line}")
        && error.kind() != io::ErrorKind::BrokenPipe
    {
        *LOST.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
    }
}

/// Says what became of standard output, where lines of it were lost.
pub(super) fn check_printed() -> gonio::Result<()> {
    let lost = LOST.lock().unwrap_or_else(PoisonError::into_inner).take();
    lost.map_or(Ok(()), |error| Err(Error::io(Path::new("standard output"), error)))
}

/// Lists what is not as asked of a stage: all of it with `--verbose`, nothing where a command is to be quiet.
pub(super) fn tell(stage: &StageArguments, is_quiet: bool, diagnostics: &[Diagnostic]) {
    if !is_quiet {
        list(diagnostics, if stage.verbose { usize::MAX } else { MOST_WARNINGS });
    }
}

/// What is not as asked, for machines: severity (`warning` or `info`), origin, message.
pub(super) fn diagnostics_json<'a>(diagnostics: impl IntoIterator<Item = &'a Diagnostic>) -> Value {
    let one = |found: &Diagnostic| {
        let severity = if found.severity == Severity::Warning { "warning" } else { "info" };
        json!({ "severity": severity, "origin": &*found.origin.name, "message": found.message })
    };
    diagnostics.into_iter().map(one).collect()
}

/// Lists what is not as asked: warnings line by line, at most `most`, and how many more there are.
pub(super) fn list(diagnostics: &[Diagnostic], most: usize) {
    let warnings: Vec<_> = diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Warning).collect();
    for warning in warnings.iter().take(most) {
        say(&format!("warning: {warning}"));
    }
    if warnings.len() > most {
        say(&format!("{} more warnings; --verbose lists them all", warnings.len() - most));
    }
}
