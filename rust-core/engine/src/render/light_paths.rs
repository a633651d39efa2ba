//! Light paths of a render: which lights they start at, and how many go with a block of camera paths.

use super::Shared;
use crate::{
    compile::{CompiledScene, View, light_paths_pay},
    film::{SplatBlock, SplatLayout},
    light::EmissionSampler,
    scene::{Caustics, Crop, Integrator, Settings},
    transport::{Arrivals, Arriving, Emission, Escapes, LIGHT_BATCH, LightTracer, Picture, Receiver, Transport, Wanted, Workspace},
};
use std::{ops::Range, sync::Arc};

/// How light paths of a render start.
#[derive(Clone, Debug)]
pub(crate) struct LightPaths {
    sampler: Arc<EmissionSampler>,
    /// Whether they bring caustics alone; else all light is theirs.
    caustics: bool,
}

/// Samples of a pixel that have batch numbers of their own in a tile.
const SAMPLES: u64 = 1 << 32;

/// The light paths that a view asks for, if any, and by light whether they start there.
pub(super) fn plan(scene: &CompiledScene, settings: &Settings) -> Option<(LightPaths, Arc<[u32]>)> {
    let wanted = match settings.caustics {
        Caustics::Off => false,
        Caustics::On => true,
        Caustics::Auto => scene.casters.pay,
    };
    if settings.integrator == Integrator::Light {
        let sampler = EmissionSampler::new(&scene.tables.lights, None, sphere(scene), &scene.casters.targets);
        return (!sampler.is_empty()).then(|| (LightPaths { sampler: sampler.into(), caustics: false }, [].into()));
    }
    if !wanted || !light_paths_pay::are_possible(scene, settings) {
        return None;
    }
    LightPaths::bringing(scene, &light_paths_pay::starts(scene))
}

/// A sphere around all surfaces.
fn sphere(scene: &CompiledScene) -> ([f32; 3], f32) {
    let (centre, radius) = scene.bounds.sphere(scene.tables.origin);
    (centre, (radius * (1.0 + 1e-5)) as f32)
}

impl LightPaths {
    /// Those that bring the caustics of some lights, and by light whether they start there; none where these send nothing.
    pub(crate) fn bringing(scene: &CompiledScene, starts: &[bool]) -> Option<(Self, Arc<[u32]>)> {
        let sampler = light_paths_pay::emission(scene, starts);
        let started = || starts.iter().map(|starts| u32::from(*starts)).collect();
        (!sampler.is_empty()).then(|| (Self { sampler: sampler.into(), caustics: true }, started()))
    }

    /// Whether they bring caustics alone.
    pub(super) fn caustics(&self) -> bool {
        self.caustics
    }

    /// How paths start.
    pub(crate) fn sampler(&self) -> &EmissionSampler {
        &self.sampler
    }

    /// Power of the lights, as splats are counted by.
    pub(super) fn power(&self) -> f64 {
        self.sampler.total_power().iter().sum()
    }

    /// Traces the light paths that go with some samples of a tile: as many as a whole tile has pixels, for each sample.
    pub(super) fn trace(
        &self,
        shared: &Shared,
        (view, transport): (&View, &Transport),
        (tile, samples): (usize, Range<u32>),
        splats: &SplatLayout,
        workspace: &mut Workspace,
        cancelled: &dyn Fn() -> bool,
    ) -> SplatBlock {
        let Crop { min, max } = view.window;
        let picture = Picture { camera: &view.camera, placement: &view.placement, window: [min, max] };
        let wanted = Wanted { arrivals: Arriving::No, specular_only: self.caustics, picture: Some(picture) };
        let tracer = LightTracer { tables: &shared.scene.tables, transport, emission: Emission::Lights(&self.sampler), wanted };
        let mut brought = Vec::new();
        let mut paths = 0;
        for sample in samples {
            if cancelled() {
                break;
            }
            let batch = tile as u64 * SAMPLES + u64::from(sample);
            tracer.trace(batch, &mut Unasked, &mut brought, workspace, cancelled);
            paths += LIGHT_BATCH as u64;
        }
        splats.block(&brought, paths, &transport.passes.groups, transport.limits.clamps)
    }
}

/// Nobody asks where else light went.
struct Unasked;

impl Receiver for Unasked {
    fn arrived(&mut self, _: &Arrivals) {}
    fn escaped(&mut self, _: &Escapes) {}
}
