//! The triangles that a tile may show, in its raster.

use super::view::{Rows, TileView, handedness};
use crate::{
    accel::{BeamVisitor, NONE},
    geometry::GeometryTable,
    transport::{Tables, ray_mask},
};

/// Triangles for each pixel of a tile beyond which rays are faster.
const MOST_A_PIXEL: usize = 6;

/// Triangles in the raster of a tile, in columns.
#[derive(Debug, Default)]
pub(super) struct Triangles {
    /// Raster x and y times the depth, and the depth: `corners[corner][axis]`.
    pub(super) corners: [[Vec<f32>; 3]; 3],
    pub(super) instance: Vec<u32>,
    /// −1 for those of mirrored instances, else 1.
    pub(super) hand: Vec<f32>,
    /// Unit normals in the camera's space, of all sides or of none turned about.
    pub(super) normal: [Vec<f32>; 3],
}

impl Triangles {
    pub(super) fn count(&self) -> usize {
        self.instance.len()
    }

    fn clear(&mut self) {
        self.corners.iter_mut().flatten().for_each(Vec::clear);
        self.instance.clear();
        self.hand.clear();
    }

    /// Lists what the tile may show, and tells `other` the columns and rows of what is no triangle at rest; false if rays are faster.
    pub(super) fn list(&mut self, view: &TileView, tables: &Tables, other: impl FnMut([[usize; 2]; 2])) -> bool {
        self.clear();
        let most = MOST_A_PIXEL * view.size[0] * view.size[1];
        let map = InstanceMap { instance: NONE, rows: *view.world(), hand: 1.0 };
        let mut listing = Listing { triangles: self, view, geometry: &tables.geometry, map, other, most };
        tables.bvh.look_along(view.beam(), ray_mask::CAMERA, &mut listing);
        let few = self.count() <= most;
        let room = gonio_simd::padded(self.count());
        self.corners.iter_mut().flatten().for_each(|column| column.resize(room, 0.0));
        self.hand.resize(room, 1.0);
        self.normal.iter_mut().for_each(|column| column.resize(room, 0.0));
        few
    }
}

/// How the instance that came last lies in the raster.
struct InstanceMap {
    instance: u32,
    rows: Rows,
    hand: f32,
}

/// Lists triangles as they are found.
struct Listing<'a, F> {
    triangles: &'a mut Triangles,
    view: &'a TileView,
    geometry: &'a GeometryTable,
    map: InstanceMap,
    other: F,
    most: usize,
}

impl<F: FnMut([[usize; 2]; 2])> BeamVisitor for Listing<'_, F> {
    fn triangles(&mut self, instance: u32, in_world: bool, corners: &[[[f32; 8]; 3]; 3], numbers: &[u32]) -> bool {
        if self.map.instance != instance {
            let rows = if in_world { *self.view.world() } else { self.view.of_instance(self.geometry, instance) };
            self.map = InstanceMap { instance, rows, hand: handedness(self.geometry, instance) };
        }
        for (columns, [x, y, z]) in self.triangles.corners.iter_mut().zip(corners) {
            for (column, row) in columns.iter_mut().zip(&self.map.rows) {
                let mut places = [0.0; 8];
                for (slot, place) in places.iter_mut().enumerate() {
                    *place = row[0] * x[slot] + row[1] * y[slot] + (row[2] * z[slot] + row[3]);
                }
                column.extend_from_slice(&places[..numbers.len()]);
            }
        }
        let count = self.triangles.count() + numbers.len();
        self.triangles.instance.resize(count, instance);
        self.triangles.hand.resize(count, self.map.hand);
        count <= self.most
    }

    fn other(&mut self, bounds: [[f32; 3]; 2]) {
        if let Some(pixels) = self.view.pixels_of(bounds) {
            (self.other)(pixels);
        }
    }
}
