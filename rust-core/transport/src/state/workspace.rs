//! The workspace of a worker: the wavefront state of a batch of paths, in columns, and the sums of its block.

use crate::accumulate::light_sums::code;
use crate::accumulate::tile_sums::TileSums;
use crate::graph::{CHUNK, GraphScratch, OutputColumns, SurfaceColumns};
use crate::state::branches::Branches;
use crate::state::light_samples::LightSampleQueue;
use crate::state::measure_points::MeasurePoints;
use crate::state::paths::Paths;
use crate::state::retraced::RetracedRays;
use crate::state::shadow_order::ShadowOrder;
use crate::state::shadow_rays::ShadowRays;
use crate::state::walks::Walks;
use crate::statistics::Statistics;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use gonio_accel::{Hits, TransparentHit};
use gonio_light::Arrival;

/// All that a worker needs to trace a batch; made once a worker, so that no stage allocates.
#[derive(Debug, Default)]
pub struct Workspace {
    /// Paths of this bounce, and those that its stages send on to the next.
    pub(crate) paths: Paths,
    pub(crate) next: Paths,
    pub(crate) branches: Branches,
    /// Nearest hits of `paths`, an entry a path.
    pub(crate) hits: Hits,
    /// Hits behind the shapes of lights.
    pub(crate) retraced: Hits,
    pub(crate) retraced_rays: RetracedRays,
    /// NEE of the chunk under way.
    pub(crate) light_queue: LightSampleQueue,
    pub(crate) shadows: ShadowRays,
    pub(crate) shadow_order: ShadowOrder,
    /// Lights that arrived and where, for the learned light cache; `None` where nothing learns.
    pub arrivals: Option<Vec<Arrival>>,
    /// By shadow ray, 1 where something opaque blocks it; hits on the transparent surfaces that it passes.
    pub(crate) blocked: Vec<u8>,
    pub(crate) passed: Vec<TransparentHit>,
    pub(crate) measure: MeasurePoints,
    pub(crate) walks: Walks,
    pub(crate) walk_hits: Hits,
    /// Subsurface walks that reached the surface.
    pub(crate) out: Vec<u32>,
    /// Path numbers in the order of their materials, and where each material's begin and end.
    pub(crate) order: Vec<u32>,
    pub(crate) material_start: Vec<u32>,
    pub(crate) material_end: Vec<u32>,
    /// By path, the material number of its hit.
    pub(crate) material_of: Vec<u32>,
    /// Mixes and the paths at them.
    pub(crate) mixed: Vec<(u32, u32)>,
    /// Weights of a mix over a chunk, three channels a closure.
    pub(crate) weights: Vec<f32>,
    /// Numbers of paths that escaped, and of those that hit the shape of a light.
    pub(crate) escaped: Vec<u32>,
    pub(crate) at_lights: Vec<u32>,
    /// Surface points of the chunk, and what the shading program computes there.
    pub(crate) surface: SurfaceColumns,
    pub(crate) scratch: GraphScratch,
    pub(crate) outputs: OutputColumns,
    /// What programs of shader passes computed.
    pub(crate) shader_outputs: OutputColumns,
    /// Sums of the sample block under way.
    pub sums: TileSums,
    /// The same for trees of specular rays, which guide denoisers.
    pub(crate) specular_sums: TileSums,
    /// Rays traced and lanes alive, for benchmarks.
    pub statistics: Statistics,
}

impl Workspace {
    /// Slots of the current rays, and their hits.
    pub fn hits_by_slot(&self) -> (impl Iterator<Item = u32>, &Hits) {
        ((0..self.paths.count).map(|path| self.paths.slot(path)), &self.hits)
    }

    /// Gives trees of specular rays sums of their own.
    pub(crate) fn start_sharp(&mut self, transport: &Transport) {
        self.branches.prepare(transport);
        self.specular_sums.clear();
        std::mem::swap(&mut self.sums, &mut self.specular_sums);
    }

    /// Adds their sums to the block's; so many rays count as one sample.
    pub(crate) fn end_sharp(&mut self, rays: u32) {
        std::mem::swap(&mut self.sums, &mut self.specular_sums);
        self.sums.add_sharp(&self.specular_sums, 1.0 / rays as f32);
    }

    /// Empties the block's sums, and makes room for those that passes want.
    pub fn prepare(&mut self, tables: &Tables, transport: &Transport, shows_lights: bool) {
        self.branches.prepare(transport);
        for sums in [&mut self.sums, &mut self.specular_sums] {
            sums.lights.prepare(if shows_lights { code::COUNT } else { 0 });
            sums.groups.prepare(transport.passes.groups.count);
            sums.prepare_passes(&transport.passes);
        }
        self.sums.shader.prepare(&transport.passes.shader);
        if !tables.geometry.set_catcher.is_empty() {
            self.sums.prepare_catchers();
        }
        self.sums.clear();
    }
}

const _: () = assert!(CHUNK.is_multiple_of(gonio_simd::PADDING));
