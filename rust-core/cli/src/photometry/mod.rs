//! `gonio photometry`.

mod fixture;
mod fixture_json;
mod json;
mod product;
mod product_json;
mod text;
pub(super) mod ugr;

pub(super) use json::aside_json;
pub(super) use text::{as_text, aside, opening, shape_name, symmetry_name};

use super::{
    arguments::{PhotometryOptions, SymmetryName},
    drawing,
    file::{self, check_ending, check_targets, ending, put},
    messages::print,
    words::Words,
};
use gonio::{Error, Result};
use gonio_formats::FormatError;
use gonio_formats::gdtf::{self, Gdtf};
use gonio_formats::gldf::{self, Gldf, split_variant};
use gonio_formats::photometry::{
    Goniogram, PolarUnit, SPACINGS, Symmetry, UgrTable, beside, cone_diagram, ies, ldt, polar_diagram, read_variant, tm33,
};
use json::as_json;
use std::path::Path;

/// The longest file in bytes: hundreds of times the longest luminaire's.
const LONGEST: u64 = 256 << 20;

/// Reads the file, says what it holds, and writes what was asked for.
pub(super) fn photometry(options: &PhotometryOptions) -> Result<i32> {
    for (option, path, endings) in outputs(options) {
        check_ending(option, path, endings)?;
    }
    check_targets([&options.polar, &options.cone, &options.convert].into_iter().flatten())?;
    let (path, variant) = chosen(options);
    let bytes = file::read(path, LONGEST, "luminaire's file")?;
    if gldf::looks_like(&bytes) && variant.is_none() && !options.ugr_table && outputs(options).next().is_none() {
        return list(path, &bytes, options.json);
    }
    let mut goniogram = load(options, path, variant, &bytes)?;
    let figures = goniogram.figures();
    for (option, path, _) in outputs(options) {
        let bytes = match option {
            "polar" => drawing::encoded(polar_diagram(&goniogram, PolarUnit::CandelaPerKilolumen), path)?,
            "cone" => drawing::encoded(cone_diagram(&goniogram), path)?,
            _ => converted(&mut goniogram, path),
        };
        put(path, &bytes)?;
    }
    let table = options.ugr_table.then(|| ugr_table(&goniogram, options)).transpose()?;
    if options.json {
        print(&as_json(options, &goniogram, &figures, table.as_ref()).to_string());
    } else if let Some(table) = table {
        ugr::as_text(&goniogram, &table).iter().for_each(|line| print(line));
    } else {
        as_text(&goniogram, &figures, options.front, Words::english()).iter().for_each(|line| print(line));
    }
    Ok(0)
}

/// The luminaire in the format of an ending; what that has no place for is told.
fn converted(goniogram: &mut Goniogram, path: &Path) -> Vec<u8> {
    let ending = ending(path);
    if ending == "xml" {
        return tm33::write(goniogram, false);
    }
    let bytes = if ending == "ldt" { ldt::write(goniogram) } else { ies::write(goniogram) };
    if goniogram.spectrum.is_some() {
        let told = format!("a .{ending} file has no place for the spectrum: it is left out there, .xml (TM-33) has it");
        goniogram.warnings.push(FormatError::whole(told));
    }
    bytes
}

/// The file, and the variant of it that was asked for.
fn chosen(options: &PhotometryOptions) -> (&Path, Option<&str>) {
    let (path, variant) = options.file.to_str().map_or((options.file.as_path(), None), |path| {
        let (path, variant) = split_variant(path);
        (Path::new(path), variant)
    });
    (path, options.variant.as_deref().or(variant))
}

/// Whether a file is a product or a fixture by its ending.
pub(super) fn is_product(path: &Path) -> bool {
    ["gldf", "gdtf"].contains(&ending(path).as_str())
}

/// Lists the variants of a product's file, or the modes of a fixture's.
pub(super) fn info(path: &Path, json: bool) -> Result<i32> {
    list(path, &file::read(path, LONGEST, "luminaire's file")?, json)
}

/// Lists the variants of a product, or the modes of a fixture.
fn list(path: &Path, bytes: &[u8], json: bool) -> Result<i32> {
    if gdtf::is_fixture(bytes, &path.to_string_lossy()) {
        let fixture = Gdtf::read(bytes).map_err(|error| Error::in_file(path, &error))?;
        if json {
            print(&fixture_json::as_json(path, &fixture).to_string());
        } else {
            fixture::as_text(&fixture).iter().for_each(|line| print(line));
        }
        return Ok(0);
    }
    let product = Gldf::read(bytes).map_err(|error| Error::in_file(path, &error))?;
    if json {
        print(&product_json::as_json(path, &product).to_string());
    } else {
        product::as_text(&product).iter().for_each(|line| print(line));
    }
    Ok(0)
}

fn ugr_table(goniogram: &Goniogram, options: &PhotometryOptions) -> Result<UgrTable> {
    goniogram.ugr_table(options.shr).map_err(|error| {
        let is_spacing = !(SPACINGS[0]..=SPACINGS[1]).contains(&options.shr);
        if is_spacing { Error::Setting { name: "shr".into(), problem: error.problem } } else { Error::in_file(&options.file, &error) }
    })
}

/// The files asked for, with their option and the endings it takes.
fn outputs(options: &PhotometryOptions) -> impl Iterator<Item = (&'static str, &Path, &'static [&'static str])> {
    let all: [(_, _, &'static [&'static str]); 3] = [
        ("polar", &options.polar, drawing::ENDINGS),
        ("cone", &options.cone, drawing::ENDINGS),
        ("convert", &options.convert, &["ies", "ldt", "xml"]),
    ];
    all.into_iter().filter_map(|(option, path, endings)| Some((option, path.as_deref()?, endings)))
}

/// The file's goniogram, for the lamps and with the turn that were asked for.
fn load(options: &PhotometryOptions, path: &Path, variant: Option<&str>, bytes: &[u8]) -> Result<Goniogram> {
    let read = read_variant(bytes, &path.to_string_lossy(), variant, &mut beside(path));
    let mut goniogram = read.map_err(|error| Error::in_file(path, &error))?;
    if let Some(number) = options.lamp_set {
        let chosen = goniogram.with_lamp_set(number as usize - 1);
        goniogram = chosen.map_err(|error| Error::Setting { name: "lamp-set".into(), problem: error.problem })?;
    }
    goniogram = goniogram.tilted(options.tilt).map_err(|error| Error::Setting { name: "tilt".into(), problem: error.problem })?;
    if let Some(degrees) = options.rotate {
        if !degrees.is_finite() {
            return Err(Error::Setting { name: "rotate".into(), problem: format!("{degrees} was found, expected degrees") });
        }
        goniogram = goniogram.rotated(degrees);
    }
    Ok(match options.symmetry {
        Some(name) => goniogram.symmetrised(name.into()),
        None => goniogram,
    })
}

impl From<SymmetryName> for Symmetry {
    fn from(name: SymmetryName) -> Self {
        match name {
            SymmetryName::None => Self::None,
            SymmetryName::Rotational => Self::Rotational,
            SymmetryName::C0 => Self::AboutC0,
            SymmetryName::C90 => Self::AboutC90,
            SymmetryName::Quadrants => Self::Quadrants,
        }
    }
}
