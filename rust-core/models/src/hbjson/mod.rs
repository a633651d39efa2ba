//! Honeybee models: JSON by honeybee-schema 2.x.

mod faces;
mod generic;
mod grids;
mod luminaires;
mod modifiers;
mod node;
mod sets;
mod shades;
mod states;

use crate::builder::Builder;
use crate::{Model, Options};
use gonio_scene::{Error, Origin, Result};
use modifiers::Library;
use node::Node;
use serde_json::Value;
use states::States;
use std::collections::HashSet;
use std::path::Path;

/// Metres in each unit that a model may have.
const UNITS: [(&str, f64); 5] = [("Meters", 1.0), ("Millimeters", 0.001), ("Feet", 0.3048), ("Inches", 0.0254), ("Centimeters", 0.01)];

/// A model that is being read.
struct Reader<'a> {
    builder: Builder,
    library: Library<'a>,
    states: States<'a>,
    /// The file, for messages.
    file: String,
    metres: f64,
    /// Objects whose twins on the other side of a wall were read already.
    twins: HashSet<&'a str>,
}

/// Reads the text of a model.
///
/// # Errors
/// It is no JSON, no model, or an option names a group or a state that it does not have.
pub(crate) fn read(path: &Path, text: &str, options: &Options) -> Result<Model> {
    let wrong = |line: Option<u64>, problem: String| Error::Format { path: path.into(), line, problem };
    let json: Value = serde_json::from_str(text).map_err(|error| {
        let problem = format!("this is no JSON ({error})");
        wrong(Some(error.line() as u64), problem)
    })?;
    let root = Node::root(&json);
    if root.kind() != "Model" {
        return Err(wrong(None, format!("an object of type '{}' was found, expected a honeybee Model", root.kind())));
    }
    let unit = root.text("units").unwrap_or("Meters");
    let known = UNITS.iter().find(|(name, _)| *name == unit);
    let metres = known.ok_or_else(|| wrong(None, format!("units are '{unit}', expected {}", UNITS.map(|(name, _)| name).join(", "))))?.1;
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut builder = Builder::default();
    builder.model.metres_per_unit = metres;
    let library = Library::of(&root);
    let mut reader = Reader { builder, library, states: States::new(&options.states), file, metres, twins: HashSet::new() };
    reader.model(&root);
    reader.states.check()?;
    Ok(reader.builder.model)
}

impl<'a> Reader<'a> {
    fn model(&mut self, root: &Node<'a>) {
        for room in root.list("rooms") {
            self.builder.count("Room");
            let set = self.library.set_of_room(&room);
            if let Err(problem) = &set {
                self.warn(&room, &format!("{problem}; the generic modifiers are used"));
            }
            let set = set.unwrap_or_default();
            room.list("faces").iter().for_each(|face| self.face(face, &set));
            self.shades_of(&room, &set);
        }
        let set = sets::Set::default();
        root.list("orphaned_faces").iter().for_each(|face| self.face(face, &set));
        root.list("orphaned_apertures").iter().for_each(|aperture| self.sub_face(aperture, &set, "Wall"));
        root.list("orphaned_doors").iter().for_each(|door| self.sub_face(door, &set, "Wall"));
        root.list("orphaned_shades").iter().for_each(|shade| self.orphaned_shade(shade));
        root.list("shade_meshes").iter().for_each(|mesh| self.shade_mesh(mesh));
        if let Some(radiance) = root.get("properties").and_then(|properties| properties.get("radiance")) {
            radiance.list("sensor_grids").iter().for_each(|grid| self.sensor_grid(grid));
            radiance.list("views").iter().for_each(|view| self.view(view));
            radiance.list("luminaires").iter().for_each(|luminaire| self.luminaire(luminaire));
        }
        for (count, what) in self.states.told() {
            let origin = Origin { name: what.as_str().into(), file: self.file.as_str().into() };
            self.builder.note(&origin, format!("of its {count} states the first is shown; --state {what}=N shows another, counted from 0"));
        }
    }

    fn origin(&self, node: &Node<'_>) -> Origin {
        let place = format!("{}: {}", self.file, node.path);
        Origin { name: node.identifier().into(), file: place.as_str().into() }
    }

    fn warn(&mut self, node: &Node<'_>, message: &str) {
        let origin = self.origin(node);
        self.builder.warn(&origin, message);
    }
}

/// What a key of the object's radiance properties holds.
fn radiance<'a>(node: &Node<'a>, key: &str) -> Option<Node<'a>> {
    node.get("properties")?.get("radiance")?.get(key)
}
