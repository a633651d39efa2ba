//! The reader of `description.xml`.

use super::geometry::Geometries;
use super::{DESCRIPTION, Gdtf, GdtfEmitter, Mode};
use crate::archive::{Archive, inside, some_of};
use crate::error::{FormatError, Result};
use crate::photometry::text::{parse, quote};
use crate::xml::{LineNumbers, at, attribute, children, descend, document, tag, text_of};
use roxmltree::Node;

/// Warnings that are kept.
const MOST_WARNINGS: usize = 50;

/// Modes, emitters and points of a spectrum that are read.
const MOST_MODES: usize = 1000;
const MOST_EMITTERS: usize = 1000;
const MOST_POINTS: usize = 1 << 16;

impl Gdtf {
    /// Reads a GDTF file. References to what is not there are told where they are used.
    ///
    /// # Errors
    /// What is no archive, has no `description.xml`, or one that is no GDTF; with the file inside the archive and its line.
    pub fn read(bytes: &[u8]) -> Result<Self> {
        let archive = Archive::open(bytes)?;
        if archive.size(DESCRIPTION).is_none() {
            let names = some_of(archive.names());
            let found = if names.is_empty() { "nothing".to_owned() } else { names };
            return Err(FormatError::whole(format!("no {DESCRIPTION} is in the archive, expected one in a GDTF file; it holds {found}")));
        }
        let description = archive.read(DESCRIPTION)?;
        let text = text_of(&description).map_err(|error| inside(DESCRIPTION, &error))?;
        fixture(&text).map_err(|error| if error.place.is_some() { inside(DESCRIPTION, &error) } else { error })
    }
}

fn fixture(text: &str) -> Result<Gdtf> {
    let document = document(text)?;
    let root = document.root_element();
    if root.tag_name().name() != "GDTF" {
        return Err(at(root, format!("{} was found, expected <GDTF>", tag(root))));
    }
    let Some(head) = descend(root, &["FixtureType"]) else {
        return Err(at(root, "no <FixtureType> was found, expected one in <GDTF>".into()));
    };
    let mut notes = Notes { lines: LineNumbers::new(text), warnings: Vec::new() };
    let emitters = emitters(head, &mut notes);
    let mut geometries = Geometries::new(head, &emitters);
    let listed = descend(head, &["DMXModes"]).into_iter().flat_map(|list| children(list, "DMXMode"));
    let mut modes = Vec::new();
    for node in listed.take(MOST_MODES) {
        let name = attribute(node, "Name").to_owned();
        modes.push(Mode { name, beams: geometries.beams(node, &mut notes)? });
    }
    let name = [attribute(head, "LongName"), attribute(head, "Name"), attribute(head, "ShortName")];
    Ok(Gdtf {
        manufacturer: attribute(head, "Manufacturer").to_owned(),
        name: name.into_iter().find(|name| !name.is_empty()).unwrap_or_default().to_owned(),
        version: attribute(root, "DataVersion").to_owned(),
        id: attribute(head, "FixtureTypeID").to_owned(),
        modes,
        emitters,
        warnings: notes.warnings,
    })
}

/// What is noted while a fixture is read.
pub(super) struct Notes {
    lines: LineNumbers,
    warnings: Vec<FormatError>,
}

impl Notes {
    /// A problem at a node.
    pub(super) fn problem(&self, node: Node<'_, '_>, problem: String) -> FormatError {
        inside(DESCRIPTION, &self.lines.at(node, problem))
    }

    /// A warning, while there are few, and once for each place.
    pub(super) fn warn(&mut self, node: Node<'_, '_>, problem: String) {
        if self.warnings.len() < MOST_WARNINGS {
            let problem = self.problem(node, problem);
            if !self.warnings.contains(&problem) {
                self.warnings.push(problem);
            }
        }
    }
}

fn emitters(head: Node<'_, '_>, notes: &mut Notes) -> Vec<GdtfEmitter> {
    let listed = descend(head, &["PhysicalDescriptions", "Emitters"]).into_iter().flat_map(|list| children(list, "Emitter"));
    let emitter = |node| {
        let colour: Vec<f64> = attribute(node, "Color").split(',').take(2).filter_map(parse).collect();
        GdtfEmitter {
            name: attribute(node, "Name").to_owned(),
            chromaticity: <[f64; 2]>::try_from(colour).ok(),
            spectrum: spectrum(node, notes),
        }
    };
    listed.take(MOST_EMITTERS).map(emitter).collect()
}

/// The spectrum at the greatest drive; the points' order does not count.
fn spectrum(emitter: Node<'_, '_>, notes: &mut Notes) -> Vec<(f64, f64)> {
    let drive = |node: &Node<'_, '_>| parse(attribute(*node, "Physical")).unwrap_or(0.0);
    let points = |node: &Node<'_, '_>| children(*node, "MeasurementPoint").next().is_some();
    let measured = children(emitter, "Measurement").filter(points).max_by(|a, b| drive(a).total_cmp(&drive(b)));
    let Some(measured) = measured else { return Vec::new() };
    let mut found = Vec::new();
    for node in children(measured, "MeasurementPoint").take(MOST_POINTS) {
        match (parse(attribute(node, "WaveLength")), parse(attribute(node, "Energy"))) {
            (Some(nm), Some(energy)) => found.push((nm, energy)),
            _ => notes.warn(node, format!("a point of the emitter {} has no WaveLength and Energy", quote(attribute(emitter, "Name")))),
        }
    }
    found.sort_by(|a: &(f64, f64), b| a.0.total_cmp(&b.0));
    found
}
