//! What a program reads and writes: surface points, registers and computed parameters, in columns.

use super::{CHUNK, nearby_rays::NearbyRays};
use crate::geometry::{GeometryTable, HitLanes};
use gonio_image::texture::TileReader;
use gonio_nodes::Registers;
use gonio_simd::{Column, Lanes, Vec3};

/// Surface points of a chunk, one entry a hit; normals lie on the side of `wo`.
#[derive(Clone, Debug)]
pub struct SurfaceColumns {
    /// Instance numbers.
    pub instance: Column<u32>,
    /// Triangle numbers in their meshes.
    pub primitive: Column<u32>,
    /// Barycentric coordinates of corners 1 and 2.
    pub barycentric: [Column; 2],
    /// Positions, rebased world space.
    pub position: [Column; 3],
    /// World position of the rebased origin, metres; the same for all points.
    pub origin: [f32; 3],
    /// Error bounds of the positions along the normals.
    pub error: Column,
    /// Unit triangle normals.
    pub geometric_normal: [Column; 3],
    /// Unit shading normals.
    pub shading_normal: [Column; 3],
    /// Unit shading normals before the program bent them; only where it does.
    pub smooth_normal: [Column; 3],
    /// Unit normals of the coat; only where the program gives them.
    pub coat_normal: [Column; 3],
    /// Tangents along the first texture coordinate, not unit; zero where there is none.
    pub tangent: [Column; 3],
    /// Width of the cone around the ray where it arrives, metres; zero where there is none.
    pub cone: Column,
    /// Width of a pixel on the surface, metres; zero where the ray has no cone.
    pub width: Column,
    /// Width that images are looked up over, in texture coordinates.
    pub uv_width: Column,
    /// The share of a pixel's width that a sample's lookups are over ([`Transport::lookup_width`](crate::Transport::lookup_width)).
    pub lookup_width: f32,
    /// 1 on the front side, −1 on the back.
    pub side: Column,
    /// Unit directions to where the ray came from.
    pub wo: [Column; 3],
    /// Times of the shutter, where anything moves.
    pub time: Column,
    /// Whether there are times.
    pub has_times: bool,
    /// Flags of the paths, their counts of bounces by kind, and the lengths of the rays; only where the program asks for the ray.
    pub ray_flags: Column<u32>,
    /// See `ray_flags`.
    pub ray_counts: Column<u32>,
    /// See `ray_flags`, metres.
    pub ray_length: Column,
}

impl Default for SurfaceColumns {
    fn default() -> Self {
        let column = || Column::new(CHUNK);
        let three = || [column(), column(), column()];
        Self {
            instance: Column::new(CHUNK),
            primitive: Column::new(CHUNK),
            barycentric: [column(), column()],
            position: three(),
            origin: [0.0; 3],
            error: column(),
            geometric_normal: three(),
            shading_normal: three(),
            smooth_normal: three(),
            coat_normal: three(),
            tangent: three(),
            cone: column(),
            width: column(),
            uv_width: column(),
            lookup_width: 1.0,
            side: column(),
            wo: three(),
            time: column(),
            has_times: false,
            ray_flags: Column::new(CHUNK),
            ray_counts: Column::new(CHUNK),
            ray_length: column(),
        }
    }
}

impl SurfaceColumns {
    /// One register of the hits, at their times.
    #[inline(always)]
    pub(crate) fn hit<L: Lanes>(&self, l: L, geometry: &GeometryTable, at: usize) -> HitLanes<L> {
        let (instance, primitive) = (l.load_integers(&self.instance, at), l.load_integers(&self.primitive, at));
        let [u, v] = [l.load(&self.barycentric[0], at), l.load(&self.barycentric[1], at)];
        let hit = geometry.hit_lanes(l, instance, primitive, u, v);
        if self.has_times { hit.at_time(l.load(&self.time, at)) } else { hit }
    }
}

/// One register of three columns.
#[inline(always)]
pub(super) fn load3<L: Lanes>(l: L, columns: &[Column; 3], at: usize) -> Vec3<L> {
    Vec3::load(l, [&columns[0], &columns[1], &columns[2]], at)
}

/// The parameters that a program computed, `CHUNK` values a place, in the order of its outputs.
#[derive(Clone, Debug, Default)]
pub struct OutputColumns {
    pub(super) values: Vec<f32>,
}

impl OutputColumns {
    /// The column of the `place`-th computed place.
    pub fn column(&self, place: usize) -> &[f32] {
        &self.values[place * CHUNK..(place + 1) * CHUNK]
    }
}

/// Columns of the steps.
#[derive(Debug, Default)]
pub struct GraphScratch {
    pub(super) registers: Registers,
    /// Rays of steps that look around hits, once there were any.
    pub(super) nearby: Option<Box<NearbyRays>>,
    /// Tiles of textures within a memory limit.
    pub(super) tiles: TileReader,
}
