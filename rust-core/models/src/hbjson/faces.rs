//! Rooms' faces with windows and doors cut out of them.

use super::node::Node;
use super::sets::{self, Place, Set};
use super::{Reader, radiance};
use crate::builder::{Paint, Triangles};
use crate::outline::{cut, moved};
use crate::vector::{Vec3, newell, unit};

/// Metres by which the second of two faces at one place lies inside its room: each room sees its own.
const TWIN_OFFSET: f64 = 1e-3;

/// A Face3D.
pub(super) struct Outline {
    pub(super) boundary: Vec<Vec3>,
    pub(super) holes: Vec<Vec<Vec3>>,
}

/// The outline of an object's geometry.
///
/// # Errors
/// What is missing or no number.
pub(super) fn outline(node: &Node<'_>) -> Result<Outline, String> {
    let geometry = node.get("geometry").ok_or("geometry is missing, expected a Face3D")?;
    let corners = |list: &Node<'_>| list.items().map(|corner| corner.vector()).collect::<Result<Vec<Vec3>, String>>();
    let boundary = corners(&geometry.get("boundary").ok_or("geometry.boundary is missing, expected a list of corners")?)?;
    let holes = geometry.list("holes").iter().map(corners).collect::<Result<_, _>>()?;
    Ok(Outline { boundary, holes })
}

/// The type of an object's boundary condition.
fn boundary<'a>(node: &Node<'a>) -> &'a str {
    node.get("boundary_condition").map_or("Outdoors", |condition| condition.kind())
}

impl<'a> Reader<'a> {
    /// Adds a face with its windows, doors and shades.
    pub(super) fn face(&mut self, face: &Node<'a>, set: &Set<'a>) {
        self.builder.count("Face");
        let face_type = face.text("face_type").unwrap_or("Wall");
        let parts: Vec<Node<'a>> = face.list("apertures").into_iter().chain(face.list("doors")).collect();
        match sets::of_face(face_type, boundary(face)) {
            Some(place) => {
                let result = self.punched(face, &parts, set, place);
                self.tell(face, result);
            }
            None => self.warn(
                face,
                &format!("face type '{face_type}' was found, expected Wall, Floor, RoofCeiling or AirBoundary; it is left out"),
            ),
        }
        parts.iter().for_each(|part| self.sub_face(part, set, face_type));
        self.shades_of(face, set);
    }

    /// Warns of an object that is left out.
    pub(super) fn tell(&mut self, node: &Node<'a>, result: Result<(), String>) {
        if let Err(problem) = result {
            self.warn(node, &format!("{problem}; it is left out"));
        }
    }

    /// Adds a face without what its windows and doors cover.
    fn punched(&mut self, face: &Node<'a>, parts: &[Node<'a>], set: &Set<'a>, place: Place) -> Result<(), String> {
        let Some(paint) = self.paint(face, set, place) else { return Ok(()) };
        let Outline { mut boundary, mut holes } = outline(face)?;
        // Windows that are wrong are told when their turn comes.
        holes.extend(parts.iter().filter_map(|part| outline(part).ok()).map(|part| part.boundary));
        if self.is_twin(face) {
            let inwards = unit(newell(&boundary)).unwrap_or_default().map(|x| -x * TWIN_OFFSET / self.metres);
            boundary = moved(&boundary, inwards);
            holes = holes.iter().map(|hole| moved(hole, inwards)).collect();
        }
        self.add_flat(face, &boundary, &holes, &paint)
    }

    /// Whether an object's other side was read before; it is noted down.
    fn is_twin(&mut self, node: &Node<'a>) -> bool {
        if self.twins.contains(node.identifier()) {
            return true;
        }
        let objects = node.get("boundary_condition").map(|condition| condition.list("boundary_condition_objects")).unwrap_or_default();
        self.twins.extend(objects.first().and_then(|object| object.value.as_str()));
        false
    }

    /// Adds a flat surface.
    pub(super) fn add_flat(&mut self, node: &Node<'a>, boundary: &[Vec3], holes: &[Vec<Vec3>], paint: &Paint) -> Result<(), String> {
        let cut = cut(boundary, holes)?;
        if let Some(doubt) = cut.doubt {
            self.warn(node, doubt);
        }
        // A window may take the whole of its wall.
        if !cut.triangles.is_empty() {
            self.builder.add(&self.origin(node), Triangles::of_cut(&cut, self.metres), paint);
        }
        Ok(())
    }

    /// Adds a window or a door with its shades.
    pub(super) fn sub_face(&mut self, part: &Node<'a>, set: &Set<'a>, face_type: &str) {
        let is_door = part.kind() == "Door";
        self.builder.count(if is_door { "Door" } else { "Aperture" });
        // What both rooms have is one pane.
        if !self.is_twin(part) {
            let place = if is_door {
                sets::of_door(boundary(part), part.flag("is_glass"), face_type)
            } else {
                sets::of_aperture(boundary(part), part.flag("is_operable"), face_type)
            };
            let result = self.flat(part, set, place);
            self.tell(part, result);
        }
        self.shades_of(part, set);
    }

    /// Adds an object that is its geometry, in its state.
    pub(super) fn flat(&mut self, node: &Node<'a>, set: &Set<'a>, place: Place) -> Result<(), String> {
        let paint = self.paint(node, set, place);
        let state = self.states.of(node);
        for shade in state.iter().flat_map(|state| state.list("shades")) {
            let asked = shade.get("modifier");
            let result = self.state_shade(&shade, asked, set);
            self.tell(&shade, result);
        }
        let Some(paint) = paint else { return Ok(()) };
        let Outline { boundary, holes } = outline(node)?;
        self.add_flat(node, &boundary, &holes, &paint)
    }

    fn state_shade(&mut self, shade: &Node<'a>, asked: Option<Node<'a>>, set: &Set<'a>) -> Result<(), String> {
        let Some(paint) = self.paint_of(shade, asked, set, sets::of_shade(false)) else { return Ok(()) };
        let Outline { boundary, holes } = outline(shade)?;
        self.add_flat(shade, &boundary, &holes, &paint)
    }

    /// The material of an object: that of its state, its own, its room's by what it is, or honeybee's own; `None` where nothing is there.
    pub(super) fn paint(&mut self, node: &Node<'a>, set: &Set<'a>, place: Place) -> Option<Paint> {
        let asked = self.states.of(node).and_then(|state| state.get("modifier")).or_else(|| radiance(node, "modifier"));
        self.paint_of(node, asked, set, place)
    }

    fn paint_of(&mut self, node: &Node<'a>, asked: Option<Node<'a>>, set: &Set<'a>, place: Place) -> Option<Paint> {
        let asked = asked.or_else(|| set.get(place));
        let found = asked.map(|asked| self.library.modifier(&asked));
        let (name, modifier) = match found {
            Some(Ok(found)) => found,
            other => {
                if let Some(Err(problem)) = other {
                    self.warn(node, &format!("{problem}; '{}' is used", place.2));
                }
                (place.2, super::generic::generic(place.2)?)
            }
        };
        let origin = gonio_scene::Origin { name: name.into(), file: self.file.as_str().into() };
        self.builder.paint(name, &origin, &modifier)
    }
}
