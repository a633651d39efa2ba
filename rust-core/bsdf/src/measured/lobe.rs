//! A measurement as one of a surface's lobes.

use super::MeasuredBsdf;
use super::angles::through;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3, Wavelengths};

/// What was measured, seen from one side or the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasuredLobe<'s, L: Lanes> {
    bsdf: &'s MeasuredBsdf,
    /// Where the measurement's front is seen.
    front: M<L>,
    wavelengths: Wavelengths<'s, L>,
}

impl<'s, L: Lanes> MeasuredLobe<'s, L> {
    /// The lobe of hits that see the measurement's front where `front` says so.
    #[inline(always)]
    pub(crate) fn new(bsdf: &'s MeasuredBsdf, front: M<L>, wavelengths: Wavelengths<'s, L>) -> Self {
        Self { bsdf, front, wavelengths }
    }
    /// Whether some light may pass through.
    #[inline(always)]
    pub(crate) fn transmits(&self) -> bool {
        self.bsdf.scatters.iter().any(|side| side[1])
    }
    /// Roughness r that spreads light about as far as the measurement.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> f32 {
        self.bsdf.albedos.roughness()
    }
    /// Share of light that leaves to the view.
    #[inline(always)]
    pub(crate) fn albedo(&self, wo: Vec3<L>) -> Spectrum<L> {
        let l = wo.x.lanes();
        let mut albedo = Spectrum::zero(l);
        for (side, here) in [self.front, l.m(true).and_not(self.front)].into_iter().enumerate() {
            if here.any() {
                albedo = here.select(self.wavelengths.reflectance(self.bsdf.albedos.of_view(l, side, wo)), albedo);
            }
        }
        albedo
    }
    /// Value × cosine and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        eval(wo.x.lanes(), self, wo, wi)
    }
    /// A direction with the pdf of [`Self::eval`], and whether there is one.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        sample(wo.x.lanes(), self, wo, u)
    }
    /// A direction as the measurement's front has it: seen from behind, y points the other way. Undone by itself.
    #[inline(always)]
    fn seen(&self, v: Vec3<L>) -> Vec3<L> {
        Vec3::new(v.x, self.front.select(v.y, -v.y), v.z)
    }
    /// Where the front and where the back is seen.
    #[inline(always)]
    fn sides(&self, l: L) -> [M<L>; 2] {
        [self.front, l.m(true).and_not(self.front)]
    }
}

/// [`MeasuredLobe::eval`] as a function of its own: most surfaces should not carry its registers.
#[inline(never)]
fn eval<L: Lanes>(l: L, lobe: &MeasuredLobe<'_, L>, wo: Vec3<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || {
            let (wo, wi) = (lobe.seen(wo), lobe.seen(wi));
            let up = Vec3::new(wi.x, wi.y, wi.z.abs());
            let passes = wi.z.lt(0.0);
            let mut sum = (Spectrum::zero(l), l.f(0.0));
            for (side, here) in lobe.sides(l).into_iter().enumerate() {
                let here = here & wo.z.gt(0.0);
                for (transmitted, through) in [(false, wi.z.gt(0.0)), (true, passes)] {
                    let chosen = here & through;
                    if lobe.bsdf.scatters[side][usize::from(transmitted)] && chosen.any() {
                        let (value, pdf) = eval_side(l, lobe, [side, usize::from(transmitted)], up, wo);
                        sum = (chosen.select(value, sum.0), chosen.select(pdf, sum.1));
                    }
                }
            }
            sum
        },
    )
}

/// What was measured between directions on one side, compiled once however many sides there are: by wavelength where that is known, else by its colour.
#[inline(never)]
fn eval_side<L: Lanes>(l: L, lobe: &MeasuredLobe<'_, L>, [side, kind]: [usize; 2], wi: Vec3<L>, wo: Vec3<L>) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || {
            // No closure of an Option's: it may stay a call outside of the lanes' level.
            if let Some(nanometres) = lobe.wavelengths.nanometres()
                && let Some(own) = lobe.bsdf.eval_at(l, nanometres, wi, wo)
            {
                return own;
            }
            let (colour, pdf) = lobe.bsdf.eval_side(l, side, kind == 1, wi, wo);
            (lobe.wavelengths.coefficient(colour), pdf)
        },
    )
}

/// [`MeasuredLobe::sample`] as a function of its own.
#[inline(never)]
fn sample<L: Lanes>(l: L, lobe: &MeasuredLobe<'_, L>, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
    l.vectorize(
        #[inline(always)]
        || {
            let seen = lobe.seen(wo);
            let (mut wi, mut usable) = (Vec3::splat(l, [0.0, 0.0, 1.0]), l.m(false));
            for (side, here) in lobe.sides(l).into_iter().enumerate() {
                if here.any() {
                    let (up, [transmitted, sound]) = lobe.bsdf.sample_side(l, side, seen, u);
                    wi = here.select(transmitted.select(through(up), up), wi);
                    usable |= here & sound;
                }
            }
            (lobe.seen(wi), usable & wo.z.gt(0.0))
        },
    )
}
