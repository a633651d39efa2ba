//! Measuring the BSDF of made-up samples.

use crate::{
    array::Array,
    error::{exception, setting, told},
    measured::MeasuredBsdf,
    scene::Scene,
    table,
    watched::{tell_rays, watched},
};
use gonio::{
    Diagnostic, Error,
    output::write_atomically,
    sample_bsdf::{Options, Orientation, Progress, Side, Stop, Window, measure},
    scene::Scene as Description,
};
use gonio_formats::bsdf::{Basis, Hemispheres, Measured, xml};
use gonio_simd::Execution;
use gonio_usd::{SampleTime, Stage, StageOptions};
use pyo3::prelude::*;
use std::{io::Write, path::PathBuf, sync::atomic::AtomicBool, time::Duration};

/// A made-up sample's scattering between patches of directions. Sides are named as for `MeasuredBsdf`: the word is the side light comes from.
#[pyclass(frozen, module = "gonio")]
pub(crate) struct SampleReading {
    reading: gonio::sample_bsdf::SampleReading,
    diagnostics: Vec<Diagnostic>,
}

#[pymethods]
impl SampleReading {
    /// Shares of the light from each incident patch (rows) that leave into each outgoing one: luminance.
    fn shares(&self, side: &str) -> PyResult<Array> {
        let (side, reflection) = self.side(side)?;
        let found = if reflection { &side.reflected } else { &side.transmitted };
        Ok(self.rows(found.iter().map(|rgb| gonio::colour::luminance(*rgb)).collect()))
    }
    /// Their standard errors.
    fn standard_errors(&self, side: &str) -> PyResult<Array> {
        let (side, reflection) = self.side(side)?;
        Ok(self.rows(if reflection { side.reflected_errors.clone() } else { side.transmitted_errors.clone() }))
    }
    /// Shares of the light from each incident patch that leave at all.
    fn totals(&self, side: &str) -> PyResult<Array> {
        let (side, reflection) = self.side(side)?;
        let total = |from: &gonio::sample_bsdf::FromPatch| if reflection { from.reflected.value } else { from.transmitted.value };
        Ok(Array::flat(side.from.iter().map(total).collect()))
    }
    /// Shares of the light from each patch of "front" or "back" that leave sideways, beyond the sample, and are counted nowhere.
    fn lost(&self, side: &str) -> PyResult<Array> {
        let side = match side {
            "front" | "back" => self.came_from(side == "front")?,
            _ => return Err(setting("side", format!("'{side}' was found, expected front or back"))),
        };
        Ok(Array::flat(side.from.iter().map(|from| from.lost.value).collect()))
    }
    /// The measured material.
    fn bsdf(&self) -> PyResult<MeasuredBsdf> {
        let patches = self.reading.patches().map_err(exception)?;
        Ok(MeasuredBsdf::of(Measured::Patches(patches)))
    }
    /// Writes BSDF XML, which Radiance and WINDOW read.
    #[pyo3(signature = (path, *, name = "sample"))]
    fn write(&self, py: Python<'_>, path: PathBuf, name: &str) -> PyResult<()> {
        let written = py.detach(|| {
            let text = xml::write_patches(&self.reading.patches()?, name);
            write_atomically(&path, true, |file| file.write_all(text.as_bytes()))
        });
        written.map_err(exception)
    }
    /// Least and greatest x and y of the window, metres.
    #[getter]
    fn window(&self) -> ([f64; 2], [f64; 2]) {
        (self.reading.window.min, self.reading.window.max)
    }
    /// Rays that were traced.
    #[getter]
    fn rays(&self) -> u64 {
        self.reading.paths
    }
    /// Time that it took.
    #[getter]
    fn seconds(&self) -> f64 {
        self.reading.elapsed.as_secs_f64()
    }
    /// The relative error of the worst patch.
    #[getter]
    fn error(&self) -> f64 {
        self.reading.error()
    }
    /// Whether the error that was asked for was reached.
    #[getter]
    fn converged(&self) -> bool {
        self.reading.converged
    }
    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        told(&self.diagnostics)
    }
    fn __repr__(&self) -> String {
        format!("<gonio.SampleReading: {}, {:.1} M rays>", self.reading.basis.name, self.reading.paths as f64 * 1e-6)
    }
}

impl SampleReading {
    fn rows(&self, values: Vec<f64>) -> Array {
        Array::rows(values, self.reading.basis.count())
    }

    /// What came from a side, and whether what stays on it is meant.
    fn side(&self, name: &str) -> PyResult<(&Side, bool)> {
        let hemispheres: Hemispheres = table::side(name)?;
        Ok((self.came_from(hemispheres.is_from_front())?, hemispheres.is_reflection()))
    }

    fn came_from(&self, front: bool) -> PyResult<&Side> {
        let found = self.reading.sides.iter().find(|side| side.from_front == front);
        found.ok_or_else(|| setting("side", "light from that side was not measured"))
    }
}

/// Measures what light from every patch of directions becomes in a sample, as Radiance's genBSDF does: `source` is a scene that holds the sample and
/// nothing else, or a USD stage's path, of which `prim` may be the sample. Its front looks along `front`, which is z of the material, and `up`
/// is y.
///
/// window: least and greatest x and y along the material's axes, metres, that light falls on (without one all of the sample); repeat: how often the
/// sample is repeated on every side by the window's size; basis: "full", "half" or "quarter" (Klems); sides: "both", "front" or "back"; colour:
/// whether the material has colours; error: relative standard error of a patch's matrix values at which it stops, 0 for all `rays` of every patch;
/// time_limit: seconds; progress: as for `goniometer`.
#[pyfunction]
#[pyo3(signature = (source, *, prim = None, frame = None, front = [0.0, 0.0, 1.0], up = [0.0, 1.0, 0.0], window = None, repeat = 0, basis = "full", sides = "both", colour = false, error = 0.03, rays = 1 << 20, time_limit = None, seed = 0, threads = 0, progress = None))]
#[expect(clippy::too_many_arguments, reason = "keyword arguments")]
pub(crate) fn sample_bsdf(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    prim: Option<String>,
    frame: Option<f64>,
    front: [f64; 3],
    up: [f64; 3],
    window: Option<([f64; 2], [f64; 2])>,
    repeat: u32,
    basis: &str,
    sides: &str,
    colour: bool,
    error: f64,
    rays: u64,
    time_limit: Option<f64>,
    seed: u32,
    threads: u32,
    progress: Option<Py<PyAny>>,
) -> PyResult<SampleReading> {
    let time = time_limit.map(Duration::try_from_secs_f64).transpose().map_err(|_| setting("time_limit", "expected seconds"))?;
    let options = Options {
        orientation: Orientation { front, up },
        window: window.map(|(min, max)| Window { min, max }),
        repeats: repeat,
        basis: basis_of(basis)?,
        sides: match sides {
            "both" => [true, true],
            "front" => [true, false],
            "back" => [false, true],
            _ => return Err(setting("sides", format!("'{sides}' was found, expected both, front or back"))),
        },
        colour,
        stop: Stop { error, rays, time },
        seed,
        threads,
    };
    let (scene, mut diagnostics) = read(py, source, prim, frame)?;
    let reading = run(py, &scene, &options, progress.as_ref())?;
    diagnostics.extend(reading.diagnostics.iter().cloned());
    Ok(SampleReading { reading, diagnostics })
}

fn basis_of(name: &str) -> PyResult<Basis> {
    let known = ["full", "half", "quarter"].contains(&name).then(|| Basis::known(&format!("LBNL/Klems {name}"))).flatten();
    known.ok_or_else(|| setting("basis", format!("'{name}' was found, expected full, half or quarter")))
}

/// The sample's scene, and what is not as asked for.
fn read(py: Python<'_>, source: &Bound<'_, PyAny>, prim: Option<String>, frame: Option<f64>) -> PyResult<(Description, Vec<Diagnostic>)> {
    if let Ok(scene) = source.cast::<Scene>() {
        if prim.is_some() || frame.is_some() {
            return Err(setting("prim", "a scene is the sample as a whole; prims and frames are those of stages"));
        }
        return Ok((scene.borrow().scene.clone(), Vec::new()));
    }
    let path = source.extract::<PathBuf>()?;
    let time = frame.map_or(SampleTime::Start, SampleTime::Code);
    let options = StageOptions { time, subtree: prim, ..StageOptions::default() };
    let loaded = Stage::open(py, &path, &options).and_then(|stage| stage.load(py, &options, &AtomicBool::new(false)));
    loaded.map(|loaded| (loaded.scene, loaded.diagnostics)).map_err(|error: Error| exception(error))
}

fn run(py: Python<'_>, scene: &Description, options: &Options, told: Option<&Py<PyAny>>) -> PyResult<gonio::sample_bsdf::SampleReading> {
    let ask = |py: Python<'_>, now: Option<&Progress>| tell_rays(py, told, now);
    watched(py, ask, |stop, progress| measure(scene, options, Execution::detect(), stop, progress))
}
