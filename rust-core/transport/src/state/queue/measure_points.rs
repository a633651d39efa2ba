//! The queue of points whose illuminance is to be measured: `stage/shade.rs` and `stage/sensors.rs` fill it, `stage/measure.rs` empties it.

use crate::state::columns::{Columns3, columns3};
use gonio_camera::sampler::BATCH;
use gonio_simd::{Column, padded};

/// Points whose illuminance is measured.
#[derive(Debug)]
pub(crate) struct MeasurePoints {
    pub(crate) count: usize,
    pub(crate) position: Columns3,
    pub(crate) error: Column,
    pub(crate) geometric_normal: Columns3,
    pub(crate) shading_normal: Columns3,
    pub(crate) throughput: Columns3,
    pub(crate) width: Column,
    pub(crate) slot: Column<u32>,
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
            throughput: columns3(room),
            width: Column::new(room),
            slot: Column::new(room),
        }
    }
}
