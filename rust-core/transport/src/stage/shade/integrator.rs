//! What a schedule decides about shading: how a register of points is lit, and how rays go on from there.

use crate::accumulate::deposit::Deposits;
use crate::stage::light::measure::MeasureContext;
use crate::state::chunk::ChunkContext;
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::vertex::Vertex;
use crate::tables::material::SurfaceMaterial;
use gonio_bsdf::Lobes;
use gonio_simd::Lanes;

/// The part of a schedule that shades, one for each [`crate::tables::transport::Estimator`]. Stages never ask which one it is.
pub(crate) trait Integrator {
    /// Whether light that enters a surface walks under it.
    const WALKS: bool;

    /// Most shadow rays that a hit sends.
    fn shadow_rays_per_hit(&self) -> usize;

    /// Lights a register of points and sends rays on.
    #[expect(clippy::too_many_arguments, reason = "a surface, and what lighting it fills")]
    fn shade<L: Lanes>(
        &self,
        chunk: &ChunkContext<'_, L>,
        material: &SurfaceMaterial,
        point: &mut Vertex<L>,
        lobes: &Lobes<'_, L>,
        at: usize,
        queues: &mut Queues,
        deposits: &mut Deposits,
    );

    /// Lights points whose illuminance is measured, and starts their paths where light from surface to surface is looked for.
    fn measure<L: Lanes>(&self, chunk: &MeasureContext<'_, L>, shadows: &mut ShadowRays, next: &mut Paths, deposits: &mut Deposits);
}
