//! `gonio render`.

use super::{
    arguments::{ComplexityArgument, FilterArgument, HeadlightArgument, RenderOptions, StageArguments},
    autocrop, by_wavelength,
    checkpoint::{Keeper, sample_range, take_part},
    daylight, explain,
    file::check_targets,
    file_name, frames,
    messages::print,
    messages::say,
    messages::tell,
    output::{Notes, Writer},
    products::{Picture, Products, half_layers},
    progress::{Reporter, clock},
    sequence,
    snapshot::Snapshots,
    stage::{Stage, is_model},
};
use gonio::{
    Error, Result,
    checkpoint::Identity,
    compile::{CompiledScene, compile},
    film::{Film, Image, Layer},
    render::Render,
    scene::{AMBIENT_OCCLUSION, Aov, Crop, EYE_NORMAL, EYE_POSITION, Filter, MatteKind, Scene, Settings},
    texture::TextureStatistics,
};
use gonio_simd::Execution;
use gonio_usd::{
    Complexity, Loaded, Purpose, SampleTime, StageOptions, VariantSelection, camera,
    frame_name::has_frame,
    framing::is_camera_lit,
    render_settings::RenderVariable,
    render_variable::{self, aov_by_name},
    view::{Headlight, Resolution, ViewOptions, complete},
};
use pyo3::prelude::*;
use std::{
    path::PathBuf,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::{Duration, Instant},
};

/// Renders all frames asked for.
pub(super) fn render(py: Python<'_>, options: &RenderOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let mut stage_options =
        StageOptions { motion_vectors: shows_motion(options), camera: options.camera.clone(), ..stage_options(&options.stage)? };
    // A stage that is read again and again may be edited meanwhile.
    stage_options.kept = options.frame_count.is_some() || options.frames.as_ref().is_some_and(|frames| frames.contains([',', ':']));
    stage_options.detached = stage_options.kept;
    let start = Instant::now();
    let stage = Stage::open(py, &options.stage.stage, &options.stage.state, &stage_options)?;
    if options.stage.verbose && !options.quiet {
        say(&format!("pxr imported and the stage opened in {:.2} s", start.elapsed().as_secs_f64()));
    }
    if let Some(path) = &options.explain {
        return explain::render(py, options, &stage, &stage_options, path, interrupted);
    }
    if options.list_cameras {
        for camera in &stage.info().cameras {
            print(&camera.path);
        }
        return Ok(0);
    }
    let execution = Execution::detect();
    let writer = Writer::new(&options.files, execution)?;
    by_wavelength::check(&options.files)?;
    let frames = frames_of(options, stage.info().time_range.map(|[first, _]| first))?;
    Snapshots::new(options.snapshot)?;
    let mut sequence =
        Sequence { options, stage: &stage, stage_options, writer: &writer, execution, products: Products::default(), previous: None };
    sequence::run(&frames, |frame| sequence.frame(py, frame, interrupted))
}

/// Frames of one stage, each of which leaves to the next what has not changed.
struct Sequence<'a> {
    options: &'a RenderOptions,
    stage: &'a Stage,
    stage_options: StageOptions,
    writer: &'a Writer,
    execution: Execution,
    products: Products,
    previous: Option<Arc<CompiledScene>>,
}

impl Sequence<'_> {
    /// Reads, compiles and renders a frame.
    fn frame(&mut self, py: Python<'_>, frame: Option<f64>, interrupted: &'static AtomicBool) -> Result<()> {
        let (options, stage, writer, execution) = (self.options, self.stage, self.writer, self.execution);
        self.stage_options.time = sample_time(options, frame);
        check_targets(&files_of(options, stage, frame)?)?;
        let start = Instant::now();
        let loaded = stage.load(py, &self.stage_options, interrupted)?;
        let (loading, waited_for_meshes) = (start.elapsed(), loaded.waited_for_meshes);
        if loaded.kept_shapes > 0 && options.stage.verbose && !options.quiet {
            say(&format!("{} shapes are as in the frame before", loaded.kept_shapes));
        }
        let time = frame.unwrap_or(0.0) / stage.info().time_codes_per_second;
        let named = file_name::named_frame(frame, stage.info().time_range, options.default_time);
        let of_frame = |path: &PathBuf| file_name::filled_in(path, named);
        let checkpoint = options.checkpoint.checkpoint.as_ref().map(of_frame).transpose()?;
        let deep = options.files.deep.as_ref().map(of_frame).transpose()?;
        let by_wavelength = options.files.by_wavelength.as_ref().map(of_frame).transpose()?;
        let names_nothing = options.files.output.is_empty() && checkpoint.is_none() && deep.is_none() && by_wavelength.is_none();
        let pictures = if names_nothing {
            self.products.pictures(&loaded, named)?
        } else {
            let paths: Vec<PathBuf> = options.files.output.iter().map(of_frame).collect::<Result<_>>()?;
            vec![Picture::of_all_products(&loaded, paths.into_iter(), deep)]
        };
        let count = pictures.len();
        let mut loaded = Some(loaded);
        for (number, picture) in pictures.into_iter().enumerate() {
            // The last picture has the scene for itself; meshes and images are shared anyway.
            let scene = if number + 1 == count { loaded.take() } else { loaded.clone() };
            let Some(scene) = scene else { break };
            let checkpoint = checkpoint.clone();
            let is_first = number == 0;
            let by_wavelength = by_wavelength.clone().filter(|_| is_first);
            let job = Job {
                options,
                writer,
                execution,
                picture,
                is_first,
                checkpoint,
                by_wavelength,
                loading,
                waited_for_meshes,
                time,
                interrupted,
            };
            let previous = self.previous.as_deref();
            if let Some(compiled) = py.detach(|| job.run(scene, previous))? {
                self.previous = Some(compiled);
            }
        }
        Ok(())
    }
}

/// The files that the command line names for a frame.
pub(super) fn files_of(options: &RenderOptions, stage: &Stage, frame: Option<f64>) -> Result<Vec<PathBuf>> {
    let frame = file_name::named_frame(frame, stage.info().time_range, options.default_time);
    let files = &options.files;
    let named = files.output.iter().chain(&files.deep).chain(&files.by_wavelength).chain(&options.checkpoint.checkpoint);
    named.map(|path| file_name::filled_in(path, frame)).collect()
}

/// When the stage is read for a frame.
pub(super) fn sample_time(options: &RenderOptions, frame: Option<f64>) -> SampleTime {
    match frame {
        Some(code) => SampleTime::Code(code),
        None if options.default_time => SampleTime::Default,
        None => SampleTime::Start,
    }
}

/// The frames asked for; without any the stage's own time, once. `first` is the stage's first.
pub(super) fn frames_of(options: &RenderOptions, first: Option<f64>) -> Result<Vec<Option<f64>>> {
    let named = options.frames.as_deref().map(frames::parse).transpose()?;
    let frames = match (named, options.frame_count) {
        (None, None) => return Ok(vec![None]),
        (Some(frames), None) => frames,
        (named, Some(count)) => frames::counted(named.as_deref(), first, count, options.frame_inc)?,
    };
    let mut files = options
        .files
        .output
        .iter()
        .map(|path| ("output", path))
        .chain(options.files.deep.iter().map(|path| ("deep", path)))
        .chain(options.files.by_wavelength.iter().map(|path| ("by-wavelength", path)))
        .chain(options.checkpoint.checkpoint.iter().map(|path| ("checkpoint", path)));
    if let (true, Some((name, path))) = (frames.len() > 1, files.find(|(_, path)| !has_frame(path))) {
        return Err(Error::Setting {
            name: name.into(),
            problem: format!("{}: several frames need a place for the frame number, such as '####' or '$F4'", path.display()),
        });
    }
    Ok(frames.into_iter().map(Some).collect())
}

/// Whether the command line asks for a pass of motion vectors.
pub(super) fn shows_motion(options: &RenderOptions) -> bool {
    options.aov.iter().any(|name| aov_by_name(name) == Some(Aov::Motion))
}

/// What of the stage is read, from the command line.
pub(super) fn stage_options(arguments: &StageArguments) -> Result<StageOptions> {
    let purpose = |token: &String| {
        let problem = || Error::setting("purposes", format!("'{token}' was found, expected default, render, proxy or guide"));
        Purpose::from_token(token).ok_or_else(problem)
    };
    Ok(StageOptions {
        purposes: match arguments.purposes.as_slice() {
            [] => None,
            tokens => Some(tokens.iter().map(purpose).collect::<Result<_>>()?),
        },
        complexity: match arguments.complexity {
            ComplexityArgument::Low => Complexity::Low,
            ComplexityArgument::Medium => Complexity::Medium,
            ComplexityArgument::High => Complexity::High,
            ComplexityArgument::Veryhigh => Complexity::VeryHigh,
            ComplexityArgument::Auto => Complexity::Auto,
        },
        population_mask: arguments.mask.clone(),
        variants: variants("variant", &arguments.variant)?,
        session_layer: arguments.session_layer.clone(),
        render_settings: arguments.settings.clone(),
        render_pass: arguments.render_pass.clone(),
        disable_motion_blur: arguments.disable_motion_blur,
        disable_draw_mode: arguments.disable_draw_mode,
        hide_lights: arguments.hide_lights,
        spectral: arguments.spectral,
        haze: arguments.haze,
        strict: arguments.strict,
        lenient: arguments.lenient,
        ..StageOptions::default()
    })
}

/// The variants that an option chooses.
pub(super) fn variants(option: &str, texts: &[String]) -> Result<Vec<VariantSelection>> {
    let variant = |text: &String| {
        let problem = || Error::setting(option, format!("'{text}' was found, expected /Prim{{set=variant}}"));
        VariantSelection::parse(text).ok_or_else(problem)
    };
    texts.iter().map(variant).collect()
}

/// What the command line adds to a stage: daylight, view and settings. `product` is the render product whose picture it is.
pub(super) fn complete_scene(options: &RenderOptions, loaded: &mut Loaded, product: Option<usize>) -> Result<()> {
    if options.disable_scene_lights {
        loaded.scene.lights.clear();
    }
    if options.disable_scene_materials {
        loaded.scene.instances.iter_mut().for_each(|instances| instances.materials.clear());
    }
    daylight::add(&options.daylight, loaded, options.stage.strict, options.quiet)?;
    Job::apply_settings(options, loaded, product)
}

/// Which light scenes without any get: models, whose rooms a lamp at the camera would not light, an even sky.
fn headlight(options: &RenderOptions) -> Headlight {
    match options.headlight {
        Some(HeadlightArgument::Dome) => Headlight::Dome,
        None if is_model(&options.stage.stage) => Headlight::Dome,
        _ => Headlight::Camera,
    }
}

/// What the header of EXR files says beside the passes.
pub(super) fn attributes(options: &RenderOptions, scene: &Scene) -> [(String, String); 3] {
    let camera = &scene.cameras[scene.settings.camera as usize];
    [
        ("gonio:camera".to_owned(), camera.origin.name.to_string()),
        ("gonio:stage".to_owned(), options.stage.stage.file_name().unwrap_or_default().to_string_lossy().into_owned()),
        ("gonio:seed".to_owned(), scene.settings.seed.to_string()),
    ]
}

/// One picture to make.
struct Job<'a> {
    options: &'a RenderOptions,
    writer: &'a Writer,
    execution: Execution,
    picture: Picture,
    /// Of its frame: it tells what the stage has to tell.
    is_first: bool,
    checkpoint: Option<PathBuf>,
    by_wavelength: Option<PathBuf>,
    loading: Duration,
    waited_for_meshes: Duration,
    /// Of the frame, seconds.
    time: f64,
    interrupted: &'static AtomicBool,
}

impl Job<'_> {
    /// Compiles, renders and writes; gives the compiled scene for the next frame to reuse, if there is one.
    fn run(&self, mut loaded: Loaded, previous: Option<&CompiledScene>) -> Result<Option<Arc<CompiledScene>>> {
        // Render products of the stage name files too.
        check_targets(self.picture.files.iter().map(|file| &file.path).chain(&self.picture.deep))?;
        complete_scene(self.options, &mut loaded, self.picture.product)?;
        if self.is_first {
            tell(&self.options.stage, self.options.quiet, &loaded.diagnostics);
        }
        if let Some(path) = &self.by_wavelength {
            by_wavelength::render(self.options, (&loaded.scene, previous), path, self.execution, self.interrupted)?;
            if self.picture.files.is_empty() && self.picture.deep.is_empty() && self.checkpoint.is_none() {
                return Ok(None);
            }
        }
        let hidden = self.writer.ask_for_passes(&mut loaded.scene.settings);
        if !self.picture.deep.is_empty() {
            ask_for_deep(&mut loaded.scene.settings);
        }
        let compiled = Arc::new(compile(&loaded.scene, previous, self.interrupted)?);
        self.complain(&compiled)?;
        self.tell_sizes(&compiled);
        self.trace(&loaded.scene, &compiled, &hidden)?;
        Ok(Some(compiled))
    }

    /// Command line over render settings over defaults.
    fn apply_settings(options: &RenderOptions, loaded: &mut Loaded, product: Option<usize>) -> Result<()> {
        let view = ViewOptions {
            camera: options.camera.clone(),
            resolution: match (options.res.as_deref(), options.image_width) {
                (Some([width, height]), _) => Resolution::Exact([*width, *height]),
                (_, Some(width)) => Resolution::Width(width),
                _ => Resolution::Stage,
            },
            // husk counts in per cent.
            scale: if options.res_scale >= 10.0 { options.res_scale / 100.0 } else { options.res_scale },
            pixel_aspect: options.pixel_aspect,
            camera_light: !options.disable_camera_light && options.headlight != Some(HeadlightArgument::None),
            headlight: headlight(options),
            data_window: options.crop.is_none(),
            product,
        };
        let primary = Python::attach(|py| camera::primary_camera_name(py, loaded.scene.cameras.len()));
        for note in complete(loaded, &primary, &view)? {
            if !options.quiet {
                say(&note.to_string());
            }
        }
        if options.lamp_groups {
            loaded.scene.group_by_lamp();
        }
        let light_groups = loaded.scene.light_groups();
        let settings = &mut loaded.scene.settings;
        settings.samples = options.spp.unwrap_or(settings.samples);
        settings.set_antialiasing(options.antialiasing.unwrap_or_default());
        settings.sample_range = options.checkpoint.samples.as_deref().map(sample_range).transpose()?;
        settings.noise_threshold = options.noise_threshold;
        settings.min_samples = options.min_spp;
        settings.max_bounces = options.max_bounces.unwrap_or(settings.max_bounces);
        settings.integrator = options.integrator.into();
        settings.caustics = options.caustics.into();
        settings.guiding = options.guiding.into();
        settings.light_samples = options.light_samples;
        settings.filter = filter(options.filter);
        settings.filter_width = options.filter_width;
        options.work.apply(settings);
        options.textures.apply(settings);
        settings.clamp_direct = options.clamp_direct;
        settings.clamp_indirect = options.clamp_indirect.unwrap_or(settings.clamp_indirect);
        settings.time_limit_s = options.time_limit;
        if let Some(ranks) = options.cryptomatte_depth {
            settings.set_cryptomatte_depth(ranks.next_multiple_of(2));
        }
        if !options.aov.is_empty() {
            set_aovs(settings, &options.aov)?;
        }
        if !settings.aovs.contains(&Aov::Color) {
            // Pictures for looking at are made of it, and it costs nothing.
            settings.aovs.insert(0, Aov::Color);
        }
        if options.files.deep.is_some() {
            ask_for_deep(settings);
        }
        settings.deep_tolerance = options.deep_tolerance;
        if options.light_groups || options.lamp_groups {
            settings.add_light_groups(light_groups);
        }
        if let Some(crop) = &options.crop {
            settings.crop = Some(crop_of(crop, settings.resolution)?);
        }
        if let Some(part) = &options.checkpoint.part {
            take_part(part, settings)?;
        }
        Ok(())
    }

    /// Diagnostics of the compile step; errors with `--strict`.
    fn complain(&self, compiled: &CompiledScene) -> Result<()> {
        tell(&self.options.stage, self.options.quiet, &compiled.diagnostics);
        match compiled.diagnostics.first() {
            Some(first) if self.options.stage.strict => Err(Error::scene(&first.origin, first.message.clone())),
            _ => Ok(()),
        }
    }

    fn tell_sizes(&self, compiled: &CompiledScene) {
        if self.options.stage.verbose {
            let s = &compiled.statistics;
            let megabytes = |bytes: u64| bytes as f64 / 1e6;
            say(&format!(
                "{} triangles in {} instances, {} lights, SIMD level {}",
                s.triangles,
                s.instances,
                s.lights,
                self.execution.name()
            ));
            say(&format!("{:.1} MB of geometry, {:.1} MB of textures", megabytes(s.geometry_bytes), megabytes(s.texture_bytes)));
            let (read, meshes) = (self.loading.as_secs_f64(), self.waited_for_meshes.as_secs_f64());
            say(&format!("read in {read:.2} s, {meshes:.2} s of it waiting for meshes that are built beside"));
            say(&format!("textures in {:.2} s, trees in {:.2} s, compiled in {:.2} s in all", s.textures_s, s.build_s, s.total_s));
        }
    }

    /// Renders and writes but for the passes `hidden`; an interrupted render leaves the picture so far.
    fn trace(&self, scene: &Scene, compiled: &Arc<CompiledScene>, hidden: &[Aov]) -> Result<()> {
        let start = Instant::now();
        let mut keeper = self.keeper(scene)?;
        let film = keeper.as_ref().map_or(Ok(None), Keeper::film)?;
        let mut render = match film {
            Some(film) => Render::resume(compiled.clone(), &scene.settings, self.execution, film)?,
            None => Render::start(compiled.clone(), &scene.settings, self.execution)?,
        };
        let mut snapshots = Snapshots::new(self.options.snapshot)?;
        let keep = |film: &Film| {
            keeper.iter_mut().for_each(|keeper| keeper.keep_if_due(film));
            snapshots.take_if_due(|| self.snapshot(scene, film, hidden));
        };
        drive(&mut render, self.options.quiet, self.interrupted, keep)?;
        let result = render.finish();
        if let Err(error) = &result
            && !matches!(error, Error::Cancelled)
        {
            return result;
        }
        // A disk without room for the one may have some for the other.
        let kept = keeper.as_mut().map_or(Ok(()), |keeper| keeper.keep(render.film()));
        let mut image = render.film().develop();
        if result.is_ok() {
            self.writer.finish(&mut image)?;
        }
        image.layers.retain(|layer| !hidden.contains(&layer.aov));
        if image.samples > 0 || result.is_ok() || render.progress().fraction > 0.0 {
            self.write(scene, &mut image, result.is_err(), false)?;
        }
        if !self.options.quiet && result.is_ok() {
            let rays = render.progress().rays as f64 * 1e-6;
            let seconds = start.elapsed().as_secs_f64();
            let samples = samples_of(&scene.settings, &render, &image);
            say(&format!("{samples} in {}, {:.1} Mrays/s", clock(start.elapsed()), rays / seconds.max(1e-3)));
        }
        if let (false, Some(words)) = (self.options.quiet, render.guiding()) {
            say(words);
        }
        if let (false, Some(statistics)) = (self.options.quiet, compiled.tables.textures.statistics()) {
            tell_textures(&statistics, self.options.stage.verbose);
        }
        if result.is_err() {
            // The process ends next, which gives everything back at once; somebody waits.
            std::mem::forget((render, image));
        }
        kept.and(result)
    }

    /// Writes the picture so far. One that cannot be written does not end the render.
    fn snapshot(&self, scene: &Scene, film: &Film, hidden: &[Aov]) {
        let mut image = film.develop();
        image.layers.retain(|layer| !hidden.contains(&layer.aov));
        let samples = image.samples;
        match self.write(scene, &mut image, true, true) {
            Ok(()) if self.options.quiet => {}
            Ok(()) => say(&format!("snapshot with {samples} samples a pixel")),
            Err(error) => say(&format!("warning: the snapshot could not be written: {error}")),
        }
    }

    /// Writes all files at once: the wait is that for the slowest.
    fn write(&self, scene: &Scene, image: &mut Image, interrupted: bool, snapshot: bool) -> Result<()> {
        let exposure = scene.cameras[scene.settings.camera as usize].exposure.0;
        // All files of a picture show the same.
        let variables = self.picture.files.first().map(|file| file.variables.as_slice()).unwrap_or_default();
        let notes = Notes {
            half_layers: &half_layers(variables),
            gamut: self.picture.gamut,
            exposure,
            time: self.time,
            camera_lit: is_camera_lit(scene),
            interrupted,
            snapshot,
            attributes: &attributes(self.options, scene),
        };
        let paths: Vec<PathBuf> = self.picture.files.iter().map(|file| file.path.clone()).collect();
        let deep = |path: &PathBuf| self.writer.write_deep(path, image, &notes, self.options.quiet || snapshot);
        // What can be written is, whatever becomes of the others.
        let deep = self.picture.deep.iter().map(deep).fold(Ok(()), Result::and);
        name_layers(self.options, image, &scene.settings, variables);
        write_cropped(self.writer, &paths, image, &notes, self.options).and(deep)
    }

    /// What keeps the render's checkpoint, if there is to be one.
    fn keeper(&self, scene: &Scene) -> Result<Option<Keeper>> {
        let Some(path) = &self.checkpoint else { return Ok(None) };
        let identity = Identity::new(scene, self.execution, attributes(self.options, scene).to_vec());
        Keeper::new(path.clone(), identity, &self.options.checkpoint).map(Some)
    }
}

/// Writes a picture's files, EXR files cropped to what they show if that was asked for.
pub(super) fn write_cropped(writer: &Writer, paths: &[PathBuf], image: &Image, notes: &Notes<'_>, options: &RenderOptions) -> Result<()> {
    let quiet = options.quiet || notes.snapshot;
    if options.autocrop.is_empty() {
        return writer.write_all(paths, image, notes, quiet);
    }
    let is_exr = |path: &&PathBuf| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr"));
    let (to_crop, others): (Vec<&PathBuf>, Vec<&PathBuf>) = paths.iter().partition(is_exr);
    let owned = |paths: Vec<&PathBuf>| paths.into_iter().cloned().collect::<Vec<_>>();
    let written = writer.write_all(&owned(others), image, notes, quiet);
    let mut part = image.clone();
    autocrop::crop(&mut part, &options.autocrop)?;
    writer.write_all(&owned(to_crop), &part, notes, quiet).and(written)
}

/// Asks for the deep picture.
fn ask_for_deep(settings: &mut Settings) {
    if !settings.aovs.contains(&Aov::Deep) {
        settings.aovs.push(Aov::Deep);
    }
}

/// What textures within a memory limit took, and what went wrong with them.
fn tell_textures(statistics: &TextureStatistics, verbose: bool) {
    let megabytes = |bytes: u64| bytes as f64 / 1e6;
    for note in &statistics.notes {
        say(&format!("warning: {note}"));
    }
    if verbose {
        let (most, limit, total) = (megabytes(statistics.most), megabytes(statistics.limit), megabytes(statistics.total));
        say(&format!("texture memory: {most:.1} MB at most within {limit:.1} MB, {total:.1} MB of textures"));
        say(&format!(
            "texture tiles: {} looked up, {:.3} % of them in memory; {} read ({:.1} MB), {} given up",
            statistics.lookups,
            100.0 * statistics.hit_rate(),
            statistics.tiles_read,
            megabytes(statistics.bytes_read),
            statistics.evicted
        ));
    }
}

/// Makes the layers of a picture those of the stage's render variables, unless there are none or the command line asks for others.
pub(super) fn name_layers(options: &RenderOptions, image: &mut Image, settings: &Settings, variables: &[RenderVariable]) {
    if !options.aov.is_empty() || variables.is_empty() {
        return;
    }
    let named = render_variable::layers(image, settings, variables);
    // Beside them stay light groups, and the colour, which costs nothing.
    let is_extra = |layer: &Layer| matches!(layer.aov, Aov::Color | Aov::LightGroup(_)) && named.iter().all(|own| own.aov != layer.aov);
    image.layers.retain(is_extra);
    image.layers.extend(named);
}

/// Waits until a render has ended or was interrupted, shows how far it is, and has `look` see its film now and then; what came of it is for [`Render::finish`] to say.
pub(super) fn drive(render: &mut Render, quiet: bool, interrupted: &AtomicBool, mut look: impl FnMut(&Film)) -> Result<()> {
    let mut reporter = Reporter::new(quiet);
    while !render.is_finished() {
        if interrupted.load(Ordering::Relaxed) {
            render.cancel();
        }
        // Waiting for tiles keeps the loop quiet; which tile it was does not matter to a file.
        let _ = render.next_tile(Duration::from_millis(20));
        while render.next_tile(Duration::ZERO).is_some() {}
        reporter.show(&render.progress());
        look(render.film());
        Python::attach(|py| py.check_signals()).map_err(|_| Error::Cancelled)?;
    }
    reporter.clear();
    Ok(())
}

/// How many samples a pixel has, in words.
fn samples_of(settings: &Settings, render: &Render, image: &Image) -> String {
    if settings.antialiasing.is_adaptive() {
        let [width, height] = image.size();
        return format!("{:.2} rays a pixel", render.statistics().camera_rays as f64 / (width * height).max(1) as f64);
    }
    let more = || format!("{} and more, {:.1} in the mean", image.samples, image.mean_samples);
    let samples = if image.mean_samples > f64::from(image.samples) { more() } else { image.samples.to_string() };
    format!("{samples} samples a pixel")
}

/// Asks for passes by their names.
fn set_aovs(settings: &mut Settings, names: &[String]) -> Result<()> {
    settings.aovs.clear();
    for name in names.iter().map(|name| name.trim()) {
        let found = aov_by_name(name).map(|aov| vec![aov]).or_else(|| settings.named_passes(name));
        let found = found.ok_or_else(|| Error::setting("aov", unknown_aov(name)))?;
        settings.aovs.extend(found);
    }
    Ok(())
}

fn unknown_aov(name: &str) -> String {
    if name.starts_with("lpe:") {
        let problem = gonio::scene::light_path(name).err().unwrap_or_default();
        return format!("'{name}' was found, expected a light path expression such as lpe:C<RD>L or lpe:C<RS>.*L: {problem}");
    }
    let standard = [EYE_NORMAL, EYE_POSITION, AMBIENT_OCCLUSION, "primvars:NAME", "lightgroup:NAME", "lpe:EXPRESSION"];
    let known = Aov::NAMES.iter().map(|(_, name)| *name).chain(MatteKind::NAMES.iter().map(|(_, name, _)| *name)).chain(standard);
    format!("'{name}' was found, expected one of {}", known.collect::<Vec<_>>().join(", "))
}

/// Pixels, or parts of the picture where a number has a decimal point.
fn crop_of(texts: &[String], resolution: [u32; 2]) -> Result<Crop> {
    let parts = texts.iter().any(|text| text.contains('.'));
    let mut bounds = [0; 4];
    for (i, text) in texts.iter().enumerate() {
        let number: f64 = text
            .parse()
            .ok()
            .filter(|x: &f64| x.is_finite())
            .ok_or_else(|| Error::Setting { name: "crop".into(), problem: format!("'{text}' was found, expected a number") })?;
        let scale = if parts { f64::from(resolution[i % 2]) } else { 1.0 };
        bounds[i] = (number * scale).round().max(0.0) as u32;
    }
    Ok(Crop { min: [bounds[0], bounds[1]], max: [bounds[2], bounds[3]] })
}

/// The filter of an argument.
fn filter(argument: FilterArgument) -> Filter {
    match argument {
        FilterArgument::Box => Filter::Box,
        FilterArgument::Tent => Filter::Tent,
        FilterArgument::Gaussian => Filter::Gaussian,
        FilterArgument::BlackmanHarris => Filter::BlackmanHarris,
    }
}
