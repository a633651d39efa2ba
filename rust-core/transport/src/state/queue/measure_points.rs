//! The queue of points whose illuminance is to be measured: `stage/shade/shading.rs` and `stage/start/sensors.rs` fill it, `stage/light/measure.rs` empties it.

use crate::media::set::MediaColumns;
use crate::state::columns::{Columns3, append3, columns3};
use crate::state::path_core::PathCore;
use gonio_camera::sampler::BATCH;
use gonio_simd::{Column, F, Lanes, M, SpectrumColumns, U, Vec3, padded};

/// Points whose illuminance is measured.
#[derive(Debug)]
pub(crate) struct MeasurePoints {
    pub(crate) count: usize,
    pub(crate) position: Columns3,
    pub(crate) error: Column,
    pub(crate) geometric_normal: Columns3,
    pub(crate) shading_normal: Columns3,
    pub(crate) throughput: SpectrumColumns,
    pub(crate) width: Column,
    pub(crate) slot: Column<u32>,
    /// Classes of receivers, see [`crate::state::vertex::Interaction`].
    pub(crate) receiver: Column<u32>,
    /// What is before them.
    media: MediaColumns,
}

impl Default for MeasurePoints {
    fn default() -> Self {
        let room = padded(BATCH) + gonio_simd::PADDING;
        Self {
            count: 0,
            position: columns3(room),
            error: Column::new(room),
            geometric_normal: columns3(room),
            shading_normal: columns3(room),
            throughput: SpectrumColumns::new(room),
            width: Column::new(room),
            slot: Column::new(room),
            receiver: Column::new(room),
            media: MediaColumns::new(room),
        }
    }
}

/// One register of points, to be appended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasureLanes<L: Lanes> {
    pub(crate) position: Vec3<L>,
    pub(crate) error: F<L>,
    pub(crate) geometric_normal: Vec3<L>,
    pub(crate) shading_normal: Vec3<L>,
    pub(crate) receiver: U<L>,
    /// What the path carries that found them.
    pub(crate) core: PathCore<L>,
}

impl MeasurePoints {
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, point: &MeasureLanes<L>, chosen: M<L>) {
        if !chosen.any() {
            return;
        }
        let n = self.count;
        append3(point.position, chosen, &mut self.position, n);
        point.error.append(chosen, &mut self.error, n);
        append3(point.geometric_normal, chosen, &mut self.geometric_normal, n);
        append3(point.shading_normal, chosen, &mut self.shading_normal, n);
        self.throughput.append(point.core.throughput, chosen, n);
        point.core.width.append(chosen, &mut self.width, n);
        point.core.slot.append(chosen, &mut self.slot, n);
        point.receiver.append(chosen, &mut self.receiver, n);
        self.media.append(point.core.media, chosen, n);
        self.count += chosen.count();
    }

    /// What paths carry that start at some points: theirs is a slot of its own, and they have met nothing yet.
    #[inline(always)]
    pub(crate) fn core<L: Lanes>(&self, l: L, at: usize) -> PathCore<L> {
        let slot = l.load_integers(&self.slot, at) + BATCH as u32;
        let (throughput, width, media) = (self.throughput.load(l, at), l.load(&self.width, at), self.media.load(l, at));
        PathCore { throughput, width, media, ..PathCore::new(l, slot, l.u(0)) }
    }
}
