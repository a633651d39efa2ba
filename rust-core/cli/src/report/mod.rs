//! `gonio report`.

mod colour;
mod eyes;
mod grids;
mod head;
mod html;
mod pictures;
mod power;
mod schedule;
mod year;

pub(super) use head::{Head, today};
pub(super) use html::{Page, as_file};

use super::{
    arguments::{ReportOptions, ScaleArguments},
    daylight,
    denoise::Denoiser,
    falsecolor,
    file::{check_ending, check_targets, ending, print_path, put},
    measure::{apply_settings, author_grids, evaluated},
    messages::say,
    messages::tell,
    progress::Reporter,
    render::stage_options,
    stage::{Stage, light_model},
    words::Words,
};
use colour::Colours;
use gonio::{
    Diagnostic, Error, Result, Severity,
    compile::{CompiledScene, compile},
    measure::Measurements,
    output::FalseColourScale,
    scene::Integrator,
};
use gonio_page::{Language, check_browser};
use gonio_usd::{Loaded, SampleTime, camera::choose, meter::axes};
use pyo3::prelude::*;
use schedule::Schedule;
use std::sync::{Arc, atomic::AtomicBool};
use year::Years;

/// Endings of a page's file.
const ENDINGS: &[&str] = &["html", "htm", "pdf"];

/// Writes the page.
pub(super) fn report(py: Python<'_>, options: &ReportOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    check_ending("output", &options.output, ENDINGS)?;
    // Said before anything is rendered.
    FalseColourScale::new(options.max_illuminance.unwrap_or(1.0), options.steps, None)?;
    FalseColourScale::new(options.max_luminance.unwrap_or(1.0), options.steps, None)?;
    check_targets([&options.output])?;
    if ending(&options.output) == "pdf" {
        check_browser().map_err(|error| Error::setting("output", error.to_string()))?;
    }
    let years = Years::read(&options.annual)?;
    let mut stage_options = stage_options(&options.stage)?;
    stage_options.time = options.frame.map_or(SampleTime::Start, SampleTime::Code);
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    author_grids(py, &stage, &options.grids, None)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    let words = Words::new(Language::of_code(&options.language));
    eyes::add(&mut loaded.scene, options, &words)?;
    let today = today(py).map_err(|error| Error::Internal(error.to_string()))?;
    let denoiser = denoiser(options);
    py.detach(|| run((options, &words), loaded, (today, &years), denoiser.as_ref(), interrupted))
}

/// What takes the noise out of the pictures, unless that is not wanted or not to be had, which is told.
fn denoiser(options: &ReportOptions) -> Option<Denoiser> {
    let found = (!options.no_denoise && !options.no_pictures).then(Denoiser::new)?;
    let tell = |error: &Error| {
        if !options.quiet {
            say(&format!("the pictures keep their noise: {error}"));
        }
    };
    found.inspect_err(tell).ok()
}

fn run(
    (options, words): (&ReportOptions, &Words),
    mut loaded: Loaded,
    (today, years): (String, &Years),
    denoiser: Option<&Denoiser>,
    interrupted: &'static AtomicBool,
) -> Result<i32> {
    daylight::add(&options.daylight, &mut loaded, options.stage.strict, options.quiet)?;
    light_model(&options.stage.stage, &mut loaded, options.quiet);
    let cameras = cameras(options, &loaded)?;
    let mut diagnostics = loaded.diagnostics.clone();
    let (pictures, compiled) = pictures::pictures(options, &mut loaded, &cameras, denoiser, interrupted, &mut diagnostics)?;
    let measured = measured(options, &mut loaded, compiled.as_deref(), interrupted, &mut diagnostics)?;
    let lit = (&loaded.scene, &measured);
    let colours = Colours::new(lit, compiled.as_deref(), Reporter::new(options.quiet), interrupted)?;
    let power = power(options, (&loaded, words), compiled, &measured, interrupted)?;
    tell(&options.stage, options.quiet, &diagnostics);
    let schedule = Schedule::new(&loaded, words);
    let mut page = Page::new(&Head::new(options, today, words), words);
    schedule.write(words, &mut page);
    pictures::write(&pictures, words, &mut page);
    grids::write_grids(options, &measured.grids, &power, (words, &mut page))?;
    grids::write_meters(&measured.meters, words, &mut page);
    colours.write(options, words, &mut page)?;
    years.write(words, &mut page);
    schedule.write_files(words, &mut page);
    write_notes(&diagnostics, years, words, &mut page);
    let html = page.finish();
    let bytes = as_file(html.clone(), &options.output, interrupted).or_else(|error| html::kept(&html, &options.output, error))?;
    put(&options.output, &bytes)?;
    if !options.quiet {
        print_path(&options.output);
    }
    Ok(0)
}

/// The paths of the cameras whose pictures are wanted; a nameless one sees everything of a stage without cameras.
fn cameras(options: &ReportOptions, loaded: &Loaded) -> Result<Vec<Option<String>>> {
    let known = &loaded.scene.cameras;
    let path = |number: u32| known.get(number as usize).map(|camera| camera.origin.name.to_string());
    if options.no_pictures {
        return Ok(Vec::new());
    }
    if !options.camera.is_empty() {
        return options.camera.iter().map(|name| Ok(choose(known, Some(name), None, "")?.and_then(path))).collect();
    }
    Ok(if known.is_empty() { vec![None] } else { (0..known.len() as u32).map(path).collect() })
}

/// What the stage's grids and meters show, and those of the command line.
fn measured(
    options: &ReportOptions,
    loaded: &mut Loaded,
    previous: Option<&CompiledScene>,
    interrupted: &'static AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Measurements> {
    let scene = &mut loaded.scene;
    if scene.meters.is_empty() && scene.grids.is_empty() {
        return Ok(Measurements::default());
    }
    apply_settings(scene, (options.point_spp, options.max_bounces), Integrator::Path, (&options.work, &options.textures));
    let found = evaluated(scene, previous, Reporter::new(options.quiet), interrupted)?;
    diagnostics.extend(found.diagnostics.iter().filter(|new| !diagnostics.contains(new)).cloned().collect::<Vec<_>>());
    Ok(found)
}

/// The lines of the installed power density, of a scene that may have been compiled for its pictures.
fn power(
    options: &ReportOptions,
    (loaded, words): (&Loaded, &Words),
    compiled: Option<Arc<CompiledScene>>,
    measured: &Measurements,
    interrupted: &'static AtomicBool,
) -> Result<Vec<String>> {
    if measured.grids.is_empty() {
        return Ok(Vec::new());
    }
    let scene = compiled.map_or_else(|| compile(&loaded.scene, None, interrupted).map(Arc::new), Ok)?;
    let [up, _] = axes(loaded.info.up_axis);
    Ok(power::density(&measured.grids, &Schedule::new(loaded, words), &scene, (up, options.grid_density), words))
}

/// What the stage asks for and is not as asked.
fn write_notes(diagnostics: &[Diagnostic], years: &Years, words: &Words, page: &mut Page) {
    let own = diagnostics.iter().filter(|diagnostic| diagnostic.severity == Severity::Warning).map(ToString::to_string);
    let mut warnings: Vec<String> = own.collect();
    for warning in years.warnings() {
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }
    if !warnings.is_empty() {
        page.section(&words.notes.title);
        page.list(&warnings);
    }
}

/// Steps up to what was asked for, or to a round number that nearly all values stay below; even ones, or even in the logarithm over so many decades.
fn scale(options: &ReportOptions, max: Option<f32>, log: Option<f32>, values: &[f32]) -> Result<FalseColourScale> {
    falsecolor::scale(&ScaleArguments { max, steps: options.steps, log }, values)
}
