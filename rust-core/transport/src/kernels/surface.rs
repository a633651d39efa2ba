//! Surface points, and what shading programs compute there.

use crate::geometry::GeometryTable;
use crate::graph::{self, Around, GraphScratch, OutputColumns, Program, SurfaceColumns};
use crate::stage::find::surface::{ChunkSource, HitSource, surface_chunk};
use crate::state::chunk::ChunkColumns;
use crate::tables::Tables;
use gonio_image::texture::TextureTable;
use gonio_simd::{Lanes, Vec3};

/// [`surface_chunk`].
#[inline(never)]
pub(crate) fn surface_points<L: Lanes, H: HitSource + ?Sized>(
    l: L,
    tables: &Tables,
    program: &Program,
    hits: &H,
    source: &ChunkSource<'_>,
    out: &mut SurfaceColumns,
) {
    l.vectorize(
        #[inline(always)]
        || surface_chunk(l, tables, program, hits, source, out),
    );
}

/// [`graph::evaluate`] on a scene's tables.
#[inline(always)]
pub(crate) fn evaluate<L: Lanes>(
    l: L,
    tables: &Tables,
    program: &Program,
    points: &mut SurfaceColumns,
    count: usize,
    scratch: &mut GraphScratch,
    outputs: &mut OutputColumns,
) {
    let around = Around { bvh: &tables.bvh, any_transparent: tables.any_transparent };
    evaluate_on(l, program, &(&tables.geometry, &tables.textures, &around), points, count, scratch, outputs);
}

/// [`graph::evaluate`].
#[inline(never)]
pub(crate) fn evaluate_on<L: Lanes>(
    l: L,
    program: &Program,
    asked: &(&GeometryTable, &TextureTable, &Around<'_>),
    points: &mut SurfaceColumns,
    count: usize,
    scratch: &mut GraphScratch,
    outputs: &mut OutputColumns,
) {
    l.vectorize(
        #[inline(always)]
        || graph::evaluate(l, program, *asked, points, count, scratch, outputs),
    );
}

/// Surface points of a chunk of hits, and what a program computes there.
#[inline(always)]
pub(crate) fn run_program<L: Lanes, H: HitSource + ?Sized>(
    l: L,
    tables: &Tables,
    program: &Program,
    hits: &H,
    source: &ChunkSource<'_>,
    columns: &mut ChunkColumns,
) {
    let ChunkColumns { surface, scratch, outputs, .. } = columns;
    surface_points(l, tables, program, hits, source, surface);
    if !program.is_empty() {
        evaluate(l, tables, program, surface, source.count, scratch, outputs);
    }
}

/// [`GeometryTable::lift`] at a register of a chunk's hits.
#[inline(never)]
pub(crate) fn lift<L: Lanes>(l: L, geometry: &GeometryTable, surface: &SurfaceColumns, at: usize, geometric: &Vec3<L>) -> Vec3<L> {
    l.vectorize(
        #[inline(always)]
        || geometry.lift(l, &surface.hit(l, geometry, at), *geometric),
    )
}
