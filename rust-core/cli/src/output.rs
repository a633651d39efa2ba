//! Writing a picture under the names asked for.

use super::{
    arguments::OutputArguments,
    denoise::Denoiser,
    file::{make_folder, print_path, write_or_keep},
};
use gonio::{
    Error, Result,
    colour::Gamut,
    film::Image,
    output::{Adaptation, DisplaySpace, ExrOptions, Look, ToneMap, log_average, write_deep_exr, write_exr, write_picture},
    scene::{Aov, Settings},
    threads::start,
};
use gonio_simd::Execution;
use std::{
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// What a file says about its picture.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Notes<'a> {
    /// Exposure of the camera.
    pub(super) exposure: f32,
    /// When the picture is, seconds.
    pub(super) time: f64,
    /// White surfaces that face the camera are as bright as white is shown.
    pub(super) camera_lit: bool,
    /// The render did not end by itself, and somebody waits.
    pub(super) interrupted: bool,
    /// The render goes on.
    pub(super) snapshot: bool,
    /// Passes that EXR files have in half floats, whatever they hold.
    pub(super) half_layers: &'a [String],
    /// The gamut of EXR files' colours; `None` is Rec.709.
    pub(super) gamut: Option<Gamut>,
    /// Further text attributes.
    pub(super) attributes: &'a [(String, String)],
}

/// What file names and options say about writing.
#[derive(Debug)]
pub(super) struct Writer {
    look: Look,
    /// Whether the command line says how radiance becomes display values.
    is_stated: bool,
    /// What follows the brightness of an animation's frames.
    eye: Option<Mutex<Adaptation>>,
    half: bool,
    denoiser: Option<Denoiser>,
    execution: Execution,
}

/// The ending of a picture's name, in small letters; others than those that can be written are an error.
pub(super) fn check_name(path: &Path) -> Result<String> {
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    if matches!(ending.as_str(), "exr" | "png" | "jpg" | "jpeg") {
        return Ok(ending);
    }
    Err(Error::setting("output", format!("{}: the ending is '{ending}', expected exr, png or jpg", path.display())))
}

/// Refuses deep pictures in other formats than OpenEXR.
pub(super) fn check_deep_name(path: &Path) -> Result<()> {
    match check_name(path)?.as_str() {
        "exr" => Ok(()),
        other => Err(Error::setting("deep", format!("{}: the ending is '{other}', deep pictures are .exr", path.display()))),
    }
}

impl Writer {
    /// Checks the options and the names' endings before anything is rendered.
    pub(super) fn new(options: &OutputArguments, execution: Execution) -> Result<Self> {
        for path in &options.output {
            let ending = check_name(path)?;
            if matches!(ending.as_str(), "jpg" | "jpeg") && options.color_space != "srgb" {
                let problem = format!("{}: JPEG files are sRGB, '{}' goes to PNG", path.display(), options.color_space);
                return Err(Error::setting("color-space", problem));
            }
            make_folder(path)?;
        }
        if let Some(path) = &options.deep {
            check_deep_name(path)?;
            make_folder(path)?;
        }
        let denoiser = options.denoise.then(Denoiser::new).transpose()?;
        let (tone_map, space) = (
            options.tonemap.as_deref().map_or_else(|| Ok(ToneMap::default()), ToneMap::by_name)?,
            DisplaySpace::by_name(&options.color_space)?,
        );
        let look = Look::new(tone_map, options.exposure, options.white, None, space)?;
        let seconds = options.adaptation.filter(|_| tone_map.adapts());
        if let Some(wrong) = seconds.filter(|seconds| seconds.is_nan() || *seconds < 0.0) {
            return Err(Error::setting("adaptation", format!("{wrong} was found, expected seconds from 0 on")));
        }
        let eye = seconds.map(|seconds| Mutex::new(Adaptation::new(seconds)));
        let is_stated = options.tonemap.is_some();
        Ok(Self { look, is_stated, eye, half: options.half, denoiser, execution })
    }

    /// Asks for the passes that writing needs; gives those that no file shows.
    pub(super) fn ask_for_passes(&self, settings: &mut Settings) -> Vec<Aov> {
        if self.denoiser.is_some() { Denoiser::ask_for_guides(settings) } else { Vec::new() }
    }

    /// Denoises a picture, if that was asked for.
    pub(super) fn finish(&self, image: &mut Image) -> Result<()> {
        self.denoiser.as_ref().map_or(Ok(()), |denoiser| denoiser.run(image))
    }

    /// Writes all files at once: the wait is that for the slowest.
    pub(super) fn write_all(&self, paths: &[PathBuf], image: &Image, about: &Notes<'_>, quiet: bool) -> Result<()> {
        let as_it_is = about.camera_lit && !self.is_stated;
        let look = if as_it_is { Look { tone_map: ToneMap::None, ..self.look } } else { self.look_at(image, about) };
        // Where a folder is gone meanwhile and cannot be made, writing tells.
        paths.iter().for_each(|path| drop(make_folder(path)));
        let written: Vec<Result<()>> = std::thread::scope(|scope| {
            let write = |path| move || self.write(path, image, &look, about);
            let writers: Vec<_> = paths.iter().map(|path| start(scope, write(path))).collect();
            let broken = |_| Err(Error::Internal("the writing of a file broke off".into()));
            let mut ended = Vec::with_capacity(paths.len());
            for (writer, path) in writers.into_iter().zip(paths) {
                ended.push(writer.map_or_else(write(path), |writer| writer.join().unwrap_or_else(broken)));
            }
            ended
        });
        let mut failed = None;
        for (path, result) in paths.iter().zip(written) {
            // What was written is told, whatever became of the others.
            match result {
                Ok(()) if quiet => {}
                Ok(()) => print_path(path),
                Err(error) => failed = failed.or(Some(error)),
            }
        }
        failed.map_or(Ok(()), Err)
    }

    /// Writes the picture's deep samples.
    pub(super) fn write_deep(&self, path: &Path, image: &Image, about: &Notes<'_>, quiet: bool) -> Result<()> {
        drop(make_folder(path));
        write_or_keep(path, |path| write_deep_exr(path, image, &self.exr_options(about)))?;
        if !quiet {
            print_path(path);
        }
        Ok(())
    }

    fn exr_options(&self, about: &Notes<'_>) -> ExrOptions {
        let Notes { exposure, interrupted, attributes, half_layers, gamut, .. } = *about;
        ExrOptions {
            half: self.half,
            half_layers: half_layers.to_vec(),
            gamut,
            exposure,
            hasty: interrupted,
            attributes: attributes.to_vec(),
        }
    }

    /// How a picture is shown, by an eye that has adapted to those before it.
    fn look_at(&self, image: &Image, about: &Notes<'_>) -> Look {
        let adapted = self.eye.as_ref().map(|eye| {
            let measured = log_average(image, self.execution);
            let mut eye = eye.lock().unwrap_or_else(PoisonError::into_inner);
            // The eye adapts to pictures that are done.
            let before = *eye;
            let adapted = eye.follow(measured, about.time);
            if about.snapshot {
                *eye = before;
            }
            adapted
        });
        Look { adapted, ..self.look }
    }

    /// Writes one file.
    fn write(&self, path: &Path, image: &Image, look: &Look, about: &Notes<'_>) -> Result<()> {
        let write = |path: &Path| {
            if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr")) {
                write_exr(path, image, &self.exr_options(about))
            } else {
                write_picture(path, image, look, self.execution)
            }
        };
        // The next snapshot may find room.
        if about.snapshot { write(path) } else { write_or_keep(path, write) }
    }
}
