//! `gonio bsdf`.

mod convert;
mod describe;
mod fit;
mod sample;

use super::{
    arguments::BsdfOptions,
    drawing,
    file::{self, check_ending, check_targets, ending, put},
    messages::print,
};
use gonio::{Error, Result};
use gonio_formats::{
    bsdf::{Format, Measured, lobe_diagram, lobe_map, read},
    tame,
};
use pyo3::Python;
use serde_json::Value;
use std::{path::Path, sync::atomic::AtomicBool};

/// The longest file in bytes: a spectral anisotropic measurement of RGL takes 100 MB.
const LONGEST: u64 = 2 << 30;

/// A measured material and the format that it came in.
struct Loaded {
    measured: Measured,
    format: Format,
}

/// Reads the file or measures the sample, says what it holds, and writes what was asked for.
pub(super) fn bsdf(py: Python<'_>, options: &BsdfOptions, interrupted: &'static AtomicBool) -> Result<i32> {
    let outputs: [(_, _, &[&str]); 4] = [
        ("lobes", &options.lobes, drawing::ENDINGS),
        ("map", &options.map, drawing::ENDINGS),
        ("output", &options.output, &["gbsdf", "xml"]),
        ("material", &options.material, &["usda"]),
    ];
    for (option, path, expected) in outputs {
        path.as_deref().map_or(Ok(()), |path| check_ending(option, path, expected))?;
        check_targets(path)?;
    }
    match (&options.file, &options.sample.sample) {
        // Were they in conflict for the parser, what wants a sample would pass with a file.
        (Some(_), Some(_)) => Err(Error::setting("sample", "it is measured in the place of a file; both were named")),
        (Some(file), None) => py.detach(|| told(options, file, file, &load(file)?, Value::Null)),
        (None, Some(stage)) => {
            if options.material.is_some() && options.output.is_none() {
                return Err(Error::setting("material", "it names the measurement's file, expected -o too"));
            }
            let (loaded, reading) = sample::measured(py, &options.sample, stage, interrupted)?;
            let file = options.output.as_ref().unwrap_or(stage);
            py.detach(|| told(options, stage, file, &loaded, reading))
        }
        (None, None) => Err(Error::setting("file", "nothing to read was named")),
    }
}

/// Says what was loaded from somewhere, and writes what was asked for; materials name `file`.
fn told(options: &BsdfOptions, from: &Path, file: &Path, loaded: &Loaded, reading: Value) -> Result<i32> {
    let name = from.file_name().unwrap_or_default().to_string_lossy();
    let mut description = describe::as_json(from, loaded);
    if !reading.is_null() {
        description["sample"] = reading;
    }
    if let Some(path) = &options.lobes {
        put(path, &drawing::encoded(lobe_diagram(&loaded.measured, &name), path)?)?;
    }
    if let Some(path) = &options.map {
        put(path, &drawing::encoded(lobe_map(&loaded.measured, &name), path)?)?;
    }
    if let Some(path) = &options.output {
        description["conversion"] = convert::convert(options, &loaded.measured, &name, path)?;
    }
    if options.fit || options.material.is_some() {
        let found = loaded.measured.fit().map_err(|error| Error::in_file(from, &error))?;
        if let Some(path) = &options.material {
            put(path, fit::as_usda(&found, &name, &fit::asset_path(path, file)?).as_bytes())?;
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
    let mut lines = sample::as_text(&description["sample"]);
    lines.extend(describe::as_text(description));
    lines.extend(convert::as_text(&description["conversion"]));
    lines.extend(fit::as_text(&description["fit"]));
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| tame(line)).collect()
}

fn load(path: &Path) -> Result<Loaded> {
    let bytes = file::read(path, LONGEST, "measured material's file")?;
    let name = path.to_string_lossy();
    let measured = read(&bytes, &name).map_err(|error| Error::in_file(path, &error))?;
    let format = Format::of(&bytes, &name).unwrap_or(Format::Gbsdf);
    Ok(Loaded { measured, format })
}
