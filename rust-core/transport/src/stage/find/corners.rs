//! What a graph gives at the corners of triangles, seen from right above: displacement asks it before anything is traced.

use crate::geometry::GeometryTable;
use crate::graph::{Around, CHUNK, GraphScratch, OutputColumns, Program, SurfaceColumns};
use crate::kernels;
use gonio_image::texture::TextureTable;
use gonio_simd::{Column, Execution, Lanes, Vec3, dispatch};

/// A corner of a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Its number, three a triangle.
    pub number: u32,
    /// The unit normal there, world space.
    pub normal: [f32; 3],
}

/// The instance that corners belong to, and all that a graph may ask.
#[derive(Clone, Copy, Debug)]
pub struct CornerTables<'a> {
    /// The level of the lanes.
    pub execution: Execution,
    /// The mesh.
    pub geometry: &'a GeometryTable,
    /// The images.
    pub textures: &'a TextureTable,
    /// The surfaces around.
    pub around: Around<'a>,
    /// The instance's number in the geometry.
    pub instance: u32,
    /// World position of the rebased origin, metres.
    pub origin: [f64; 3],
}

/// Columns for a chunk of corners, used again from chunk to chunk.
#[derive(Debug, Default)]
pub struct CornerRoom {
    surface: SurfaceColumns,
    scratch: GraphScratch,
    outputs: OutputColumns,
}

impl CornerTables<'_> {
    /// The first three places that a program computes, zero for those that it has not.
    pub fn values(&self, program: &Program, corners: &[Corner], room: &mut CornerRoom, values: &mut [[f32; 3]]) {
        let places = program.outputs.iter().map(|output| output.sources.len()).sum::<usize>().min(3);
        for (corners, values) in corners.chunks(CHUNK).zip(values.chunks_mut(CHUNK)) {
            self.fill(corners, &mut room.surface);
            let CornerRoom { surface, scratch, outputs } = room;
            dispatch!(self.execution, l => run(l, self, program, corners.len(), (&mut *surface, &mut *scratch, &mut *outputs)));
            for (at, value) in values.iter_mut().enumerate() {
                for (place, component) in value.iter_mut().enumerate() {
                    *component = if place < places { outputs.column(place)[at] } else { 0.0 };
                }
            }
        }
    }

    /// What is known of the corners; registers beyond the last one hold it again.
    fn fill(&self, corners: &[Corner], out: &mut SurfaceColumns) {
        out.origin = self.origin.map(|x| x as f32);
        let Some(last) = corners.last() else { return };
        for at in 0..CHUNK {
            let corner = corners.get(at).unwrap_or(last);
            out.instance[at] = self.instance;
            out.primitive[at] = corner.number / 3;
            (out.barycentric[0][at], out.barycentric[1][at]) = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)][(corner.number % 3) as usize];
            for (axis, value) in corner.normal.into_iter().enumerate() {
                out.shading_normal[axis][at] = value;
                out.wo[axis][at] = value;
            }
            out.side[at] = 1.0;
        }
    }
}

#[inline(always)]
fn run<L: Lanes>(
    l: L,
    tables: &CornerTables<'_>,
    program: &Program,
    count: usize,
    (surface, scratch, outputs): (&mut SurfaceColumns, &mut GraphScratch, &mut OutputColumns),
) {
    place(l, tables.geometry, program, count, surface);
    kernels::evaluate_on(l, program, &(tables.geometry, tables.textures, &tables.around), surface, count, scratch, outputs);
}

/// Positions, triangle normals and tangents.
#[inline(always)]
fn place<L: Lanes>(l: L, geometry: &GeometryTable, program: &Program, count: usize, out: &mut SurfaceColumns) {
    for at in (0..count).step_by(L::COUNT) {
        let [u, v] = [l.load(&out.barycentric[0], at), l.load(&out.barycentric[1], at)];
        let hit = geometry.hit_lanes(l, l.load_integers(&out.instance, at), l.load_integers(&out.primitive, at), u, v);
        let point = geometry.surface_point(l, &hit);
        store3(point.position, &mut out.position, at);
        store3(point.geometric_normal, &mut out.geometric_normal, at);
        let tangent = match program.uv {
            Some(column) => geometry.uv_derivatives(l, &hit, column, point.edges).tangent,
            None => Vec3::splat(l, [0.0; 3]),
        };
        store3(tangent, &mut out.tangent, at);
    }
}

#[inline(always)]
fn store3<L: Lanes>(v: Vec3<L>, columns: &mut [Column; 3], at: usize) {
    let [x, y, z] = columns;
    v.store([x, y, z], at);
}
