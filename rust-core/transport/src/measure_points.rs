//! Points whose illuminance waits to be measured.

use super::columns::{Columns3, columns3};
use gonio_camera::sampler::BATCH;
use gonio_simd::{Column, padded};

/// Points whose illuminance is measured.
#[derive(Debug)]
pub(super) struct MeasurePoints {
    pub(super) count: usize,
    pub(super) position: Columns3,
    pub(super) error: Column,
    pub(super) geometric_normal: Columns3,
    pub(super) shading_normal: Columns3,
    pub(super) throughput: Columns3,
    pub(super) width: Column,
    pub(super) slot: Column<u32>,
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
