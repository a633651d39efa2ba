//! IES TM-27-14 and -20 (`.spdx`): the first spectral distribution of the document.

use crate::{check::checked, source::Spectrum};
use gonio_formats::{
    FormatError,
    spectrum::{MOST, SpectralPoint, quoted},
};
use roxmltree::{Document, Node, ParsingOptions};

/// What the root's name begins with: the edition follows.
const ROOT: &str = "IESTM27";

/// Quantities that are no light.
const NO_LIGHT: [&str; 4] = ["reflectance", "transmittance", "absorptance", "other"];

/// Reads the document.
pub(super) fn read(text: &str, name: &str) -> Result<Spectrum, FormatError> {
    // No definitions, so nothing grows as it is read; each point is two nodes.
    let options = ParsingOptions { allow_dtd: false, nodes_limit: 4 * MOST as u32, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options)
        .map_err(|error| FormatError::line(error.pos().row.into(), format!("not XML: {error}")))?;
    let root = document.root_element();
    if !root.tag_name().name().starts_with(ROOT) {
        return Err(at(root, format!("<{}> was found, expected a root whose name begins with {ROOT}", quoted(root.tag_name().name()))));
    }
    let mut distributions = root.descendants().filter(|node| node.tag_name().name() == "SpectralDistribution");
    let distribution = distributions.next().ok_or_else(|| at(root, "no SpectralDistribution".to_owned()))?;
    let others = distributions.count();
    let quantity = child_text(distribution, "SpectralQuantity").unwrap_or_default();
    if NO_LIGHT.contains(&quantity.to_ascii_lowercase().as_str()) {
        return Err(at(distribution, format!("SpectralQuantity {} is no power of a source", quoted(quantity))));
    }
    let points = points(distribution, text)?;
    let title = ["Description", "CatalogNumber", "Manufacturer"].iter().find_map(|key| header(root, key));
    let mut spectrum = checked(title.unwrap_or(name), &points)?;
    if others > 0 {
        spectrum.notes.insert(0, format!("1 of {} spectral distributions is read", others + 1));
    }
    Ok(spectrum)
}

/// The distribution's points. Lines are counted on the way, since a document counts them from its start each time.
fn points(distribution: Node<'_, '_>, text: &str) -> Result<Vec<SpectralPoint>, FormatError> {
    let [mut from, mut line] = [0, 1];
    let mut points = Vec::new();
    for node in distribution.children().filter(|node| node.tag_name().name() == "SpectralData") {
        let start = node.range().start;
        line += text.as_bytes()[from..start].iter().filter(|byte| **byte == b'\n').count();
        from = start;
        let point = point(node).map_err(|problem| FormatError::line(line as u64, problem))?;
        points.push(SpectralPoint { line: Some(line as u64), ..point });
    }
    Ok(points)
}

fn point(node: Node<'_, '_>) -> Result<SpectralPoint, String> {
    let wavelength = node.attribute("wavelength").ok_or("SpectralData without a wavelength")?;
    let number = |text: &str, what: &str| text.trim().parse().map_err(|_| format!("{what} {} is no number", quoted(text)));
    Ok(SpectralPoint { nm: number(wavelength, "wavelength")?, power: number(node.text().unwrap_or_default(), "power")?, line: None })
}

fn child_text<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.children().find(|child| child.tag_name().name() == name)?.text().map(str::trim).filter(|text| !text.is_empty())
}

fn header<'a>(root: Node<'a, '_>, name: &str) -> Option<&'a str> {
    root.children().find(|child| child.tag_name().name() == "Header").and_then(|header| child_text(header, name))
}

fn at(node: Node<'_, '_>, problem: String) -> FormatError {
    FormatError::line(node.document().text_pos_at(node.range().start).row.into(), problem)
}
