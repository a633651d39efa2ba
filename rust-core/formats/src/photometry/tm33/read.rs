//! The reader.

use super::radiant::Radiant;
use super::{ROOT, spectral};
use crate::error::{FormatError, Result};
use crate::photometry::arrange::arrange;
use crate::photometry::axis::{Axis, Table};
use crate::photometry::check::Least;
use crate::photometry::grid::{SAME, sorted};
use crate::photometry::text::{LARGEST, decode, number, parse, quote};
use crate::photometry::{Goniogram, HeaderLine, LampSet, Opening, OpeningShape, PhotometricType, Stated};
use crate::xml::{LineNumbers, at, children, content, descend, document, line, value_at};
use roxmltree::Node;

/// The head's elements and the keywords that they become.
const TEXTS: [(&str, &str); 7] = [
    ("Manufacturer", "MANUFAC"),
    ("CatalogNumber", "LUMCAT"),
    ("Description", "LUMINAIRE"),
    ("Laboratory", "TESTLAB"),
    ("ReportNumber", "TEST"),
    ("ReportDate", "ISSUEDATE"),
    ("Comment", "OTHER"),
];

/// Lengths above this are no metres.
const LONGEST: f64 = 20.0;

/// Reads a TM-33 file for its first emitter with luminous intensities, or without such one its first with radiant or photon intensities and a spectrum.
///
/// # Errors
/// What is no XML or has another root, no intensities, none on a whole grid of angles, or none that can be candela.
pub fn read(bytes: &[u8]) -> Result<Goniogram> {
    let text = decode(bytes)?;
    let document = document(&text)?;
    let root = document.root_element();
    if !root.tag_name().name().starts_with(ROOT) {
        return Err(at(root, format!("<{}> was found, expected a root whose name begins with {ROOT}", quote(root.tag_name().name()))));
    }
    let mut warnings = Vec::new();
    let emitters: Vec<_> = children(root, "Emitter").collect();
    let luminous = emitters.iter().find_map(|emitter| Some((*emitter, descend(*emitter, &["LuminousData", "LuminousIntensity"])?, None)));
    let other = || emitters.iter().find_map(|emitter| Radiant::of(*emitter).map(|found| (*emitter, found.intensity, Some(found))));
    let Some((emitter, intensity, radiant)) = luminous.or_else(other) else {
        return Err(at(root, "no emitter with luminous intensities was found, nor with radiant or photon intensities".into()));
    };
    if emitters.len() > 1 {
        warnings.push(FormatError::whole(format!("1 of {} emitters is read", emitters.len())));
    }
    let photometric_type = photometric_type(root);
    let spectrum = spectral::of_emitter(emitter, &LineNumbers::new(&text), &mut warnings);
    let mut table = table(intensity, &mut warnings)?;
    if let Some(radiant) = radiant {
        let candela = radiant.candela(spectrum.as_ref(), &mut warnings)?;
        table.intensities.iter_mut().for_each(|value| *value *= candela);
    }
    table.order(&mut warnings)?;
    let symmetry = arrange(&mut table, photometric_type, &mut warnings)?;
    let body = lengths(descend(root, &["Luminaire", "Dimensions"]), ["Length", "Width", "Height"]).unwrap_or_default();
    let mut goniogram = Goniogram {
        photometric_type,
        symmetry,
        horizontal: table.horizontal.angles,
        vertical: table.vertical.angles,
        intensities: table.intensities,
        opening: opening(emitter),
        body: metres(body),
        lamp_sets: vec![lamps(emitter, intensity, &mut warnings)],
        lamp_set: 0,
        tilt: None,
        stated: Stated::default(),
        header: header(root),
        spectrum,
        warnings,
    };
    goniogram.check();
    Ok(goniogram)
}

fn header(root: Node<'_, '_>) -> Vec<HeaderLine> {
    let Some(head) = descend(root, &["Header"]) else { return Vec::new() };
    let keyword = |node: &Node<'_, '_>| TEXTS.iter().find(|(name, _)| *name == node.tag_name().name()).map(|(_, keyword)| *keyword);
    let line = |node: Node<'_, '_>| Some(HeaderLine { keyword: keyword(&node)?.into(), text: content(node).to_owned() });
    head.children().filter_map(line).filter(|line| !line.text.is_empty()).take(1000).collect()
}

fn photometric_type(root: Node<'_, '_>) -> PhotometricType {
    let kind = descend(root, &["Equipment", "Gonioradiometer", "Type"]).map(content).unwrap_or_default();
    match kind.trim_end().chars().last() {
        Some('A') => PhotometricType::A,
        Some('B') => PhotometricType::B,
        _ => PhotometricType::C,
    }
}

/// Angles and intensities; they may stand in any order.
fn table(intensity: Node<'_, '_>, warnings: &mut Vec<FormatError>) -> Result<Table> {
    let factor = value(intensity, "Multiplier").filter(|factor| *factor > 0.0).unwrap_or(1.0);
    let mut points = Vec::new();
    for node in children(intensity, "IntData") {
        let angle = |name: &str| node.attribute(name).and_then(parse);
        let (Some(h), Some(v), Some(value)) = (angle("h"), angle("v"), parse(content(node))) else {
            return Err(at(node, "expected an intensity with the angles h and v".into()));
        };
        if (value * factor).abs() > LARGEST {
            return Err(at(node, format!("an intensity is {:e} cd, expected {LARGEST:e} at most", value * factor)));
        }
        points.push((h, v, value * factor));
    }
    let horizontal = sorted(points.iter().map(|point| point.0).collect());
    let vertical = sorted(points.iter().map(|point| point.1).collect());
    if points.is_empty() || horizontal.len().checked_mul(vertical.len()) != Some(points.len()) {
        let (h, v) = (horizontal.len(), vertical.len());
        return Err(at(intensity, format!("{} intensities of {h} horizontal and {v} vertical angles: no whole grid", points.len())));
    }
    let index = |angles: &[f64], angle: f64| angles.partition_point(|other| *other < angle - SAME);
    let mut intensities = vec![f64::NAN; points.len()];
    for (h, v, value) in &points {
        intensities[index(&horizontal, *h) * vertical.len() + index(&vertical, *v)] = *value;
    }
    if intensities.iter().any(|value| value.is_nan()) {
        return Err(at(intensity, "an intensity's angles come again: no whole grid".into()));
    }
    // Looking a line up takes as long as the file is: one for all.
    let line = line(intensity);
    let mut least = Least::default();
    intensities.iter().for_each(|value| least.see(*value, line));
    least.repair(&mut intensities, warnings)?;
    let axis = |name: &'static str, angles: Vec<f64>| Axis { name, lines: vec![line; angles.len()], angles };
    Ok(Table { horizontal: axis("horizontal angle", horizontal), vertical: axis("vertical angle", vertical), intensities })
}

fn lamps(emitter: Node<'_, '_>, intensity: Node<'_, '_>, warnings: &mut Vec<FormatError>) -> LampSet {
    let rated = value(emitter, "RatedLumens").filter(|flux| *flux > 0.0);
    let relative = descend(intensity, &["AbsolutePhotometry"]).is_some_and(|node| ["false", "0"].contains(&content(node)));
    let quantity = value(emitter, "Quantity").unwrap_or(1.0);
    if quantity != 1.0 {
        warnings.push(FormatError::whole(format!("the emitter's quantity is {}: not multiplied", number(quantity))));
    }
    let colour = descend(emitter, &["ColorTemperature", "FixedCCT"]).map(|node| format!("{} K", content(node)));
    LampSet {
        count: 1,
        name: descend(emitter, &["Description"]).map(content).unwrap_or_default().to_owned(),
        flux: rated,
        absolute: !relative && rated.is_none(),
        watts: value(emitter, "InputWattage").unwrap_or(0.0).max(0.0),
        colour: colour.unwrap_or_default(),
        ..LampSet::default()
    }
}

/// The opening by the first luminous area of the bottom, and the height of the sides.
fn opening(emitter: Node<'_, '_>) -> Opening {
    let Some(areas) = descend(emitter, &["EmissionAreas"]) else { return Opening::default() };
    let bottom = descend(areas, &["BottomFace", "BottomArea"]).or_else(|| descend(areas, &["TopFace", "TopArea"]));
    let circular = bottom.and_then(|area| descend(area, &["Circular"])).is_some_and(|node| ["true", "1"].contains(&content(node)));
    let [length, width] = lengths(bottom, ["Length", "Width"]).unwrap_or_default();
    let side = |face: &str, area: &str| lengths(descend(areas, &[face, area]), ["Height"]).map_or(0.0, |[height]| height);
    let sides = [("C0Face", "C0Area"), ("C90Face", "C90Area"), ("C180Face", "C180Area"), ("C270Face", "C270Area")];
    let heights = sides.map(|(face, area)| side(face, area));
    let height = heights.into_iter().fold(0.0, f64::max);
    let shape = match (circular, height > 0.0) {
        _ if length <= 0.0 && width <= 0.0 => OpeningShape::Point,
        (true, true) => OpeningShape::VerticalCylinder,
        (true, false) => OpeningShape::Disk,
        (false, true) => OpeningShape::Box,
        (false, false) => OpeningShape::Rectangle,
    };
    // The length runs along C90–C270. One unit holds for all of the opening's lengths.
    let all = metres([width, length, height, heights[0], heights[1], heights[2], heights[3]]);
    if shape == OpeningShape::Point {
        return Opening::default();
    }
    Opening { shape, size: [all[0], all[1], all[2]], heights: [all[3], all[4], all[5], all[6]] }
}

/// Lengths of one kind in metres.
fn metres<const N: usize>(lengths: [f64; N]) -> [f64; N] {
    let millimetres = lengths.iter().any(|length| *length > LONGEST);
    lengths.map(|length| if millimetres { length / 1000.0 } else { length })
}

fn lengths<const N: usize>(node: Option<Node<'_, '_>>, names: [&str; N]) -> Option<[f64; N]> {
    let node = node?;
    Some(names.map(|name| value(node, name).unwrap_or(0.0).max(0.0)))
}

fn value(node: Node<'_, '_>, name: &str) -> Option<f64> {
    value_at(node, &[name])
}
