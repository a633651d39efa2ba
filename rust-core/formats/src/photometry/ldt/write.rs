//! The writer.

use crate::photometry::check::TOLERANCE;
use crate::photometry::text::{encode, number, one_line};
use crate::photometry::{Goniogram, OpeningShape, PhotometricType, Symmetry};
use std::borrow::Cow;

/// How many times longer than wide a linear luminaire is at least.
const LINEAR: f64 = 4.0;

/// Writes EULUMDAT for the lamp set the goniogram is for, the others beside it as alternatives; ISO 8859-1, numbers of ten digits.
///
/// Photometric types A and B are resampled to type C. Lamps without a flux of their own become absolute photometry: the luminaire's flux
/// with a negative number of lamps. The light output ratio and the downward fraction are the stated ones where the intensities bear them out
/// within 2 %, else the intensities' own; direct ratios that are not stated are reckoned.
pub fn write(goniogram: &Goniogram) -> Vec<u8> {
    let goniogram = match goniogram.photometric_type {
        PhotometricType::C => Cow::Borrowed(goniogram),
        _ => Cow::Owned(goniogram.to_type_c()),
    };
    let (planes, stored) = planes(&goniogram);
    let flux = reference_flux(&goniogram);
    let mut lines = head(&goniogram, &planes);
    lines.extend(geometry(&goniogram, flux));
    lines.extend(lamp_sets(&goniogram, flux));
    lines.extend(goniogram.stated.direct_ratios.unwrap_or_else(|| rounded(goniogram.direct_ratios())).map(number));
    lines.extend(planes.iter().chain(&goniogram.vertical).map(|angle| number(*angle)));
    for plane in stored {
        lines.extend(plane.iter().map(|intensity| number(intensity * 1000.0 / flux)));
    }
    encode(&(lines.join("\r\n") + "\r\n"))
}

/// The flux in lm that cd/klm are for.
fn reference_flux(goniogram: &Goniogram) -> f64 {
    let flux = goniogram.lamps().and_then(|lamps| lamps.flux).unwrap_or_else(|| goniogram.flux());
    if flux > 0.0 { flux } else { 1000.0 }
}

/// All C planes' angles, and the intensities of those that are stored.
fn planes(goniogram: &Goniogram) -> (Vec<f64>, Vec<Vec<f64>>) {
    let mut all = goniogram.expanded().horizontal;
    // The circle's end is its beginning.
    all.pop();
    let within = |low: f64, high: f64| all.iter().copied().filter(move |c| (low..=high).contains(c));
    let wanted: Vec<f64> = match goniogram.symmetry {
        Symmetry::Rotational => vec![0.0],
        Symmetry::None => all.clone(),
        Symmetry::AboutC0 => within(0.0, 180.0).collect(),
        Symmetry::AboutC90 => within(270.0, 360.0).chain(within(0.0, 90.0)).collect(),
        Symmetry::Quadrants => within(0.0, 90.0).collect(),
    };
    if goniogram.symmetry == Symmetry::Rotational {
        all = vec![0.0];
    }
    let plane = |c: &f64| goniogram.vertical.iter().map(|gamma| goniogram.intensity_at(*c, *gamma)).collect();
    (all, wanted.iter().map(plane).collect())
}

/// The common step of angles, or 0.
fn step(angles: &[f64]) -> f64 {
    let step = angles.get(1).zip(angles.first()).map_or(0.0, |(second, first)| second - first);
    let uniform = angles.windows(2).all(|pair| (pair[1] - pair[0] - step).abs() < 1e-6);
    if uniform { step } else { 0.0 }
}

fn head(goniogram: &Goniogram, planes: &[f64]) -> Vec<String> {
    let symmetry = match goniogram.symmetry {
        Symmetry::None => 0,
        Symmetry::Rotational => 1,
        Symmetry::AboutC0 => 2,
        Symmetry::AboutC90 => 3,
        Symmetry::Quadrants => 4,
    };
    // Of 1 to 3, whatever the symmetry: programs refuse others, and cut linear luminaires alone into pieces.
    let kind = match goniogram.symmetry {
        Symmetry::Rotational => 1,
        _ if is_linear(goniogram) => 2,
        _ => 3,
    };
    let text = |keyword: &str| one_line(goniogram.text(keyword).unwrap_or_default());
    vec![
        text("MANUFAC"),
        kind.to_string(),
        symmetry.to_string(),
        planes.len().to_string(),
        number(step(planes)),
        goniogram.vertical.len().to_string(),
        number(step(&goniogram.vertical)),
        text("TEST"),
        text("LUMINAIRE"),
        text("LUMCAT"),
        text("FILE"),
        one_line(goniogram.text("DATE").or_else(|| goniogram.text("ISSUEDATE")).unwrap_or_default()),
    ]
}

/// Whether what shines, or the luminaire where nothing is said of that, is far longer than it is wide.
fn is_linear(goniogram: &Goniogram) -> bool {
    let ([x, y, _], [length, width, _]) = (goniogram.opening.size, goniogram.body);
    let [a, b] = match goniogram.opening.shape {
        OpeningShape::Rectangle | OpeningShape::Box | OpeningShape::CylinderAlongX | OpeningShape::CylinderAlongY => [x, y],
        // A width of 0 is round.
        OpeningShape::Point if width > 0.0 => [length, width],
        _ => return false,
    };
    a.max(b) > LINEAR * a.min(b)
}

/// From the luminaire's size to the tilt of the measurement.
fn geometry(goniogram: &Goniogram, lamp_flux: f64) -> Vec<String> {
    let area = goniogram.opening.eulumdat_area();
    let body = if goniogram.body == [0.0; 3] { [area[0], area[1], goniogram.opening.size[2]] } else { goniogram.body };
    let lengths = body.iter().chain(&area).chain(&goniogram.opening.heights);
    let flux = goniogram.flux();
    let (down, output) = (if flux > 0.0 { goniogram.flux_below() / flux } else { 0.0 }, flux / lamp_flux);
    // Counted fluxes are better than what interpolation makes of the table.
    let stated = |stated: Option<f64>, own: f64, allowed: f64| stated.filter(|stated| (stated - own).abs() <= allowed).unwrap_or(own);
    let down = stated(goniogram.stated.downward_fraction, down, TOLERANCE);
    let output = stated(goniogram.stated.light_output_ratio, output, TOLERANCE * output);
    let ratios = [100.0 * down, 100.0 * output, 1.0, goniogram.stated.measurement_tilt];
    lengths.map(|metres| number(metres * 1000.0)).chain(ratios.map(number)).collect()
}

/// Direct ratios have three digits.
fn rounded(ratios: [f64; 10]) -> [f64; 10] {
    ratios.map(|ratio| (1e3 * ratio).round() / 1e3)
}

fn lamp_sets(goniogram: &Goniogram, lamp_flux: f64) -> Vec<String> {
    // The set that the intensities are for comes first, as readers without a choice take that one.
    let sets = goniogram
        .lamps()
        .into_iter()
        .chain(goniogram.lamp_sets.iter().enumerate().filter(|(index, _)| *index != goniogram.lamp_set).map(|(_, set)| set));
    let mut lines = vec![goniogram.lamp_sets.len().max(1).to_string()];
    for set in sets {
        let absolute = set.absolute || set.flux.is_none();
        let count = i64::from(set.count.max(1)) * if absolute { -1 } else { 1 };
        lines.push(count.to_string());
        lines.push(one_line(&set.name));
        lines.push(number(set.flux.unwrap_or(lamp_flux)));
        lines.push(one_line(&set.colour));
        lines.push(one_line(&set.colour_rendering));
        lines.push(number(set.watts));
    }
    if goniogram.lamps().is_none() {
        lines.extend(["-1".into(), String::new(), number(lamp_flux), String::new(), String::new(), "0".into()]);
    }
    lines
}
