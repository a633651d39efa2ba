//! Running a program over a chunk of hits.

use super::{
    Around, CHUNK, GraphScratch, OutputColumns, Program, SurfaceColumns,
    columns::load3,
    hit_step::{Points, run_hit_step},
    normals::bend_normals,
    program::Direction,
};
use crate::geometry::GeometryTable;
use gonio_image::texture::TextureTable;
use gonio_nodes::Registers;
use gonio_simd::{F, Lanes, Vec3};

/// Runs a program over the first `count` hits of a chunk: fills `outputs`, and bends the shading normals if it says so.
#[inline(always)]
pub fn evaluate<L: Lanes>(
    l: L,
    program: &Program,
    (geometry, textures, around): (&GeometryTable, &TextureTable, &Around<'_>),
    points: &mut SurfaceColumns,
    count: usize,
    scratch: &mut GraphScratch,
    outputs: &mut OutputColumns,
) {
    let places = program.outputs.iter().map(|output| output.sources.len()).sum::<usize>();
    outputs.values.resize(places * CHUNK, 0.0);
    let piece = program.steps.piece();
    for first in (0..count).step_by(piece) {
        let len = piece.min(count - first);
        let tables = Points { geometry, textures, columns: points, first };
        program.steps.run(
            l,
            len,
            &mut scratch.registers,
            #[inline(always)]
            |step, io| run_hit_step(l, step, &tables, (around, &mut scratch.nearby, &mut scratch.tiles), io),
        );
        let sources = program.outputs.iter().flat_map(|output| output.sources.iter().map(|source| (source, output.range)));
        for (place, (source, range)) in sources.enumerate() {
            let column = &mut outputs.values[place * CHUNK..(place + 1) * CHUNK];
            for at in (0..len).step_by(L::COUNT) {
                let value = scratch.registers.read(l, *source, at);
                let value = match range {
                    Some(range) => held(value, range),
                    None => value,
                };
                value.store(column, first + at);
            }
        }
        for at in (0..len).step_by(L::COUNT) {
            store_directions(l, program, points, &scratch.registers, first, at);
        }
    }
}

/// A value within a range; what is nearest to nothing where it is no number.
#[inline(always)]
fn held<L: Lanes>(value: F<L>, [low, high]: [f32; 2]) -> F<L> {
    let number = value.ge(low) | value.lt(low);
    number.select(value.max(low).min(high), value.lanes().f(0.0f32.clamp(low, high)))
}

/// Puts the tangent, the coat's normal and the bent normal of the piece's entry `at` in place.
#[inline(always)]
fn store_directions<L: Lanes>(l: L, program: &Program, points: &mut SurfaceColumns, registers: &Registers, first: usize, at: usize) {
    let direction = |[x, y, z]: Direction| Vec3::new(registers.read(l, x, at), registers.read(l, y, at), registers.read(l, z, at));
    let at = first + at;
    if let Some(tangent) = program.tangent {
        let [a, b, c] = &mut points.tangent;
        direction(tangent).store([a, b, c], at);
    }
    if let Some(normal) = program.coat_normal {
        let smooth = load3(l, &points.shading_normal, at);
        let [a, b, c] = &mut points.coat_normal;
        direction(normal).normalize_or(smooth).store([a, b, c], at);
    }
    if let Some(normal) = program.normal {
        let smooth = load3(l, &points.shading_normal, at);
        let smooth = program.smooth_normal.map_or(smooth, |own| direction(own).normalize_or(smooth));
        bend_normals(l, points, at, direction(normal), smooth, program.free_normal);
    }
}
