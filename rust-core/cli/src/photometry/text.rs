//! What a luminaire's file holds, for readers.

use gonio_formats::{
    photometry::{Aside, Figures, Goniogram, LampSet, Opening, OpeningShape, PhotometricType, Spread, Symmetry, Tilt},
    spectrum::SpectralPower,
    tame,
};

/// CIE flux codes as they are written: whole per cent.
pub(super) fn percents(codes: [f64; 5]) -> [i64; 5] {
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
pub(crate) fn as_text(goniogram: &Goniogram, figures: &Figures, front: Option<f64>) -> Vec<String> {
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
    lines.extend(figures.aside.as_ref().map(aside));
    lines.extend(classes(goniogram, front));
    lines.push(format!("opening: {}", opening(&goniogram.opening)));
    for (index, set) in goniogram.lamp_sets.iter().enumerate() {
        let here = if index == goniogram.lamp_set && goniogram.lamp_sets.len() > 1 { " (in use)" } else { "" };
        lines.push(format!("lamp set {}{here}: {}", index + 1, lamps(set)));
    }
    lines.extend(goniogram.tilt.as_ref().map(tilt));
    lines.extend(goniogram.spectrum.as_ref().map(spectrum));
    lines.extend(goniogram.warnings.iter().map(|warning| format!("warning: {warning}")));
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| tame(line)).collect()
}

fn spectrum(found: &SpectralPower) -> String {
    let [first, last] = [found.wavelengths_nm.first(), found.wavelengths_nm.last()].map(|nm| nm.copied().unwrap_or(0.0));
    format!("spectrum: {} points from {first} to {last} nm (gonio spectrum has its figures)", found.power.len())
}

fn spreads([c0, c90]: &[Spread; 2]) -> String {
    let about = if c0.up { ", about zenith" } else { "" };
    format!("{:.1}° in C0–C180, {:.1}° in C90–C270{about}", c0.angle(), c90.angle())
}

/// A beam whose axis is in none of the planes that stand above.
pub(crate) fn aside(aside: &Aside) -> String {
    let [c, across] = [aside.c, (aside.c + 180.0).rem_euclid(360.0)];
    let [beam, field] = [aside.beam, aside.field].map(|spread| spread.angle());
    format!("the beam's axis lies in neither plane: {beam:.1}° (50 %) and {field:.1}° (10 %) in C{c}–C{across}")
}

/// The opening of a file.
pub(crate) fn opening(opening: &Opening) -> String {
    let [x, y, z] = opening.size;
    match opening.shape {
        OpeningShape::Point => shape_name(opening.shape).to_owned(),
        OpeningShape::Box if opening.heights.iter().any(|height| *height != z) => {
            let [c0, c90, c180, c270] = opening.heights;
            let sides = format!("{c0:.3}, {c90:.3}, {c180:.3}, {c270:.3} m high towards C0, C90, C180, C270");
            format!("{}, {x:.3} m along C0, {y:.3} m along C90, {sides}", shape_name(opening.shape))
        }
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

pub(super) fn type_name(photometric_type: PhotometricType) -> &'static str {
    match photometric_type {
        PhotometricType::A => "A",
        PhotometricType::B => "B",
        PhotometricType::C => "C",
    }
}

pub(crate) fn symmetry_name(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::None => "no symmetry",
        Symmetry::Rotational => "rotational",
        Symmetry::AboutC0 => "about C0-C180",
        Symmetry::AboutC90 => "about C90-C270",
        Symmetry::Quadrants => "quadrants",
    }
}

pub(crate) fn shape_name(shape: OpeningShape) -> &'static str {
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
