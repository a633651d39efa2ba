//! Where walks under surfaces come out: lit and scattered as by a white Lambertian surface.

use super::{
    bounce::scatter,
    direct_light::light,
    material::Tables,
    path::{SampleContext, Transport},
    shade::{CONE_PER_ROUGHNESS, Point, Stage},
    state::{BATCH, Workspace, flag},
};
use crate::{bsdf::subsurface, sampler::dimension};
use gonio_simd::{F, Frame, Lanes, M, Rgb, U, Vec3};

/// Where walks come out.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExitPoint<L: Lanes> {
    pub(super) alive: M<L>,
    pub(super) position: Vec3<L>,
    pub(super) error: F<L>,
    pub(super) geometric: Vec3<L>,
    pub(super) shading: Vec3<L>,
    pub(super) throughput: Rgb<L>,
    pub(super) slot: U<L>,
    pub(super) flags: U<L>,
    pub(super) counts: U<L>,
    pub(super) width: F<L>,
}

/// Lights and scatters what comes out from under a surface, as a white Lambertian surface does; `base` is the first dimension of its numbers.
#[inline(always)]
pub(super) fn leave<L: Lanes>(
    l: L,
    tables: &Tables,
    transport: &Transport,
    context: &SampleContext,
    exit: &ExitPoint<L>,
    base: u32,
    ws: &mut Workspace,
) {
    let stage = Stage { l, tables, transport, context, material: &tables.materials.surfaces[0] };
    let point = Point {
        alive: exit.alive,
        path: l.u(0),
        position: exit.position,
        error: exit.error,
        geometric: exit.geometric,
        frame: Frame::from_normal(exit.shading),
        wo: exit.shading,
        throughput: exit.throughput,
        flags: exit.flags,
        counts: exit.counts,
        slot: exit.slot,
        instance: l.u(0),
        width: exit.width,
        spread: l.f(CONE_PER_ROUGHNESS),
        bounces: exit.flags >> flag::BOUNCE_SHIFT,
        medium: Rgb::zero(l),
        behind: Rgb::zero(l),
        only_delta: l.m(false),
    };
    let lobes = subsurface::exit(l);
    let wo = Vec3::splat(l, [0.0, 0.0, 1.0]);
    let index = context.sampler.index(l, exit.slot & (BATCH as u32 - 1), context.sample);
    let [u_choice, u_roulette] = context.sampler.pair(l, index, base + dimension::LIGHT_CHOICE);
    if !tables.lights.is_empty() {
        let [u, v] = context.sampler.pair(l, index, base + dimension::LIGHT);
        light(&stage, &point, wo, &lobes, [u_choice, u, v], exit.alive, ws);
    }
    let [u, v] = context.sampler.pair(l, index, base + dimension::BSDF);
    scatter(&stage, &point, wo, &lobes, [l.f(0.5), u, v, u_roulette], exit.alive, ws);
}
