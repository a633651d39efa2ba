//! `gonio dim`.

mod shown;

use super::{
    arguments::DimOptions,
    file::{check_ending, check_targets, print_path, put},
    measure::{loaded, watched},
    messages::{diagnostics_json, print, say, tell},
    progress::Reporter,
};
use gonio::{
    Error, Result,
    dim::{DimTask, Dimming, Near, dim as found_dimming},
};
use gonio_simd::Execution;
use gonio_usd::SampleTime;
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// Measures the groups, solves, and writes what was asked for; the status is 1 where a target is not met.
pub(super) fn dim(py: Python<'_>, options: &DimOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    if let Some(output) = &options.output {
        check_ending("output", output, &["usda"])?;
        check_targets([output])?;
    }
    let [watts, fixed] = [("watts", &options.watts), ("fixed", &options.fixed)].map(|(option, texts)| numbers(option, texts));
    let (watts, fixed, near) = (watts?, fixed?, near(&options.near)?);
    let (stage, loaded) = loaded(py, &options.measuring, interrupted)?;
    let (scene, quiet) = (&loaded.scene, options.measuring.quiet);
    let (min_level, errors_kept) = (options.min_level, options.errors);
    let task = DimTask { targets: &options.target, watts: &watts, fixed: &fixed, min_level, near, errors_kept };
    let found = watched(Reporter::new(quiet), None, interrupted, |watch| found_dimming(scene, &task, Execution::detect(), watch))?;
    tell(&options.measuring.stage, quiet, &found.diagnostics);
    found.notes.iter().filter(|_| !quiet).for_each(|note| say(note));
    if let Some(output) = &options.output {
        let time = options.measuring.frame.map_or(SampleTime::Start, SampleTime::Code);
        put(output, stage.usd("output")?.dimmed(py, &factors(&found), time, output)?.as_bytes())?;
    }
    show(options, &found);
    Ok(i32::from(!found.solution.meets_all()))
}

/// What `--near` asks for.
fn near(texts: &[String]) -> Result<Near> {
    match texts {
        [] => Ok(Near::LeastPower),
        [one] if one == "equal" => Ok(Near::Equal),
        several if several.iter().any(|text| text == "equal") => {
            Err(Error::setting("near", "'equal' stands alone, expected it or GROUP=LEVEL"))
        }
        _ => Ok(Near::Levels(numbers("near", texts)?)),
    }
}

/// Groups' numbers of zero or more, as an option has them.
fn numbers(option: &'static str, texts: &[String]) -> Result<Vec<(String, f64)>> {
    let number = |text: &String| {
        let wrong = || Error::setting(option, format!("'{text}' was found, expected GROUP=NUMBER with a number of zero or more"));
        let (name, number) = text.rsplit_once('=').ok_or_else(wrong)?;
        let number = number.trim().parse().ok().filter(|x: &f64| x.is_finite() && *x >= 0.0).ok_or_else(wrong)?;
        Ok((name.to_owned(), number))
    };
    texts.iter().map(number).collect()
}

/// The factors of the prims whose lights are dimmed.
fn factors(found: &Dimming) -> Vec<(String, f64)> {
    let dimmed = found.groups.iter().zip(&found.solution.levels).filter(|(_, level)| **level < 1.0);
    dimmed.flat_map(|(group, level)| group.prims.iter().map(|prim| (prim.clone(), *level))).collect()
}

fn show(options: &DimOptions, found: &Dimming) {
    if options.measuring.json {
        let mut whole = found.json();
        whole["diagnostics"] = diagnostics_json(&found.diagnostics);
        print(&whole.to_string());
        return;
    }
    shown::lines(found).iter().for_each(|line| print(line));
    options.output.iter().filter(|_| !options.measuring.quiet).for_each(|output| print_path(output));
}
