//! What a luminaire's file holds, for readers.

use crate::words::{FileWords, Words};
use gonio_formats::{
    photometry::{Aside, Figures, Goniogram, LampSet, Opening, OpeningShape, PhotometricType, Spread, Symmetry, Tilt},
    spectrum::SpectralPower,
    tame,
};
use gonio_page::fill;

/// CIE flux codes as they are written: whole per cent.
pub(super) fn percents(codes: [f64; 5]) -> [i64; 5] {
    codes.map(|code| (100.0 * code).round() as i64)
}

/// Flux codes, and the rating as an outdoor luminaire with the street on its side C(`front`).
fn classes(goniogram: &Goniogram, front: Option<f64>, say: &FileWords) -> Vec<String> {
    let Some(codes) = goniogram.flux_codes() else { return Vec::new() };
    let front = front.unwrap_or_else(|| goniogram.street_side());
    let rating = goniogram.zones(front).rating(goniogram.is_square());
    vec![
        fill(&say.codes, &[("codes", &percents(codes).map(|code| code.to_string()).join(" "))]),
        fill(&say.rating, &[("rating", &rating.to_string()), ("front", &front.to_string())]),
    ]
}

/// What a file says, line by line; `front` is the C plane that faces a street, the format's own without it.
pub(crate) fn as_text(goniogram: &Goniogram, figures: &Figures, front: Option<f64>, words: &Words) -> Vec<String> {
    let say = &words.file;
    let named = ["MANUFAC", "LUMINAIRE", "LUMCAT", "TEST", "DATE"].into_iter().zip(&say.texts);
    let mut lines: Vec<String> = named.filter_map(|(keyword, name)| Some(format!("{name}: {}", goniogram.text(keyword)?))).collect();
    lines.extend(light(goniogram, figures, words));
    lines.extend(figures.aside.as_ref().map(|of| aside(of, words)));
    lines.extend(classes(goniogram, front, say));
    lines.push(fill(&say.opening, &[("opening", &opening(&goniogram.opening, words))]));
    for (index, set) in goniogram.lamp_sets.iter().enumerate() {
        let here = if index == goniogram.lamp_set && goniogram.lamp_sets.len() > 1 { say.in_use.as_str() } else { "" };
        lines.push(fill(&say.lamp_set, &[("number", &(index + 1).to_string()), ("in_use", here), ("lamps", &lamps(set, words))]));
    }
    lines.extend(goniogram.tilt.as_ref().map(|of| tilt(of, words)));
    lines.extend(goniogram.spectrum.as_ref().map(|of| spectrum(of, words)));
    lines.extend(goniogram.warnings.iter().map(|warning| fill(&say.warning, &[("warning", &warning.to_string())])));
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| tame(line)).collect()
}

/// Angles that were measured, flux, power, and where the light goes.
fn light(goniogram: &Goniogram, figures: &Figures, words: &Words) -> Vec<String> {
    let (say, numbers) = (&words.file, words.numbers);
    let ratio =
        figures.light_output_ratio.map_or(String::new(), |ratio| fill(&say.ratio, &[("percent", &numbers.fixed(ratio * 100.0, 1))]));
    let [c, gamma] = figures.peak_direction.map(|angle| numbers.form(&angle.to_string()));
    let power = figures.watts.zip(figures.efficacy).map(|(watts, efficacy)| {
        fill(&say.power, &[("watts", &numbers.form(&watts.to_string())), ("efficacy", &numbers.fixed(efficacy, 1))])
    });
    let measured = [
        ("type", type_name(goniogram.photometric_type)),
        ("stated", say.name(symmetry_name(goniogram.symmetry))),
        ("planes", &goniogram.horizontal.len().to_string()),
        ("angles", &goniogram.vertical.len().to_string()),
        ("found", say.name(symmetry_name(figures.symmetry))),
    ];
    let down = numbers.fixed(figures.downward_fraction * 100.0, 1);
    let mut lines = vec![
        fill(&say.photometry, &measured),
        fill(&say.flux, &[("flux", &numbers.fixed(figures.flux, 1)), ("ratio", &ratio), ("down", &down)]),
    ];
    lines.extend(power);
    lines.push(fill(&say.peak, &[("peak", &numbers.fixed(figures.peak, 1)), ("c", &c), ("gamma", &gamma)]));
    lines.push(fill(&say.beam, &[("spreads", &spreads(&figures.beam, words))]));
    lines.push(fill(&say.field, &[("spreads", &spreads(&figures.field, words))]));
    lines
}

fn spectrum(found: &SpectralPower, words: &Words) -> String {
    let [first, last] = [found.wavelengths_nm.first(), found.wavelengths_nm.last()].map(|nm| nm.copied().unwrap_or(0.0));
    let [first, last] = [first, last].map(|nm| words.numbers.form(&nm.to_string()));
    fill(&words.file.spectrum, &[("count", &found.power.len().to_string()), ("first", &first), ("last", &last)])
}

fn spreads([c0, c90]: &[Spread; 2], words: &Words) -> String {
    let zenith = if c0.up { words.file.zenith.as_str() } else { "" };
    let [c0, c90] = [c0, c90].map(|spread| words.numbers.fixed(spread.angle(), 1));
    fill(&words.file.spreads, &[("c0", &c0), ("c90", &c90), ("zenith", zenith)])
}

/// A beam whose axis is in none of the planes that stand above.
pub(crate) fn aside(aside: &Aside, words: &Words) -> String {
    let [c, across] = [aside.c, (aside.c + 180.0).rem_euclid(360.0)].map(|angle| words.numbers.form(&angle.to_string()));
    let [beam, field] = [aside.beam, aside.field].map(|spread| words.numbers.fixed(spread.angle(), 1));
    fill(&words.file.aside, &[("beam", &beam), ("field", &field), ("c", &c), ("across", &across)])
}

/// The opening of a file.
pub(crate) fn opening(opening: &Opening, words: &Words) -> String {
    let say = &words.file;
    let shape = say.name(shape_name(opening.shape));
    let [x, y, z] = opening.size.map(|length| words.numbers.fixed(length, 3));
    match opening.shape {
        OpeningShape::Point => shape.to_owned(),
        OpeningShape::Box if opening.heights.iter().any(|height| *height != opening.size[2]) => {
            let [c0, c90, c180, c270] = opening.heights.map(|height| words.numbers.fixed(height, 3));
            let sides = [("c0", c0.as_str()), ("c90", &c90), ("c180", &c180), ("c270", &c270), ("shape", shape), ("x", &x), ("y", &y)];
            fill(&say.extent_of_sides, &sides)
        }
        _ => fill(&say.extent, &[("shape", shape), ("x", &x), ("y", &y), ("z", &z)]),
    }
}

fn lamps(set: &LampSet, words: &Words) -> String {
    let (say, numbers) = (&words.file, words.numbers);
    let flux = set.flux.map_or(say.no_flux.clone(), |flux| numbers.form(&format!("{flux} lm")));
    let kind = if set.absolute { &say.absolute } else { &say.relative };
    let texts = [set.name.as_str(), &flux, kind, &set.colour, &set.colour_rendering];
    let texts: Vec<&str> = texts.into_iter().filter(|text| !text.is_empty()).collect();
    let (count, watts) = (set.count.to_string(), numbers.form(&set.watts.to_string()));
    fill(&say.lamps, &[("count", &count), ("texts", &texts.join(", ")), ("watts", &watts)])
}

fn tilt(tilt: &Tilt, words: &Words) -> String {
    let [first, last] = [tilt.angles.first(), tilt.angles.last()].map(|angle| angle.copied().unwrap_or(0.0));
    let least = tilt.factors.iter().copied().fold(f64::INFINITY, f64::min);
    let [first, last, least] = [first, last, least].map(|number| words.numbers.form(&number.to_string()));
    fill(&words.file.tilt, &[("first", &first), ("last", &last), ("least", &least)])
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
