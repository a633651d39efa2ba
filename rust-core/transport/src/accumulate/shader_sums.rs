//! Sums of shader AOVs.

use crate::tables::shader_passes::ShaderPasses;
use gonio_camera::sampler::BATCH;
use gonio_simd::Column;

/// Sums by pixel slot, one column a channel; none where no pass is wanted.
#[derive(Debug, Default)]
pub struct ShaderSums {
    /// Channel after channel.
    pub columns: Vec<Column>,
}

impl ShaderSums {
    /// Makes room for what the passes of a view show.
    pub fn prepare(&mut self, passes: &ShaderPasses) {
        self.columns.resize_with(passes.columns, || Column::new(BATCH));
    }
}
