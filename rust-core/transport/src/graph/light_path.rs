//! What is known of the ray that shades a hit (Cycles' `svm_node_light_path`).

use super::SurfaceColumns;
use crate::state::flag::{self, event};
use gonio_simd::{F, Lanes};

/// A value of the Light Path node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightPathValue {
    /// 1 for rays of the camera.
    Camera,
    /// 1 for shadow rays.
    Shadow,
    /// 1 after diffuse scattering.
    Diffuse,
    /// 1 after glossy or specular scattering, reflected or transmitted.
    Glossy,
    /// 1 after a mirror or smooth glass.
    Singular,
    /// 1 after reflection.
    Reflection,
    /// 1 after refraction.
    Transmission,
    /// Metres from the ray's start.
    Length,
    /// Scatterings so far.
    Depth,
    /// Bounces of a kind, by its byte in the path's counts: diffuse, glossy, refracted, straight through.
    DepthOf(u8),
}

/// The value for a register of hits.
#[inline(always)]
pub(super) fn light_path<L: Lanes>(l: L, points: &SurfaceColumns, at: usize, value: LightPathValue) -> F<L> {
    let flags = l.load_integers(&points.ray_flags, at);
    let has = |bit: u32| (flags & bit).ne(0);
    let (camera, shadow) = (has(flag::CAMERA), has(flag::SHADOW));
    let last = (flags >> flag::LAST_SHIFT) & 3;
    let scattered = !(camera | shadow);
    let known = match value {
        LightPathValue::Camera => camera,
        LightPathValue::Shadow => shadow,
        LightPathValue::Diffuse => scattered & last.eq(event::DIFFUSE),
        LightPathValue::Glossy => scattered & last.ne(event::DIFFUSE),
        LightPathValue::Singular => scattered & has(flag::DELTA),
        LightPathValue::Reflection => scattered & last.ne(event::TRANSMISSION),
        LightPathValue::Transmission => scattered & last.eq(event::TRANSMISSION),
        LightPathValue::Length => return l.load(&points.ray_length, at),
        LightPathValue::Depth => return (flags >> flag::BOUNCE_SHIFT).to_float(),
        LightPathValue::DepthOf(kind) => return ((l.load_integers(&points.ray_counts, at) >> (u32::from(kind) * 8)) & 255).to_float(),
    };
    l.f(1.0).keep_if(known)
}
