//! How much work each pixel made, for the cost pass: the rays of its paths, shadow rays left out.

use crate::state::paths::Paths;
use gonio_camera::sampler::BATCH;
use gonio_simd::Column;

/// Rays by pixel slot; empty where no pass asks for them.
#[derive(Debug, Default)]
pub struct Effort {
    /// Rays so far.
    pub rays: Column,
}

impl Effort {
    /// Makes room, if the pass is wanted.
    pub(crate) fn prepare(&mut self, wanted: bool) {
        let room = if wanted { BATCH } else { 0 };
        if self.rays.len() != room {
            self.rays = Column::new(room);
        }
    }

    /// Counts a ray of each path.
    pub(crate) fn count(&mut self, paths: &Paths) {
        if self.rays.is_empty() {
            return;
        }
        for path in 0..paths.count {
            // The slots of measured points and of shadow catchers are those of their pixels, a batch or more further.
            self.rays[paths.slot(path) as usize % BATCH] += 1.0;
        }
    }
}
