//! The workspace of a worker: the wavefront state of a batch of paths, in columns, and the sums of its block.
//!
//! Schedules own it, and hand each stage the parts that it reads and writes.

use crate::accumulate::deposit::Deposits;
use crate::accumulate::tile_sums::TileSums;
use crate::state::chunk::ChunkColumns;
use crate::state::material_order::MaterialOrder;
use crate::state::nearest::NearestHits;
use crate::state::paths::Paths;
use crate::state::queue::Queues;
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::state::queue::walks::WalkHits;
use crate::state::times::SlotTimes;
use crate::state::wavelengths::SlotWavelengths;
use crate::statistics::Statistics;
use crate::tables::Tables;
use crate::tables::transport::Transport;
use crate::words::code;
use gonio_accel::Hits;
use gonio_camera::sampler::{Runs, Sampler};
use gonio_simd::{Execution, WavelengthTable};
use std::sync::Arc;

/// All that a worker needs to trace a batch; made once a worker, so that no stage allocates.
#[derive(Debug, Default)]
pub struct Workspace {
    /// Paths of this bounce.
    pub(crate) paths: Paths,
    /// What their rays met.
    pub(crate) nearest: NearestHits,
    /// 1 for places that another surface lies on.
    pub(crate) covered: Vec<u8>,
    pub(crate) materials: MaterialOrder,
    /// The chunk under way.
    pub(crate) chunk: ChunkColumns,
    /// What shading sends on.
    pub(crate) queues: Queues,
    pub(crate) walk_hits: WalkHits,
    /// When the samples of the batch see.
    pub(crate) times: SlotTimes,
    /// At which wavelengths they see, where light has any.
    pub(crate) wavelengths: Option<Arc<SlotWavelengths>>,
    pub(crate) shadow_trace: ShadowTrace,
    /// Light and AOVs of the block under way.
    pub deposits: Deposits,
    /// Sums of the trees of specular rays, which guide denoisers.
    pub(crate) specular_sums: TileSums,
    /// Rays traced and lanes alive, for benchmarks.
    pub statistics: Statistics,
}

impl Workspace {
    /// Draws the wavelengths of a batch, where light has any; stages share what is returned.
    pub(crate) fn draw_wavelengths(
        &mut self,
        table: Option<&Arc<WavelengthTable>>,
        execution: Execution,
        numbers: (&Sampler, &Runs),
    ) -> Option<Arc<SlotWavelengths>> {
        self.deposits.wavelengths = None;
        SlotWavelengths::draw(execution, table, numbers, &mut self.wavelengths);
        self.deposits.wavelengths.clone_from(&self.wavelengths);
        self.wavelengths.clone()
    }

    /// Slots of the current rays, and their hits.
    pub fn hits_by_slot(&self) -> (impl Iterator<Item = u32>, &Hits) {
        ((0..self.paths.count).map(|path| self.paths.slot(path)), &self.nearest.hits)
    }

    /// Gives trees of specular rays sums of their own.
    pub(crate) fn begin_specular(&mut self) {
        self.specular_sums.clear();
        std::mem::swap(&mut self.deposits.sums, &mut self.specular_sums);
    }

    /// Adds their sums to the block's; so many rays count as one sample.
    pub(crate) fn end_specular(&mut self, rays: u32) {
        std::mem::swap(&mut self.deposits.sums, &mut self.specular_sums);
        self.deposits.sums.add_specular(&self.specular_sums, 1.0 / rays as f32);
    }

    /// Empties the block's sums, and makes room for those that passes want.
    pub fn prepare(&mut self, tables: &Tables, transport: &Transport, shows_lights: bool) {
        let sums = &mut self.deposits.sums;
        for sums in [&mut *sums, &mut self.specular_sums] {
            sums.lights.prepare(if shows_lights { code::COUNT } else { 0 });
            sums.groups.prepare(transport.passes.groups.count);
            sums.expressions.prepare(transport.passes.expressions.as_ref().map_or(0, |expressions| expressions.count));
            sums.prepare_passes(&transport.passes);
        }
        sums.shader.prepare(&transport.passes.shader);
        if !tables.geometry.set_catcher.is_empty() {
            sums.prepare_catchers();
        }
        if !tables.geometry.set_holdout.is_empty() || tables.materials.surfaces.iter().any(|surface| surface.holdout) {
            sums.prepare_holes();
        }
        sums.clear();
    }
}
