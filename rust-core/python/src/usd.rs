//! USD stages and the command line.

use crate::{
    error::{exception, setting},
    scene::Scene,
};
use gonio_usd::{
    Complexity, Purpose, SampleTime, StageOptions,
    camera::primary_camera_name,
    dependencies::files_of_stage,
    load_stage,
    view::{ViewOptions, complete},
};
use pyo3::prelude::*;
use std::{path::PathBuf, sync::atomic::AtomicBool};

/// Reads a USD stage; `scene.diagnostics` tells what is not as the stage asked for. `motion_vectors`: for the pass `motion`, things are read at the
/// frames before and after too, where nothing is blurred. `hide_lights`: the camera does not see the shapes of lamps. `haze`: metres at
/// which contrast falls to 5 % in haze that fills all of space.
#[pyfunction]
#[pyo3(signature = (path, *, frame = None, camera = None, render_settings = None, render_pass = None, purposes = None, complexity = "high", camera_light = true, strict = false, motion_vectors = false, hide_lights = false, haze = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn load_usd<'py>(
    py: Python<'py>,
    path: PathBuf,
    frame: Option<f64>,
    camera: Option<String>,
    render_settings: Option<String>,
    render_pass: Option<String>,
    purposes: Option<Vec<String>>,
    complexity: &str,
    camera_light: bool,
    strict: bool,
    motion_vectors: bool,
    hide_lights: bool,
    haze: Option<f64>,
) -> PyResult<Bound<'py, Scene>> {
    let mut options = StageOptions { strict, render_settings, render_pass, motion_vectors, hide_lights, haze, ..StageOptions::default() };
    options.time = frame.map_or(SampleTime::Start, SampleTime::Code);
    options.complexity = Complexity::from_name(complexity)
        .ok_or_else(|| setting("complexity", format!("'{complexity}' was found, expected low, medium, high, veryhigh or auto")))?;
    if let Some(tokens) = purposes {
        let purpose = |token: &String| {
            let problem = || setting("purposes", format!("'{token}' was found, expected default, render, proxy or guide"));
            Purpose::from_token(token).ok_or_else(problem)
        };
        options.purposes = Some(tokens.iter().map(purpose).collect::<PyResult<_>>()?);
    }
    let mut loaded = load_stage(py, &path, &options, &AtomicBool::new(false)).map_err(exception)?;
    let view = ViewOptions { camera, camera_light, ..ViewOptions::default() };
    let primary = primary_camera_name(py, loaded.scene.cameras.len());
    let notes = complete(&mut loaded, &primary, &view).map_err(exception)?;
    loaded.diagnostics.extend(notes);
    Scene { scene: loaded.scene, diagnostics: loaded.diagnostics, cameras_have_shape: false, ..Scene::default() }.public(py)
}

/// The scene that `gonio render` with these arguments, the program's name first, would trace at a frame; relative paths start at `folder`.
#[pyfunction]
pub(crate) fn _scene(py: Python<'_>, arguments: Vec<String>, folder: PathBuf, frame: Option<f64>) -> PyResult<Bound<'_, Scene>> {
    let loaded = gonio_cli::farm_scene(py, &arguments, &folder, frame).map_err(exception)?;
    Scene { scene: loaded.scene, diagnostics: loaded.diagnostics, cameras_have_shape: false, ..Scene::default() }.public(py)
}

/// The scene that `gonio view` with these arguments, the program's name first, would show at a frame, and what its window has to know, as JSON.
#[pyfunction]
pub(crate) fn _view_scene(
    py: Python<'_>,
    arguments: Vec<String>,
    folder: PathBuf,
    frame: Option<f64>,
) -> PyResult<(Bound<'_, Scene>, String)> {
    let gonio_cli::Viewed { loaded, about } = gonio_cli::view_scene(py, &arguments, &folder, frame).map_err(exception)?;
    let scene = Scene { scene: loaded.scene, diagnostics: loaded.diagnostics, cameras_have_shape: true, ..Scene::default() };
    Ok((scene.public(py)?, about))
}

/// Paths of all files that the stage in a file is made of.
#[pyfunction]
pub(crate) fn _files_of_stage(py: Python<'_>, path: PathBuf) -> PyResult<Vec<String>> {
    files_of_stage(py, &path).map_err(exception)
}

/// Runs the command line; gives the exit status.
#[pyfunction]
pub(crate) fn _main(py: Python<'_>, arguments: Vec<String>) -> i32 {
    crate::memory::keep();
    gonio_cli::run(py, arguments)
}
