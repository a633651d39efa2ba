//! Writing a picture under the names asked for.

use super::{arguments::OutputArguments, denoise::Denoiser, file::make_folder, print};
use gonio::{
    Error, Result,
    film::Image,
    output::{ExrOptions, ToneMap, write_exr, write_picture},
    scene::{Aov, Settings},
};
use gonio_simd::Execution;
use std::path::{Path, PathBuf};

/// What a file says about its picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Notes<'a> {
    /// Exposure of the camera.
    pub(super) exposure: f32,
    /// The render did not end by itself, and somebody waits.
    pub(super) interrupted: bool,
    /// Further text attributes.
    pub(super) attributes: &'a [(String, String)],
}

/// What file names and options say about writing.
#[derive(Debug)]
pub(super) struct Writer {
    tone_map: ToneMap,
    stops: f32,
    half: bool,
    denoiser: Option<Denoiser>,
    execution: Execution,
}

impl Writer {
    /// Checks the options and the names' endings before anything is rendered.
    pub(super) fn new(options: &OutputArguments, execution: Execution) -> Result<Self> {
        for path in &options.output {
            let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
            if !matches!(ending.as_str(), "exr" | "png" | "jpg" | "jpeg") {
                return Err(Error::Setting {
                    name: "output".into(),
                    problem: format!("{}: the ending is '{ending}', expected exr, png or jpg", path.display()),
                });
            }
            make_folder(path)?;
        }
        let denoiser = options.denoise.then(Denoiser::new).transpose()?;
        Ok(Self { tone_map: tone_map(&options.tonemap)?, stops: options.exposure, half: options.half, denoiser, execution })
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
        let written: Vec<Result<()>> = std::thread::scope(|scope| {
            let writers: Vec<_> = paths.iter().map(|path| scope.spawn(move || self.write(path, image, about))).collect();
            let broken = |_| Err(Error::Internal("the writing of a file broke off".into()));
            writers.into_iter().map(|writer| writer.join().unwrap_or_else(broken)).collect()
        });
        for (path, result) in paths.iter().zip(written) {
            result?;
            if !quiet {
                print(&path.display().to_string());
            }
        }
        Ok(())
    }

    /// Writes one file.
    fn write(&self, path: &Path, image: &Image, about: &Notes<'_>) -> Result<()> {
        if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("exr")) {
            let Notes { exposure, interrupted, attributes } = *about;
            let options = ExrOptions { half: self.half, exposure, hasty: interrupted, attributes: attributes.to_vec() };
            write_exr(path, image, &options)
        } else {
            write_picture(path, image, self.tone_map, self.stops, self.execution)
        }
    }
}

fn tone_map(text: &str) -> Result<ToneMap> {
    let unknown =
        || Error::Setting { name: "tonemap".into(), problem: format!("'{text}' was found, expected photographic, none or ev100=NUMBER") };
    match text {
        "photographic" => Ok(ToneMap::Photographic),
        "none" => Ok(ToneMap::None),
        _ => {
            let ev = text.strip_prefix("ev100=").and_then(|ev| ev.parse::<f32>().ok()).filter(|ev| ev.is_finite());
            ev.map(ToneMap::Ev100).ok_or_else(unknown)
        }
    }
}
