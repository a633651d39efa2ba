//! The operators and the display's curves, register by register.

use super::{DisplaySpace, Look, ToneMap};
use gonio_simd::{F, Lanes, Rgb};

/// Grey that the log-average luminance is brought to.
pub const KEY: f32 = 0.18;

/// What all pixels of a picture have in common.
#[derive(Clone, Copy, Debug)]
pub struct ToneCurve {
    /// Factor on radiance.
    pub(super) scale: f32,
    /// How the photographic operators rise towards white; `None` without them.
    rise: Option<f32>,
    space: DisplaySpace,
}

impl ToneCurve {
    /// The curve of a look at a picture with a log-average luminance.
    pub fn new(look: &Look, average: f32) -> Self {
        let exposure = match look.tone_map {
            ToneMap::None => 1.0,
            ToneMap::Photographic | ToneMap::Local => KEY / average,
            ToneMap::Ev100(ev) => 1.0 / (1.2 * ev.exp2()),
        };
        // y (1 + rise · y) / (1 + y) is the display's peak where y is white; 1 / white² where the peak is 1, as Reinhard has it.
        let rise = (look.space.peak() * (1.0 + look.white) / look.white - 1.0) / look.white;
        Self { scale: look.stops.exp2() * exposure, rise: look.tone_map.adapts().then_some(rise), space: look.space }
    }
}

/// Display values in [0, 1] of a register of scene-linear colours; `around` is the scaled luminance that compresses, each pixel's own if `None`.
#[inline(always)]
pub fn map_lanes<L: Lanes>(colour: Rgb<L>, around: Option<F<L>>, curve: &ToneCurve) -> Rgb<L> {
    let colour = operated(colour, around, curve);
    match curve.space {
        DisplaySpace::Srgb => srgb_each(colour),
        DisplaySpace::DisplayP3 => srgb_each(turned(colour, &DisplaySpace::TO_DISPLAY_P3)),
        DisplaySpace::Rec2020Pq => {
            let Rgb { r, g, b } = turned(colour, &DisplaySpace::TO_REC2020);
            Rgb::new(pq(r), pq(g), pq(b))
        }
    }
}

/// Linear light that the display is to show, before its primaries and its curve: 1 is white.
#[inline(always)]
pub(super) fn operated<L: Lanes>(colour: Rgb<L>, around: Option<F<L>>, curve: &ToneCurve) -> Rgb<L> {
    let colour = colour.max(0.0) * curve.scale;
    let Some(rise) = curve.rise else { return colour };
    let y = colour.luminance();
    let compressing = match around {
        Some(around) => around,
        None => y,
    };
    colour * ((y * rise + 1.0) / (compressing + 1.0))
}

/// In other primaries.
#[inline(always)]
fn turned<L: Lanes>(colour: Rgb<L>, matrix: &[[f32; 3]; 3]) -> Rgb<L> {
    let [r, g, b] = matrix;
    Rgb::new(sum(colour, r), sum(colour, g), sum(colour, b))
}

#[inline(always)]
fn sum<L: Lanes>(colour: Rgb<L>, weights: &[f32; 3]) -> F<L> {
    colour.r * weights[0] + colour.g * weights[1] + colour.b * weights[2]
}

#[inline(always)]
fn srgb_each<L: Lanes>(colour: Rgb<L>) -> Rgb<L> {
    Rgb::new(srgb(colour.r), srgb(colour.g), srgb(colour.b))
}

/// The sRGB curve (IEC 61966-2-1) of a value clipped to [0, 1].
#[inline(always)]
fn srgb<L: Lanes>(x: F<L>) -> F<L> {
    let x = x.saturate();
    x.lt(0.003_130_8).select(x * 12.92, x.max(1e-8).normal_pow(1.0 / 2.4).mul_add(1.055, -0.055))
}

/// The inverse of PQ's curve (SMPTE ST 2084, ITU-R BT.2100) of a value that is 1 at reference white.
#[inline(always)]
fn pq<L: Lanes>(x: F<L>) -> F<L> {
    let x = (x * (DisplaySpace::REFERENCE_WHITE / 10_000.0)).saturate();
    let power = x.max(1e-12).normal_pow(0.159_301_76);
    (power.mul_add(18.851_563, 0.835_937_5) / power.mul_add(18.6875, 1.0)).pow(78.843_75).saturate()
}
