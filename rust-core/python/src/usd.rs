//! USD stages and the command line.

use crate::{error::exception, scene::Scene};
use gonio_usd::{Complexity, Purpose, SampleTime, StageOptions, framing, load_stage, settings::conform_cameras};
use pyo3::prelude::*;
use std::{path::PathBuf, sync::atomic::AtomicBool};

/// Reads a USD stage; `scene.diagnostics` tells what is not as the stage asked for.
#[pyfunction]
#[pyo3(signature = (path, *, frame = None, purposes = None, complexity = "high", strict = false))]
pub(crate) fn load_usd(
    py: Python<'_>, path: PathBuf, frame: Option<f64>, purposes: Option<Vec<String>>, complexity: &str, strict: bool,
) -> PyResult<Scene> {
    let setting = |name: &str, problem: String| exception(gonio::Error::Setting { name: name.into(), problem });
    let mut options = StageOptions { strict, ..StageOptions::default() };
    options.time = frame.map_or(SampleTime::Start, SampleTime::Code);
    options.complexity = Complexity::from_name(complexity)
        .ok_or_else(|| setting("complexity", format!("'{complexity}' was found, expected low, medium, high or veryhigh")))?;
    if let Some(tokens) = purposes {
        let purpose = |token: &String| {
            let problem = || setting("purposes", format!("'{token}' was found, expected default, render, proxy or guide"));
            Purpose::from_token(token).ok_or_else(problem)
        };
        options.purposes = tokens.iter().map(purpose).collect::<PyResult<_>>()?;
    }
    let mut loaded = load_stage(py, &path, &options, &AtomicBool::new(false)).map_err(exception)?;
    let policy = loaded.settings.as_ref().map_or(framing::ConformPolicy::default(), |settings| settings.conform);
    conform_cameras(&mut loaded.scene, policy);
    Ok(Scene { scene: loaded.scene, diagnostics: loaded.diagnostics })
}

/// Runs the command line; gives the exit status.
#[pyfunction]
pub(crate) fn _main(py: Python<'_>, arguments: Vec<String>) -> i32 {
    gonio_usd::cli::run(py, arguments)
}
