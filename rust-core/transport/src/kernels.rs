//! The large kernels that several stages call, as functions of their own that are never inlined: BSDF sampling, light sampling, surface points, shading programs.
//!
//! Inlined at every call they would make stages of a hundred thousand instructions, which compile for minutes and run no faster: a call costs
//! nanoseconds where a register's worth of shading costs microseconds. Each enables its level's instructions again.
//!
//! Arguments are handed on as they came: a pattern among them copies its registers, in two calls of `memcpy`, before the level's instructions are on.
//! Points that many branches read are passed by reference. By value they would be stored once more before the branches.

use crate::geometry::GeometryTable;
use crate::graph::{self, Around, GraphScratch, OutputColumns, Program, SurfaceColumns};
use crate::stage::find::surface::{ChunkSource, HitSource, surface_chunk};
use crate::state::chunk::ChunkColumns;
use crate::state::paths::PreviousLanes;
use crate::tables::Tables;
use gonio_bsdf::{BsdfSample, LightHits, Lobes, ParameterValues, SpecularRay, Surface, Way};
use gonio_image::texture::TextureTable;
use gonio_light::{FixedLightSample, LightCache, LightSample};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// [`Surface::transmittance`].
#[inline(never)]
pub(crate) fn transmittance<L: Lanes>(
    l: L,
    surface: &Surface,
    values: &ParameterValues<'_>,
    at: usize,
    wo: Vec3<L>,
    entering: M<L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.transmittance(l, values, at, wo, entering),
    )
}

/// [`Surface::emitted`].
#[inline(never)]
pub(crate) fn emitted<L: Lanes>(
    l: L,
    surface: &Surface,
    values: &ParameterValues<'_>,
    at: usize,
    wo: Vec3<L>,
    entering: M<L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.emitted(l, values, at, wo, entering),
    )
}

/// [`Lobes::eval_diffuse`].
#[inline(never)]
pub(crate) fn eval_diffuse<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.eval_diffuse(l, wo, wi),
    )
}

/// [`Lobes::eval`] without the density.
#[inline(never)]
pub(crate) fn eval<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.eval(l, wo, wi).0,
    )
}

/// [`Lobes::sample`].
#[inline(never)]
pub fn sample<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, u: [F<L>; 3]) -> BsdfSample<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.sample(l, wo, u),
    )
}

/// [`Lobes::sample_or_follow`].
#[inline(never)]
pub(crate) fn sample_or_follow<L: Lanes>(
    l: L,
    lobes: &Lobes<'_, L>,
    wo: Vec3<L>,
    u: [F<L>; 3],
    wi: Vec3<L>,
    follows: M<L>,
) -> BsdfSample<L> {
    l.vectorize(
        #[inline(always)]
        || lobes.sample_or_follow(l, wo, u, wi, follows),
    )
}

/// [`Surface::flux`].
#[inline(never)]
pub(crate) fn flux<'s, L: Lanes>(
    l: L,
    surface: &'s Surface,
    light: &LightHits<'_, L>,
    lobes: &Lobes<'s, L>,
    to: Vec3<L>,
    room: &mut Lobes<'s, L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.flux(l, light, lobes, to, room),
    )
}

/// [`Surface::flux_diffuse`].
#[inline(never)]
pub(crate) fn flux_diffuse<L: Lanes>(l: L, light: &LightHits<'_, L>, room: &Lobes<'_, L>, to: Vec3<L>) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || Surface::flux_diffuse(l, light, room, to),
    )
}

/// [`Surface::flux_factor`].
#[inline(never)]
pub(crate) fn flux_factor<'s, L: Lanes>(
    l: L,
    surface: &'s Surface,
    light: &LightHits<'_, L>,
    lobes: &Lobes<'s, L>,
    sample: &BsdfSample<L>,
    room: &mut Lobes<'s, L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || surface.flux_factor(l, light, lobes, sample, room),
    )
}

/// [`Lobes::specular_rays`].
#[inline(never)]
pub(crate) fn specular_rays<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>) -> [SpecularRay<L>; Way::ALL.len()] {
    l.vectorize(
        #[inline(always)]
        || lobes.specular_rays(l, wo),
    )
}

/// [`gonio_light::LightTable::sample_fixed`].
#[inline(never)]
pub(crate) fn sample_fixed<L: Lanes>(
    l: L,
    tables: &Tables,
    fixed: &FixedLightSample,
    receiver: U<L>,
    p: &Vec3<L>,
    n: &Vec3<L>,
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_fixed(l, fixed, receiver, p, n),
    )
}

/// [`gonio_light::LightTable::sample_li`].
#[inline(never)]
pub fn sample_li<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    receiver: U<L>,
    p: &Vec3<L>,
    n: &Vec3<L>,
    u: &[F<L>; 3],
) -> LightSample<L> {
    l.vectorize(
        #[inline(always)]
        || tables.lights.sample_li(l, light_cache, receiver, p, n, u[0], &[u[1], u[2]]),
    )
}

/// A point on a light that a ray hit, and the previous vertex, from which MIS asks for the pdf.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LightHit<L: Lanes> {
    pub(crate) light: U<L>,
    pub(crate) from: PreviousLanes<L>,
    pub(crate) direction: Vec3<L>,
    pub(crate) point: Vec3<L>,
}

/// [`gonio_light::LightTable::eval_hit`].
#[inline(never)]
pub(crate) fn eval_light<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    hit: &LightHit<L>,
    mask: M<L>,
) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || {
            let PreviousLanes { position, normal, receiver } = hit.from;
            tables.lights.eval_hit(l, light_cache, receiver, hit.light, position, normal, hit.direction, hit.point, mask)
        },
    )
}

/// [`gonio_light::LightTable::eval_escaped`].
#[inline(never)]
#[expect(clippy::too_many_arguments, reason = "a ray and how it came to be")]
pub(crate) fn eval_escaped<L: Lanes>(
    l: L,
    tables: &Tables,
    light_cache: Option<&LightCache>,
    from: PreviousLanes<L>,
    direction: Vec3<L>,
    pdf: F<L>,
    first_and_delta: [M<L>; 2],
    only: Option<u32>,
    kind: U<L>,
) -> Spectrum<L> {
    l.vectorize(
        #[inline(always)]
        || {
            let PreviousLanes { position, normal, receiver } = from;
            let [first, delta] = first_and_delta;
            tables.lights.eval_escaped(l, light_cache, receiver, position, normal, direction, pdf, first, delta, only, kind)
        },
    )
}

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
