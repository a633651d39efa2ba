//! `gonio view`: the window is the Python side's (`gonio.view`); what it shows of a stage is read here, in a process of its own.

use super::{
    arguments::{Arguments, Command, ShowArgument, ViewOptions},
    daylight,
    interrupt::INTERRUPTED,
    render::stage_options,
    stage::{Stage, is_model},
};
use clap::Parser;
use gonio::{Error, Result, Severity, compile::Bounds, output::ToneMap};
use gonio_usd::{Loaded, SampleTime, StageOptions, camera, context::UpAxis, framing::camera_light_of, view, view::complete};
use pyo3::{prelude::*, types::PyDict};
use serde_json::{Value, json};
use std::path::Path;

/// A stage as a window wants it.
#[derive(Debug)]
pub struct Viewed {
    /// The scene, with a camera and light.
    pub loaded: Loaded,
    /// What the window has to know of it, as JSON: axes, times, cameras, names of placements, messages.
    pub about: String,
}

/// The stage that `gonio view` with these words, the program's name first, would show at a frame; relative paths start at `folder`.
///
/// # Errors
/// The words are not understood, or as [`load_stage`] and [`complete`].
pub fn view_scene(py: Python<'_>, words: &[String], folder: &Path, frame: Option<f64>) -> Result<Viewed> {
    let parsed = Arguments::try_parse_from(words).map_err(|error| Error::setting("arguments", error.to_string()))?;
    let Command::View(mut options) = parsed.command else {
        return Err(Error::setting("arguments", "expected those of gonio view"));
    };
    options.inputs().for_each(|path| *path = folder.join(&*path));
    let time = frame.or(options.frame).map_or(SampleTime::Start, SampleTime::Code);
    let stage_options = StageOptions { time, camera: options.camera.clone(), ..stage_options(&options.stage)? };
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    let mut loaded = stage.load(py, &stage_options, &INTERRUPTED)?;
    daylight::add(&options.daylight, &mut loaded, options.stage.strict, true)?;
    // The window cuts no part out of the view and has passes of its own.
    let wanted = view::ViewOptions {
        camera: options.camera.clone(),
        camera_light: !options.disable_camera_light,
        headlight: if is_model(&options.stage.stage) { view::Headlight::Dome } else { view::Headlight::Camera },
        data_window: false,
        ..view::ViewOptions::default()
    };
    let primary = camera::primary_camera_name(py, loaded.scene.cameras.len());
    let notes = complete(&mut loaded, &primary, &wanted)?;
    loaded.diagnostics.extend(notes);
    options.work.apply(&mut loaded.scene.settings);
    options.textures.apply(&mut loaded.scene.settings);
    let mut about = about(&loaded, time);
    about["inputs"] = options.inputs().map(|path| json!(path.to_string_lossy())).collect();
    Ok(Viewed { loaded, about: about.to_string() })
}

/// What the window has to know.
fn about(loaded: &Loaded, time: SampleTime) -> Value {
    let (scene, info) = (&loaded.scene, &loaded.info);
    let bounds = Bounds::of_scene(scene);
    let frame = match time {
        SampleTime::Code(code) => Some(code),
        _ => info.time_range.map(|[first, _]| first),
    };
    json!({
        "up": if info.up_axis == UpAxis::Z { "Z" } else { "Y" },
        "frame": frame,
        "frames": info.time_range,
        "frames_per_second": info.time_codes_per_second,
        "bounds": if bounds.is_empty() { Value::Null } else { json!([bounds.min, bounds.max]) },
        "resolution": scene.settings.resolution,
        "pixel_aspect": scene.settings.pixel_aspect,
        "camera": scene.settings.camera,
        "cameras": scene.cameras,
        // It goes along with the view.
        "headlight": camera_light_of(scene).map(|number| json!([number, scene.lights[number]])),
        "placements": scene.instances.iter().map(|set| json!([&*set.origin.name, set.transforms.len()])).collect::<Vec<_>>(),
        "messages": loaded.diagnostics.iter().map(|d| json!([d.severity == Severity::Warning, d.to_string()])).collect::<Vec<_>>(),
    })
}

/// Opens the window; gives the exit status once it is closed. `words` are the command line.
pub(super) fn view(py: Python<'_>, options: &ViewOptions, words: &[String]) -> Result<i32> {
    options.tonemap.as_deref().map(ToneMap::by_name).transpose()?;
    let folder = std::env::current_dir().map_err(|error| Error::io(Path::new("."), error))?;
    let window = || -> PyResult<i32> { py.import("gonio.view")?.call_method1("run", (words, folder, choices(py, options)?))?.extract() };
    window().map_err(|error| Error::setting("view", error.value(py).to_string()))
}

/// What the window begins with.
fn choices<'py>(py: Python<'py>, options: &ViewOptions) -> PyResult<Bound<'py, PyDict>> {
    let show = match options.show {
        ShowArgument::Picture => "picture",
        ShowArgument::Luminance => "luminance",
        ShowArgument::Illuminance => "illuminance",
    };
    let choices = PyDict::new(py);
    choices.set_item("stage", &options.stage.stage)?;
    choices.set_item("resolution", options.res.as_deref().map(|res| (res[0], res[1])))?;
    choices.set_item("samples", options.spp)?;
    choices.set_item("show", show)?;
    choices.set_item("exposure", options.exposure)?;
    choices.set_item("tonemap", options.tonemap.as_deref())?;
    choices.set_item("scale_max", options.scale.max)?;
    choices.set_item("scale_steps", options.scale.steps)?;
    choices.set_item("scale_log", options.scale.log)?;
    choices.set_item("screenshot", options.screenshot.as_deref())?;
    choices.set_item("after", options.after)?;
    Ok(choices)
}
