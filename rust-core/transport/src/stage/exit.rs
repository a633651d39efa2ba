//! Exit of subsurface random walks: the point is lit (NEE) and scatters as a white Lambertian surface.

use crate::stage::nee::light;
use crate::stage::scatter::scatter;
use crate::state::vertex::{Stage, Vertex};
use crate::state::workspace::Workspace;
use gonio_bsdf::subsurface;
use gonio_camera::sampler::dimension;
use gonio_simd::{Lanes, Vec3};

/// Lights and scatters walks that come out, as a white Lambertian surface; `base` is the first sampler dimension that it uses.
#[inline(always)]
pub(crate) fn leave<L: Lanes>(stage: &Stage<'_, L>, point: &Vertex<L>, base: u32, ws: &mut Workspace) {
    let Stage { l, tables, context, .. } = *stage;
    let lobes = subsurface::exit(l);
    let wo = Vec3::splat(l, [0.0, 0.0, 1.0]);
    let index = context.index(l, point.slot);
    let [u_light, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    if !tables.lights.is_empty() {
        let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
        light(stage, point, wo, &lobes, [u_light, u, v], point.alive, ws);
    }
    let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
    scatter(stage, point, wo, &lobes, [l.f(0.5), u, v, u_roulette], [point.alive, l.m(false)], ws);
}
