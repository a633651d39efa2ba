//! The picture of `gonio render` by wavelength.

use super::{
    arguments::{OutputArguments, RenderOptions},
    file::{check_ending, print_path},
    measure::watched,
    messages::{say, tell},
    progress::Reporter,
    render::attributes,
};
use gonio::{
    Error, Result,
    compile::CompiledScene,
    output::{ExrOptions, check_spectral, write_spectral},
    scene::Scene,
    spectral_picture::spectral_picture,
};
use gonio_simd::Execution;
use gonio_spectrum::{Bands, bands_of};
use std::{path::Path, sync::atomic::AtomicBool};

/// Checks what was asked for before anything is rendered.
pub(super) fn check(files: &OutputArguments) -> Result<()> {
    let Some(path) = &files.by_wavelength else { return Ok(()) };
    check_ending("by-wavelength", path, &["exr", "hsr"])?;
    check_spectral(path, bands(files.band)?)
}

/// What was asked for of pictures that this one does not follow.
fn not_followed(options: &RenderOptions) -> Option<String> {
    let files = &options.files;
    let asked = [("--denoise", files.denoise), ("--half", files.half), ("--autocrop", !options.autocrop.is_empty())];
    let names: Vec<&str> = asked.iter().filter(|(_, is_asked)| *is_asked).map(|(name, _)| *name).collect();
    (!names.is_empty()).then(|| format!("the picture by wavelength is written as it was rendered, without {}", names.join(", ")))
}

/// The bands that were asked for.
fn bands(width_nm: f64) -> Result<&'static Bands> {
    bands_of(width_nm).ok_or_else(|| Error::setting("band", format!("{width_nm} nm was found, expected 5, 10 or 20")))
}

/// Renders a scene's view and writes it.
pub(super) fn render(
    options: &RenderOptions,
    (scene, previous): (&Scene, Option<&CompiledScene>),
    path: &Path,
    execution: Execution,
    interrupted: &AtomicBool,
) -> Result<()> {
    let bands = bands(options.files.band)?;
    let (found, diagnostics) =
        watched(Reporter::new(options.quiet), previous, interrupted, |watch| spectral_picture(scene, bands, execution, watch))?;
    tell(&options.stage, options.quiet, &diagnostics);
    if let Some(note) = not_followed(options).filter(|_| !options.quiet) {
        say(&format!("note: {note}"));
    }
    let notes = ExrOptions { attributes: attributes(options, scene).to_vec(), ..ExrOptions::default() };
    write_spectral(path, &found, &notes)?;
    if !options.quiet {
        print_path(path);
    }
    Ok(())
}
