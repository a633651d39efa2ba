//! Ray files of the command line.

use crate::{arguments::GoniometerOptions, file};
use gonio::{
    Diagnostic, Error, Result,
    goniometer::Rays,
    scene::{Origin, Transform},
};
use gonio_formats::rays::{RayFile, read};
use std::path::Path;

/// The longest file in bytes: 200 million rays of seven numbers.
const LONGEST: u64 = 6 << 30;

/// All ray files, each placed as the prim that it names. `place` gives a prim's transform, `metres` is the stage's unit.
pub(super) fn all(
    options: &GoniometerOptions,
    metres: f64,
    mut place: impl FnMut(&str) -> Result<Transform>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<Rays>> {
    let mut files = Vec::new();
    for text in &options.rays_file {
        let (path, prim) = split(text, &options.luminaire);
        files.push((path, place(prim)?, load(Path::new(path), diagnostics)?));
    }
    let total: f64 = files.iter().map(|(_, _, file)| file.total).sum();
    files
        .into_iter()
        .map(|(path, placed, file)| {
            // Each keeps its share.
            let file = match options.rays_flux {
                Some(lumens) => of_lumens(file, lumens / total).map_err(|error| Error::in_file(path, &error))?,
                None => file,
            };
            Rays::of(&file, path, &placed, metres)
        })
        .collect()
}

/// The file with so many lumens in the place of one of its own unit.
fn of_lumens(file: RayFile, factor: f64) -> Result<RayFile, gonio_formats::FormatError> {
    let lumens = file.total * factor;
    file.with_lumens(lumens)
}

/// File and prim of `FILE@/Prim`; without a prim it is the luminaire.
fn split<'a>(text: &'a str, luminaire: &'a str) -> (&'a str, &'a str) {
    match text.rfind("@/") {
        Some(at) => (&text[..at], &text[at + 1..]),
        None => (text, luminaire),
    }
}

fn load(path: &Path, diagnostics: &mut Vec<Diagnostic>) -> Result<RayFile> {
    let bytes = file::read(path, LONGEST, "ray file")?;
    let found = read(&bytes, &path.to_string_lossy(), false).map_err(|error| Error::in_file(path, &error))?;
    let origin = Origin::new(path.to_string_lossy());
    diagnostics.extend(found.warnings.iter().map(|warning| Diagnostic::warning(&origin, warning.to_string())));
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_may_name_their_prim() {
        assert_eq!(split("led@home.ray@/Lamp/Chip", "/Lamp"), ("led@home.ray", "/Lamp/Chip"));
        assert_eq!(split("led.ray", "/Lamp"), ("led.ray", "/Lamp"));
    }
}
