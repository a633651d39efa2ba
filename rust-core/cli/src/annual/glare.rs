//! `gonio annual-glare`.

use super::{
    inputs::{positions, weather, year},
    pictures, settings, tell_doubts,
};
use crate::{
    arguments::AnnualGlareOptions,
    file::{check_targets, print_path, put},
    measure::{apply_settings, author_grids, watched},
    messages::{diagnostics_json, print, tell},
    progress::Reporter,
    reading::triple,
    render::stage_options,
    stage::Stage,
};
use gonio::{
    Diagnostic, Error, Result,
    annual::{AnnualTask, told},
    annual_glare::{Eye, EyesTraced, trace_eyes},
    measure::{GridPoints, around},
    scene::{Integrator, Origin, SITTING, Scene},
    sky::Frame,
};
use gonio_annual::{EyeGlare, GlareYear, Schedule, Year, to_npy};
use gonio_simd::Execution;
use gonio_usd::{daylight::up_axis, meter::axes};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::{
    path::{Path, PathBuf},
    sync::atomic::{AtomicBool, Ordering},
};

/// The most eyes whose year is drawn each.
const MOST_DRAWN: usize = 24;

/// Traces the eyes and rates their year.
pub(crate) fn annual_glare(py: Python<'_>, options: &AnnualGlareOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let (year, schedule) = year(&options.year, positions(&options.year), &weather(&options.year)?)?;
    tell_doubts(&options.year, &year);
    let stage_options = stage_options(&options.stage)?;
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let mut grids = options.grids.clone();
    grids.height = grids.height.or((!grids.grid.is_empty()).then_some(SITTING));
    author_grids(py, &stage, &grids, None)?;
    let mut loaded = stage.load(py, &stage_options, interrupted)?;
    loaded.scene.grids.retain(|grid| grids.grid.iter().any(|prim| *prim == *grid.origin.name));
    apply_settings(&mut loaded.scene, (options.spp, options.max_bounces), Integrator::Path, (&options.work, &options.textures));
    let [up, ahead] = axes(loaded.info.up_axis);
    let eyes = eyes(options, &loaded.scene, up, ahead)?;
    let frame = Frame { up_axis: up_axis(loaded.info.up_axis), north_deg: options.year.north };
    py.detach(|| {
        let tell = |diagnostics: &[Diagnostic]| tell(&options.stage, options.quiet, diagnostics);
        tell(&loaded.diagnostics);
        if let Some(folder) = &options.year.output {
            check_targets(paths(folder, eyes.len()).iter())?;
        }
        let task = AnnualTask { year: &year, frame, factor: options.factor, facades: &[], closed: &[] };
        let follow = |watch: &mut gonio::measure::Watch<'_>| trace_eyes(&loaded.scene, &eyes, &task, Execution::detect(), watch);
        let traced = watched(Reporter::new(options.quiet), None, interrupted, follow)?;
        tell(&traced.diagnostics);
        let told: Vec<Diagnostic> = loaded.diagnostics.iter().chain(&traced.diagnostics).cloned().collect();
        let glare = rated(options, (&year, &schedule), traced, interrupted)?;
        finish(options, (&year, &schedule), (&eyes, &told), &glare)
    })
}

/// The eyes of the command line, and those over grids, which look around.
fn eyes(options: &AnnualGlareOptions, scene: &Scene, up: [f64; 3], ahead: [f64; 3]) -> Result<Vec<Eye>> {
    let facings = options.facing.iter().map(|text| triple("facing", text)).collect::<Result<Vec<_>>>()?;
    let directions = if facings.is_empty() { around(up, ahead, options.directions.unwrap_or(4)) } else { facings };
    let looking = |name: &str, position: [f64; 3]| {
        let eye = |(number, facing): (usize, &[f64; 3])| {
            let name = if directions.len() > 1 { format!("{name} ({} of {})", number + 1, directions.len()) } else { name.to_owned() };
            Eye { origin: Origin::new(name), position, facing: *facing }
        };
        directions.iter().enumerate().map(eye).collect::<Vec<_>>()
    };
    let mut eyes = Vec::new();
    for text in &options.eye {
        eyes.extend(looking(text, triple("eye", text)?));
    }
    for grid in &scene.grids {
        for (place, position) in GridPoints::new(scene, grid)?.known().enumerate() {
            eyes.extend(looking(&format!("{}/{}", grid.origin.name, place + 1), position));
        }
    }
    if eyes.is_empty() {
        return Err(Error::setting("eye", "there is nobody who looks; name an eye with --eye X,Y,Z or a floor with --grid /Prim"));
    }
    Ok(eyes)
}

/// The year of all eyes.
fn rated(
    options: &AnnualGlareOptions,
    (year, schedule): (&Year, &Schedule),
    traced: EyesTraced,
    interrupted: &AtomicBool,
) -> Result<GlareYear> {
    let settings = settings(&options.year, None, options.work.threads)?;
    let goes_on = || !interrupted.load(Ordering::Relaxed);
    GlareYear::new(year, schedule, (traced.views, traced.group), &settings, &goes_on).map_err(told)?.ok_or(Error::Cancelled)
}

/// Tells and writes.
fn finish(
    options: &AnnualGlareOptions,
    (year, schedule): (&Year, &Schedule),
    (eyes, told): (&[Eye], &[Diagnostic]),
    glare: &GlareYear,
) -> Result<i32> {
    let figures = glare.glare(schedule);
    if let Some(folder) = &options.year.output {
        for path in written(folder, year, eyes, (glare, &figures))? {
            if !options.year.json {
                print_path(&path);
            }
        }
    }
    let fit = |limit: usize| figures.iter().filter(|(found, _)| found.keeps()[limit]).count() as f64 / figures.len() as f64;
    let spatial = [("0.35", fit(0)), ("0.40", fit(1)), ("0.45", fit(2))];
    if options.year.json {
        let eye = |(eye, (found, error)): (&Eye, &(EyeGlare, Option<EyeGlare>))| {
            json!({
                "name": &*eye.origin.name,
                "position_m": eye.position,
                "facing": eye.facing,
                "glare": found,
                "standard_errors": error,
                "en17037": found.level(),
            })
        };
        let shares: serde_json::Map<String, Value> = spatial.iter().map(|(limit, share)| ((*limit).to_owned(), json!(share))).collect();
        let value = json!({
            "weather": options.year.weather.to_string_lossy(),
            "place": year.place,
            "schedule": options.year.schedule,
            "sun_position": positions(&options.year).name(),
            "used_steps": schedule.count(),
            "views": eyes.iter().zip(&figures).map(eye).collect::<Vec<_>>(),
            "views_within_5_percent": shares,
            "diagnostics": diagnostics_json(told),
        });
        print(&value.to_string());
        return Ok(0);
    }
    eyes.iter().zip(&figures).for_each(|(eye, (found, error))| print(&line(eye, found, error.as_ref())));
    if eyes.len() > 1 {
        let told: Vec<String> = spatial.iter().map(|(limit, share)| format!("{:.0} % at {limit}", 100.0 * share)).collect();
        print(&format!("views whose DGP is exceeded in no more than 5 % of the used time: {}", told.join(", ")));
    }
    Ok(0)
}

fn line(eye: &Eye, found: &EyeGlare, error: Option<&EyeGlare>) -> String {
    let per_cent = |value: f64, error: Option<f64>| match error {
        Some(error) => format!("{:.1} ± {:.1} %", 100.0 * value, 100.0 * error),
        None => format!("{:.1} %", 100.0 * value),
    };
    let [x, y, z] = eye.facing;
    let value = match error {
        Some(error) => format!("{:.3} ± {:.3}", found.dgp_5_percent, error.dgp_5_percent),
        None => format!("{:.3}", found.dgp_5_percent),
    };
    format!(
        "{} towards {x:.2},{y:.2},{z:.2}: DGP {value} exceeded in 5 % of the used time; above 0.35 in {}, 0.40 in {}, 0.45 in {}; EN 17037: {}",
        eye.origin.name,
        per_cent(found.above_035, error.map(|error| error.above_035)),
        per_cent(found.above_040, error.map(|error| error.above_040)),
        per_cent(found.above_045, error.map(|error| error.above_045)),
        found.level(),
    )
}

/// The files: series, table, and the year of the first eyes as pictures.
fn paths(folder: &Path, eyes: usize) -> Vec<PathBuf> {
    let pictures = (1..=eyes.min(MOST_DRAWN)).map(|number| format!("glare_{number}.png"));
    ["glare.npy", "glare.csv"].map(str::to_owned).into_iter().chain(pictures).map(|name| folder.join(name)).collect()
}

fn written(
    folder: &Path,
    year: &Year,
    eyes: &[Eye],
    (glare, figures): (&GlareYear, &[(EyeGlare, Option<EyeGlare>)]),
) -> Result<Vec<PathBuf>> {
    let paths = paths(folder, eyes.len());
    put(&paths[0], &to_npy(eyes.len(), year.steps.len(), glare.all_values()))?;
    put(&paths[1], table(eyes, figures).as_bytes())?;
    for (eye, path) in paths[2..].iter().enumerate() {
        pictures::glare_carpet(path, year, glare.values(eye))?;
    }
    Ok(paths)
}

/// A line for each view.
fn table(eyes: &[Eye], figures: &[(EyeGlare, Option<EyeGlare>)]) -> String {
    let mut text = "view,x_m,y_m,z_m,facing_x,facing_y,facing_z,above_035,above_040,above_045,dgp_5_percent,en17037\n".to_owned();
    for (Eye { origin, position: [x, y, z], facing: [fx, fy, fz] }, (found, _)) in eyes.iter().zip(figures) {
        let EyeGlare { above_035, above_040, above_045, dgp_5_percent } = found;
        let numbers = format!("{x},{y},{z},{fx},{fy},{fz},{above_035},{above_040},{above_045},{dgp_5_percent}");
        text += &format!("\"{}\",{numbers},{}\n", origin.name, found.level());
    }
    text
}
