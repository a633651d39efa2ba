//! What lies before and behind the surfaces that paths hit.

use super::catcher;
use crate::media::set::Solid;
use crate::state::chunk::ChunkContext;
use crate::state::vertex::Vertex;
use crate::tables::material::SurfaceMaterial;
use gonio_accel::NONE;
use gonio_bsdf::ParameterValues;
use gonio_simd::{F, Lanes, Spectrum};

/// Dims the path by what it has come through (Beer and Lambert), and looks up what is behind the surface.
#[inline(always)]
pub(crate) fn absorb<L: Lanes>(
    chunk: &ChunkContext<'_, L>,
    material: &SurfaceMaterial,
    values: &ParameterValues<'_>,
    point: &mut Vertex<L>,
    at: usize,
) {
    let l = chunk.l;
    point.core.media = chunk.paths.media.gather(l, point.path);
    // What is before the surface that it went straight through last is behind it.
    let distance = l.gather(&chunk.hits.t, point.path) - chunk.paths.rays.passed.distance(l, point.path);
    let media = chunk.tables.materials.media.at(chunk.sample.wavelengths(l, point.core.slot));
    let mut left = point.core.media.transmittance(media, distance);
    if !chunk.tables.geometry.set_catcher.is_empty() {
        left = catcher::arrives_alone(point.core.flags, point.core.slot).select(Spectrum::one(l), left);
    }
    point.core.throughput = point.core.throughput * left;
    let beyond = point.core.media;
    if !media.table.is_empty() {
        before_boundary(chunk, point, distance);
    }
    let surface = &material.surface;
    let solid = match material.solid_medium {
        Some(row) => Some(Solid { absorption: Spectrum::zero(l), row }),
        None if surface.is_solid() => Some(Solid { absorption: surface.absorption(l, values, at), row: 0 }),
        None => None,
    };
    let entering = l.load(&chunk.columns.surface.side, at).gt(0.0);
    point.behind = beyond.behind(solid, material.interior, entering);
}

/// Puts paths back into what they were in before they left it, or entered it, just before they hit a surface: fog that stands on a floor is before it.
#[inline(always)]
fn before_boundary<L: Lanes>(chunk: &ChunkContext<'_, L>, point: &mut Vertex<L>, distance: F<L>) {
    let l = chunk.l;
    let Some([instance, primitive]) = chunk.paths.rays.passed.last(l, point.path) else { return };
    let touching = point.alive & instance.ne(NONE) & distance.le(point.at.error.abs() * TOUCHING);
    // Where catchers alone are there is nothing that stands on them.
    let touching = touching.and_not(catcher::arrives_alone(point.core.flags, point.core.slot));
    let (instances, primitives) = (instance.to_array(), primitive.to_array());
    let mut bits = touching.bits();
    while bits != 0 {
        let lane = bits.trailing_zeros();
        bits &= bits - 1;
        let material = chunk.tables.geometry.material(instances[lane as usize], primitives[lane as usize]);
        if let Some(row) = chunk.tables.materials.interior(material) {
            let here = touching & l.iota().eq(lane);
            point.core.media = point.core.media.back_across(row, here);
        }
    }
}

/// Surfaces are one within so many times the error of a hit's position.
const TOUCHING: f32 = 4.0;
