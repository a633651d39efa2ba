//! Reading BSDF XML.

use roxmltree::{Document, Node, ParsingOptions};

use super::super::Measured;
use super::super::hemispheres::Hemispheres;
use super::super::patches::{Band, Basis, Matrix, Patches};
use super::super::text::{Words, shown};
use super::super::tree::{Component, TensorTree};
use super::{BANDS, DIRECTIONS, SHIRLEY_CHIU, starts_in, tree};
use crate::error::{FormatError, Place, Result};

/// More elements than that no such file has; each takes memory several times its text.
const MOST_NODES: u32 = 1 << 20;

/// One block of scattering data.
struct Block<'a, 'input> {
    node: Node<'a, 'input>,
    band: Band,
    hemispheres: Hemispheres,
}

/// Reads BSDF XML: [`Patches`] or [`TensorTree`].
///
/// # Errors
/// When it is not XML, an element that is needed is absent, a basis is not known, or numbers are not as many as the bases say, are not
/// numbers, or negative.
pub fn read(bytes: &[u8]) -> Result<Measured> {
    let text = document_text(bytes);
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options)
        .map_err(|error| FormatError::line(error.pos().row.into(), format!("not XML: {error}")))?;
    let root = document.root_element();
    let layer = descend(root, "Optical").and_then(|optical| descend(optical, "Layer"));
    let layer = layer.ok_or_else(|| at(root, format!("<{}>: expected WindowElement with Optical and Layer", root.tag_name().name())))?;
    let definition = expect(layer, "DataDefinition")?;
    let structure = expect(definition, "IncidentDataStructure")?;
    match content(structure) {
        name if name.eq_ignore_ascii_case("Columns") => patches(layer, definition, false),
        name if name.eq_ignore_ascii_case("Rows") => patches(layer, definition, true),
        name if name.eq_ignore_ascii_case("TensorTree3") => trees(layer, 3),
        name if name.eq_ignore_ascii_case("TensorTree4") => trees(layer, 4),
        name => Err(at(structure, format!("\"{}\", expected Columns, Rows, TensorTree3 or TensorTree4", shown(name)))),
    }
}

/// The document without its declaration and what stands before it, whose lines stay as empty ones, so that all others keep their numbers.
fn document_text(bytes: &[u8]) -> String {
    let start = starts_in(bytes).unwrap_or(0);
    let declaration = bytes[start..].starts_with(b"<?xml").then(|| bytes[start..].windows(2).position(|pair| pair == b"?>"));
    let start = declaration.flatten().map_or(start, |end| start + end + 2);
    let (before, document) = bytes.split_at(start);
    let lines = before.iter().filter(|byte| **byte == b'\n').count();
    "\n".repeat(lines) + &String::from_utf8_lossy(document)
}

/// Matrices; `rows` says that a row of the text is one incident patch.
fn patches(layer: Node<'_, '_>, definition: Node<'_, '_>, rows: bool) -> Result<Measured> {
    let mut bases = Vec::new();
    for node in children(definition, "AngleBasis") {
        bases.push(basis(node)?);
    }
    let mut matrices: Vec<Matrix> = Vec::new();
    for block in blocks(layer)? {
        let incident = basis_index(&mut bases, expect(block.node, "ColumnAngleBasis")?)?;
        let outgoing = basis_index(&mut bases, expect(block.node, "RowAngleBasis")?)?;
        let data = expect(block.node, "ScatteringData")?;
        let (columns, lines) = (bases[incident].count(), bases[outgoing].count());
        let mut words = words(data);
        let numbers = words.numbers(columns * lines, "scattering data")?;
        if let Some(extra) = words.word() {
            return Err(FormatError::line(words.line(), format!("\"{}\" after {lines} × {columns} values", shown(extra))));
        }
        let value = |i: usize| if rows { numbers[i % columns * lines + i / columns] } else { numbers[i] };
        // Measurements fall below zero by their noise.
        let values = (0..numbers.len()).map(|i| (value(i) as f32).max(0.0)).collect::<Vec<_>>();
        if let Some(bad) = numbers.iter().find(|v| !(**v as f32).is_finite()) {
            return Err(at(data, format!("value {bad}, expected a finite one")));
        }
        // As in Radiance, the last of several blocks for the same counts.
        matrices.retain(|m| m.hemispheres != block.hemispheres || m.band != block.band);
        matrices.push(Matrix::new(block.hemispheres, block.band, incident, outgoing, values));
    }
    Ok(Measured::Patches(Patches::new(bases, matrices)?))
}

fn trees(layer: Node<'_, '_>, rank: u32) -> Result<Measured> {
    let mut components: Vec<Component> = Vec::new();
    for block in blocks(layer)? {
        let basis = expect(block.node, "AngleBasis")?;
        if !content(basis).eq_ignore_ascii_case(SHIRLEY_CHIU) {
            return Err(at(basis, format!("angle basis \"{}\", expected {SHIRLEY_CHIU}", shown(content(basis)))));
        }
        let tree = tree::parse(words(expect(block.node, "ScatteringData")?), rank)?;
        components.retain(|c| c.hemispheres != block.hemispheres || c.band != block.band);
        components.push(Component { hemispheres: block.hemispheres, band: block.band, tree });
    }
    Ok(Measured::Tree(TensorTree::new(components)?))
}

/// All blocks whose part of the spectrum and direction have a name that we know.
fn blocks<'a, 'input>(layer: Node<'a, 'input>) -> Result<Vec<Block<'a, 'input>>> {
    let mut blocks = Vec::new();
    for data in children(layer, "WavelengthData") {
        let wavelength = expect(data, "Wavelength")?;
        let Some(band) = named(&BANDS, content(wavelength)) else { continue };
        for node in children(data, "WavelengthDataBlock") {
            let direction = expect(node, "WavelengthDataDirection")?;
            let Some(hemispheres) = named(&DIRECTIONS, content(direction)) else {
                return Err(at(
                    direction,
                    format!("\"{}\", expected Transmission or Reflection, Front or Back", shown(content(direction))),
                ));
            };
            blocks.push(Block { node, band, hemispheres });
        }
    }
    Ok(blocks)
}

/// A basis that the file defines.
fn basis(node: Node<'_, '_>) -> Result<Basis> {
    let name = content(expect(node, "AngleBasisName")?);
    let mut borders = vec![0.0];
    let mut counts = Vec::new();
    for ring in children(node, "AngleBasisBlock") {
        let count = words(expect(ring, "nPhis")?).number("a number of patches")?;
        let bounds = expect(ring, "ThetaBounds")?;
        let lower = words(expect(bounds, "LowerTheta")?).number("an angle")?;
        let upper = words(expect(bounds, "UpperTheta")?).number("an angle")?;
        if (lower - borders[borders.len() - 1]).abs() > 1e-3 {
            return Err(at(bounds, format!("ring from {lower}°, expected {}° where the last one ends", borders[borders.len() - 1])));
        }
        if !(count >= 1.0 && count <= f64::from(u16::MAX) && count.fract() == 0.0) {
            return Err(at(ring, format!("{count} patches in a ring, expected a whole number from 1 on")));
        }
        borders.push(upper);
        counts.push(count as u32);
    }
    Basis::new(name, &borders, &counts).map_err(|error| at(node, error.problem))
}

/// The basis that a node names: one of the file, or a known one that is then among them.
fn basis_index(bases: &mut Vec<Basis>, node: Node<'_, '_>) -> Result<usize> {
    let name = content(node);
    if let Some(index) = bases.iter().position(|basis| basis.name.eq_ignore_ascii_case(name)) {
        return Ok(index);
    }
    bases.push(Basis::known(name).ok_or_else(|| at(node, format!("angle basis \"{}\" is not defined", shown(name))))?);
    Ok(bases.len() - 1)
}

/// What a word of a list of names stands for, whatever its case.
fn named<T: Copy>(names: &[(&str, T)], word: &str) -> Option<T> {
    names.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)).map(|(_, value)| *value)
}

fn children<'a, 'input>(node: Node<'a, 'input>, name: &'static str) -> impl Iterator<Item = Node<'a, 'input>> {
    node.children().filter(move |child| child.tag_name().name() == name)
}

fn descend<'a, 'input>(node: Node<'a, 'input>, name: &'static str) -> Option<Node<'a, 'input>> {
    children(node, name).next()
}

fn expect<'a, 'input>(node: Node<'a, 'input>, name: &'static str) -> Result<Node<'a, 'input>> {
    descend(node, name).ok_or_else(|| at(node, format!("no <{name}> in <{}>", node.tag_name().name())))
}

/// A node's text without the white space around it.
fn content<'a>(node: Node<'a, '_>) -> &'a str {
    node.text().unwrap_or("").trim()
}

/// A node's words with the lines that they are in.
fn words<'a>(node: Node<'a, '_>) -> Words<'a> {
    let start = node.first_child().map_or(node.range().start, |text| text.range().start);
    Words::new(node.text().unwrap_or(""), node.document().text_pos_at(start).row.into())
}

/// A problem at a node.
fn at(node: Node<'_, '_>, problem: String) -> FormatError {
    let line = node.document().text_pos_at(node.range().start).row.into();
    FormatError { place: Some(Place::Line(line)), problem }
}
