//! `--explain`: what a prim has become.

use super::{arguments::RenderOptions, light_words::describe, messages::print, render::sample_time, stage::Stage, words::Words};
use gonio::{
    Result,
    compile::luminous_fluxes,
    scene::{Camera, Projection},
};
use gonio_formats::short_number;
use gonio_usd::{Loaded, StageOptions, explain::explain};
use pyo3::prelude::*;
use std::sync::atomic::AtomicBool;

/// As `gonio render --explain` has it: at the first frame asked for.
pub(super) fn render(
    py: Python<'_>,
    options: &RenderOptions,
    stage: &Stage,
    stage_options: &StageOptions,
    path: &str,
    interrupted: &AtomicBool,
) -> Result<i32> {
    let first = stage.info().time_range.map(|[first, _]| first);
    let frame = super::render::frames_of(options, first)?.first().copied().flatten();
    let stage_options = StageOptions { time: sample_time(options, frame), lenient: true, ..stage_options.clone() };
    let loaded = stage.load(py, &stage_options, interrupted)?;
    tell(py, stage, &stage_options, &loaded, path)
}

/// Prints the lines.
pub(super) fn tell(py: Python<'_>, stage: &Stage, options: &StageOptions, loaded: &Loaded, path: &str) -> Result<i32> {
    let path = if path.len() > 1 { path.trim_end_matches('/') } else { path };
    let lines = explain(py, stage.usd("explain")?, options, loaded, path)?;
    lines.iter().for_each(|line| print(line));
    lights(loaded, path).iter().for_each(|line| print(line));
    loaded.scene.cameras.iter().filter(|camera| &*camera.origin.name == path).for_each(|camera| print(&of_camera(camera)));
    Ok(0)
}

/// Photometry of the lights that a prim became.
fn lights(loaded: &Loaded, path: &str) -> Vec<String> {
    let scene = &loaded.scene;
    let own = scene.lights.iter().zip(luminous_fluxes(scene)).filter(|(light, _)| &*light.origin.name == path);
    own.map(|(light, flux)| {
        let flux = flux.map_or(String::new(), |flux| format!(", {} lm in all", short_number(flux)));
        let group = if light.group.is_empty() { String::new() } else { format!(", light group '{}'", light.group) };
        format!("light: {}{flux}{group}", describe(light, Words::english()))
    })
    .collect()
}

fn of_camera(camera: &Camera) -> String {
    let lens = match camera.projection {
        Projection::Perspective { focal_length } => {
            let angle = |side: f64| (0.5 * side / focal_length).atan().to_degrees() * 2.0;
            format!("{:.1}° × {:.1}°", angle(camera.aperture[0]), angle(camera.aperture[1]))
        }
        Projection::Orthographic => format!("parallel, {} × {} m", short_number(camera.aperture[0]), short_number(camera.aperture[1])),
        _ => "panorama".to_owned(),
    };
    let [near, far] = camera.clipping.map(short_number);
    let lens_words = if camera.lens_radius > 0.0 {
        format!(", sharp at {} m", short_number(camera.focus_distance))
    } else {
        ", everything sharp".into()
    };
    format!("camera: {lens}{lens_words}, from {near} to {far} m, exposure {}", camera.exposure.0)
}
