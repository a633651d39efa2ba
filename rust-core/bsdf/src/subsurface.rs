//! Light under the surface: from a colour and a radius to a medium, the way in, and the steps of a random walk (Chiang, Kutz, Burley 2016).
//!
//! The walk itself goes through the scene and is the integrator's: it enters along a sample marked as such, takes steps of
//! [`WalkMedium::flight`] and [`WalkMedium::arrive`] that end at the surface or at a scattering, turns by [`WalkMedium::scatter`], and leaves through
//! [`exit`], a white Lambert lobe. Lengths are in metres.

use super::diffuse::DiffuseLobe;
use super::lobes::Lobes;
use super::microfacet::Widths;
use super::phase::sample_henyey_greenstein;
use super::switches::SubsurfaceMethod;
use core::f32::consts::PI;
use gonio_simd::{F, Lanes, M, Spectrum, Vec3};

/// Steps after which a walk is lost.
pub const MAXIMUM_STEPS: u32 = 256;
/// The step from which on the walk goes by [`WalkMedium::reduced`].
pub const REDUCED_FROM: u32 = 10;
/// Throughput under which a walk ends.
pub const LEAST_THROUGHPUT: f32 = 1e-6;
/// Radii below this many metres scatter nothing: such channels are diffuse.
pub(crate) const LEAST_RADIUS: f32 = 1e-8;
/// Least single-scattering albedo of a walk; what is missing is taken from the throughput.
const LEAST_ALBEDO: f32 = 0.2;
/// Largest single-scattering albedo.
const MOST_ALBEDO: f32 = 0.999_999;

/// What is under a surface.
#[derive(Clone, Copy, Debug)]
pub struct WalkMedium<L: Lanes> {
    /// Single-scattering albedo.
    pub albedo: Spectrum<L>,
    /// Extinction coefficient, 1/m.
    pub extinction: Spectrum<L>,
    /// Mean cosine g of the phase function (Henyey, Greenstein).
    pub anisotropy: F<L>,
}

/// A sampled flight.
#[derive(Clone, Copy, Debug)]
pub struct Flight<L: Lanes> {
    /// Length of the flight if nothing is in the way, metres.
    pub distance: F<L>,
    /// Probabilities with which each channel's extinction was chosen.
    pub channels: Spectrum<L>,
}

/// Single-scattering albedo of a half-space with diffuse albedo `c` (van de Hulst's relation inverted; d'Eon, A Hitchhiker's Guide to
/// Multiple Scattering, eq. 53.7).
#[inline(always)]
fn van_de_hulst<L: Lanes>(c: F<L>, g: F<L>) -> F<L> {
    let s = c * 4.20863 - c.mul_add(c.mul_add(17.7126, 41.6808), 9.59217).sqrt() + 4.09712;
    let s2 = s * s;
    (1.0 - s2) / (1.0 - g * s2)
}

#[inline(always)]
fn polynomial<L: Lanes>(x: F<L>, coefficients: [f32; 8]) -> F<L> {
    let mut sum = x.lanes().f(coefficients[7]);
    for i in (0..7).rev() {
        sum = sum.mul_add(x, coefficients[i]);
    }
    sum
}

/// The terms in g of the fit of single-scattering albedos (Wrenninge, Villemin, Hery 2017), for g from 0 to 0.9.
#[derive(Clone, Copy, Debug)]
struct Fit<L: Lanes>([F<L>; 6]);

impl<L: Lanes> Fit<L> {
    #[inline(always)]
    fn new(g: F<L>) -> Self {
        let b = [0.0, 31.149_158, -201.847_02, 841.576, -2_018.092_9, 2_731.715_6, -1_935.414_2, 559.009_05];
        let e = [0.0, 76.731_63, -594.356_8, 2_448.883_4, -5_576.685, 7_116.601_7, -4_763.545, 1_303.531_8];
        Self([
            polynomial(g, [1.826_052_4, -1.284_510_6, -1.799_046_3, 9.193_933, -22.821_558, 32.023_487, -23.626_48, 7.210_67]),
            polynomial(g, b).exp() * 0.127_355_96 + 4.985_112,
            polynomial(g, [1.096_861, -0.394_704_06, 1.052_581_2, -8.839_637, 28.864_323, -46.880_29, 38.540_284, -12.718_104]),
            polynomial(g, [0.496_310_2, 0.360_146_58, -2.151_393, 17.889_69, -55.298_4, 82.065_99, -58.510_6, 15.847_83]),
            polynomial(g, e).exp() * 0.003_106_039_5 + 4.231_903,
            polynomial(g, [2.406_03, -2.518_148_4, 9.184_949, -79.219_17, 259.082_87, -403.613_8, 302.857_12, -87.437_05]),
        ])
    }
    #[inline(always)]
    fn albedo(&self, colour: F<L>) -> F<L> {
        let [a, b, c, d, e, f] = self.0;
        let one = colour.lanes().f(1.0);
        let blend = colour.max(0.0).sqrt().sqrt();
        let low = a * (b * colour).atan2(one).max(1e-20).pow(c);
        let high = d * (e * colour).atan2(one).max(1e-20).pow(f);
        low.lerp(high, blend)
    }
}

/// √(3 (1 − α')) of the reduced albedo α' at which a dipole of relative index `eta` reflects `colour` (Jensen et al. 2001).
#[inline(always)]
fn dipole_scale<L: Lanes>(colour: F<L>, eta: F<L>) -> F<L> {
    let inverse = eta.recip();
    let internal = inverse * (inverse * -1.44 + 0.71) + 0.668 + eta * 0.0636;
    let boundary = (1.0 + internal) / (1.0 - internal) * (4.0 / 3.0);
    let l = colour.lanes();
    let (mut low, mut high) = (l.f(0.0), l.f(1.0));
    let mut middle = l.f(0.5);
    for _ in 0..12 {
        middle = (low + high) * 0.5;
        let s = ((1.0 - middle) * 3.0).safe_sqrt();
        let reflected = middle * 0.5 * ((-(boundary * s)).exp() + 1.0) * (-s).exp();
        let below = reflected.lt(colour);
        low = below.select(middle, low);
        high = below.select(high, middle);
    }
    let reduced = colour.lt(1e-4).select(l.f(0.0), colour.ge(0.995).select(l.f(MOST_ALBEDO), middle));
    ((1.0 - reduced) * 3.0).safe_sqrt()
}

impl<L: Lanes> WalkMedium<L> {
    /// The medium that gives a half-space about the colour `colour` from 0 to 1, and the factor on the throughput that goes in; `radius` in
    /// metres, `g` from −1 to 1, `eta` the index for the skin's lengths.
    #[inline(always)]
    pub fn new(method: SubsurfaceMethod, colour: Spectrum<L>, radius: Spectrum<L>, g: F<L>, eta: F<L>) -> (Self, Spectrum<L>) {
        let l = g.lanes();
        let (g, radius) = match method {
            SubsurfaceMethod::RandomWalkLegacy => (g.clamp(-0.99, 0.9), radius * (0.25 / PI)),
            SubsurfaceMethod::RandomWalkSkin => {
                let scale = colour.map(
                    #[inline(always)]
                    |colour| dipole_scale(colour, eta),
                );
                (g.clamp(-0.99, 0.9), radius * scale)
            }
            SubsurfaceMethod::Burley => (l.f(0.0), radius * (0.25 / PI)),
            SubsurfaceMethod::RandomWalk | SubsurfaceMethod::Diffuse => (g.clamp(-0.99, 0.99), radius),
        };
        let mut albedo = colour.map(
            #[inline(always)]
            |colour| van_de_hulst(colour, g),
        );
        let mut extinction = radius.map(
            #[inline(always)]
            |radius| radius.max(1e-16).recip(),
        );
        if matches!(method, SubsurfaceMethod::RandomWalkLegacy | SubsurfaceMethod::RandomWalkSkin) {
            let forward = g.ge(0.0);
            let fit = Fit::new(g.max(0.0));
            let fitted = colour.map(
                #[inline(always)]
                |colour| fit.albedo(colour),
            );
            albedo = forward.select(fitted, albedo);
            extinction = forward.select(extinction * (1.0 - g.max(0.0)).recip(), extinction);
        }
        let albedo = albedo.clamp(0.0, MOST_ALBEDO);
        let raised = albedo.max(LEAST_ALBEDO);
        let [factor] = (albedo / raised).zip(
            colour,
            #[inline(always)]
            |factor, colour| [factor.keep_if(colour.gt(0.0))],
        );
        (Self { albedo: raised, extinction, anisotropy: g }, factor)
    }
    /// The medium that scatters evenly and carries light as far (similarity theory).
    #[inline(always)]
    pub fn reduced(&self) -> Self {
        let kept = 1.0 - self.anisotropy;
        let scattering = self.albedo * self.extinction;
        let extinction = self.extinction - scattering * self.anisotropy;
        Self { albedo: scattering * kept / extinction, extinction, anisotropy: self.anisotropy.lanes().f(0.0) }
    }
    /// A flight: `u[0]` chooses a channel by what its scattering would leave of the throughput, `u[1]` the distance.
    #[inline(always)]
    pub fn flight(&self, throughput: Spectrum<L>, u: [F<L>; 2]) -> Flight<L> {
        let channels = (throughput * self.albedo).shares();
        let extinction = channels.choose(u[0], self.extinction);
        Flight { distance: -(1.0 - u[1]).max(1e-9).ln() / extinction, channels }
    }
    /// Throughput after `distance` of a flight that ended where `surface` is set at the surface and else at a scattering; balance heuristic
    /// over the channels.
    #[inline(always)]
    pub fn arrive(&self, throughput: Spectrum<L>, flight: &Flight<L>, distance: F<L>, surface: M<L>) -> Spectrum<L> {
        let white = Spectrum::one(distance.lanes());
        let depth = self.extinction * distance;
        // A common factor of all channels keeps the quotient from becoming 0 / 0.
        let least = depth.min_component();
        let passed = (Spectrum::constant(least) - depth).exp();
        let density = passed * surface.select(white, self.extinction);
        let value = passed * surface.select(white, self.extinction * self.albedo);
        let pdf = flight.channels.dot(density);
        throughput * value * pdf.max(1e-30).recip()
    }
    /// The direction after a scattering of light that goes along `direction`; its density is the phase function, so that no factor remains.
    #[inline(always)]
    pub fn scatter(&self, direction: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
        sample_henyey_greenstein(self.anisotropy, direction, u)
    }
}

/// [`WalkMedium::new`] as a function of its own: the fit's powers would be most of a surface's code.
#[inline(never)]
pub(crate) fn medium<L: Lanes>(
    l: L,
    method: SubsurfaceMethod,
    colour: Spectrum<L>,
    radius: Spectrum<L>,
    g: F<L>,
    eta: F<L>,
) -> (WalkMedium<L>, Spectrum<L>) {
    l.vectorize(
        #[inline(always)]
        || WalkMedium::new(method, colour, radius, g, eta),
    )
}

/// The lobe through which a walk leaves: Lambert, white.
#[inline(always)]
pub fn exit<L: Lanes>(l: L) -> Lobes<'static, L> {
    Lobes::lambert(l, Spectrum::one(l))
}

/// The way in: through a facet without loss, or evenly.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EntryLobe<L: Lanes> {
    /// Width of the facets.
    pub(crate) alpha: F<L>,
    /// Outside over inside index.
    pub(crate) inverse: F<L>,
    /// Share that enters with the cosine's density.
    pub(crate) diffuse: f32,
}

impl<L: Lanes> EntryLobe<L> {
    /// The way in for a method, roughness r and index.
    #[inline(always)]
    pub(crate) fn new(method: SubsurfaceMethod, roughness: F<L>, eta: F<L>) -> Self {
        let inverse = eta.clamp(1.01, 3.8).recip();
        let alpha = roughness * roughness;
        match method {
            SubsurfaceMethod::RandomWalkSkin => Self { alpha: alpha.lanes().f(1.0), inverse, diffuse: 0.5 },
            SubsurfaceMethod::Burley => Self { alpha, inverse, diffuse: 1.0 },
            _ => Self { alpha, inverse, diffuse: 0.0 },
        }
    }
    /// A direction into the surface, and whether it is one.
    #[inline(always)]
    pub(crate) fn sample(&self, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, M<L>) {
        let l = wo.x.lanes();
        let h = Widths::isotropic(self.alpha).sample(wo, l.f(1.0), [u[1], u[2]]);
        let c = wo.dot(h);
        let cos = (1.0 - (1.0 - c * c) * self.inverse * self.inverse).safe_sqrt();
        let refracted = h * (c * self.inverse - cos) - wo * self.inverse;
        let even = u[0].lt(self.diffuse);
        let wi = even.select(-DiffuseLobe::sample([u[1], u[2]]), refracted);
        (wi, wi.z.lt(0.0) & (even | wo.z.gt(0.0)))
    }
}
