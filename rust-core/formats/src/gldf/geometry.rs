//! Bodies, models and mountings of variants.

use super::SimpleGeometry;
use super::read::ById;
use crate::photometry::text::{number, parse};
use crate::xml::{attribute, children, descend, value_at};
use roxmltree::Node;

/// Metres in a millimetre, GLDF's unit of lengths.
const MILLIMETRE: f64 = 1e-3;

fn list<'a, 'input>(general: Option<Node<'a, 'input>>, name: &'static str) -> impl Iterator<Item = Node<'a, 'input>> {
    let geometries = general.and_then(|general| descend(general, &["Geometries"]));
    geometries.into_iter().flat_map(move |node| children(node, name))
}

/// A length in metres, 0 where none is stated.
fn metres(node: Node<'_, '_>, path: &[&str]) -> f64 {
    value_at(node, path).unwrap_or(0.0).max(0.0) * MILLIMETRE
}

/// Bodies of simple shape by their identifiers.
pub(super) fn simple_geometries(general: Option<Node<'_, '_>>) -> ById<SimpleGeometry> {
    let simple = |node: Node<'_, '_>| {
        let body = match (descend(node, &["Cuboid"]), descend(node, &["Cylinder"])) {
            (Some(cuboid), _) => ["Length", "Width", "Height"].map(|name| metres(cuboid, &[name])),
            (None, Some(cylinder)) => [metres(cylinder, &["Diameter"]), 0.0, metres(cylinder, &["Height"])],
            (None, None) => [0.0; 3],
        };
        let emitter = match (descend(node, &["RectangularEmitter"]), descend(node, &["CircularEmitter"])) {
            (Some(face), _) => ["Length", "Width"].map(|name| metres(face, &[name])),
            (None, Some(face)) => [metres(face, &["Diameter"]), 0.0],
            (None, None) => [0.0; 2],
        };
        let heights = ["C0", "C90", "C180", "C270"].map(|side| metres(node, &["C-Heights", side]));
        SimpleGeometry { body, emitter, heights }
    };
    list(general, "SimpleGeometry").map(|node| (attribute(node, "id").to_owned(), simple(node))).collect()
}

/// Files of models by the models' identifiers.
pub(super) fn models(general: Option<Node<'_, '_>>, files: &ById<usize>) -> ById<Vec<usize>> {
    let model = |node| children(node, "GeometryFileReference").filter_map(|file| files.get(attribute(file, "fileId")).copied()).collect();
    list(general, "ModelGeometry").map(|node| (attribute(node, "id").to_owned(), model(node))).collect()
}

/// How a variant may be mounted, in words.
pub(super) fn mountings(variant: Node<'_, '_>) -> Vec<String> {
    let Some(mountings) = descend(variant, &["Mountings"]) else { return Vec::new() };
    let places = mountings.children().filter(Node::is_element).take(10);
    let ways = |place: Node<'_, '_>| {
        let name = words(place.tag_name().name());
        let (mut name, from) = (name, parse(attribute(place, "mountingHeight")));
        if let Some(height) = from {
            name += &format!(" at {} m", number(height * MILLIMETRE));
        }
        let ways: Vec<String> =
            place.children().filter(Node::is_element).take(10).map(|way| format!("{name}, {}", described(way))).collect();
        if ways.is_empty() { vec![name] } else { ways }
    };
    places.flat_map(ways).collect()
}

/// A way of mounting with the length that it states.
fn described(way: Node<'_, '_>) -> String {
    let lengths = ["recessedDepth", "pendantLength", "poleHeight"];
    let length = lengths.into_iter().find_map(|name| parse(attribute(way, name)));
    let name = words(way.tag_name().name());
    length.map_or(name.clone(), |length| format!("{name} {} m", number(length * MILLIMETRE)))
}

/// `SurfaceMounted` as `surface mounted`.
fn words(name: &str) -> String {
    let mut words = String::new();
    for letter in name.chars().take(40) {
        if letter.is_uppercase() && !words.is_empty() {
            words.push(' ');
        }
        words.extend(letter.to_lowercase());
    }
    words
}
