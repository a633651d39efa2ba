//! Geometries, and the beams that hang on them.

use super::numbers::{angle, place, positive, stated};
use super::read::Notes;
use super::{Beam, BeamKind, GdtfEmitter};
use crate::error::Result;
use crate::l3d::Place;
use crate::photometry::text::quote;
use crate::xml::{attribute, descend};
use roxmltree::Node;
use std::collections::HashMap;

/// Geometries within one another: each takes the stack further down.
const DEEPEST: usize = 64;

/// Geometries that are visited in all modes: references stand for whole trees, and trees of references grow without end.
const MOST_VISITS: usize = 1 << 16;

/// Beams of a mode.
const MOST_BEAMS: usize = 1 << 12;

/// The trees of a fixture.
pub(super) struct Geometries<'a, 'input, 'm> {
    by_name: HashMap<&'a str, Node<'a, 'input>>,
    emitters: &'m [GdtfEmitter],
    visits: usize,
}

impl<'a, 'input, 'm> Geometries<'a, 'input, 'm> {
    pub(super) fn new(head: Node<'a, 'input>, emitters: &'m [GdtfEmitter]) -> Self {
        let listed = descend(head, &["Geometries"]).into_iter().flat_map(|list| list.children()).filter(Node::is_element);
        Self { by_name: listed.map(|node| (attribute(node, "Name"), node)).collect(), emitters, visits: 0 }
    }

    /// The beams of a mode.
    ///
    /// # Errors
    /// Geometries that hang too deep, or are too many.
    pub(super) fn beams(&mut self, mode: Node<'_, '_>, notes: &mut Notes) -> Result<Vec<Beam>> {
        let name = attribute(mode, "Geometry");
        let mut found = Vec::new();
        match self.by_name.get(name).copied() {
            Some(node) => self.visit(node, &Place::ORIGIN, 0, &mut found, notes)?,
            None => notes.warn(mode, format!("no geometry {} is defined", quote(name))),
        }
        Ok(found)
    }

    fn visit(&mut self, node: Node<'_, '_>, within: &Place, depth: usize, found: &mut Vec<Beam>, notes: &mut Notes) -> Result<()> {
        self.visits += 1;
        if depth == DEEPEST || self.visits > MOST_VISITS {
            let problem = if depth == DEEPEST {
                format!("more than {DEEPEST} geometries hang on one another")
            } else {
                format!("more than {MOST_VISITS} geometries are placed")
            };
            return Err(notes.problem(node, problem));
        }
        let here = within.then(&place(node, notes));
        if node.tag_name().name() == "GeometryReference" {
            let name = attribute(node, "Geometry");
            return match self.by_name.get(name).copied() {
                // A reference's own place comes in the place of that of the geometry that it names.
                Some(named) => self.inside(named, &here, depth, found, notes),
                None => {
                    notes.warn(node, format!("no geometry {} is defined", quote(name)));
                    Ok(())
                }
            };
        }
        self.inside(node, &here, depth, found, notes)
    }

    /// A geometry at its place, and what hangs on it.
    fn inside(&mut self, node: Node<'_, '_>, here: &Place, depth: usize, found: &mut Vec<Beam>, notes: &mut Notes) -> Result<()> {
        if node.tag_name().name() == "Beam" {
            if found.len() == MOST_BEAMS {
                return Err(notes.problem(node, format!("a mode has more than {MOST_BEAMS} beams")));
            }
            found.push(self.beam(node, here, notes));
        }
        node.children().filter(Node::is_element).try_for_each(|child| self.visit(child, here, depth + 1, found, notes))
    }

    fn beam(&self, node: Node<'_, '_>, here: &Place, notes: &mut Notes) -> Beam {
        let mut unstated = Vec::new();
        let mut number = |name, own| stated(node, name, own, &mut unstated, notes);
        let (flux, temperature, radius) =
            (number("LuminousFlux", 10_000.0), number("ColorTemperature", 6000.0), number("BeamRadius", 0.05));
        let [beam_deg, field_deg] = ["BeamAngle", "FieldAngle"].map(|name| angle(node, name, &mut unstated, notes));
        let emitter = attribute(node, "EmitterSpectrum");
        let named = self.emitters.iter().position(|found| found.name == emitter);
        if named.is_none() && !emitter.is_empty() {
            notes.warn(node, format!("no emitter {} is defined", quote(emitter)));
        }
        Beam {
            name: attribute(node, "Name").to_owned(),
            kind: kind(node, notes),
            flux,
            beam_deg,
            field_deg,
            radius,
            temperature,
            rendering: positive(node, "ColorRenderingIndex"),
            watts: positive(node, "PowerConsumption"),
            emitter: named,
            direction: here.direction([0.0, 0.0, -1.0]),
            unstated,
        }
    }
}

fn kind(node: Node<'_, '_>, notes: &mut Notes) -> BeamKind {
    match attribute(node, "BeamType") {
        "" | "Wash" => BeamKind::Wash,
        "Fresnel" => BeamKind::Fresnel,
        "PC" => BeamKind::PlanoConvex,
        "Spot" => BeamKind::Spot,
        "Rectangle" => BeamKind::Rectangle(positive(node, "RectangleRatio").unwrap_or(1.7777)),
        "None" => BeamKind::None,
        "Glow" => BeamKind::Glow,
        other => {
            notes.warn(node, format!("the beam type {} is unknown: Wash is taken", quote(other)));
            BeamKind::Wash
        }
    }
}
