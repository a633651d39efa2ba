//! Sampling of all lobes.

use super::eval::{Asked, evaluate};
use super::{Lobes, Shape, Side, Slot};
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// A sampled direction. `value / pdf` is the throughput factor; `pdf` 0 is a failed sample.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample<L: Lanes> {
    /// Direction towards the light, unit, in the shading frame.
    pub wi: Vec3<L>,
    /// BSDF × |cos θi|, or the weight of a delta lobe.
    pub value: Spectrum<L>,
    /// Density per solid angle over all lobes, or the probability of a delta lobe.
    pub pdf: F<L>,
    /// Perfect mirror or smooth refraction: lights cannot be sampled for this direction.
    pub delta: M<L>,
    /// The direction is on the other side of the normal that the chosen lobe is about; of fibres, it has been inside.
    pub transmitted: M<L>,
    /// Straight through a thin wall: the ray goes on as if nothing were there but the colour.
    pub straight: M<L>,
    /// Into the medium under the surface, which [`Lobes::medium`] tells: `wi` is the first direction of a walk.
    pub entered: M<L>,
    /// The chosen lobe is diffuse, fuzz or subsurface.
    pub diffuse: M<L>,
    /// Roughness r of the chosen lobe, 1 for diffuse ones.
    pub roughness: F<L>,
}

impl<L: Lanes> BsdfSample<L> {
    /// No lobe was chosen yet.
    #[inline(always)]
    pub(super) fn nothing(l: L) -> Self {
        let nothing = l.m(false);
        Self {
            wi: Vec3::splat(l, [0.0, 0.0, 1.0]),
            value: Spectrum::zero(l),
            pdf: l.f(0.0),
            delta: nothing,
            transmitted: nothing,
            straight: nothing,
            entered: nothing,
            diffuse: nothing,
            roughness: l.f(1.0),
        }
    }
}

impl<L: Lanes> Lobes<'_, L> {
    /// Chooses a lobe by its share, samples it and evaluates all of them there (one-sample balance heuristic).
    #[inline(always)]
    pub fn sample(&self, l: L, wo: Vec3<L>, u: [F<L>; 3]) -> BsdfSample<L> {
        self.sample_with(l, wo, u, None)
    }
    /// The same, but lanes that follow go in a given direction, which no lobe has chosen: `pdf` is that of the lobes all the same (path guiding).
    #[inline(always)]
    pub fn sample_or_follow(&self, l: L, wo: Vec3<L>, u: [F<L>; 3], wi: Vec3<L>, follows: M<L>) -> BsdfSample<L> {
        self.sample_with(l, wo, u, Some((wi, follows)))
    }
    #[inline(always)]
    fn sample_with(&self, l: L, wo: Vec3<L>, u: [F<L>; 3], given: Option<(Vec3<L>, M<L>)>) -> BsdfSample<L> {
        let mut sample = BsdfSample::nothing(l);
        let mut point = u[0] * self.total;
        let follows = if let Some((_, follows)) = given { follows } else { l.m(false) };
        let (mut passed, mut found) = (follows, follows);
        for slot in self.slots[..self.count].iter().flatten() {
            let here = point.lt(slot.share).and_not(passed);
            if here.any() {
                let rest = (point / slot.share.max(1e-20)).clamp(0.0, 0.999_999_94);
                found |= here & self.choose(l, wo, slot, here, [rest, u[1], u[2]], &mut sample);
            }
            passed |= here;
            point -= slot.share;
        }
        if let Some((wi, follows)) = given {
            sample.wi = follows.select(wi, sample.wi);
        }
        let (value, pdf) = evaluate(l, self, wo, sample.wi, Asked::Sampled);
        let alone = sample.delta | sample.entered;
        sample.value = alone.select(sample.value, value).keep_if(found);
        sample.pdf = alone.select(sample.pdf, pdf).keep_if(found);
        sample
    }
    /// Fills the lanes `here` with a direction of `slot`, and with value and pdf where it is a delta lobe; returns where it is usable.
    #[inline(always)]
    pub(super) fn choose(&self, l: L, wo: Vec3<L>, slot: &Slot<'_, L>, here: M<L>, u: [F<L>; 3], sample: &mut BsdfSample<L>) -> M<L> {
        let (wi, [usable, through]) = slot.sample(&self.tilts, wo, u);
        sample.wi = here.select(wi, sample.wi);
        sample.transmitted |= here & through;
        sample.roughness = here.select(slot.roughness(l), sample.roughness);
        if !slot.is_specular() && !matches!(slot.shape, Shape::Straight) {
            sample.diffuse |= here;
        }
        let enters = matches!(slot.shape, Shape::Subsurface(_));
        let alone = if enters { here } else { here & slot.delta(l) };
        if !alone.any() {
            return usable;
        }
        let (mut value, pdf) = slot.delta_eval(l, &self.tilts, wo, sample.wi);
        if let (true, Some(coat)) = (slot.coated, &self.coat) {
            value = value * coat.colour(sample.wi);
        }
        sample.value = alone.select(value, sample.value);
        sample.pdf = alone.select(pdf * slot.share / self.total.max(1e-20), sample.pdf);
        if enters {
            sample.entered |= alone;
        } else {
            sample.delta |= alone;
        }
        if slot.side == Side::Mirrored {
            sample.straight |= alone;
        }
        usable
    }
}
