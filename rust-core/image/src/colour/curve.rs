//! Tone curves that files bring along.

use super::Transfer;

/// From a stored number to a linear one, each in 0..1; extended to negative numbers as an odd function.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// A function that has a name.
    Named(Transfer),
    /// A power.
    Power(f64),
    /// Values of 16 bits at equal distances over 0..1, straight between them (ICC.1:2022, 10.6); two at least.
    Table(Vec<u16>),
    /// `(a x + b)^g + e` from `d` on and `c x + f` below (ICC.1:2022, 10.18, function 4), in the order g, a, b, c, d, e, f.
    Parametric([f64; 7]),
}

/// ITU-R BT.709's camera curve, inverted: what video in Rec.709 means by its numbers.
const REC709_CAMERA: [f64; 7] = [1.0 / 0.45, 1.0 / 1.099, 0.099 / 1.099, 1.0 / 4.5, 0.081, 0.0, 0.0];
/// Functions that curves of files are compared with.
const NAMED: [Transfer; 6] =
    [Transfer::Srgb, Transfer::Linear, Transfer::Gamma22, Transfer::Gamma18, Transfer::Gamma24, Transfer::AdobeRgb];
/// Half a code of 8 bits: what files' tables and rounded exponents differ from the functions that they mean.
const NEAR: f64 = 0.5 / 255.0;

impl Curve {
    /// ITU-R BT.709's camera curve.
    pub const REC709_CAMERA: Self = Self::Parametric(REC709_CAMERA);

    /// Stored to linear.
    pub fn decode(&self, stored: f64) -> f64 {
        let x = stored.abs();
        let linear = match self {
            Self::Named(transfer) => transfer.decode(x),
            Self::Power(exponent) => x.powf(*exponent),
            Self::Table(values) => table(values, x),
            Self::Parametric([g, a, b, _, d, e, _]) if x >= *d => (a * x + b).max(0.0).powf(*g) + e,
            Self::Parametric([_, _, _, c, _, _, f]) => c * x + f,
        };
        linear.copysign(stored)
    }

    /// The curve, by the name of the nearest function that has one if that is within half a code of 8 bits.
    pub fn simplified(self) -> Self {
        let difference = |transfer: Transfer| {
            let stored = (0..=64).map(|step| f64::from(step) / 64.0);
            stored.map(|x| (transfer.encode(self.decode(x)) - x).abs()).fold(0.0, f64::max)
        };
        let nearest = NAMED.map(|transfer| (difference(transfer), transfer)).into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.filter(|(difference, _)| *difference < NEAR).map_or(self, |(_, transfer)| Self::Named(transfer))
    }
}

/// A table's value at `x`, held at its end.
fn table(values: &[u16], x: f64) -> f64 {
    let last = values.len().saturating_sub(1);
    let place = x.min(1.0) * last as f64;
    let below = (place as usize).min(last);
    let value = |at: usize| values.get(at.min(last)).map_or(0.0, |value| f64::from(*value) / 65535.0);
    value(below) + (value(below + 1) - value(below)) * (place - below as f64)
}
