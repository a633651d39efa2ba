//! Shades: of rooms, faces, windows and doors, and those without a parent.

use super::Reader;
use super::node::Node;
use super::sets::{self, Set};
use crate::builder::Triangles;
use crate::outline::cut;
use crate::vector::Vec3;

impl<'a> Reader<'a> {
    /// Adds the shades of an object, outside and inside.
    pub(super) fn shades_of(&mut self, node: &Node<'a>, set: &Set<'a>) {
        for (key, is_indoor) in [("outdoor_shades", false), ("indoor_shades", true)] {
            for shade in node.list(key) {
                self.builder.count("Shade");
                let result = self.flat(&shade, set, sets::of_shade(is_indoor));
                self.tell(&shade, result);
            }
        }
    }

    pub(super) fn orphaned_shade(&mut self, shade: &Node<'a>) {
        self.builder.count("Shade");
        let result = self.flat(shade, &Set::default(), sets::of_orphan(shade.flag("is_detached")));
        self.tell(shade, result);
    }

    pub(super) fn shade_mesh(&mut self, mesh: &Node<'a>) {
        self.builder.count("ShadeMesh");
        let result = self.mesh(mesh);
        self.tell(mesh, result);
    }

    fn mesh(&mut self, mesh: &Node<'a>) -> Result<(), String> {
        // A mesh without parents is detached where nothing is said.
        let is_detached = mesh.get("is_detached").is_none() || mesh.flag("is_detached");
        let Some(paint) = self.paint(mesh, &Set::default(), sets::of_orphan(is_detached)) else { return Ok(()) };
        let geometry = mesh.get("geometry").ok_or("geometry is missing, expected a Mesh3D")?;
        let points: Vec<Vec3> = geometry.list("vertices").iter().map(Node::vector).collect::<Result<_, _>>()?;
        let mut shape = Triangles::default();
        for face in geometry.list("faces") {
            match corners(&face, &points).and_then(|corners| cut(&corners, &[])) {
                Ok(cut) => {
                    let first = shape.points.len() as u32;
                    shape.points.extend(cut.points.iter().map(|p| p.map(|x| x * self.metres)));
                    shape.triangles.extend(cut.triangles.iter().map(|triangle| triangle.map(|corner| corner + first)));
                }
                Err(problem) => self.tell(&face, Err(problem)),
            }
        }
        if shape.triangles.is_empty() {
            return Err("it has no faces".into());
        }
        self.builder.add(&self.origin(mesh), shape, &paint);
        Ok(())
    }
}

/// The corners of a mesh's face.
fn corners(face: &Node<'_>, points: &[Vec3]) -> Result<Vec<Vec3>, String> {
    let corner = |index: Node<'_>| {
        let found = index.value.as_u64().and_then(|index| points.get(usize::try_from(index).ok()?));
        found.copied().ok_or_else(|| format!("corner {} was found, expected a number below {}", index.value, points.len()))
    };
    face.items().map(corner).collect()
}
