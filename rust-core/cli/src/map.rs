//! `gonio map`.

use super::{
    arguments::{MapArguments, ScaleArguments},
    daylight, falsecolor,
    file::{check_ending, check_targets, ending, print_path, put, write_or_keep},
    interrupt::goes_on,
    measure::colour_json,
    messages::diagnostics_json,
    messages::print,
    messages::say,
    messages::tell,
    progress::Reporter,
    render::stage_options,
    share::share,
    stage::{Stage, light_model},
};
use gonio::{
    Diagnostic, Error, Result,
    compile::compile,
    light_paths::Watch,
    map::{
        IlluminationMaps, Looks, MapOptions, Quantity, SurfaceMap, TexelSize, divided_meshes, illumination_maps, map_layer, most_batches,
        view, write_map_exr,
    },
    measure::MOST_BOUNCES,
    output::{FalseColour, FalseColourScale},
    scene::Scene,
    transport::LIGHT_BATCH,
};
use gonio_simd::Execution;
use gonio_usd::{
    Loaded, SampleTime, camera,
    view::{Resolution, ViewOptions, complete},
};
use pyo3::prelude::*;
use serde_json::{Value, json};
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
    sync::atomic::AtomicBool,
    time::Instant,
};

/// Rays along the side of a pixel of a view.
const VIEW_SIDE: u32 = 3;

/// Traces maps and writes what was asked for.
pub(super) fn map(py: Python<'_>, options: &MapArguments, interrupted: &'static AtomicBool) -> Result<i32> {
    options.output.iter().try_for_each(|path| check_ending("output", path, &["exr", "usda", "png"]))?;
    let quantity = Quantity::by_name(&options.quantity)?;
    let wanted = wanted(options, quantity)?;
    if options.uv.is_none() && options.output.iter().any(|path| ending(path) == "exr") {
        return Err(Error::setting("output", "a texture wants texture coordinates: --uv st"));
    }
    check_targets(&options.output)?;
    let mut stage_options = stage_options(&options.stage)?;
    stage_options.time = options.frame.map_or(SampleTime::Start, SampleTime::Code);
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    for path in &options.output {
        if stage.is_made_of(py, path)? {
            let problem = format!("{} is a layer of the stage that is measured; write the map beside it", path.display());
            return Err(Error::setting("output", problem));
        }
    }
    let loaded = stage.load(py, &stage_options, interrupted)?;
    py.detach(|| run(options, &wanted, quantity, loaded, &stage, interrupted))
}

fn run(
    options: &MapArguments,
    wanted: &MapOptions,
    quantity: Quantity,
    mut loaded: Loaded,
    stage: &Stage,
    interrupted: &'static AtomicBool,
) -> Result<i32> {
    daylight::add(&options.daylight, &mut loaded, options.stage.strict, options.quiet)?;
    light_model(&options.stage.stage, &mut loaded, options.quiet);
    let camera = ViewOptions {
        camera: options.view.clone(),
        resolution: options.image_width.map_or(Resolution::Stage, Resolution::Width),
        camera_light: false,
        ..ViewOptions::default()
    };
    let primary = Python::attach(|py| camera::primary_camera_name(py, loaded.scene.cameras.len()));
    complete(&mut loaded, &primary, &camera)?;
    options.work.apply(&mut loaded.scene.settings);
    options.textures.apply(&mut loaded.scene.settings);
    tell(&options.stage, options.quiet, &loaded.diagnostics);
    let scene = &loaded.scene;
    let compiled = compile(scene, None, interrupted)?;
    let start = Instant::now();
    let maps = traced(options, wanted, scene, &compiled, interrupted)?;
    let seconds = start.elapsed().as_secs_f64();
    tell(&options.stage, options.quiet, &compiled.diagnostics);
    tell(&options.stage, options.quiet, &maps.diagnostics);
    let written = write(options, scene, &maps, stage)?;
    for path in options.output.iter().filter(|path| ending(path) == "png") {
        let (values, size) =
            view(&maps, &compiled, &scene.settings, quantity, Looks { side: VIEW_SIDE, smooth: true }, Execution::detect())?;
        let ScaleArguments { max, steps, log } = options.scale;
        let scale = FalseColourScale::of_values(&values, max, steps, log, quantity.is_of_colour())?;
        let style = FalseColour { scale, unit: quantity.unit().into(), contours: false, smoothing: 0, legend: true };
        falsecolor::write(path, &style.draw(&values, size))?;
    }
    if options.json {
        let before: Vec<Diagnostic> = loaded.diagnostics.iter().chain(&compiled.diagnostics).cloned().collect();
        print(&as_json(&maps, seconds, &before).to_string());
    } else {
        as_text(&maps, seconds).iter().for_each(|line| print(line));
        written.iter().chain(options.output.iter().filter(|path| ending(path) == "png")).for_each(|path| print_path(path));
    }
    Ok(0)
}

fn traced(
    options: &MapArguments,
    wanted: &MapOptions,
    scene: &Scene,
    compiled: &gonio::compile::CompiledScene,
    interrupted: &AtomicBool,
) -> Result<IlluminationMaps> {
    let mut reporter = Reporter::new(options.quiet);
    let batches = most_batches(scene, wanted) as f64;
    let start = Instant::now();
    let mut progress = |done: u64| {
        let paths = (done * LIGHT_BATCH as u64) as f64;
        let speed = paths * 1e-6 / start.elapsed().as_secs_f64().max(1e-3);
        let fraction = done as f64 / batches;
        let left = (done > 0).then(|| start.elapsed().mul_f64((1.0 - fraction).max(0.0) / fraction));
        reporter.tell(fraction, &format!("{:.1} million paths at most", paths * 1e-6), left, &format!("{speed:.2} million a second"));
        goes_on(interrupted)
    };
    let found =
        illumination_maps(scene, compiled, wanted, Execution::detect(), &mut Watch { cancel: interrupted, progress: &mut progress });
    reporter.clear();
    found
}

/// What the options ask for.
fn wanted(options: &MapArguments, quantity: Quantity) -> Result<MapOptions> {
    let texel = match (options.texel, options.resolution.as_deref()) {
        (Some(metres), _) => TexelSize::Metres(metres),
        (None, Some([width, height])) => TexelSize::Resolution([*width, *height]),
        _ => TexelSize::Automatic,
    };
    Ok(MapOptions {
        prims: options.prim.clone(),
        uv: options.uv.clone(),
        texel,
        error: share("error", &options.error)?,
        paths: options.paths,
        time_limit_s: options.time_limit,
        colours: options.colours,
        figures: options.figures || matches!(quantity, Quantity::Figure(_)),
        memory: options.memory,
        max_bounces: options.max_bounces.unwrap_or(MOST_BOUNCES),
    })
}

/// Writes textures and layers; gives their paths.
fn write(options: &MapArguments, scene: &Scene, maps: &IlluminationMaps, stage: &Stage) -> Result<Vec<PathBuf>> {
    let asked = |kind: &'static str| options.output.iter().filter(move |path| ending(path) == kind);
    let mut written = Vec::new();
    // A layer that names textures wants them beside it.
    let beside = |path: &PathBuf| path.with_extension("exr");
    let textures: Vec<PathBuf> = match options.uv {
        Some(_) if asked("exr").next().is_none() => asked("usda").take(1).map(beside).collect(),
        _ => asked("exr").cloned().collect(),
    };
    let mut names = HashMap::new();
    for path in &textures {
        for (number, map) in maps.surfaces.iter().enumerate() {
            let path = if maps.surfaces.len() == 1 { path.clone() } else { named(path, map, number) };
            write_or_keep(&path, |path| write_map_exr(path, map))?;
            names.insert(number, path.clone());
            written.push(path);
        }
    }
    for path in asked("usda") {
        let asset = |texture: &PathBuf| asset(path, texture);
        let names = names.iter().map(|(number, texture)| (*number, asset(texture))).collect();
        let faces = |prim: &str| Python::attach(|py| stage.faces(py, prim, options.frame));
        let (mut text, count) = map_layer(scene, maps, &faces, &names);
        if count < maps.surfaces.len() {
            let rest = maps.surfaces.len() - count;
            say(&format!(
                "{}: {rest} of {} surfaces are no meshes of their own, or are placed several times; left out",
                path.display(),
                maps.surfaces.len()
            ));
        }
        if options.divided {
            text.push_str(&divided_meshes(scene, maps, stage.info().metres_per_unit)?);
        }
        put(path, text.as_bytes())?;
        written.push(path.clone());
    }
    Ok(written)
}

/// A texture as a layer names it: by its file's name where it lies beside it.
fn asset(layer: &Path, texture: &Path) -> String {
    match (layer.parent() == texture.parent(), texture.file_name()) {
        (true, Some(name)) => format!("./{}", name.to_string_lossy()),
        _ => texture.to_string_lossy().into_owned(),
    }
}

fn named(path: &Path, map: &SurfaceMap, number: usize) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let prim = map.surface.origin.name.rsplit('/').next().unwrap_or_default();
    path.with_file_name(format!("{stem}.{number}-{prim}.exr"))
}

/// The sides that get light: their surface, front or back, and their numbers.
fn lit(maps: &IlluminationMaps) -> impl Iterator<Item = (&SurfaceMap, usize)> {
    maps.surfaces.iter().flat_map(|map| [0, 1].map(|side| (map, side))).filter(|(map, side)| map.sides[*side].is_some())
}

const SIDES: [&str; 2] = ["front", "back"];

/// Surfaces of which a line is written.
const MOST_LINES: usize = 40;

fn as_text(maps: &IlluminationMaps, seconds: f64) -> Vec<String> {
    let mut lines = vec![format!(
        "{:.1} million light paths of {:.1} lm in {seconds:.1} s; error {:.2} %, averaged over the lit area; {} MiB",
        maps.paths as f64 * 1e-6,
        maps.emitted,
        100.0 * maps.error,
        maps.memory.div_ceil(1 << 20)
    )];
    if maps.cut_off > 0.0 {
        lines.push(format!("{:.3} lm were cut off by the most bounces", maps.cut_off));
    }
    let line = |(map, side): (&SurfaceMap, usize)| {
        let summary = &map.summaries[side];
        let [least, most] = summary.extremes;
        format!(
            "{} {}: {:.2} lx (direct {:.2}), {least:.2} to {most:.2}, {:.3} m², {:.2} lm ± {:.2}",
            map.surface.origin,
            SIDES[side],
            summary.mean(),
            summary.direct / summary.area,
            summary.area,
            summary.flux,
            summary.standard_error
        )
    };
    let line = |lit: (&SurfaceMap, usize)| {
        let colour = lit.0.summaries[lit.1].colour.as_ref().map_or(String::new(), |colour| format!("; in all {}", colour.note()));
        line(lit) + &colour
    };
    lines.extend(lit(maps).take(MOST_LINES).map(line));
    let rest = lit(maps).count().saturating_sub(MOST_LINES);
    if rest > 0 {
        lines.push(format!("and {rest} more; --json lists them all"));
    }
    lines
}

fn as_json(maps: &IlluminationMaps, seconds: f64, of_stage: &[Diagnostic]) -> Value {
    let side = |(map, side): (&SurfaceMap, usize)| {
        let summary = &map.summaries[side];
        json!({
            "name": &*map.surface.origin.name,
            "placement": map.surface.placement[0],
            "side": SIDES[side],
            "area_m2": summary.area,
            "flux_lm": summary.flux,
            "direct_lm": summary.direct,
            "standard_error_lm": summary.standard_error,
            "mean_lx": summary.mean(),
            "least_lx": summary.extremes[0],
            "greatest_lx": summary.extremes[1],
            "parts": map.chart.len(),
            "colour": summary.colour.as_ref().map(|colour| colour_json(colour)),
        })
    };
    json!({
        "paths": maps.paths,
        "seconds": seconds,
        "error": maps.error,
        "emitted_lm": maps.emitted,
        "cut_off_lm": maps.cut_off,
        "memory_bytes": maps.memory,
        "surfaces": lit(maps).map(side).collect::<Vec<_>>(),
        "diagnostics": diagnostics_json(of_stage.iter().chain(&maps.diagnostics)),
    })
}
