//! A render as an iterator of tiles.

use crate::{error::exception, film::Film, scene::Scene};
use gonio::{
    compile::{CompiledScene, compile},
    render,
};
use gonio_simd::Execution;
use pyo3::{exceptions::PyRuntimeError, prelude::*};
use std::{
    sync::{Arc, atomic::AtomicBool},
    time::{Duration, Instant},
};

/// A tile with new samples: its pixels are `[x, x + width)` by `[y, y + height)`, rows from the top.
#[pyclass(frozen, get_all, module = "gonio")]
pub(crate) struct Tile {
    /// First column.
    x: u32,
    /// First row, counted from the top.
    y: u32,
    /// Columns.
    width: u32,
    /// Rows.
    height: u32,
    /// Samples a pixel.
    samples: u32,
}

/// How far a render is.
#[pyclass(frozen, get_all, module = "gonio")]
pub(crate) struct Progress {
    /// 0 to 1.
    fraction: f64,
    /// Samples a pixel that every tile has.
    samples: u32,
    /// Seconds since the start.
    elapsed: f64,
    /// Estimated seconds to the end, None before there is anything to go by.
    remaining: Option<f64>,
    /// Rays traced.
    rays: u64,
}

/// A render under way. Iterate over it for tiles, then take the film; leaving its `with` block cancels it.
#[pyclass(module = "gonio")]
pub(crate) struct Render {
    running: Option<render::Render>,
    compiled: Option<Arc<CompiledScene>>,
    exposure: f32,
}

impl Render {
    fn running(&self) -> PyResult<&render::Render> {
        self.running.as_ref().ok_or_else(|| PyRuntimeError::new_err("the render has been closed"))
    }
}

#[pymethods]
impl Render {
    /// Compiles the scene as it is now and starts the workers; `previous` lends the trees and images of what did not change.
    #[new]
    #[pyo3(signature = (scene, previous = None))]
    fn new(py: Python<'_>, scene: &Scene, previous: Option<&Self>) -> PyResult<Self> {
        let description = scene.scene.clone();
        let before = previous.and_then(|render| render.compiled.clone());
        let started = py.detach(move || {
            let settings = description.settings.clone();
            let exposure = description.cameras.get(settings.camera as usize).map_or(1.0, |camera| camera.exposure.0);
            let compiled = Arc::new(compile(&description, before.as_deref(), &AtomicBool::new(false))?);
            render::Render::start(compiled.clone(), &settings, Execution::detect()).map(|render| (render, exposure, compiled))
        });
        let (running, exposure, compiled) = started.map_err(exception)?;
        Ok(Self { running: Some(running), exposure, compiled: Some(compiled) })
    }
    fn __enter__(slf: Py<Self>) -> Py<Self> {
        slf
    }
    #[pyo3(signature = (*_exception))]
    fn __exit__(&mut self, py: Python<'_>, _exception: &Bound<'_, pyo3::types::PyTuple>) {
        let closed = (self.running.take(), self.compiled.take());
        py.detach(move || drop(closed));
    }
    fn __iter__(slf: Py<Self>) -> Py<Self> {
        slf
    }
    /// The next tile with new samples; waits with the GIL released.
    fn __next__(&self, py: Python<'_>) -> PyResult<Option<Tile>> {
        loop {
            py.check_signals()?;
            let running = self.running()?;
            let ready = py.detach(|| running.next_tile(Duration::from_millis(50)));
            if let Some(ready) = ready {
                let area = running.film().tile_area(ready.tile);
                let [width, height] = [0, 1].map(|axis| area.max[axis] - area.min[axis]);
                return Ok(Some(Tile { x: area.min[0], y: area.min[1], width, height, samples: ready.samples }));
            }
            if running.is_finished() && py.detach(|| running.next_tile(Duration::ZERO)).is_none() {
                return Ok(None);
            }
        }
    }
    /// Waits for the end, at most `timeout` seconds; True when it has ended.
    #[pyo3(signature = (timeout = None))]
    fn wait(&mut self, py: Python<'_>, timeout: Option<f64>) -> PyResult<bool> {
        let start = Instant::now();
        while !self.running()?.is_finished() {
            py.check_signals()?;
            if timeout.is_some_and(|limit| start.elapsed().as_secs_f64() >= limit) {
                return Ok(false);
            }
            let running = self.running()?;
            // Tiles are not wanted here; taking them keeps the wait short.
            let _ = py.detach(|| running.next_tile(Duration::from_millis(20)));
        }
        match &mut self.running {
            Some(running) => py.detach(|| running.finish()).map(|()| true).map_err(exception),
            None => Ok(true),
        }
    }
    /// Asks the workers to stop.
    fn cancel(&self) -> PyResult<()> {
        self.running()?.cancel();
        Ok(())
    }
    /// How far it is.
    #[getter]
    fn progress(&self) -> PyResult<Progress> {
        let p = self.running()?.progress();
        let remaining = p.remaining.map(|time| time.as_secs_f64());
        Ok(Progress { fraction: p.fraction, samples: p.samples, elapsed: p.elapsed.as_secs_f64(), remaining, rays: p.rays })
    }
    /// What is not as asked for, as (origin, message).
    #[getter]
    fn diagnostics(&self) -> Vec<(String, String)> {
        let all = self.compiled.iter().flat_map(|compiled| &compiled.diagnostics);
        all.map(|d| (d.origin.to_string(), d.message.clone())).collect()
    }
    /// The film so far.
    fn film(&self, py: Python<'_>) -> PyResult<Film> {
        let running = self.running()?;
        Ok(Film::new(py.detach(|| running.film().develop()), self.exposure))
    }
}
