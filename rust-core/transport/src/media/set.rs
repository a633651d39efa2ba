//! The media that a ray is in (Cycles' volume stack).
//!
//! Media that overlap add up, and nothing scatters in them: their extinction is their absorption, whose sum is all that light takes notice of.

use gonio_simd::{Column, F, Lanes, M, Rgb, Spectrum, SpectrumColumns, U};

/// Lights further away than this are infinitely far.
pub(super) const FAR: f32 = 1e20;
/// What sums leave of media that a ray has left, as a part of them and a metre.
pub(super) const RESIDUE: f32 = 1e-5;

/// One register of what rays are in.
#[derive(Clone, Copy, Debug)]
pub struct MediaSet<L: Lanes> {
    /// Extinction a metre, of all of them together.
    extinction: Spectrum<L>,
}

impl<L: Lanes> MediaSet<L> {
    /// The open: nothing takes light away.
    #[inline(always)]
    pub fn open(l: L) -> Self {
        Self { extinction: Spectrum::zero(l) }
    }

    /// What absorbs so much a metre.
    #[inline(always)]
    pub fn absorbing(absorption: Spectrum<L>) -> Self {
        Self { extinction: absorption }
    }

    /// Absorption a metre of all of them together.
    #[inline(always)]
    pub fn absorption(self) -> Spectrum<L> {
        self.extinction
    }

    /// What a place is in, as [`crate::surroundings_at`] tells; in every lane.
    #[inline(always)]
    pub fn at_place(l: L, absorption: [f32; 3]) -> Self {
        let [r, g, b] = absorption.map(|x| l.f(x));
        Self::absorbing(Spectrum::coefficient(Rgb::new(r, g, b)))
    }

    /// The same of some places, whose absorption stands in columns.
    #[inline(always)]
    pub fn at_places(l: L, [r, g, b]: &[Column; 3], place: U<L>) -> Self {
        Self::absorbing(Spectrum::coefficient(Rgb::new(l.gather(r, place), l.gather(g, place), l.gather(b, place))))
    }

    /// This where the mask is set, else another.
    #[inline(always)]
    pub fn select(self, mask: M<L>, other: Self) -> Self {
        Self { extinction: mask.select(self.extinction, other.extinction) }
    }

    /// What is behind a surface that encloses so much absorption: volumes add up, solids take the place of what is before them.
    #[inline(always)]
    pub fn behind(self, enclosed: Spectrum<L>, entering: M<L>, any_volume: bool) -> Self {
        let before = self.extinction;
        let extinction = if any_volume {
            entering.select(before + enclosed, (before - enclosed - before * RESIDUE).max(0.0))
        } else {
            // Leaving a solid leads to the open.
            enclosed.keep_if(entering)
        };
        Self { extinction }
    }

    /// What is left of light after so many metres (Beer and Lambert).
    #[inline(always)]
    pub fn transmittance(self, distance: F<L>) -> Spectrum<L> {
        (self.extinction * -distance.min(FAR)).exp()
    }
}

/// What rays are in that wait between stages.
#[derive(Debug)]
pub struct MediaColumns {
    extinction: SpectrumColumns,
}

impl MediaColumns {
    /// Room for so many rays, which are in the open.
    pub fn new(room: usize) -> Self {
        Self { extinction: SpectrumColumns::new(room) }
    }
    /// Writes the chosen lanes behind the first `len` rays.
    #[inline(always)]
    pub fn append<L: Lanes>(&mut self, media: MediaSet<L>, chosen: M<L>, len: usize) {
        self.extinction.append(media.extinction, chosen, len);
    }
    /// Those of a register of rays from the one at `at` on.
    #[inline(always)]
    pub fn load<L: Lanes>(&self, l: L, at: usize) -> MediaSet<L> {
        MediaSet { extinction: self.extinction.load(l, at) }
    }
    /// Those of some rays.
    #[inline(always)]
    pub fn gather<L: Lanes>(&self, l: L, ray: U<L>) -> MediaSet<L> {
        MediaSet { extinction: self.extinction.gather(l, ray) }
    }
    /// Copies those of one ray over another's.
    pub fn copy(&mut self, from: usize, to: usize) {
        self.extinction.copy(from, to);
    }
    /// Adds one of some absorptions to what a ray is in, so many times.
    pub fn add(&mut self, ray: usize, absorption: &SpectrumColumns, from: usize, times: f32) {
        self.extinction.add(ray, absorption, from, times);
    }
    /// Lets nothing take away less than nothing: open meshes may be left without having been entered.
    #[inline(always)]
    pub fn hold<L: Lanes>(&mut self, l: L, count: usize) {
        (0..count).step_by(L::COUNT).for_each(|at| self.extinction.store(self.extinction.load(l, at).max(0.0), at));
    }
    /// All extinctions.
    pub(super) fn extinction(&self) -> &SpectrumColumns {
        &self.extinction
    }
}
