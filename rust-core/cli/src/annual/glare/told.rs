//! What eyes have of a year, as lines, for machines and as files.

use crate::{
    annual::{
        inputs::positions,
        pictures,
        plots::{self, Times},
        text,
    },
    arguments::AnnualGlareOptions,
    file::{print_path, put},
    messages::{diagnostics_json, print},
    words::Words,
};
use gonio::{Diagnostic, Result, annual_glare::Eye};
use gonio_annual::{EyeGlare, GlareYear, Schedule, Year, to_npy};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// The most eyes whose year is drawn each.
const MOST_DRAWN: usize = 24;

/// Tells and writes.
pub(super) fn finish(
    options: &AnnualGlareOptions,
    (year, schedule): (&Year, &Schedule),
    (eyes, told): (&[Eye], &[Diagnostic]),
    (glare, facades): (&GlareYear, &[&str]),
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
        let mut value = json!({
            "weather": options.year.weather.to_string_lossy(),
            "place": year.place,
            "schedule": options.year.schedule,
            "sun_position": positions(&options.year).name(),
            "used_steps": schedule.count(),
            "views": eyes.iter().zip(&figures).map(eye).collect::<Vec<_>>(),
            "views_within_5_percent": shares,
            "surfaces": options.surfaces,
            "diagnostics": diagnostics_json(told),
        });
        if !options.facades.group.is_empty() {
            value["groups"] = json!(facades);
        }
        if !glare.closed_hours().is_empty() {
            value["closed_hours"] = json!(glare.closed_hours());
        }
        print(&value.to_string());
        return Ok(0);
    }
    eyes.iter().zip(&figures).for_each(|(eye, (found, error))| print(&line(eye, found, error.as_ref())));
    text::closed(facades, glare.closed_hours()).iter().for_each(|line| print(line));
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
pub(super) fn paths(folder: &Path, eyes: usize) -> Vec<PathBuf> {
    let pictures = (1..=eyes.min(MOST_DRAWN)).flat_map(|number| ["png", "svg"].map(|ending| format!("glare_{number}.{ending}")));
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
    let times = Times::new(year);
    for (eye, files) in paths[2..].chunks_exact(2).enumerate() {
        pictures::glare_carpet(&files[0], year, glare.values(eye))?;
        put(&files[1], plots::glare(&eyes[eye], &figures[eye], (&times, glare.values(eye)), Words::english()).as_bytes())?;
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
