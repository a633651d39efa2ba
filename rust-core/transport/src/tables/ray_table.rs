//! Rays from a table, with which light paths may start.

use gonio_light::EmittedRay;
use gonio_simd::{Lanes, U, Vec3};

/// Rays that carry flux, each as much as if it were the only one. Rebased world space.
#[derive(Clone, Debug, Default)]
pub struct RayTable {
    /// Where they start.
    pub origin: [Vec<f32>; 3],
    /// Unit directions.
    pub direction: [Vec<f32>; 3],
    /// Flux, R, G, B.
    pub flux: [Vec<f32>; 3],
}

impl RayTable {
    /// Rays in it.
    pub fn len(&self) -> usize {
        self.flux[0].len()
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// Some of its rays, by their numbers.
    #[inline(always)]
    pub(crate) fn rays<L: Lanes>(&self, l: L, number: U<L>) -> EmittedRay<L> {
        let three = |columns: &[Vec<f32>; 3]| {
            let [x, y, z] = columns;
            Vec3::new(l.gather(x, number), l.gather(y, number), l.gather(z, number))
        };
        let flux = three(&self.flux);
        EmittedRay {
            origin: three(&self.origin),
            normal: Vec3::splat(l, [0.0; 3]),
            direction: three(&self.direction),
            flux: flux.into(),
            light: l.u(0),
            clear: l.f(0.0),
        }
    }
}
