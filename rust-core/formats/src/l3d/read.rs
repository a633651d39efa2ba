//! The reader of `structure.xml`.

use super::{L3d, L3dLight, L3dMesh, L3dPart, L3dShape, Place, STRUCTURE, ShiningFaces};
use crate::archive::{Archive, inside, some_of};
use crate::error::{FormatError, Result};
use crate::photometry::text::{parse, quote};
use crate::xml::{LineNumbers, at, attribute, children, descend, document, tag, text_at, text_of};
use roxmltree::Node;
use std::collections::HashMap;

/// Joints after one another: each takes the stack further down.
const DEEPEST: usize = 64;

/// Warnings that are kept.
const MOST_WARNINGS: usize = 50;

/// Metres in the units of meshes.
const UNITS: [(&str, f64); 7] = [("m", 1.0), ("dm", 0.1), ("cm", 0.01), ("mm", 1e-3), ("yard", 0.9144), ("foot", 0.3048), ("inch", 0.0254)];

impl<'a> L3d<'a> {
    /// Reads an L3D file; its meshes stay in the archive.
    ///
    /// # Errors
    /// What is no archive, has no `structure.xml`, or one that is no L3D; with the file inside the archive and its line.
    pub fn read(bytes: &'a [u8]) -> Result<Self> {
        let archive = Archive::open(bytes)?;
        if archive.size(STRUCTURE).is_none() {
            let names = some_of(archive.names());
            let found = if names.is_empty() { "nothing".to_owned() } else { names };
            return Err(FormatError::whole(format!("no {STRUCTURE} is in the archive, expected one in an L3D file; it holds {found}")));
        }
        let structure = archive.read(STRUCTURE)?;
        let text = text_of(&structure).map_err(|error| inside(STRUCTURE, &error))?;
        model(archive, &text).map_err(|error| inside(STRUCTURE, &error))
    }
}

fn model<'a>(archive: Archive<'a>, text: &str) -> Result<L3d<'a>> {
    let document = document(text)?;
    let root = document.root_element();
    if root.tag_name().name() != "Luminaire" {
        return Err(at(root, format!("{} was found, expected L3D's <Luminaire>", tag(root))));
    }
    let name = text_at(root, &["Header", "Name"]);
    let mut reader = Reader {
        lines: LineNumbers::new(text),
        ids: HashMap::new(),
        model: L3d { archive, name, meshes: Vec::new(), parts: Vec::new(), lights: Vec::new(), warnings: Vec::new() },
    };
    for node in descend(root, &["GeometryDefinitions"]).into_iter().flat_map(|list| children(list, "GeometryFileDefinition")) {
        reader.mesh(node);
    }
    let Some(structure) = descend(root, &["Structure"]) else {
        return Err(at(root, "no <Structure> was found, expected one in <Luminaire>".into()));
    };
    for node in children(structure, "Geometry") {
        reader.part(node, &Place::ORIGIN, 0)?;
    }
    Ok(reader.model)
}

/// A model that is being read.
struct Reader<'a> {
    lines: LineNumbers,
    /// Places of meshes by their identifiers.
    ids: HashMap<String, usize>,
    model: L3d<'a>,
}

impl Reader<'_> {
    fn warn(&mut self, node: Node<'_, '_>, problem: String) {
        if self.model.warnings.len() < MOST_WARNINGS {
            let problem = inside(STRUCTURE, &self.lines.at(node, problem));
            self.model.warnings.push(problem);
        }
    }

    fn mesh(&mut self, node: Node<'_, '_>) {
        let (id, name, unit) = (attribute(node, "id"), attribute(node, "filename"), attribute(node, "units"));
        let metres = UNITS.iter().find(|(name, _)| *name == unit).map(|(_, metres)| *metres);
        if metres.is_none() {
            self.warn(node, format!("the unit {} is unknown: metres are taken", quote(unit)));
        }
        let path = format!("{id}/{name}");
        if self.model.archive.size(&path).is_none() {
            self.warn(node, format!("{} is not in the archive", quote(&path)));
        }
        self.ids.insert(id.to_owned(), self.model.meshes.len());
        self.model.meshes.push(L3dMesh { path, metres: metres.unwrap_or(1.0) });
    }

    /// Position and turn of a node; none are the origin.
    fn place(&mut self, node: Node<'_, '_>) -> Place {
        Place::new(self.vector(node, "Position"), self.vector(node, "Rotation"))
    }

    fn vector(&mut self, node: Node<'_, '_>, name: &str) -> [f64; 3] {
        let Some(vector) = descend(node, &[name]) else { return [0.0; 3] };
        let found = ["x", "y", "z"].map(|axis| parse(attribute(vector, axis)));
        if found.contains(&None) {
            self.warn(vector, format!("{} has no three numbers x, y and z: 0 stands for what is missing", tag(vector)));
        }
        found.map(|number| number.unwrap_or(0.0))
    }

    /// A `<Geometry>` within a place, and all that hangs on it.
    fn part(&mut self, node: Node<'_, '_>, within: &Place, depth: usize) -> Result<()> {
        if depth == DEEPEST {
            return Err(self.lines.at(node, format!("more than {DEEPEST} joints hang on one another")));
        }
        let place = within.then(&self.place(node));
        let id = descend(node, &["GeometryReference"]).map(|reference| attribute(reference, "geometryId")).unwrap_or_default();
        match self.ids.get(id) {
            Some(mesh) => {
                let shining = shining(node);
                let name = attribute(node, "partName").to_owned();
                self.model.parts.push(L3dPart { name, mesh: *mesh, place, shining });
            }
            None => self.warn(node, format!("no geometry {} is defined", quote(id))),
        }
        for light in descend(node, &["LightEmittingObjects"]).into_iter().flat_map(|list| children(list, "LightEmittingObject")) {
            let own = place.then(&self.place(light));
            self.light(light, own);
        }
        for joint in descend(node, &["Joints"]).into_iter().flat_map(|list| children(list, "Joint")) {
            // The joint's own turn comes after its place, about the same axes.
            let turn = Place::new([0.0; 3], self.vector(joint, "DefaultRotation"));
            let place = place.then(&self.place(joint)).then(&turn);
            for geometry in descend(joint, &["Geometries"]).into_iter().flat_map(|list| children(list, "Geometry")) {
                self.part(geometry, &place, depth + 1)?;
            }
        }
        Ok(())
    }

    fn light(&mut self, node: Node<'_, '_>, place: Place) {
        let length = |node: Node<'_, '_>, name: &str| parse(attribute(node, name)).filter(|length| *length > 0.0);
        let circle = descend(node, &["Circle"]).map(|circle| length(circle, "diameter").map(L3dShape::Circle));
        let rectangle =
            descend(node, &["Rectangle"]).map(|sides| Some(L3dShape::Rectangle([length(sides, "sizeX")?, length(sides, "sizeY")?])));
        let shape = circle.or(rectangle);
        if shape == Some(None) {
            self.warn(node, "the light emitting object has a shape without a size: a point is taken".into());
        }
        let heights = descend(node, &["LuminousHeights"]);
        let height = |name: &str| heights.and_then(|heights| length(heights, name)).unwrap_or(0.0);
        self.model.lights.push(L3dLight {
            name: attribute(node, "partName").to_owned(),
            place,
            shape: shape.flatten().unwrap_or(L3dShape::Point),
            heights: ["c0", "c90", "c180", "c270"].map(height),
        });
    }
}

/// Faces that shine, as the format has them since 0.10, and as it had them before.
fn shining(node: Node<'_, '_>) -> Vec<ShiningFaces> {
    let mut found = Vec::new();
    for surface in descend(node, &["LightEmittingSurfaces"]).into_iter().flat_map(|list| children(list, "LightEmittingSurface")) {
        // A surface that several lights share is listed with the first.
        let light = descend(surface, &["LightEmittingObjectReference"]).map(|node| attribute(node, "lightEmittingPartName"));
        let assigned = descend(surface, &["FaceAssignments"]);
        found.extend(assigned.into_iter().flat_map(|list| list.children()).filter_map(|node| faces(node, light.unwrap_or_default())));
    }
    let before = descend(node, &["LightEmittingFaceAssignments"]);
    let assigned = before.into_iter().flat_map(|list| list.children());
    found.extend(assigned.filter_map(|node| faces(node, attribute(node, "lightEmittingPartName"))));
    found
}

fn faces(node: Node<'_, '_>, light: &str) -> Option<ShiningFaces> {
    let number = |name: &str| attribute(node, name).parse::<u32>().ok();
    let first = number("faceIndex").or_else(|| number("faceIndexBegin"))?;
    let last = number("faceIndex").or_else(|| number("faceIndexEnd"))?;
    Some(ShiningFaces { light: light.to_owned(), group: number("groupIndex"), faces: [first, last] })
}
