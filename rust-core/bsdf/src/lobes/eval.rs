//! Evaluation of all lobes.

use super::{Lobes, Shape, Side, Slot};
use gonio_simd::{F, Lanes, Spectrum, Vec3};

/// What an evaluation is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Asked {
    /// A direction that a light gave.
    All,
    /// A direction that the lobes gave: bump rules leave more open.
    Sampled,
    /// The part of a light's direction that is not of facets and interfaces.
    Diffuse,
    /// A light path's direction towards the light, seen from where the path goes: all but toon lobes.
    Seen,
    /// The same but for what interfaces let pass.
    Swapped,
    /// Those alone, for they are evaluated the way that the path runs.
    Along,
}

impl Asked {
    /// Whether a lobe counts at all.
    #[inline(always)]
    fn counts<L: Lanes>(self, slot: &Slot<'_, L>) -> bool {
        match self {
            Self::All | Self::Sampled => true,
            Self::Seen | Self::Swapped => !matches!(slot.shape, Shape::Toon(_)),
            Self::Diffuse => !slot.is_specular(),
            Self::Along => matches!(slot.shape, Shape::Glass(_) | Shape::Toon(_)),
        }
    }
}

impl<L: Lanes> Lobes<'_, L> {
    /// BSDF × |cos θi| of all lobes but delta ones, and the density with which [`Self::sample`] finds `wi`.
    #[inline(always)]
    pub fn eval(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        evaluate(l, self, wo, wi, Asked::All)
    }
    /// The same for what is asked for.
    #[inline(always)]
    fn sum(&self, l: L, wo: Vec3<L>, wi: Vec3<L>, asked: Asked) -> (Spectrum<L>, F<L>) {
        let mut sum = Spectrum::zero(l);
        let mut density = l.f(0.0);
        #[allow(clippy::manual_map, reason = "a closure may stay a call outside the level's instructions")]
        let coat = match &self.coat {
            Some(coat) => Some(coat.colour(wi)),
            None => None,
        };
        for slot in self.slots[..self.count].iter().flatten() {
            if !asked.counts(slot) {
                continue;
            }
            let (mut value, pdf) = slot.eval(&self.tilts, wo, wi);
            if let (Asked::Seen | Asked::Swapped | Asked::Along, Shape::Glass(lobe)) = (asked, &slot.shape) {
                let passed = (wo.z * wi.z).lt(0.0);
                value = match asked {
                    // Camera paths keep radiance behind an interface without the squared index; flux has it.
                    Asked::Seen => value * passed.select(lobe.squared_index().recip(), Spectrum::one(l)),
                    Asked::Along => value.keep_if(passed),
                    _ => value.keep_if(!passed),
                };
            }
            let given = matches!(asked, Asked::All | Asked::Diffuse);
            let open = slot.is_fibre() || (!given && (!slot.is_diffuse() || slot.side != Side::Reflected));
            if let Some(factor) = self.tilts.shadow(slot.normal, wi, slot.is_diffuse(), open) {
                value = value * factor;
            }
            if let (true, Some(tint)) = (slot.coated, coat) {
                value = value * tint;
            }
            sum += value;
            density = slot.share.mul_add(pdf, density);
        }
        (sum, density / self.total.max(1e-20))
    }
    /// What smooth interfaces let pass to `wo` of light from `wi`, which is behind them.
    #[inline(always)]
    pub(crate) fn passed_sharply(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
        let mut sum = Spectrum::zero(l);
        for slot in self.slots[..self.count].iter().flatten().filter(|slot| matches!(slot.shape, Shape::Glass(_))) {
            let value = slot.delta_eval(l, &self.tilts, wo, wi).0.keep_if(slot.delta(l));
            sum += match &self.coat {
                Some(coat) if slot.coated => value * coat.colour(wi),
                _ => value,
            };
        }
        sum
    }
    /// The diffuse part of [`Self::eval`]: all but facets and interfaces.
    #[inline(always)]
    pub fn eval_diffuse(&self, l: L, wo: Vec3<L>, wi: Vec3<L>) -> Spectrum<L> {
        evaluate(l, self, wo, wi, Asked::Diffuse).0
    }
}

/// [`Lobes::sum`] as a function of its own, for evaluation and sampling alike.
#[inline(never)]
pub(crate) fn evaluate<L: Lanes>(l: L, lobes: &Lobes<'_, L>, wo: Vec3<L>, wi: Vec3<L>, asked: Asked) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || lobes.sum(l, wo, wi, asked),
    )
}
