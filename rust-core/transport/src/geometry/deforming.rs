//! Points and normals of meshes that change their form, at the times of hits.

use super::{GeometryTable, HitLanes};
use gonio_simd::motion::segment_of;
use gonio_simd::{F, Lanes, M, PADDING, U, Vec3};

/// Where a mesh's keys stand; all zero for a mesh that keeps its form.
#[derive(Clone, Copy, Debug, Default)]
pub struct MeshKeys {
    /// Intervals between keys.
    pub segments: u32,
    /// First coordinate of the first key in `key_points`, and coordinates of a key.
    pub first_point: u32,
    /// See `first_point`.
    pub points: u32,
    /// First number of the first key in `key_normals`, and numbers of a key; 0 where normals stay as they are.
    pub first_normal: u32,
    /// See `first_normal`.
    pub normals: u32,
}

/// Two keys' places and the share of the way between them.
struct Between {
    from: usize,
    to: usize,
    share: f32,
}

impl Between {
    fn new(segments: u32, time: f32, first: u32, stride: u32) -> Self {
        let (number, share) = segment_of(time, segments as usize);
        let from = first as usize + number * stride as usize;
        Self { from, to: from + stride as usize, share }
    }

    fn value(&self, table: &[f32], at: usize) -> [f32; 3] {
        let (from, to) = (&table[self.from + at..self.from + at + 3], &table[self.to + at..self.to + at + 3]);
        let mut value = [0.0; 3];
        for axis in 0..3 {
            value[axis] = from[axis] + (to[axis] - from[axis]) * self.share;
        }
        value
    }
}

impl GeometryTable {
    /// A corner of the triangles where some meshes change their form, `still` being that of the others.
    #[inline(always)]
    pub(super) fn moved_point<L: Lanes>(&self, l: L, hit: &HitLanes<L>, corner: usize, still: Vec3<L>) -> Vec3<L> {
        self.moved_place(l, hit, hit.points[corner], still)
    }

    /// A point of the hits' geometry by its number over all geometry, `still` being where it is if nothing moves.
    #[inline(always)]
    pub(super) fn moved_place<L: Lanes>(&self, l: L, hit: &HitLanes<L>, number: U<L>, still: Vec3<L>) -> Vec3<L> {
        self.between_keys(l, hit, (number - hit.first_point) * 3, still, false)
    }

    /// The same for a normal whose number is at a place of the mesh's own.
    #[inline(always)]
    pub(super) fn moved_normal<L: Lanes>(&self, l: L, hit: &HitLanes<L>, place: U<L>, still: Vec3<L>) -> Vec3<L> {
        self.between_keys(l, hit, place, still, true)
    }

    #[inline(always)]
    fn between_keys<L: Lanes>(&self, l: L, hit: &HitLanes<L>, place: U<L>, still: Vec3<L>, of_normals: bool) -> Vec3<L> {
        let (meshes, places, times) = (hit.mesh.to_array(), place.to_array(), hit.time.to_array());
        let (mut columns, mut bits) = ([[0.0; PADDING]; 3], 0u64);
        for lane in 0..L::COUNT {
            if let Some(value) = self.between(meshes[lane], places[lane], times[lane], of_normals) {
                bits |= 1 << lane;
                for axis in 0..3 {
                    columns[axis][lane] = value[axis];
                }
            }
        }
        let moved: [F<L>; 3] = [l.load(&columns[0], 0), l.load(&columns[1], 0), l.load(&columns[2], 0)];
        M(l.mask_from_bits(bits)).select(Vec3::new(moved[0], moved[1], moved[2]), still)
    }

    /// The value at a place of a mesh's keys at a time; `None` where the mesh has none.
    fn between(&self, mesh: u32, place: u32, time: f32, of_normals: bool) -> Option<[f32; 3]> {
        let keys = self.mesh_keys.get(mesh as usize).filter(|keys| keys.segments > 0)?;
        let (table, first, stride) = match of_normals {
            false => (&self.key_points, keys.first_point, keys.points),
            true => (&self.key_normals, keys.first_normal, keys.normals),
        };
        // Lanes beyond the last hit have any number.
        if stride < 3 || place > stride - 3 {
            return None;
        }
        Some(Between::new(keys.segments, time, first, stride).value(table, place as usize))
    }
}
