//! Attributes of the format: numbers with own values where none is stated.

use super::read::Notes;
use crate::l3d::Place;
use crate::photometry::text::{parse, quote};
use crate::xml::attribute;
use roxmltree::Node;

/// The narrowest and the widest angle of a beam, degrees.
const ANGLES: [f64; 2] = [0.1, 360.0];

/// A number that is not negative; the format's own where none is stated, and then its name is noted.
pub(super) fn stated(node: Node<'_, '_>, name: &'static str, own: f64, unstated: &mut Vec<&'static str>, notes: &mut Notes) -> f64 {
    let text = attribute(node, name);
    if text.is_empty() {
        unstated.push(name);
        return own;
    }
    parse(text).filter(|value| *value >= 0.0).unwrap_or_else(|| {
        notes.warn(node, format!("{name} is {}, expected a number that is not negative: {own} is taken", quote(text)));
        own
    })
}

/// A number that is positive, if one is stated.
pub(super) fn positive(node: Node<'_, '_>, name: &str) -> Option<f64> {
    parse(attribute(node, name)).filter(|value| *value > 0.0)
}

/// An angle that a beam can have.
pub(super) fn angle(node: Node<'_, '_>, name: &'static str, unstated: &mut Vec<&'static str>, notes: &mut Notes) -> f64 {
    let found = stated(node, name, 25.0, unstated, notes);
    let within = found.clamp(ANGLES[0], ANGLES[1]);
    if within != found {
        notes.warn(node, format!("{name} is {found}°: {within}° is taken"));
    }
    within
}

/// The place of a geometry in its parent's: four rows in braces.
pub(super) fn place(node: Node<'_, '_>, notes: &mut Notes) -> Place {
    let text = attribute(node, "Position");
    if text.is_empty() {
        return Place::ORIGIN;
    }
    let numbers: Vec<f64> = text.split(['{', '}', ',', ' ']).filter(|part| !part.is_empty()).take(17).filter_map(parse).collect();
    let Ok(rows) = <[f64; 16]>::try_from(numbers) else {
        notes.warn(node, format!("Position is {}, expected four rows of four numbers: the geometry is not moved", quote(text)));
        return Place::ORIGIN;
    };
    Place([0, 4, 8].map(|row| [0, 1, 2, 3].map(|column| rows[row + column])))
}
