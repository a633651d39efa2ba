//! `gonio photometry`.

pub(super) mod ugr;

use super::{
    arguments::{PhotometryOptions, SymmetryName},
    drawing,
    file::{self, check_ending, ending},
    print,
};
use gonio::{Error, Result, output::write_atomically};
use gonio_formats::photometry::{
    Figures, Goniogram, LampSet, Opening, OpeningShape, PhotometricType, PolarUnit, SPACINGS, Spread, Symmetry, Tilt, UgrTable, beside,
    cone_diagram, ies, ldt, polar_diagram, read_with,
};
use serde_json::{Value, json};
use std::io::Write;
use std::path::Path;

/// The longest file in bytes: hundreds of times the longest luminaire's.
const LONGEST: u64 = 256 << 20;

/// Reads the file, says what it holds, and writes what was asked for.
pub(super) fn photometry(options: &PhotometryOptions) -> Result<i32> {
    for (option, path, endings) in outputs(options) {
        check_ending(option, path, endings)?;
    }
    let goniogram = load(options)?;
    let figures = goniogram.figures();
    for (option, path, _) in outputs(options) {
        let bytes = match option {
            "polar" => drawing::encoded(polar_diagram(&goniogram, PolarUnit::CandelaPerKilolumen), path)?,
            "cone" => drawing::encoded(cone_diagram(&goniogram), path)?,
            _ if ending(path) == "ldt" => ldt::write(&goniogram),
            _ => ies::write(&goniogram),
        };
        write_atomically(path, true, |file| file.write_all(&bytes))?;
    }
    let table = options.ugr_table.then(|| ugr_table(&goniogram, options)).transpose()?;
    if options.json {
        print(&as_json(options, &goniogram, &figures, table.as_ref()).to_string());
    } else if let Some(table) = table {
        ugr::as_text(&goniogram, &table).iter().for_each(|line| print(line));
    } else {
        as_text(&goniogram, &figures, options.front).iter().for_each(|line| print(line));
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
        ("convert", &options.convert, &["ies", "ldt"]),
    ];
    all.into_iter().filter_map(|(option, path, endings)| Some((option, path.as_deref()?, endings)))
}

/// The file's goniogram, for the lamps and with the turn that were asked for.
fn load(options: &PhotometryOptions) -> Result<Goniogram> {
    let path = &options.file;
    let bytes = file::read(path, LONGEST, "luminaire's file")?;
    let mut goniogram = read_with(&bytes, &path.to_string_lossy(), &mut beside(path)).map_err(|error| Error::in_file(path, &error))?;
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

fn as_json(options: &PhotometryOptions, goniogram: &Goniogram, figures: &Figures, table: Option<&UgrTable>) -> Value {
    let front = options.front.unwrap_or_else(|| goniogram.street_side());
    let zones = goniogram.zones(front);
    json!({
        "file": options.file.to_string_lossy(),
        "photometric_type": type_name(goniogram.photometric_type),
        "symmetry": symmetry_name(goniogram.symmetry),
        "symmetry_found": symmetry_name(figures.symmetry),
        "planes": goniogram.horizontal.len(),
        "angles": goniogram.vertical.len(),
        "flux_lm": figures.flux,
        "downward_fraction": figures.downward_fraction,
        "light_output_ratio": figures.light_output_ratio,
        "watts": figures.watts,
        "efficacy_lm_per_w": figures.efficacy,
        "peak_cd": figures.peak,
        "peak_direction_deg": figures.peak_direction,
        "beam_angle_deg": figures.beam.map(|spread| spread.angle()),
        "field_angle_deg": figures.field.map(|spread| spread.angle()),
        "cie_flux_codes": goniogram.flux_codes().map(percents),
        "bug": zones.rating(goniogram.is_square()).to_string(),
        "zones_lm": json!({ "forward": zones.forward, "back": zones.back, "up": zones.up, "front_deg": front }),
        "ugr_table": table.map(ugr::as_json),
        "opening": json!({
            "shape": shape_name(goniogram.opening.shape),
            "size_m": goniogram.opening.size,
            "heights_m": goniogram.opening.heights,
        }),
        "lamp_set": goniogram.lamp_set + 1,
        "lamp_sets": goniogram.lamp_sets.iter().map(lamps_json).collect::<Vec<_>>(),
        "tilt": goniogram.tilt.as_ref().map(|tilt| json!({
            "lamp_to_luminaire": tilt.lamp_to_luminaire,
            "angles_deg": tilt.angles,
            "factors": tilt.factors,
        })),
        "header": goniogram.header.iter().map(|line| [&line.keyword, &line.text]).collect::<Vec<_>>(),
        "warnings": goniogram.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

fn lamps_json(set: &LampSet) -> Value {
    json!({
        "count": set.count,
        "name": set.name,
        "flux_lm": set.flux,
        "absolute": set.absolute,
        "watts": set.watts,
        "colour": set.colour,
        "colour_rendering": set.colour_rendering,
    })
}

/// CIE flux codes as they are written: whole per cent.
fn percents(codes: [f64; 5]) -> [i64; 5] {
    codes.map(|code| (100.0 * code).round() as i64)
}

/// Flux codes, and the rating as an outdoor luminaire with the street on its side C(`front`).
fn classes(goniogram: &Goniogram, front: Option<f64>) -> Vec<String> {
    let Some(codes) = goniogram.flux_codes() else { return Vec::new() };
    let front = front.unwrap_or_else(|| goniogram.street_side());
    let rating = goniogram.zones(front).rating(goniogram.is_square());
    vec![
        format!("CIE flux codes: {}", percents(codes).map(|code| code.to_string()).join(" ")),
        format!("BUG rating outdoors (IES TM-15-11): {rating}, with the street at C{front}"),
    ]
}

/// What a file says, line by line; `front` is the C plane that faces a street, the format's own without it.
pub(super) fn as_text(goniogram: &Goniogram, figures: &Figures, front: Option<f64>) -> Vec<String> {
    let mut lines = Vec::new();
    for (keyword, name) in
        [("MANUFAC", "manufacturer"), ("LUMINAIRE", "luminaire"), ("LUMCAT", "number"), ("TEST", "test"), ("DATE", "date")]
    {
        lines.extend(goniogram.text(keyword).map(|text| format!("{name}: {text}")));
    }
    lines.push(format!(
        "photometry: type {}, {}, {} planes of {} angles; found: {}",
        type_name(goniogram.photometric_type),
        symmetry_name(goniogram.symmetry),
        goniogram.horizontal.len(),
        goniogram.vertical.len(),
        symmetry_name(figures.symmetry)
    ));
    let ratio = figures.light_output_ratio.map_or(String::new(), |ratio| format!(", {:.1} % of the lamps'", ratio * 100.0));
    lines.push(format!("flux: {:.1} lm{ratio}, {:.1} % of it down", figures.flux, figures.downward_fraction * 100.0));
    if let Some((watts, efficacy)) = figures.watts.zip(figures.efficacy) {
        lines.push(format!("power: {watts} W, {efficacy:.1} lm/W"));
    }
    let [c, gamma] = figures.peak_direction;
    lines.push(format!("peak: {:.1} cd at C {c}°, γ {gamma}°", figures.peak));
    lines.push(format!("beam angle (50 %): {}", spreads(&figures.beam)));
    lines.push(format!("field angle (10 %): {}", spreads(&figures.field)));
    lines.extend(classes(goniogram, front));
    lines.push(format!("opening: {}", opening(&goniogram.opening)));
    for (index, set) in goniogram.lamp_sets.iter().enumerate() {
        let here = if index == goniogram.lamp_set && goniogram.lamp_sets.len() > 1 { " (in use)" } else { "" };
        lines.push(format!("lamp set {}{here}: {}", index + 1, lamps(set)));
    }
    lines.extend(goniogram.tilt.as_ref().map(tilt));
    lines.extend(goniogram.warnings.iter().map(|warning| format!("warning: {warning}")));
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| line.chars().map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect()).collect()
}

fn spreads([c0, c90]: &[Spread; 2]) -> String {
    let about = if c0.up { ", about zenith" } else { "" };
    format!("{:.1}° in C0–C180, {:.1}° in C90–C270{about}", c0.angle(), c90.angle())
}

fn opening(opening: &Opening) -> String {
    let [x, y, z] = opening.size;
    match opening.shape {
        OpeningShape::Point => shape_name(opening.shape).to_owned(),
        shape => format!("{}, {x:.3} m along C0, {y:.3} m along C90, {z:.3} m high", shape_name(shape)),
    }
}

fn lamps(set: &LampSet) -> String {
    let flux = set.flux.map_or("no flux stated".to_owned(), |flux| format!("{flux} lm"));
    let kind = if set.absolute { "absolute" } else { "relative" };
    let texts = [set.name.as_str(), flux.as_str(), kind, set.colour.as_str(), set.colour_rendering.as_str()];
    let texts: Vec<&str> = texts.into_iter().filter(|text| !text.is_empty()).collect();
    format!("{} × {}, {} W", set.count, texts.join(", "), set.watts)
}

fn tilt(tilt: &Tilt) -> String {
    let [first, last] = [tilt.angles.first(), tilt.angles.last()].map(|angle| angle.copied().unwrap_or(0.0));
    let least = tilt.factors.iter().copied().fold(f64::INFINITY, f64::min);
    format!("factors by tilt from {first}° to {last}°, {least} at least; --tilt applies them")
}

fn type_name(photometric_type: PhotometricType) -> &'static str {
    match photometric_type {
        PhotometricType::A => "A",
        PhotometricType::B => "B",
        PhotometricType::C => "C",
    }
}

fn symmetry_name(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::None => "no symmetry",
        Symmetry::Rotational => "rotational",
        Symmetry::AboutC0 => "about C0-C180",
        Symmetry::AboutC90 => "about C90-C270",
        Symmetry::Quadrants => "quadrants",
    }
}

fn shape_name(shape: OpeningShape) -> &'static str {
    match shape {
        OpeningShape::Point => "point",
        OpeningShape::Rectangle => "rectangle",
        OpeningShape::Box => "box",
        OpeningShape::Disk => "disk",
        OpeningShape::VerticalCylinder => "vertical cylinder",
        OpeningShape::CylinderAlongX => "cylinder along C0",
        OpeningShape::CylinderAlongY => "cylinder along C90",
        OpeningShape::Ellipsoid => "ellipsoid",
        OpeningShape::DiskFacingX => "disk facing C0",
        OpeningShape::DiskFacingY => "disk facing C90",
    }
}
