//! The virtual goniophotometer.

use crate::{
    buffer::doubles,
    error::{exception, setting},
    luminaire_reading::{LuminaireReading, symmetry_of},
    scene::Scene,
    watched::{tell_rays, watched},
};
use gonio::{
    Diagnostic, Error,
    goniometer::{Angles, Frame, Options, Progress, Screen, Stop, measure},
    scene::{Origin, Scene as Description, Transform},
};
use gonio_simd::Execution;
use gonio_usd::{SampleTime, Stage, StageOptions};
use pyo3::prelude::*;
use std::{path::PathBuf, sync::atomic::AtomicBool, time::Duration};

/// Points of a screen each way that nothing is said of.
const SCREEN_POINTS: usize = 32;

/// Where the luminaire is described.
enum Source {
    Scene(Box<Description>),
    Stage { path: PathBuf, prim: String, frame: Option<f64> },
}

impl Source {
    fn of(source: &Bound<'_, PyAny>, prim: Option<String>, frame: Option<f64>) -> PyResult<Self> {
        if let Ok(scene) = source.cast::<Scene>() {
            if prim.is_some() || frame.is_some() {
                return Err(setting("luminaire", "a scene is the luminaire as a whole; prims and frames are those of stages"));
            }
            return Ok(Self::Scene(Box::new(scene.borrow().scene.clone())));
        }
        let path = source.extract::<PathBuf>()?;
        let prim = prim.ok_or_else(|| setting("luminaire", "a stage wants the path of the luminaire's prim"))?;
        Ok(Self::Stage { path, prim, frame })
    }

    /// The scene, where it stands, its name, and what is not as asked for.
    fn read(self, py: Python<'_>) -> Result<(Description, Transform, String, Vec<Diagnostic>), Error> {
        match self {
            Self::Scene(scene) => Ok((*scene, Transform::IDENTITY, "luminaire".into(), Vec::new())),
            Self::Stage { path, prim, frame } => {
                let time = frame.map_or(SampleTime::Start, SampleTime::Code);
                let options = StageOptions { time, subtree: Some(prim.clone()), ..StageOptions::default() };
                let stage = Stage::open(py, &path, &options)?;
                let placed = stage.placed(py, &prim, time, "luminaire")?;
                let loaded = stage.load(py, &options, &AtomicBool::new(false))?;
                Ok((loaded.scene, placed, prim, loaded.diagnostics))
            }
        }
    }
}

/// Measures a luminaire as a goniophotometer does: `source` is a scene that holds the luminaire and nothing else, or a USD stage's path with the
/// path of the prim that is the `luminaire`. γ = 0 looks along `down` and C0 along `c0` in the luminaire's own axes.
///
/// c_step, g_step: degrees from plane to plane and from γ to γ, or `gammas` in degrees; error: relative standard error of the peak and of the
/// flux at which it stops, 0 for all `rays`; time_limit: seconds; symmetry: that of the files, by whose averaged planes it stops, as `write` takes it; screen: distance below the luminaire, width along C0, height along C90, and
/// columns and rows, on which illuminance is measured too; seed: of the random numbers; progress: a function of rays, their most, the peak's relative error or None, and
/// seconds, which is called every 50 ms and ends the measurement by returning False.
#[pyfunction]
#[pyo3(signature = (source, luminaire = None, *, frame = None, down = [0.0, 0.0, -1.0], c0 = [1.0, 0.0, 0.0], c_step = 15.0, g_step = 5.0, gammas = None, error = 0.01, rays = 200_000_000, time_limit = None, symmetry = "auto", screen = None, seed = 0, threads = 0, progress = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn goniometer(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    luminaire: Option<String>,
    frame: Option<f64>,
    down: [f64; 3],
    c0: [f64; 3],
    c_step: f64,
    g_step: f64,
    gammas: Option<&Bound<'_, PyAny>>,
    error: f64,
    rays: u64,
    time_limit: Option<f64>,
    symmetry: &str,
    screen: Option<Vec<f64>>,
    seed: u32,
    threads: u32,
    progress: Option<Py<PyAny>>,
) -> PyResult<LuminaireReading> {
    let (scene, placed, name, mut diagnostics) = Source::of(source, luminaire, frame)?.read(py).map_err(exception)?;
    let angles = match gammas {
        Some(gammas) => Angles::regular(c_step, 90.0).map(|angles| (angles, gammas)).map_err(exception).and_then(|(angles, gammas)| {
            let gamma = gammas.extract::<Vec<f64>>().or_else(|_| doubles(gammas, "gammas"))?;
            Angles { gamma, ..angles }.checked().map_err(exception)
        })?,
        None => Angles::regular(c_step, g_step).map_err(exception)?,
    };
    let time = time_limit.map(Duration::try_from_secs_f64).transpose().map_err(|_| setting("time_limit", "expected seconds"))?;
    let options = Options {
        frame: Frame::of(&placed, down, c0, &Origin::new(&name)).map_err(exception)?,
        angles,
        stop: Stop { error, rays, time },
        symmetry: symmetry_of(symmetry)?,
        rays: Vec::new(),
        screen: screen.map(|numbers| screen_of(&numbers)).transpose()?,
        seed,
        threads,
    };
    let reading = run(py, &scene, &options, progress.as_ref())?;
    diagnostics.extend(reading.diagnostics.iter().cloned());
    let name = name.rsplit('/').next().unwrap_or_default().to_owned();
    Ok(LuminaireReading { reading, name, symmetry: options.symmetry, diagnostics })
}

fn screen_of(numbers: &[f64]) -> PyResult<Screen> {
    match *numbers {
        [distance, width, height] => Ok(Screen::below(distance, [width, height], [SCREEN_POINTS; 2])),
        [distance, width, height, columns, rows] => Ok(Screen::below(distance, [width, height], [columns as usize, rows as usize])),
        _ => Err(setting("screen", format!("{} numbers were found, expected 3 or 5", numbers.len()))),
    }
}

fn run(py: Python<'_>, scene: &Description, options: &Options, told: Option<&Py<PyAny>>) -> PyResult<gonio::goniometer::Reading> {
    let ask = |py: Python<'_>, now: Option<&Progress>| tell_rays(py, told, now);
    watched(py, ask, |stop, progress| measure(scene, options, Execution::detect(), stop, progress))
}
