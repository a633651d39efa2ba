//! What lies in a beam of rays from one point: the triangles that a part of a picture may show.

use crate::intersect::smooth::Smooth;
use crate::intersect::transform::Affine;
use crate::ray::RayMask;
use crate::tree::instance::{Geometry, InstanceRecord, MapKind};
use crate::tree::node::{Bounds, ChildRef, Kind, Node, STACK, WIDTH};
use crate::tree::tlas::Tlas;

/// All rays from a point between four others.
#[derive(Clone, Copy, Debug)]
pub struct Beam {
    /// Where the rays start, metres.
    pub apex: [f32; 3],
    /// Directions of the four rays at the rim, one after the other; of any length.
    pub rim: [[f32; 3]; 4],
}

/// Takes what lies in a beam.
pub trait BeamVisitor {
    /// Up to eight triangles of an instance, `corners[corner][axis][place]`: in the world if `in_world`, else in the instance's own space. False ends
    /// the search.
    fn triangles(&mut self, instance: u32, in_world: bool, corners: &[[[f32; WIDTH]; 3]; 3], numbers: &[u32]) -> bool;
    /// Something that is no triangle at rest, within a box of the world: lowest and highest coordinates in metres.
    fn other(&mut self, bounds: [[f32; 3]; 2]);
}

/// Where a plane's `a x + b y + c z + d` is below zero lies nothing of the beam.
type Plane = [f32; 4];

impl Beam {
    fn planes(&self) -> [Plane; 4] {
        let mut planes = [[0.0; 4]; 4];
        for (side, plane) in planes.iter_mut().enumerate() {
            let (a, b, inside) = (self.rim[side], self.rim[(side + 1) % 4], self.rim[(side + 2) % 4]);
            let mut normal = [0, 1, 2].map(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
            if dot(normal, inside) < 0.0 {
                normal = normal.map(|x| -x);
            }
            *plane = [normal[0], normal[1], normal[2], -dot(normal, self.apex)];
        }
        planes
    }

    fn transformed(&self, map: &Affine) -> Self {
        let padded = |v: [f32; 3]| [v[0], v[1], v[2], 0.0];
        let cut = |v: [f32; 4]| [v[0], v[1], v[2]];
        Self { apex: cut(map.point(padded(self.apex))), rim: self.rim.map(|way| cut(map.direction(padded(way)))) }
    }
}

fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Tlas {
    /// Shows a visitor what lies in a beam and is seen by rays of a mask, and more that lies near it.
    pub fn look_along(&self, beam: &Beam, mask: RayMask, visitor: &mut impl BeamVisitor) {
        for light in &self.loose_lights {
            if self.records[light.record as usize].mask & mask != 0 {
                visitor.other(light.bounds());
            }
        }
        let mut leaf = |leaf: ChildRef, bounds: &Bounds| {
            if leaf.is(Kind::WorldTriangles) {
                let (owner, block) = (self.owners[leaf.index()], &self.blocks[leaf.index()]);
                return owner.mask & mask == 0 || visitor.triangles(owner.id, true, &block.vertices, &block.primitives[..block.len()]);
            }
            let record = &self.records[leaf.index()];
            record.mask & mask == 0 || self.look_at(record, bounds, beam, visitor)
        };
        walk(&self.nodes, beam, &mut leaf);
    }

    /// Shows an instance; false if the visitor ended the search.
    fn look_at(&self, record: &InstanceRecord, bounds: &Bounds, beam: &Beam, visitor: &mut impl BeamVisitor) -> bool {
        if let (Geometry::Mesh(index), true) = (record.geometry.get(), record.map != MapKind::Moving) {
            let mesh = &self.meshes[index as usize];
            if mesh.is_still() && matches!(mesh.smooth, Smooth::Nothing) {
                let mut leaf = |leaf: ChildRef, _: &Bounds| {
                    let block = &mesh.blocks[leaf.index()];
                    visitor.triangles(record.id, false, &block.vertices, &block.primitives[..block.len()])
                };
                return walk(&mesh.nodes, &beam.transformed(&record.world_to_object), &mut leaf);
            }
        }
        visitor.other([bounds.min, bounds.max]);
        true
    }
}

/// Calls for the leaves whose boxes lie in a beam or near it; false if one of them ended the search.
fn walk(nodes: &[Node], beam: &Beam, leaf: &mut impl FnMut(ChildRef, &Bounds) -> bool) -> bool {
    let (planes, mut stack, mut top) = (beam.planes(), [ChildRef::ROOT; STACK], 1);
    while top > 0 {
        top -= 1;
        let Some(node) = nodes.get(stack[top].index()) else { return true };
        let mut met = met(node, &planes);
        while met != 0 {
            let slot = met.trailing_zeros() as usize % WIDTH;
            met &= met - 1;
            let child = node.children[slot];
            if child.is_inner() {
                stack[top % STACK] = child;
                top += 1;
            } else if !leaf(child, &node.bounds_of(slot)) {
                return false;
            }
        }
    }
    true
}

/// The slots of a node whose boxes lie on no plane's outer side.
fn met(node: &Node, planes: &[Plane; 4]) -> u32 {
    let mut outside = [false; WIDTH];
    for (slot, outside) in outside.iter_mut().enumerate() {
        *outside = node.bounds[0][slot] > node.bounds[3][slot];
    }
    for plane in planes {
        // The corner that lies farthest inside.
        let [x, y, z] = [0, 1, 2].map(|axis| &node.bounds[if plane[axis] > 0.0 { axis + 3 } else { axis }]);
        for (slot, outside) in outside.iter_mut().enumerate() {
            *outside |= plane[0] * x[slot] + plane[1] * y[slot] + plane[2] * z[slot] + plane[3] < 0.0;
        }
    }
    outside.iter().enumerate().fold(0, |met, (slot, outside)| met | u32::from(!outside) << slot)
}
