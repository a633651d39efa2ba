//! Made-up samples that are measured.

use super::Loaded;
use crate::{
    arguments::SampleArguments,
    daylight::number,
    interrupt::goes_on,
    messages::{MOST_WARNINGS, list},
    progress::{Reporter, clock},
    share::share,
    stage::Stage,
};
use gonio::{
    Diagnostic, Error, Result,
    goniometer::Value as WithError,
    sample_bsdf::{FromPatch, Options, Orientation, Progress, SampleReading, Stop, Window, measure},
    scene::Scene,
};
use gonio_formats::bsdf::{Basis, Format, Measured};
use gonio_simd::Execution;
use gonio_usd::{SampleTime, StageOptions};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::{path::Path, sync::atomic::AtomicBool, time::Duration};

/// The longest time limit, in seconds.
const LONGEST: f64 = 1e9;

/// Measures the sample of a stage; gives the matrices, and what is to be said of the measurement.
pub(super) fn measured(py: Python<'_>, asked: &SampleArguments, stage: &Path, interrupted: &'static AtomicBool) -> Result<(Loaded, Value)> {
    let what = options(asked)?;
    let time = asked.frame.map_or(SampleTime::Start, SampleTime::Code);
    let stage_options = StageOptions { time, subtree: asked.prim.clone(), ..StageOptions::default() };
    let loaded = Stage::open(py, stage, &[], &stage_options)?.load(py, &stage_options, interrupted)?;
    py.detach(|| {
        let reading = reading(&loaded.scene, &what, asked.quiet, interrupted)?;
        let diagnostics: Vec<Diagnostic> = loaded.diagnostics.iter().chain(&reading.diagnostics).cloned().collect();
        if !asked.quiet {
            list(&diagnostics, MOST_WARNINGS);
        }
        let measured = Measured::Patches(reading.patches()?);
        Ok((Loaded { measured, format: Format::Xml }, as_json(&reading, &diagnostics)))
    })
}

/// What is to be measured, from the command line.
fn options(asked: &SampleArguments) -> Result<Options> {
    let time = asked.time_limit.map(|seconds| {
        let fits = (0.0..=LONGEST).contains(&seconds);
        let problem = || Error::setting("time-limit", format!("{seconds} was found, expected seconds from 0 to {LONGEST}"));
        fits.then(|| Duration::from_secs_f64(seconds)).ok_or_else(problem)
    });
    let basis = Basis::known(asked.basis.in_files()).ok_or_else(|| Error::setting("basis", "it is not known"))?;
    Ok(Options {
        orientation: Orientation { front: asked.front.vector(), up: asked.up.vector() },
        window: asked.window.as_deref().map(window).transpose()?,
        repeats: asked.repeat,
        basis,
        sides: asked.sides.wanted(),
        colour: asked.colour,
        stop: Stop { error: share("error", &asked.error)?, rays: asked.rays, time: time.transpose()? },
        seed: asked.work.seed,
        threads: asked.work.threads,
    })
}

/// Two corners, `X,Y` each.
fn window(corners: &[String]) -> Result<Window> {
    let corner = |text: &String| {
        let numbers = text.split(',').map(|part| number("window", part)).collect::<Result<Vec<f64>>>()?;
        <[f64; 2]>::try_from(numbers).map_err(|_| Error::setting("window", format!("'{text}' was found, expected X,Y")))
    };
    match corners {
        [min, max] => Ok(Window { min: corner(min)?, max: corner(max)? }),
        _ => Err(Error::setting("window", "two corners are expected")),
    }
}

/// The reading, with a bar on the way.
fn reading(scene: &Scene, what: &Options, quiet: bool, interrupted: &AtomicBool) -> Result<SampleReading> {
    let mut reporter = Reporter::new(quiet);
    let mut progress = |progress: &Progress| {
        show(&mut reporter, progress, &what.stop);
        goes_on(interrupted)
    };
    let reading = measure(scene, what, Execution::detect(), interrupted, &mut progress);
    reporter.clear();
    reading
}

/// Errors fall with the root of the number of rays, so that the wanted one tells the way.
fn show(reporter: &mut Reporter, progress: &Progress, stop: &Stop) {
    let by_error = progress.error.filter(|error| error.is_finite() && *error > 0.0).map_or(0.0, |error| (stop.error / error).powi(2));
    let elapsed = progress.elapsed.as_secs_f64();
    let by_time = stop.time.map_or(0.0, |time| elapsed / time.as_secs_f64().max(1e-3));
    let fraction = (progress.paths as f64 / progress.most as f64).max(by_error).max(by_time).min(1.0);
    let remaining = (fraction > 0.0).then(|| Duration::from_secs_f64(elapsed * (1.0 - fraction) / fraction));
    let millions = progress.paths as f64 * 1e-6;
    let error = progress.error.map_or(String::new(), |error| format!(", {:.1} % at the worst patch", 100.0 * error));
    reporter.tell(fraction, &format!("{millions:.1} M rays{error}"), remaining, &format!("{:.1} M rays/s", millions / elapsed.max(1e-3)));
}

/// The measurement for machines.
fn as_json(reading: &SampleReading, diagnostics: &[Diagnostic]) -> Value {
    let value = |value: WithError| json!({ "value": value.value, "standard_error": value.error });
    let sides = reading.sides.iter().map(|side| {
        let of = |part: fn(&FromPatch) -> WithError| value(reading.of_diffuse(side, part));
        json!({
            "from": if side.from_front { "front" } else { "back" },
            "diffuse": {
                "reflected": of(|from| from.reflected),
                "transmitted": of(|from| from.transmitted),
                "absorbed": of(|from| from.absorbed),
                "lost": of(|from| from.lost),
                "cut_off": of(|from| from.cut_off),
            },
            "lost_by_patch": side.from.iter().map(|from| from.lost.value).collect::<Vec<_>>(),
            "errors_by_patch": side.from.iter().map(|from| from.error).collect::<Vec<_>>(),
        })
    });
    json!({
        "window_m": [reading.window.min, reading.window.max],
        "body_m": reading.body,
        "basis": reading.basis.name,
        "sides": sides.collect::<Vec<_>>(),
        "rays": reading.paths,
        "seconds": reading.elapsed.as_secs_f64(),
        "error": reading.error(),
        "converged": reading.converged,
        "diagnostics": diagnostics.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// The measurement in lines.
pub(super) fn as_text(sample: &Value) -> Vec<String> {
    if sample.is_null() {
        return Vec::new();
    }
    let number = |value: &Value| value.as_f64().unwrap_or(0.0);
    let size = |corners: &Value, k: usize| number(&corners[1][k]) - number(&corners[0][k]);
    let (window, body) = (&sample["window_m"], &sample["body_m"]);
    let [width, height] = [0, 1].map(|k| size(window, k));
    let [x, y, z] = [0, 1, 2].map(|k| size(body, k));
    let mut lines = vec![format!("sample: {x:.4} × {y:.4} × {z:.4} m, a window of {width:.4} × {height:.4} m")];
    for side in sample["sides"].as_array().map_or(&[][..], Vec::as_slice) {
        let from = side["from"].as_str().unwrap_or_default();
        let share = |name: &str| {
            let found = &side["diffuse"][name];
            format!("{name} {:.2} ± {:.2} %", 100.0 * number(&found["value"]), 100.0 * number(&found["standard_error"]))
        };
        let shares = ["reflected", "transmitted", "absorbed", "lost"].map(share);
        lines.push(format!("diffuse light from the {from}: {}", shares.join(", ")));
    }
    let (millions, seconds) = (1e-6 * number(&sample["rays"]), number(&sample["seconds"]));
    let short = if sample["converged"] == true { "" } else { "; the error that was asked for was not reached" };
    let taken = clock(Duration::from_secs_f64(seconds));
    let error = 100.0 * number(&sample["error"]);
    lines.push(format!(
        "rays: {millions:.1} M in {taken}, {:.1} M a second, {error:.1} % at the worst patch{short}",
        millions / seconds.max(1e-3)
    ));
    lines
}
