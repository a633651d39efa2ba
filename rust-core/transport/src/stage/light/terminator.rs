//! Where shadow rays start on coarse smooth meshes whose objects ask for it: from the curved surface, where light grazes the triangles.

use crate::kernels;
use crate::state::chunk::ChunkContext;
use crate::state::rays::RayLanes;
use crate::state::vertex::{Interaction, Vertex};
use gonio_light::LightSample;
use gonio_simd::{F, Lanes, M, Vec3};

/// Shading normals this near to their triangle's, as 1 − cosine, are flat.
const FLAT: f32 = 1e-4;
/// Square of the length beyond which a vector is no direction.
const LONGEST: f32 = 1.01;

/// Grazing light that starts from the curved surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lifted<L: Lanes> {
    /// Where it does.
    pub(crate) any: M<L>,
    /// Where the direction is none: triangles that are seen from within their own plane give such.
    pub(crate) astray: M<L>,
    /// From the triangle to where it starts, metres.
    by: Vec3<L>,
}

impl<L: Lanes> Lifted<L> {
    /// From where light in the directions `wi` starts at a point; None where no object asks for it, or no light grazes.
    #[inline(always)]
    pub(crate) fn of(chunk: &ChunkContext<'_, L>, point: &Vertex<L>, wi: Vec3<L>, usable: M<L>) -> Option<Self> {
        let ChunkContext { l, tables, .. } = *chunk;
        let geometry = &tables.geometry;
        if geometry.set_terminator.is_empty() {
            return None;
        }
        let [cosine, flat] = [point.at.frame.z.dot(wi), point.at.geometric.dot(wi)];
        let bent = (1.0 - point.at.frame.z.dot(point.at.geometric)).gt(FLAT);
        let instance = point.instance.keep_if(usable);
        let from = l.gather(&geometry.set_terminator, geometry.set_lanes(l, instance));
        let amount = share(cosine, flat, from);
        let astray = !wi.length_squared().lt(LONGEST);
        let any = (usable & bent & from.gt(0.0) & cosine.gt(0.0) & amount.gt(0.0)).and_not(astray);
        if !any.any() {
            return None;
        }
        let lift = kernels::lift(l, &tables.geometry, &chunk.columns.surface, point.place, &point.at.geometric);
        Some(Self { any, astray, by: lift * amount.keep_if(any) })
    }

    /// The shadow ray to a light sample.
    #[inline(always)]
    pub(crate) fn spawn_ray_to(&self, at: &Interaction<L>, sample: &LightSample<L>) -> RayLanes<L> {
        at.spawn_lifted_ray_to(self.by, self.any, sample)
    }
}

/// The part of the lift: all of it where light comes from below the triangle, none from `from` above it on.
#[inline(always)]
fn share<L: Lanes>(cosine: F<L>, flat: F<L>, from: F<L>) -> F<L> {
    let steep = 1.0 - flat / from;
    let slanting = 2.0 - (flat + cosine) / from;
    cosine.lt(from).select(slanting, steep).clamp(0.0, 1.0)
}
