//! `gonio bsdf`.

mod convert;
mod describe;
mod fit;

use super::{
    arguments::BsdfOptions,
    drawing,
    file::{self, check_ending},
    print,
};
use gonio::{Error, Result, output::write_atomically};
use gonio_formats::bsdf::{Format, Measured, lobe_diagram, lobe_map, read};
use serde_json::Value;
use std::io::Write;
use std::path::Path;

/// The longest file in bytes: a spectral anisotropic measurement of RGL takes 100 MB.
const LONGEST: u64 = 2 << 30;

/// A measured material and the format that it came in.
struct Loaded {
    measured: Measured,
    format: Format,
}

/// Reads the file, says what it holds, and writes what was asked for.
pub(super) fn bsdf(options: &BsdfOptions) -> Result<i32> {
    let outputs: [(_, _, &[&str]); 4] = [
        ("lobes", &options.lobes, drawing::ENDINGS),
        ("map", &options.map, drawing::ENDINGS),
        ("output", &options.output, &["gbsdf"]),
        ("material", &options.material, &["usda"]),
    ];
    for (option, path, expected) in outputs {
        path.as_deref().map_or(Ok(()), |path| check_ending(option, path, expected))?;
    }
    let loaded = load(&options.file)?;
    let name = options.file.file_name().unwrap_or_default().to_string_lossy();
    let mut description = describe::as_json(&options.file, &loaded);
    if let Some(path) = &options.lobes {
        write(path, &drawing::encoded(lobe_diagram(&loaded.measured, &name), path)?)?;
    }
    if let Some(path) = &options.map {
        write(path, &drawing::encoded(lobe_map(&loaded.measured, &name), path)?)?;
    }
    if let Some(path) = &options.output {
        description["conversion"] = convert::convert(options, &loaded.measured, &name, path)?;
    }
    if options.fit || options.material.is_some() {
        let found = loaded.measured.fit().map_err(|error| Error::in_file(&options.file, &error))?;
        if let Some(path) = &options.material {
            write(path, fit::as_usda(&found, &name, &fit::asset_path(path, &options.file)?).as_bytes())?;
        }
        description["fit"] = fit::as_json(&found);
    }
    if options.json {
        print(&description.to_string());
    } else {
        as_text(&description).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// Everything that was found, line by line.
fn as_text(description: &Value) -> Vec<String> {
    let mut lines = describe::as_text(description);
    lines.extend(convert::as_text(&description["conversion"]));
    lines.extend(fit::as_text(&description["fit"]));
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| line.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()).collect()
}

fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    write_atomically(path, true, |file| file.write_all(bytes))
}

fn load(path: &Path) -> Result<Loaded> {
    let bytes = file::read(path, LONGEST, "measured material's file")?;
    let name = path.to_string_lossy();
    let measured = read(&bytes, &name).map_err(|error| Error::in_file(path, &error))?;
    let format = Format::of(&bytes, &name).unwrap_or(Format::Gbsdf);
    Ok(Loaded { measured, format })
}
