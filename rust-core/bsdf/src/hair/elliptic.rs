//! The hair model of Huang, Hullin and Hanika, A Microfacet-based Hair Scattering Model, 2022: a dielectric cylinder of elliptic section whose
//! scales are of GGX facets.
//!
//! What light does inside has no closed form. So each hit draws one way of light through the fibre, the facets by which it enters and is
//! reflected inside; given that way, what leaves is three microfacet lobes and a wide one, with values, samples and pdfs of their own. Over many
//! hits that is the model. The widest lobe, of all that is reflected inside more than once, is that of `chiang.rs`.

use super::facets::{Facets, Interface};
use super::section::{Place, Section};
use super::{across, longitudinal, towards};
use core::f32::consts::PI;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// R, TT and TRT.
const WAYS: usize = 3;

/// Numbers that a hit draws: two for each facet of the way inside, one for the place across the fibre.
pub const NUMBERS: usize = 7;

/// What a fibre is made of.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fibre<L: Lanes> {
    /// Index of refraction.
    pub(crate) ior: F<L>,
    /// Absorption coefficient inside, in units of one over the longer half axis.
    pub(crate) absorption: Spectrum<L>,
    /// Width of the facets.
    pub(crate) alpha: F<L>,
    /// Tilt of the cuticle's scales towards the root, radians.
    pub(crate) tilt: F<L>,
    /// The half axis that stands across `turn`, over the one along it.
    pub(crate) aspect: F<L>,
    /// Angle about the fibre from the normal to that half axis, radians.
    pub(crate) turn: F<L>,
    /// Where the whole width is seen at once, with the axis across the view, for the hit does not tell where across it is.
    pub(crate) whole: M<L>,
    /// Factors on R, TT and TRT.
    pub(crate) tints: [Spectrum<L>; WAYS],
}

/// The lobes seen from one direction, given a way inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EllipticLobe<L: Lanes> {
    /// Cosine and sine of the longer axis' angle from the normal.
    turn: [F<L>; 2],
    /// Sine and cosine of the view's θ.
    theta: [F<L>; 2],
    /// Cosine and sine of its azimuth.
    azimuth: [F<L>; 2],
    alpha: F<L>,
    ior: F<L>,
    /// The interfaces through which light leaves.
    last: [Facets<L>; WAYS],
    /// What reaches them of the light, their gain and the tints included; and what the wide lobe scatters.
    amounts: [Spectrum<L>; WAYS + 1],
    /// About what leaves by each.
    shares: [F<L>; WAYS + 1],
    /// About what leaves in all.
    albedo: Spectrum<L>,
}

impl<L: Lanes> EllipticLobe<L> {
    /// The lobes seen from `wo`, and where the fibre is met: its section can be narrower than its outline.
    #[inline(always)]
    pub(crate) fn new(wo: Vec3<L>, fibre: &Fibre<L>, numbers: [F<L>; NUMBERS]) -> (Self, M<L>) {
        let (section, turn) = section(fibre, across(wo).1);
        let view = inwards(turn, wo);
        let (cos, azimuth) = across(view);
        // The normal is the round outline's: where across it the ray passes.
        let here = turn[0].mul_add(-azimuth[1], -(turn[1] * azimuth[0]));
        let anywhere = (numbers[6] * 2.0 - 1.0) * section.half_width(azimuth);
        let (entry, present) = section.seen(azimuth, fibre.whole.select(anywhere, here));
        let alpha = fibre.alpha.clamp(1e-3, 1.0);
        let ior = fibre.ior.clamp(1.0 + 1e-4, 1e3);
        let outline = Outline { section, tilt: fibre.tilt.sin_cos().into(), absorption: fibre.absorption.max(0.0) };
        let [outer, inner] = [Interface { alpha, eta: ior }, Interface { alpha, eta: ior.recip() }];
        let DrawnWay { last, gains, reaches, rest } = outline.way(view, entry, present, [&outer, &inner], &numbers);

        let [r, tt, trt] = fibre.tints.map(|tint| tint.max(0.0));
        let [first, passing, returning] = [reaches[0] * r, reaches[1] * tt, reaches[2] * trt];
        let rest = rest.keep_if(trt.is_lit());
        let amounts = [first * gains[0], passing * gains[1], returning * gains[2], rest];
        // These need no gain.
        let leaves = [last[0].mostly_reflected(&outer), last[1].mostly_passed(&inner), last[2].mostly_passed(&inner)];
        let albedo = first * leaves[0] + passing * leaves[1] + returning * leaves[2] + rest;
        let shares = [first.mean() * leaves[0], passing.mean() * leaves[1], returning.mean() * leaves[2], rest.mean()];
        (Self { turn, theta: [view.x, cos], azimuth, alpha, ior, last, amounts, shares, albedo }, present)
    }
    /// Share of light that is scattered, about.
    #[inline(always)]
    pub(crate) fn albedo(&self) -> Spectrum<L> {
        self.albedo
    }
    /// Roughness r.
    #[inline(always)]
    pub(crate) fn roughness(&self) -> F<L> {
        self.alpha.sqrt()
    }
    /// Value, which has the cosine in it, and pdf.
    #[inline(always)]
    pub(crate) fn eval(&self, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        eval(wi.x.lanes(), self, wi)
    }
    /// A direction with the pdf of [`Self::eval`], and where it is one.
    #[inline(always)]
    pub(crate) fn sample(&self, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        sample(u[0].lanes(), self, u)
    }
    #[inline(always)]
    fn interface(&self, way: usize) -> Interface<L> {
        Interface { alpha: self.alpha, eta: if way == 0 { self.ior } else { self.ior.recip() } }
    }
    /// One over the variance of the wide lobe along the fibre.
    #[inline(always)]
    fn narrow(&self) -> F<L> {
        (self.alpha * 4.0).recip()
    }
    #[inline(always)]
    fn total(&self) -> F<L> {
        self.shares[0] + self.shares[1] + self.shares[2] + self.shares[3]
    }
    #[inline(always)]
    fn eval_lanes(&self, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let narrow = self.narrow();
        let to = inwards(self.turn, wi);
        let (cos, _) = across(to);
        let even = longitudinal::value([to.x, cos], self.theta, narrow) * longitudinal::norm(narrow) * (0.5 / PI);
        let (mut value, mut density) = (self.amounts[WAYS] * even, self.shares[WAYS] * even);
        for (way, last) in self.last.iter().enumerate() {
            let [shape, pdf] = last.eval(&self.interface(way), to, way > 0);
            value += self.amounts[way] * shape;
            density = self.shares[way].mul_add(pdf, density);
        }
        (value, density / self.total().max(1e-20))
    }
    #[inline(always)]
    fn sample_lanes(&self, l: L, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        let mut point = u[0] * self.total();
        let reflects = point.lt(self.shares[0]);
        point -= self.shares[0];
        let passes = point.lt(self.shares[1]).and_not(reflects);
        point -= self.shares[1];
        let returns = point.lt(self.shares[2]).and_not(reflects | passes);
        point -= self.shares[2];
        let chosen = Facets::select(reflects, &self.last[0], &Facets::select(passes, &self.last[1], &self.last[2]));
        let interface = Interface { alpha: self.alpha, eta: reflects.select(self.ior, self.ior.recip()) };
        let facet = chosen.sample(&interface, [u[1], u[2]]);
        let [(mirrored, kept), (through, passed)] = [chosen.reflected(&interface, facet), chosen.refracted(&interface, facet)];
        let mut wi = reflects.select(mirrored, through);
        let mut usable = reflects.select(kept, passed).gt(0.0);
        let wide = !(reflects | passes | returns);
        if wide.any() {
            let rest = (point / self.shares[WAYS].max(1e-20)).saturate();
            let (sin_turn, cos_turn) = (rest * (2.0 * PI)).sin_cos();
            let sin = longitudinal::sample(self.theta, self.narrow(), [u[1], u[2]]);
            let even = towards([sin, (1.0 - sin * sin).safe_sqrt()], self.azimuth, [cos_turn, sin_turn]);
            wi = wide.select(even, wi);
            usable |= wide;
        }
        (outwards(self.turn, wi).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0])), usable)
    }
}

/// What a way inside depends on.
#[derive(Clone, Copy, Debug)]
struct Outline<L: Lanes> {
    section: Section<L>,
    /// Sine and cosine of the scales' tilt.
    tilt: [F<L>; 2],
    absorption: Spectrum<L>,
}

/// A way that light takes inside.
#[derive(Clone, Copy, Debug)]
struct DrawnWay<L: Lanes> {
    /// Where it is first met, and met from inside.
    last: [Facets<L>; WAYS],
    /// What makes up there for light that is lost between facets.
    gains: [F<L>; WAYS],
    /// What reaches those of the light.
    reaches: [Spectrum<L>; WAYS],
    /// What leaves after more reflections.
    rest: Spectrum<L>,
}

impl<L: Lanes> Outline<L> {
    /// The way of light that leaves towards `view` from `entry`, back to where it comes from.
    #[inline(always)]
    fn way(
        &self,
        view: Vec3<L>,
        entry: Place<L>,
        present: M<L>,
        [outer, inner]: [&Interface<L>; 2],
        numbers: &[F<L>; NUMBERS],
    ) -> DrawnWay<L> {
        let first = Facets::new(view, self.scale(entry, 1.0));
        let met = view.x.lanes().f(1.0).keep_if(present & first.is_met());
        let (inside, enters) = first.let_in(outer, [numbers[0], numbers[1]]);
        let (exit, passed) = self.crossed(entry, inside);

        let second = Facets::new(-inside, self.scale(exit, -1.0));
        let gain = first.gain(outer);
        let passing = passed * (met * gain * enters).keep_if(second.is_met());
        let (back, [mirrors, stays]) = second.mirror(inner, [numbers[2], numbers[3]]);
        let (end, passed_again) = self.crossed(exit, back);

        let third = Facets::new(-back, self.scale(end, -1.0));
        let inner_gain = second.gain(inner);
        let returning = passing * passed_again * (inner_gain * mirrors).keep_if(third.is_met());
        let (_, [mirrors, stays_again]) = third.mirror(inner, [numbers[4], numbers[5]]);
        let last_gain = third.gain(inner);
        let rest = returning * (last_gain * mirrors) * further(passed * passed_again, (stays + stays_again) * 0.5);
        let reaches = [Spectrum::constant(met), passing, returning];
        DrawnWay { last: [first, second, third], gains: [gain, inner_gain, last_gain], reaches, rest }
    }
    /// The normal of a scale, outwards or inwards.
    #[inline(always)]
    fn scale(&self, at: Place<L>, side: f32) -> Vec3<L> {
        let ([y, z], [sin, cos]) = (self.section.normal(at), self.tilt);
        Vec3::new(-sin, cos * y, cos * z) * side
    }
    /// The other side, and what is left of light there.
    #[inline(always)]
    fn crossed(&self, at: Place<L>, direction: Vec3<L>) -> (Place<L>, Spectrum<L>) {
        let (end, way) = self.section.crossed(at, direction);
        (end, (self.absorption * -way).exp())
    }
}

/// The section with the longer axis as its y, and that axis' angle as cosine and sine: across the view where the whole width is seen.
#[inline(always)]
fn section<L: Lanes>(fibre: &Fibre<L>, view: [F<L>; 2]) -> (Section<L>, [F<L>; 2]) {
    let aspect = fibre.aspect.clamp(1e-2, 1e2);
    let swapped = aspect.gt(1.0);
    let (sin, cos) = fibre.turn.sin_cos();
    let [cos, sin] = [fibre.whole.select(view[0], cos), fibre.whole.select(view[1], sin)];
    (Section { minor: swapped.select(aspect.recip(), aspect) }, [swapped.select(-sin, cos), swapped.select(cos, sin)])
}

/// What leaves after all further reflections, of what has been reflected inside twice: a geometric series, with the mean of what was left of
/// light so far on both ways, and the mean reflectance.
#[inline(always)]
fn further<L: Lanes>(passed: Spectrum<L>, reflectance: F<L>) -> Spectrum<L> {
    let passed = passed.safe_sqrt();
    let leaves = (1.0 - reflectance).max(1e-5);
    passed * leaves / (Spectrum::one(leaves.lanes()) - passed * (1.0 - leaves)).max(1e-6)
}

/// A direction of the shading frame in the section's coordinates.
#[inline(always)]
fn inwards<L: Lanes>([cos, sin]: [F<L>; 2], v: Vec3<L>) -> Vec3<L> {
    Vec3::new(v.x, cos.mul_add(v.z, -(sin * v.y)), -sin.mul_add(v.z, cos * v.y))
}

/// The other way round.
#[inline(always)]
fn outwards<L: Lanes>([cos, sin]: [F<L>; 2], v: Vec3<L>) -> Vec3<L> {
    Vec3::new(v.x, -sin.mul_add(v.y, cos * v.z), cos.mul_add(v.y, -(sin * v.z)))
}

/// [`EllipticLobe::eval`] as a function of its own: most surfaces should not carry its registers.
#[inline(never)]
fn eval<L: Lanes>(l: L, lobe: &EllipticLobe<L>, wi: Vec3<L>) -> (Spectrum<L>, F<L>) {
    l.vectorize(
        #[inline(always)]
        || lobe.eval_lanes(wi),
    )
}

/// [`EllipticLobe::sample`] as a function of its own.
#[inline(never)]
fn sample<L: Lanes>(l: L, lobe: &EllipticLobe<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
    l.vectorize(
        #[inline(always)]
        || lobe.sample_lanes(l, u),
    )
}
