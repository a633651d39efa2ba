//! Normals that a graph bends.

use super::{
    SurfaceColumns,
    columns::load3,
    shading::{Place, from_vector},
};
use gonio_simd::{F, Frame, Lanes, Vec3};

/// A tangent-space normal in world space, on the side of `wo`; along the texture coordinates of column `uv`, else those of the chunk's tangents.
#[inline(always)]
pub(super) fn normal_map<L: Lanes>(l: L, place: &Place<'_, L>, map: [F<L>; 3], scale: f32, uv: Option<usize>) -> [F<L>; 4] {
    let side = l.load(&place.points.side, place.at);
    // Maps are made for the front side.
    let front = load3(l, &place.points.shading_normal, place.at) * side;
    let local = Vec3::new(map[0] * scale, map[1] * scale, map[2]);
    let bent = match uv {
        None => Frame::from_tangent(front, load3(l, &place.points.tangent, place.at)).to_world(local).normalize_or(front),
        Some(column) => {
            let edges = place.geometry.edges(l, &place.hit);
            let uv = place.geometry.uv_derivatives(l, &place.hit, column, edges);
            // Mirrored coordinates turn the bitangent round.
            let winding = edges[0].cross(edges[1]).dot(front);
            let handed = l.f(1.0).copysign(uv.determinant) * l.f(1.0).copysign(winding);
            let bent = Frame::from_tangent(front, uv.tangent).to_world(Vec3::new(local.x, local.y * handed, local.z));
            uv.determinant.eq(0.0).select(front, bent.normalize_or(front))
        }
    };
    from_vector(l, bent * side)
}

/// Puts the bent normals in place where they are usable, and beside them `smooth`, the normals that they were bent from.
#[inline(always)]
pub(super) fn bend_normals<L: Lanes>(l: L, points: &mut SurfaceColumns, at: usize, normal: Vec3<L>, smooth: Vec3<L>, free: bool) {
    let (geometric, wo) = (load3(l, &points.geometric_normal, at), load3(l, &points.wo, at));
    let bent = normal.normalize_or(smooth);
    let bent = if free { bent } else { facing(l, bent, geometric, wo) };
    let [x, y, z] = &mut points.smooth_normal;
    smooth.store([x, y, z], at);
    let [x, y, z] = &mut points.shading_normal;
    bent.store([x, y, z], at);
}

/// The normal nearest to `bent` about which the mirror direction of `wo` stays above the surface by at least
/// min(0.9 n_g·wo, 0.01), so that mapped reflections never point into the surface.
#[inline(always)]
fn facing<L: Lanes>(l: L, bent: Vec3<L>, geometric: Vec3<L>, wo: Vec3<L>) -> Vec3<L> {
    let limit = (geometric.dot(wo) * 0.9).min(0.01);
    let mirror = wo.reflect(bent);
    let short = mirror.dot(geometric).lt(limit);
    if !short.any() {
        return bent;
    }
    // In the plane of wo and the surface normal, halfway between wo and the lowest allowed mirror direction.
    let flat = (mirror - geometric * mirror.dot(geometric)).normalize_or(Frame::from_normal(geometric).x);
    let lowest = flat.mul_add((l.f(1.0) - limit * limit).safe_sqrt(), geometric * limit);
    short.select((wo + lowest).normalize_or(geometric), bent)
}
