//! `gonio goniometer`.

mod json;
mod numbers;
mod rays;
mod text;

use super::{
    arguments::{GoniometerOptions, SymmetryName},
    drawing,
    file::{check_ending, check_targets, ending, put},
    interrupt::goes_on,
    messages::print,
    messages::tell,
    progress::Reporter,
    render::stage_options,
    share::share,
    stage::Stage,
};
use gonio::{
    Diagnostic, Error, Result,
    goniometer::{Angles, Frame, Options, Progress, Reading, Stop, measure},
    scene::{Origin, Scene},
};
use gonio_formats::photometry::{
    PolarUnit,
    measured::{MeasurementHead, Reduced},
    polar_diagram,
};
use gonio_simd::Execution;
use gonio_usd::SampleTime;
use pyo3::prelude::*;
use std::{borrow::Cow, sync::atomic::AtomicBool, time::Duration};

/// The longest time limit, in seconds.
const LONGEST: f64 = 1e9;

/// Measures the luminaire, says what was found, and writes what was asked for.
pub(super) fn goniometer(py: Python<'_>, options: &GoniometerOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    check_files(options)?;
    let mut stage_options = stage_options(&options.stage)?;
    stage_options.time = options.frame.map_or(SampleTime::Start, SampleTime::Code);
    stage_options.subtree = Some(options.luminaire.clone());
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let placed = stage.placed(py, &options.luminaire, stage_options.time, "luminaire")?;
    let frame = Frame::of(&placed, options.down.vector(), options.c0.vector(), &Origin::new(&options.luminaire))?;
    let mut what = asked(options, frame)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    let place = |prim: &str| stage.placed(py, prim, stage_options.time, "rays-file");
    what.rays = rays::all(options, loaded.info.metres_per_unit, place, &mut loaded.diagnostics)?;
    py.detach(|| run(options, &loaded.scene, loaded.diagnostics, &what, interrupted))
}

/// Refuses files of other kinds, and those that cannot be written, before anything is traced.
fn check_files(options: &GoniometerOptions) -> Result<()> {
    options.output.iter().try_for_each(|path| check_ending("output", path, &["ldt", "ies", "xml", "gldf"]))?;
    options.polar.iter().try_for_each(|path| check_ending("polar", path, drawing::ENDINGS))?;
    let tables = [("csv", &options.csv), ("screen-csv", &options.screen_csv)];
    tables.into_iter().try_for_each(|(option, path)| path.iter().try_for_each(|path| check_ending(option, path, &["csv"])))?;
    check_targets(options.output.iter().chain(&options.polar).chain(&options.csv).chain(&options.screen_csv))
}

/// What is to be measured, from the command line.
fn asked(options: &GoniometerOptions, frame: Frame) -> Result<Options> {
    let angles = match &options.gammas {
        Some(list) => numbers::angles(options.c_step, list)?,
        None => Angles::regular(options.c_step, options.g_step)?,
    };
    let time = options.time_limit.map(|seconds| {
        let fits = (0.0..=LONGEST).contains(&seconds);
        let problem = || Error::setting("time-limit", format!("{seconds} was found, expected seconds from 0 to {LONGEST}"));
        fits.then(|| Duration::from_secs_f64(seconds)).ok_or_else(problem)
    });
    Ok(Options {
        frame,
        angles,
        stop: Stop { error: share("error", &options.error)?, rays: options.rays, time: time.transpose()? },
        symmetry: options.symmetry.forced().map(SymmetryName::into),
        rays: Vec::new(),
        screen: options.screen.as_deref().map(numbers::screen).transpose()?,
        seed: options.work.seed,
        threads: options.work.threads,
    })
}

fn run(
    options: &GoniometerOptions,
    scene: &Scene,
    mut diagnostics: Vec<Diagnostic>,
    what: &Options,
    interrupted: &AtomicBool,
) -> Result<i32> {
    let reading = measured(scene, what, options.quiet, interrupted)?;
    let reduced = reduced(options, &reading)?;
    diagnostics.extend(reading.diagnostics.iter().cloned());
    let origin = Origin::new(&options.luminaire);
    diagnostics.extend(reduced.goniogram.warnings.iter().map(|warning| Diagnostic::warning(&origin, warning.to_string())));
    let product = options.output.iter().any(|path| ending(path) == "gldf").then(|| reading.to_gldf(&reduced)).transpose()?;
    let (product, left_out) = product.unzip();
    diagnostics.extend(left_out.into_iter().flatten());
    if options.stage.strict
        && let Some(first) = diagnostics.iter().find(|diagnostic| diagnostic.severity == gonio::Severity::Warning)
    {
        return Err(Error::scene(&first.origin, first.message.clone()));
    }
    tell(&options.stage, options.quiet, &diagnostics);
    write(options, &reading, &reduced, &product.unwrap_or_default())?;
    if options.json {
        print(&json::as_json(options, &reading, &reduced, &diagnostics).to_string());
    } else {
        text::as_text(options, &reading, &reduced).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// The reading, with a bar on the way.
fn measured(scene: &Scene, what: &Options, quiet: bool, interrupted: &AtomicBool) -> Result<Reading> {
    let mut reporter = Reporter::new(quiet);
    let mut progress = |progress: &Progress| {
        show(&mut reporter, progress, what);
        goes_on(interrupted)
    };
    let reading = measure(scene, what, Execution::detect(), interrupted, &mut progress);
    reporter.clear();
    reading
}

/// Errors fall with the root of the number of rays, so that the wanted one tells the way.
fn show(reporter: &mut Reporter, progress: &Progress, what: &Options) {
    let by_error = progress.error.filter(|error| error.is_finite() && *error > 0.0).map_or(0.0, |error| (what.stop.error / error).powi(2));
    let elapsed = progress.elapsed.as_secs_f64();
    let by_time = what.stop.time.map_or(0.0, |time| elapsed / time.as_secs_f64().max(1e-3));
    let fraction = (progress.paths as f64 / progress.most as f64).max(by_error).max(by_time).min(1.0);
    let remaining = (fraction > 0.0).then(|| Duration::from_secs_f64(elapsed * (1.0 - fraction) / fraction));
    let speed = progress.paths as f64 * 1e-6 / elapsed.max(1e-3);
    let error = progress.error.map_or(String::new(), |error| format!(", {:.2} % at the peak", 100.0 * error));
    reporter.tell(fraction, &format!("{:.1} M rays{error}", progress.paths as f64 * 1e-6), remaining, &format!("{speed:.1} M rays/s"));
}

/// The goniogram with the symmetry that was asked for.
fn reduced(options: &GoniometerOptions, reading: &Reading) -> Result<Reduced> {
    let name = options.name.clone().unwrap_or_else(|| options.luminaire.rsplit('/').next().unwrap_or_default().to_owned());
    let head = MeasurementHead {
        name,
        manufacturer: options.manufacturer.clone(),
        date: options.date.clone().unwrap_or_default(),
        ..MeasurementHead::default()
    };
    let measurement = reading.measurement(head, options.watts);
    let symmetry = options.symmetry.forced().map(SymmetryName::into);
    measurement.reduced(symmetry).map_err(|error| Error::setting("luminaire", error.problem))
}

/// Writes all files that were asked for; `product` are the bytes of those that end with `.gldf`.
fn write(options: &GoniometerOptions, reading: &Reading, reduced: &Reduced, product: &[u8]) -> Result<()> {
    for path in &options.output {
        let bytes = match ending(path).as_str() {
            "ldt" => Cow::Owned(reduced.to_ldt()),
            "ies" => Cow::Owned(reduced.to_ies()),
            "xml" => Cow::Owned(reduced.to_tm33()),
            _ => Cow::Borrowed(product),
        };
        put(path, &bytes)?;
    }
    if let Some(path) = &options.polar {
        put(path, &drawing::encoded(polar_diagram(&reduced.goniogram, PolarUnit::CandelaPerKilolumen), path)?)?;
    }
    if let Some(path) = &options.csv {
        put(path, reading.csv().as_bytes())?;
    }
    match (&options.screen_csv, &reading.screen) {
        (Some(path), Some(screen)) => put(path, screen.csv().as_bytes()),
        _ => Ok(()),
    }
}
