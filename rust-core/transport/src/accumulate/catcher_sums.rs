//! Sums of what lies behind shadow catchers.

use crate::state::columns::{Columns3, columns3};
use gonio_camera::sampler::BATCH;
use gonio_simd::Column;

/// What lies behind catchers, by pixel slot.
#[derive(Debug, Default)]
pub struct CatcherSums {
    pub(crate) sums: Option<(Column, Columns3)>,
}

impl CatcherSums {
    pub(crate) fn is_empty(&self) -> bool {
        self.sums.is_none()
    }
    pub(crate) fn prepare(&mut self) {
        self.sums = Some((Column::new(BATCH), columns3(BATCH)));
    }
    pub(crate) fn columns(&mut self) -> impl Iterator<Item = &mut Column> {
        self.sums.iter_mut().flat_map(|(coverage, behind)| [coverage].into_iter().chain(behind))
    }
    /// Coverage by catchers where there is none behind them, and the radiance of the environment behind them.
    pub fn sums(&self) -> Option<(&Column, &Columns3)> {
        self.sums.as_ref().map(|(coverage, behind)| (coverage, behind))
    }
}
