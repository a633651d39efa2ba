//! What is known of the ray that shades a hit (Cycles' `svm_node_light_path`).

use super::SurfaceColumns;
use crate::words::{counts, event, flag};
use gonio_nodes::LightPathValue;
use gonio_simd::{F, Lanes};

/// The value for a register of hits.
#[inline(always)]
pub(super) fn light_path<L: Lanes>(l: L, points: &SurfaceColumns, at: usize, value: LightPathValue) -> F<L> {
    let flags = l.load_integers(&points.ray_flags, at);
    let has = |bit: u32| (flags & bit).ne(0);
    let (camera, shadow) = (has(flag::CAMERA), has(flag::SHADOW));
    let last = (flags >> flag::LAST_SHIFT) & 3;
    let scattered = !(camera | shadow);
    // Bounces of a kind stand in a byte each.
    let depth = |kind: u32| counts::of(l.load_integers(&points.ray_counts, at), kind).to_float();
    let known = match value {
        LightPathValue::IsCameraRay => camera,
        LightPathValue::IsShadowRay => shadow,
        LightPathValue::IsDiffuseRay => scattered & last.eq(event::DIFFUSE),
        LightPathValue::IsGlossyRay => scattered & last.ne(event::DIFFUSE) & last.ne(event::VOLUME),
        LightPathValue::IsSingularRay => scattered & has(flag::DELTA),
        LightPathValue::IsReflectionRay => scattered & last.lt(event::TRANSMISSION),
        LightPathValue::IsTransmissionRay => scattered & last.eq(event::TRANSMISSION),
        LightPathValue::IsVolumeScatterRay => scattered & last.eq(event::VOLUME),
        LightPathValue::RayLength => return l.load(&points.ray_length, at),
        LightPathValue::RayDepth => return (flags >> flag::BOUNCE_SHIFT).to_float(),
        LightPathValue::DiffuseDepth => return depth(0),
        LightPathValue::GlossyDepth => return depth(1),
        LightPathValue::TransmissionDepth => return depth(2),
        LightPathValue::TransparentDepth => return depth(3),
    };
    l.f(1.0).keep_if(known)
}
