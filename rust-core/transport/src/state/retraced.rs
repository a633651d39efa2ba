//! Rays that are traced again, behind the shape of a light that they hit.

use crate::state::paths::Paths;

/// Rays that go on behind the shapes of lights; their columns keep their room from batch to batch.
#[derive(Debug, Default)]
pub(crate) struct RetracedRays {
    pub(crate) origin: [Vec<f32>; 3],
    pub(crate) direction: [Vec<f32>; 3],
    pub(crate) t_min: Vec<f32>,
    pub(crate) t_max: Vec<f32>,
    pub(crate) mask: Vec<u8>,
}

impl RetracedRays {
    /// Takes the rays of the named paths.
    pub(crate) fn select(&mut self, paths: &Paths, chosen: &[u32]) {
        fn fill<T: Copy>(to: &mut Vec<T>, from: &[T], chosen: &[u32]) {
            to.clear();
            to.extend(chosen.iter().map(|path| from[*path as usize]));
        }
        for axis in 0..3 {
            fill(&mut self.origin[axis], &paths.origin[axis], chosen);
            fill(&mut self.direction[axis], &paths.direction[axis], chosen);
        }
        fill(&mut self.t_min, &paths.t_min, chosen);
        fill(&mut self.t_max, &paths.t_max, chosen);
        fill(&mut self.mask, &paths.mask, chosen);
    }
}
