//! A render as an iterator of tiles.

use crate::{
    bake::BakedPlaces,
    error::{exception, told},
    film::Film,
    memory::{self, Keeper},
    scene::Scene,
};
use crossbeam_channel::RecvTimeoutError;
use gonio::{
    checkpoint::{Checkpoint, Identity, write_checkpoint},
    compile::{CompiledScene, TreesAhead, compile_ahead},
    render,
};
use gonio_simd::Execution;
use pyo3::{exceptions::PyRuntimeError, prelude::*, types::PyDict};
use std::{
    path::{Path, PathBuf},
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
    },
    thread::Builder,
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
    description: gonio::scene::Scene,
    /// What checkpoints say they are of, once one was asked for.
    identity: OnceLock<Identity>,
    /// Whether its pixels lie on surfaces.
    bakes: bool,
}

impl Render {
    /// The compiled scene, while the render is open.
    pub(crate) fn compiled(&self) -> Option<Arc<CompiledScene>> {
        self.compiled.clone()
    }
    /// Runs `start` on a thread of its own, and looks at signals and `cancelled` until it is through.
    fn started(
        py: Python<'_>,
        scene: &Scene,
        cancelled: Option<&Bound<'_, PyAny>>,
        bakes: bool,
        start: impl FnOnce(&AtomicBool) -> Started + Send + 'static,
    ) -> PyResult<Self> {
        let description = scene.scene.clone();
        let stop = Arc::new(AtomicBool::new(false));
        let (send, started) = crossbeam_channel::bounded(1);
        let asked = stop.clone();
        // A thread that panics drops its sender, which the loop below finds out.
        Builder::new()
            .spawn(move || send.send(start(&asked)))
            .map_err(|error| PyRuntimeError::new_err(format!("the system gives no thread: {error}")))?;
        let wanted_no_more = || -> PyResult<bool> {
            py.check_signals()?;
            cancelled.map_or(Ok(false), |cancelled| cancelled.call0()?.is_truthy())
        };
        loop {
            match py.detach(|| started.recv_timeout(COMPILE_POLL)) {
                Ok(result) => {
                    let (running, exposure, compiled) = result.map_err(exception)?;
                    let (running, compiled) = (Some(running), Some(compiled));
                    return Ok(Self { running, exposure, compiled, description, identity: OnceLock::new(), bakes });
                }
                Err(RecvTimeoutError::Disconnected) => return Err(PyRuntimeError::new_err("compiling the scene broke off")),
                Err(RecvTimeoutError::Timeout) => {
                    let outcome = wanted_no_more();
                    if !matches!(outcome, Ok(false)) {
                        stop.store(true, Ordering::Relaxed);
                        outcome?;
                        return Err(exception(gonio::Error::Cancelled));
                    }
                }
            }
        }
    }
    fn running(&self) -> PyResult<&render::Render> {
        let running = self.running.as_ref().ok_or_else(|| PyRuntimeError::new_err("the render has been closed"))?;
        if !running.is_of_this_process() {
            let problem = "this render goes on in the process that started it; a process split off from that (fork) has to start its own";
            return Err(PyRuntimeError::new_err(problem));
        }
        Ok(running)
    }
}

/// Time between two looks at whether a compilation is still wanted.
const COMPILE_POLL: Duration = Duration::from_millis(50);

/// What a thread starts: the workers, the camera's exposure, and what was compiled.
type Started = gonio::Result<(render::Render, f32, Arc<CompiledScene>)>;

/// Compiles and starts baking.
fn start_baking(
    scene: &gonio::scene::Scene,
    before: Option<&CompiledScene>,
    ahead: TreesAhead,
    places: &BakedPlaces,
    stop: &AtomicBool,
) -> Started {
    let compiled = Arc::new(compile_ahead(scene, before, ahead, stop)?);
    let render = gonio::bake::bake(scene, compiled.clone(), &places.target, &scene.settings, Execution::detect())?;
    Ok((render, 1.0, compiled))
}

/// Compiles and starts; gives the camera's exposure too.
fn start(
    scene: &gonio::scene::Scene,
    before: Option<&CompiledScene>,
    ahead: TreesAhead,
    resume: Option<&Path>,
    stop: &AtomicBool,
) -> Started {
    let (settings, execution) = (&scene.settings, Execution::detect());
    let exposure = scene.cameras.get(settings.camera as usize).map_or(1.0, |camera| camera.exposure.0);
    let film = resume.map(|path| Checkpoint::resume(path, &Identity::new(scene, execution, Vec::new()))).transpose()?;
    // Not between the steps of somebody who edits a scene, for it takes as long as there are pieces of memory.
    if before.is_none() {
        memory::give_back();
    }
    let compiled = {
        let _memory = Keeper::new();
        Arc::new(compile_ahead(scene, before, ahead, stop)?)
    };
    if before.is_none() {
        memory::give_back();
    }
    let render = match film {
        Some(film) => render::Render::resume(compiled.clone(), settings, execution, film)?,
        None => render::Render::start(compiled.clone(), settings, execution)?,
    };
    Ok((render, exposure, compiled))
}

#[pymethods]
impl Render {
    /// Compiles the scene as it is now and starts the workers; `previous` lends the trees and images of what did not change. `resume` is a
    /// checkpoint of the same scene and settings to go on from.
    ///
    /// While it compiles, signals are looked at and `cancelled`, a function that says whether to stop, is asked every 50 ms.
    #[new]
    #[pyo3(signature = (scene, previous = None, *, cancelled = None, resume = None))]
    fn new(
        py: Python<'_>,
        scene: &Scene,
        previous: Option<&Self>,
        cancelled: Option<&Bound<'_, PyAny>>,
        resume: Option<PathBuf>,
    ) -> PyResult<Self> {
        let (description, before, ahead) = (scene.scene.clone(), previous.and_then(Self::compiled), scene.trees_ahead());
        let start = move |stop: &AtomicBool| start(&description, before.as_deref(), ahead, resume.as_deref(), stop);
        Self::started(py, scene, cancelled, false, start)
    }
    /// Bakes: a render whose pixels lie on an instance in place of a camera's view; the film's passes are textures. The scene's settings tell
    /// samples and passes, not the size.
    ///
    /// `instance` is the number of the element that `put_instances` gave, `placement` that of its transform. `triangles` (height, width), int32, is
    /// the triangle of each pixel, negative where nothing lies, rows from the top; `places` (height, width, 2) are the barycentric coordinates of
    /// corners 1 and 2 in the middle of each pixel. `steps` (height, width, 4), how both change to the next column and to the next row, spreads
    /// samples over the pixel. `view` is "above" or "camera". The rest as for `Render(scene)`.
    #[staticmethod]
    #[pyo3(signature = (scene, *, instance, triangles, places, steps = None, placement = 0, view = "above", previous = None, cancelled = None))]
    #[expect(clippy::too_many_arguments, reason = "keyword arguments")]
    fn bake(
        py: Python<'_>,
        scene: &Scene,
        instance: u32,
        triangles: &Bound<'_, PyAny>,
        places: &Bound<'_, PyAny>,
        steps: Option<&Bound<'_, PyAny>>,
        placement: u32,
        view: &str,
        previous: Option<&Self>,
        cancelled: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let places = BakedPlaces::new([instance, placement], triangles, places, steps, view)?;
        let (description, before, ahead) = (scene.scene.clone(), previous.and_then(Self::compiled), scene.trees_ahead());
        let start = move |stop: &AtomicBool| start_baking(&description, before.as_deref(), ahead, &places, stop);
        Self::started(py, scene, cancelled, true, start)
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
            // Asked before, so that nothing can come after the last look.
            let finished = running.is_finished();
            let wait = if finished { Duration::ZERO } else { Duration::from_millis(50) };
            let ready = py.detach(|| running.next_tile(wait));
            if let Some(ready) = ready {
                let area = running.film().tile_area(ready.tile);
                let [width, height] = [0, 1].map(|axis| area.max[axis] - area.min[axis]);
                return Ok(Some(Tile { x: area.min[0], y: area.min[1], width, height, samples: ready.samples }));
            }
            if finished {
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
        told(self.compiled.iter().flat_map(|compiled| &compiled.diagnostics))
    }
    /// What path guiding has learned and whether it is followed, in words; None where guiding is off, or before.
    #[getter]
    fn guiding(&self) -> PyResult<Option<String>> {
        Ok(self.running()?.guiding().map(str::to_owned))
    }
    /// What textures within a memory limit took and read so far, bytes and counts; None where all are in memory.
    #[getter]
    fn texture_statistics<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(found) = self.compiled.as_ref().and_then(|compiled| compiled.tables.textures.statistics()) else { return Ok(None) };
        let statistics = PyDict::new(py);
        let numbers = [
            ("limit", found.limit),
            ("used", found.used),
            ("most", found.most),
            ("total", found.total),
            ("lookups", found.lookups),
            ("tiles_read", found.tiles_read),
            ("bytes_read", found.bytes_read),
            ("evicted", found.evicted),
        ];
        for (name, number) in numbers {
            statistics.set_item(name, number)?;
        }
        statistics.set_item("hit_rate", found.hit_rate())?;
        statistics.set_item("notes", found.notes)?;
        Ok(Some(statistics))
    }
    /// The film so far.
    fn film(&self, py: Python<'_>) -> PyResult<Film> {
        let running = self.running()?;
        Ok(Film::new(py.detach(|| running.film().develop()), self.exposure))
    }
    /// Keeps the sums so far in a file, whole or not at all; `Render(scene, resume=path)` goes on with them, `merge` joins the files of ranges.
    fn checkpoint(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        let running = self.running()?;
        if self.bakes {
            return Err(PyRuntimeError::new_err("what is baked has no checkpoints"));
        }
        let written = py.detach(|| {
            let identity = self.identity.get_or_init(|| Identity::new(&self.description, Execution::detect(), Vec::new()));
            write_checkpoint(&path, identity, running.film())
        });
        written.map_err(exception)
    }
}

/// The film of a whole render from the checkpoints of its parts (see `Scene.parts`), given in any order.
#[pyfunction]
pub(crate) fn merge(py: Python<'_>, paths: Vec<PathBuf>) -> PyResult<Film> {
    let merged = py.detach(|| {
        let whole = gonio::checkpoint::merge(&paths)?;
        Ok((whole.film.develop(), whole.identity.exposure))
    });
    merged.map(|(image, exposure)| Film::new(image, exposure)).map_err(exception)
}
