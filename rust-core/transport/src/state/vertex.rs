//! A register of path vertices on surfaces (pbrt's `SurfaceInteraction`), and what all hits of a chunk share.

use crate::graph::Program;
use crate::state::sample::SampleContext;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_simd::{F, Frame, Lanes, M, Rgb, U, Vec3};
use std::ops::Range;

/// Roughness widens a path's ray cone by this much, radians: blurred reflections need no fine texture level.
pub(crate) const CONE_PER_ROUGHNESS: f32 = 0.3;

/// One register of path vertices: what shading, NEE and scattering read of a hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertex<L: Lanes> {
    pub(crate) alive: M<L>,
    pub(crate) path: U<L>,
    /// World space, rebased, and a bound on its error, metres.
    pub(crate) position: Vec3<L>,
    pub(crate) error: F<L>,
    /// Geometric normal on the side of `wo`; the frame's z is the shading normal.
    pub(crate) geometric: Vec3<L>,
    pub(crate) frame: Frame<L>,
    pub(crate) wo: Vec3<L>,
    pub(crate) throughput: Rgb<L>,
    /// As in [`crate::state::paths::TrackLanes`].
    pub(crate) flags: U<L>,
    pub(crate) counts: U<L>,
    pub(crate) slot: U<L>,
    pub(crate) instance: U<L>,
    /// Ray cone: width here, metres, and growth a metre.
    pub(crate) width: F<L>,
    pub(crate) spread: F<L>,
    pub(crate) bounces: U<L>,
    /// Absorption a metre of what the path is in, and of what is behind the surface.
    pub(crate) medium: Rgb<L>,
    pub(crate) behind: Rgb<L>,
    /// Where all lobes are specular: mirrors or smooth glass.
    pub(crate) all_delta: M<L>,
    /// Pdf of the direction that found the vertex, per solid angle; of no meaning for camera rays.
    pub(crate) pdf: F<L>,
    /// Share of a camera ray's sample that is here; of no meaning for other rays.
    pub(crate) share: F<L>,
}

/// What all hits of a chunk share: the scene, the settings, the sample context.
#[derive(Clone, Debug)]
pub(crate) struct Stage<'a, L> {
    pub(crate) l: L,
    pub(crate) tables: &'a Tables,
    pub(crate) transport: &'a Transport,
    pub(crate) context: &'a SampleContext<'a>,
    /// What computed the chunk's shader passes, where any are wanted.
    pub(crate) shader: Option<&'a Program>,
    /// Where the chunk is in the order of the paths.
    pub(crate) hits: Range<usize>,
}
