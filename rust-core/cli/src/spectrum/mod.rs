//! `gonio spectrum`.

mod json;
mod text;

pub(super) use json::figures_json;

use super::{
    arguments::SpectrumOptions,
    drawing,
    file::{self, check_ending, check_targets, put},
    messages::print,
};
use gonio::{Error, Result};
use gonio_formats::{
    FormatError,
    gdtf::{self, Gdtf, GdtfEmitter},
    gldf::{self, Gldf, GldfSpectrum},
    photometry::tm33,
    tame,
};
use gonio_spectrum::{Figures, NAMES, Spectrum, figures, named, read, spectrum_drawing};
use serde_json::Value;
use std::path::Path;

/// The longest file in bytes: a thousand times the longest of a spectrometer.
pub(super) const LONGEST: u64 = 64 << 20;

/// A lamp as it was asked for, its spectrum and what that says.
#[derive(Debug)]
struct Lamp {
    asked: String,
    spectrum: Spectrum,
    figures: Figures,
}

/// Reads the spectra, says what they mean, and draws one if asked to.
pub(super) fn spectrum(options: &SpectrumOptions) -> Result<i32> {
    if let Some(path) = &options.output {
        check_ending("output", path, drawing::ENDINGS)?;
        one_alone(options.sources.len())?;
        check_targets([path])?;
    }
    let lamps: Vec<Lamp> = options.sources.iter().map(|source| lamps(source)).collect::<Result<Vec<_>>>()?.into_iter().flatten().collect();
    if options.output.is_some() {
        one_alone(lamps.len())?;
    }
    if let (Some(path), [lamp]) = (&options.output, lamps.as_slice()) {
        put(path, &drawing::encoded(spectrum_drawing(&lamp.spectrum, &lamp.figures), path)?)?;
    }
    match lamps.as_slice() {
        [lamp] if options.json => print(&json::as_json(lamp).to_string()),
        lamps if options.json => print(&Value::from_iter(lamps.iter().map(json::as_json)).to_string()),
        [lamp] => text::as_text(lamp).iter().for_each(|line| print(line)),
        lamps => text::as_table(lamps).iter().for_each(|line| print(line)),
    }
    Ok(0)
}

/// Makes sure that there is one lamp to be drawn.
fn one_alone(count: usize) -> Result<()> {
    if count > 1 { Err(Error::setting("output", format!("one lamp is drawn, {count} were named"))) } else { Ok(()) }
}

/// A file's lamps, or where there is no such file the lamp of that name.
fn lamps(source: &Path) -> Result<Vec<Lamp>> {
    let asked = source.to_string_lossy().into_owned();
    let spectrum = match named(&asked).filter(|_| !source.exists()) {
        Some(found) => found.map_err(|error| Error::setting(&asked, error.problem))?,
        None if !source.exists() && source.extension().is_none() && source.components().count() == 1 => {
            return Err(Error::setting(&asked, format!("neither a file nor a name, which are {NAMES}")));
        }
        None => {
            let bytes = file::read(source, LONGEST, "spectrum's file")?;
            if gldf::looks_like(&bytes) {
                return of_product(source, &bytes).map_err(|error| Error::in_file(source, &error));
            }
            if tm33::looks_like(&bytes) {
                return of_luminaire(source, &bytes).map_err(|error| Error::in_file(source, &error));
            }
            let name = source.file_name().unwrap_or_default().to_string_lossy();
            read(&bytes, &name).map_err(|error| Error::in_file(source, &error))?
        }
    };
    Ok(vec![lamp(asked, spectrum)])
}

/// The spectrum of one file or name.
pub(super) fn one(source: &str) -> Result<Spectrum> {
    let mut lamps = lamps(Path::new(source))?;
    one_alone(lamps.len())?;
    lamps.pop().map(|lamp| lamp.spectrum).ok_or_else(|| Error::setting(source, "no spectrum"))
}

fn lamp(asked: String, spectrum: Spectrum) -> Lamp {
    let figures = figures(&spectrum);
    Lamp { asked, spectrum, figures }
}

/// The spectra of a TM-33 file's emitters; of several each under its name.
fn of_luminaire(source: &Path, bytes: &[u8]) -> std::result::Result<Vec<Lamp>, FormatError> {
    let found = tm33::spectra(bytes)?;
    let asked = |name: &str| {
        let file = source.display();
        if found.len() == 1 || name.is_empty() { file.to_string() } else { format!("{file}: {}", tame(name)) }
    };
    found.iter().map(|spectrum| Ok(lamp(asked(&spectrum.name), Spectrum::of(spectrum.clone())?))).collect()
}

/// The spectra of a GLDF file, each under its identifier, or of a GDTF file's emitters under their names.
fn of_product(source: &Path, bytes: &[u8]) -> std::result::Result<Vec<Lamp>, FormatError> {
    if gdtf::is_fixture(bytes, &source.to_string_lossy()) {
        return of_fixture(source, bytes);
    }
    let product = Gldf::read(bytes)?;
    if product.spectra.is_empty() {
        return Err(FormatError::whole("the product has no spectrum"));
    }
    let spectrum = |(index, found): (usize, &GldfSpectrum)| {
        let read = product.spectrum(index).and_then(Spectrum::of);
        let read = read.map_err(|error| FormatError::whole(format!("spectrum {}: {error}", tame(&found.id))))?;
        Ok(lamp(format!("{}: {}", source.display(), found.id), read))
    };
    product.spectra.iter().enumerate().map(spectrum).collect()
}

fn of_fixture(source: &Path, bytes: &[u8]) -> std::result::Result<Vec<Lamp>, FormatError> {
    let fixture = Gdtf::read(bytes)?;
    let measured: Vec<&GdtfEmitter> = fixture.emitters.iter().filter(|emitter| !emitter.spectrum.is_empty()).collect();
    if measured.is_empty() {
        return Err(FormatError::whole("none of the fixture's emitters has a spectrum"));
    }
    let spectrum = |found: &&GdtfEmitter| {
        let (nm, power): (Vec<f64>, Vec<f64>) = found.spectrum.iter().copied().unzip();
        let read = Spectrum::new(&found.name, &nm, &power);
        let read = read.map_err(|error| FormatError::whole(format!("emitter {}: {error}", tame(&found.name))))?;
        Ok(lamp(format!("{}: {}", source.display(), found.name), read))
    };
    measured.iter().map(spectrum).collect()
}
