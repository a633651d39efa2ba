//! `gonio render --dask`: the cluster and its workers are the Python side's (`gonio.farm`), the pictures are put together here. `gonio annual --dask` has
//! the same cluster.

use super::{
    arguments::{Arguments, Command, RenderOptions},
    denoise::Denoiser,
    file::check_targets,
    file_name,
    interrupt::INTERRUPTED,
    messages::tell,
    output::{Notes, Writer},
    products::{gamut_of, half_layers},
    progress::Reporter,
    render::{attributes, complete_scene, files_of, frames_of, name_layers, sample_time, shows_motion, stage_options, write_cropped},
    stage::Stage,
};
use clap::Parser;
use gonio::{
    Error, Result,
    checkpoint::{merge, parts},
};
use gonio_simd::Execution;
use gonio_usd::{Loaded, StageOptions, framing::is_camera_lit};
use pyo3::{
    prelude::*,
    types::{PyCFunction, PyDict, PyTuple},
};
use std::{
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError, atomic::Ordering},
    time::Duration,
};

/// What `gonio render` with these words, the program's name first, would trace at a frame; relative paths start at `folder`.
pub fn farm_scene(py: Python<'_>, words: &[String], folder: &Path, frame: Option<f64>) -> Result<Loaded> {
    let parsed = Arguments::try_parse_from(words).map_err(|error| Error::setting("arguments", error.to_string()))?;
    let Command::Render(mut options) = parsed.command else {
        return Err(Error::setting("arguments", "expected those of gonio render"));
    };
    options.inputs().for_each(|path| *path = folder.join(&*path));
    options.settle();
    // The notes are the coordinator's to tell.
    options.quiet = true;
    let mut loaded = load(py, &open(py, &options)?, &options, frame)?;
    if options.files.denoise {
        Denoiser::ask_for_guides(&mut loaded.scene.settings);
    }
    Ok(loaded)
}

/// Renders all frames asked for on a cluster; `words` are the command line.
pub(super) fn render(py: Python<'_>, options: &mut RenderOptions, words: &[String]) -> Result<i32> {
    if options.files.output.is_empty() && options.files.deep.is_none() {
        return Err(Error::setting("output", "no file was given; say -o picture.exr"));
    }
    let writer = Writer::new(&options.files, Execution::detect())?;
    let folder = std::env::current_dir().map_err(|error| Error::io(Path::new("."), error))?;
    let inputs: Vec<PathBuf> = options.inputs().map(|path| folder.join(&*path)).collect();
    let cluster = connect(py, options.farm.dask.as_deref()).map_err(|error| failure(py, &error))?;
    let stage = open(py, options)?;
    let frames = frames_of(options, stage.info().time_range.map(|[first, _]| first))?;
    check_targets(&files_of(options, &stage, frames[0])?)?;
    let first = load(py, &stage, options, frames[0])?;
    tell(&options.stage, options.quiet, &first.diagnostics);
    let count = options.farm.dask_parts.map_or_else(|| cluster.call_method1("parts_for", (frames.len(),))?.extract(), Ok);
    let parts = parts(&first.scene.settings, count.map_err(|error: PyErr| failure(py, &error))?)?;
    let parts: Vec<_> = parts.iter().map(|part| (part.tiles, part.samples)).collect();
    let started = || -> PyResult<_> {
        let stages = cluster.call_method1("stages", (words, folder, inputs, options.farm.dask_send, &frames))?;
        let report = PyCFunction::new_closure(py, None, None, reporting(options.quiet))?;
        cluster.call_method1("gather", (stages, parts, report))?.try_iter()
    };
    for (frame, files) in frames.iter().zip(started().map_err(|error| failure(py, &error))?) {
        let files: Vec<PathBuf> = files.and_then(|files| files.extract()).map_err(|error| failure(py, &error))?;
        let time = frame.unwrap_or(0.0) / stage.info().time_codes_per_second;
        py.detach(|| write(options, &writer, &files, &first, *frame, time))?;
    }
    Ok(0)
}

fn open(py: Python<'_>, options: &RenderOptions) -> Result<Stage> {
    let stage_options = StageOptions { camera: options.camera.clone(), ..stage_options(&options.stage)? };
    Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)
}

/// The stage at a frame with what the command line says.
fn load(py: Python<'_>, stage: &Stage, options: &RenderOptions, frame: Option<f64>) -> Result<Loaded> {
    let time = sample_time(options, frame);
    let mut loaded =
        stage.load(py, &StageOptions { time, motion_vectors: shows_motion(options), ..stage_options(&options.stage)? }, &INTERRUPTED)?;
    complete_scene(options, &mut loaded, None)?;
    Ok(loaded)
}

/// Joins the parts of a frame and writes its pictures; `time` is the frame's, seconds.
fn write(options: &RenderOptions, writer: &Writer, files: &[PathBuf], first: &Loaded, frame: Option<f64>, time: f64) -> Result<()> {
    let (whole, scene) = (merge(files)?, &first.scene);
    let mut image = whole.film.develop();
    let hidden = writer.ask_for_passes(&mut scene.settings.clone());
    writer.finish(&mut image)?;
    image.layers.retain(|layer| !hidden.contains(&layer.aov));
    let variables = first.settings.as_ref().map(|settings| settings.variables()).unwrap_or_default();
    name_layers(options, &mut image, &scene.settings, &variables);
    let notes = Notes {
        exposure: whole.identity.exposure,
        time,
        camera_lit: is_camera_lit(scene),
        interrupted: false,
        snapshot: false,
        half_layers: &half_layers(&variables),
        gamut: gamut_of(first),
        attributes: &attributes(options, scene),
    };
    let named = file_name::named_frame(frame, first.info.time_range, options.default_time);
    let of_frame = |path: &PathBuf| file_name::filled_in(path, named);
    let outputs: Vec<PathBuf> = options.files.output.iter().map(of_frame).collect::<Result<_>>()?;
    let deep = options.files.deep.as_ref().map(of_frame).transpose()?;
    let written = write_cropped(writer, &outputs, &image, &notes, options);
    let deep = deep.map_or(Ok(()), |path| writer.write_deep(&path, &image, &notes, options.quiet));
    written.and(deep)
}

/// `gonio.farm.Cluster`, which asks now and then whether Ctrl-C was pressed.
pub(super) fn connect<'py>(py: Python<'py>, address: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
    let cancelled = |_: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| INTERRUPTED.load(Ordering::Relaxed);
    let cancelled = PyCFunction::new_closure(py, None, None, cancelled)?;
    py.import("gonio.farm")?.call_method1("Cluster", (address, cancelled))
}

/// A function that shows how far the whole is: from 0 to 1, in words, seconds left if that can be told, what goes on.
pub(super) fn reporting(quiet: bool) -> impl Fn(&Bound<'_, PyTuple>, Option<&Bound<'_, PyDict>>) -> PyResult<()> + Send + 'static {
    let reporter = Mutex::new(Reporter::new(quiet));
    move |arguments, _| {
        let (fraction, done, left, under_way): (f64, String, Option<f64>, String) = arguments.extract()?;
        let left = left.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
        let mut reporter = reporter.lock().unwrap_or_else(PoisonError::into_inner);
        reporter.tell(fraction, &done, left, &under_way);
        if fraction >= 1.0 {
            reporter.clear();
        }
        Ok(())
    }
}

/// What the Python side complained about.
pub(super) fn failure(py: Python<'_>, error: &PyErr) -> Error {
    if INTERRUPTED.load(Ordering::Relaxed) { Error::Cancelled } else { Error::setting("dask", error.value(py).to_string()) }
}
