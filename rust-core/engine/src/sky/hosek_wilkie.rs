//! The sky of Hošek and Wilkie ("An Analytic Model for Full Spectral Sky-Dome Radiance", ACM TOG 31, 2012): clear to hazy, coloured, absolute.

use super::{colour::to_rec709, within};
use crate::Result;
use std::f64::consts::FRAC_PI_2;

/// The authors' coefficients for linear Rec.709 in little-endian floats: parameters of R, G and B (2 albedos × 10 turbidities × 6 knots × 9), then
/// mean radiances of R, G and B (2 × 10 × 6). `LICENSE-HOSEK-WILKIE` is theirs.
static REC709: &[u8] = include_bytes!("hosek_wilkie.f32");
/// The same for tristimulus values, a fit of its own.
static TRISTIMULUS: &[u8] = include_bytes!("hosek_wilkie_xyz.f32");
/// Parameters of a colour in the data.
const PARAMETERS: usize = 2 * 10 * 6 * 9;
/// Radiances of a colour in the data.
const RADIANCES: usize = 2 * 10 * 6;
/// Lumens in a watt of the model's luminance.
const LUMENS_PER_WATT: f64 = 683.0;

/// One colour's formula: what a cosine, an angle from the sun and a height are weighed with, and the mean radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HosekWilkieChannel {
    /// As in the paper's formula 8, the last two exchanged.
    pub parameters: [f64; 9],
    /// In W/(m² sr) weighed by the eye.
    pub radiance: f64,
}

/// The model for one sun, turbidity and albedo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HosekWilkie {
    channels: [HosekWilkieChannel; 3],
    is_tristimulus: bool,
}

impl HosekWilkie {
    /// The sky under a sun at an elevation in degrees (0 to 90), of a turbidity (1 to 10) over ground of an albedo (0 to 1).
    ///
    /// # Errors
    /// What is out of its range.
    pub fn new(elevation_deg: f64, turbidity: f64, albedo: f64) -> Result<Self> {
        Self::with(false, elevation_deg, turbidity, albedo)
    }

    /// The same by the authors' fit to tristimulus values, which other hosts have.
    ///
    /// # Errors
    /// What is out of its range.
    pub fn tristimulus(elevation_deg: f64, turbidity: f64, albedo: f64) -> Result<Self> {
        Self::with(true, elevation_deg, turbidity, albedo)
    }

    fn with(is_tristimulus: bool, elevation_deg: f64, turbidity: f64, albedo: f64) -> Result<Self> {
        let data = if is_tristimulus { TRISTIMULUS } else { REC709 };
        Ok(Self { channels: channels(data, elevation_deg, turbidity, albedo)?, is_tristimulus })
    }

    /// The formulas of the three colours.
    pub fn channels(&self) -> [HosekWilkieChannel; 3] {
        self.channels
    }

    /// Radiance, linear Rec.709 in cd/m², towards a direction whose height above the horizon has a sine of `up` (0 to 1) and that is `angle`
    /// radians from the sun.
    pub fn radiance(&self, up: f64, angle: f64) -> [f64; 3] {
        let values = self.channels.map(|channel| LUMENS_PER_WATT * channel.radiance * shape(&channel.parameters, up, angle));
        let rgb = if self.is_tristimulus { to_rec709(values) } else { values };
        rgb.map(|value| value.max(0.0))
    }
}

/// The formulas of data that have so many colours, for a sun, a turbidity and an albedo.
pub(super) fn channels<const N: usize>(data: &[u8], elevation_deg: f64, turbidity: f64, albedo: f64) -> Result<[HosekWilkieChannel; N]> {
    let elevation = within("sun elevation", "°", elevation_deg, 0.0..=90.0)?.to_radians();
    within("turbidity", "", turbidity, 1.0..=10.0)?;
    within("ground", "", albedo, 0.0..=1.0)?;
    let knots = bernstein((elevation / FRAC_PI_2).cbrt());
    let corners = corners(turbidity, albedo);
    let channel = |colour: usize| {
        let mut channel = HosekWilkieChannel::default();
        for (weight, cell) in corners {
            for (knot, share) in knots.iter().enumerate() {
                let weight = weight * share;
                for (index, parameter) in channel.parameters.iter_mut().enumerate() {
                    *parameter += weight * value(data, colour * PARAMETERS + (cell * 6 + knot) * 9 + index);
                }
                channel.radiance += weight * value(data, N * PARAMETERS + colour * RADIANCES + cell * 6 + knot);
            }
        }
        channel
    };
    Ok(std::array::from_fn(channel))
}

/// The paper's formula 8.
pub(super) fn shape(&[a, b, c, d, e, f, g, i, h]: &[f64; 9], up: f64, angle: f64) -> f64 {
    let cosine = angle.cos();
    let mie = (1.0 + cosine * cosine) / (1.0 + h * h - 2.0 * h * cosine).powf(1.5);
    let graded = 1.0 + a * (b / (up + 0.01)).exp();
    graded * (c + d * (e * angle).exp() + f * cosine * cosine + g * mie + i * up.max(0.0).sqrt())
}

/// A number of the data.
fn value(data: &[u8], index: usize) -> f64 {
    let mut bytes = [0; 4];
    if let Some(found) = data.get(4 * index..4 * index + 4) {
        bytes.copy_from_slice(found);
    }
    f64::from(f32::from_le_bytes(bytes))
}

/// Weights of the six knots of a quintic Bézier curve.
fn bernstein(t: f64) -> [f64; 6] {
    let s = 1.0 - t;
    [s.powi(5), 5.0 * s.powi(4) * t, 10.0 * s.powi(3) * t * t, 10.0 * s * s * t.powi(3), 5.0 * s * t.powi(4), t.powi(5)]
}

/// The four cells of albedo and turbidity about a point, with their weights.
fn corners(turbidity: f64, albedo: f64) -> [(f64, usize); 4] {
    let lower = (turbidity.floor() as usize).clamp(1, 10);
    let (share, upper) = (turbidity - lower as f64, (lower + 1).min(10));
    [
        ((1.0 - albedo) * (1.0 - share), lower - 1),
        ((1.0 - albedo) * share, upper - 1),
        (albedo * (1.0 - share), 10 + lower - 1),
        (albedo * share, 10 + upper - 1),
    ]
}
