//! What a coloured coat takes from the light on its way.

use gonio_simd::{F, Lanes, Spectrum, Vec3};

/// The coat's colour along the light's way in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoatTint<L: Lanes> {
    /// Logarithm of the colour.
    pub(crate) log: Spectrum<L>,
    /// Presence of the coat.
    pub(crate) weight: F<L>,
    /// Index of the coat.
    pub(crate) ior: F<L>,
    /// Inverse cosine of the view's refracted direction.
    pub(crate) view: F<L>,
}

impl<L: Lanes> CoatTint<L> {
    /// Colour of the way in and out for light from `wi`; a transmitted direction counts as the view's.
    #[inline(always)]
    pub(super) fn colour(&self, wi: Vec3<L>) -> Spectrum<L> {
        let cos = (1.0 - (1.0 - wi.z * wi.z) / (self.ior * self.ior)).max(1e-4).sqrt();
        let light = wi.z.gt(0.0).select(cos.recip(), self.view);
        self.along((light + self.view) * 0.5)
    }
    /// Colour over a path of this many normal passages both ways.
    #[inline(always)]
    pub(crate) fn along(&self, path: F<L>) -> Spectrum<L> {
        let white = Spectrum::one(path.lanes());
        white.lerp((self.log * path).exp(), self.weight)
    }
}
