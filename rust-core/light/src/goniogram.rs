//! Goniograms: measured factors on a light's emission, by direction.

use gonio_simd::{F, Lanes, M, Vec3};
use gonio_table::{Axis, Table};
use std::f32::consts::TAU;

/// How two angles make a direction (CIE 121); `z` is up, nadir −z, C0 +x.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AngularType {
    /// Polar axis −z: tan C = y / x, cos γ = −z.
    C,
    /// Polar axis y: tan V = x / −z, sin H = y.
    B,
    /// Polar axis x: tan H = y / −z, sin V = x.
    A,
}

impl AngularType {
    /// The unit direction of a horizontal and a vertical angle in radians.
    pub fn direction(self, horizontal: f64, vertical: f64) -> [f64; 3] {
        let ((sin_h, cos_h), (sin_v, cos_v)) = (horizontal.sin_cos(), vertical.sin_cos());
        match self {
            Self::C => [sin_v * cos_h, sin_v * sin_h, -cos_v],
            Self::B => [sin_v * cos_h, sin_h, -cos_v * cos_h],
            Self::A => [sin_v, cos_v * sin_h, -cos_v * cos_h],
        }
    }

    /// Solid angle per product of the two angles' steps.
    pub fn solid_angle(self, horizontal: f64, vertical: f64) -> f64 {
        match self {
            Self::C => vertical.sin(),
            Self::B => horizontal.cos(),
            Self::A => vertical.cos(),
        }
    }
}

/// Factors on a grid of two angles in radians, zero beyond its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Goniogram {
    angular_type: AngularType,
    table: Table<2>,
    peak: f32,
}

impl Goniogram {
    /// A goniogram of horizontal and vertical angles in degrees, the vertical ones varying fastest. `None` unless angles strictly increase and there
    /// is a finite factor, zero or more, for each pair.
    pub fn new(angular_type: AngularType, horizontal_deg: &[f32], vertical_deg: &[f32], factors: &[f32]) -> Option<Self> {
        let radians = |angles: &[f32]| Axis::new(angles.iter().map(|angle| angle.to_radians()).collect());
        if factors.iter().any(|factor| !factor.is_finite() || *factor < 0.0) {
            return None;
        }
        let table = Table::new([radians(horizontal_deg)?, radians(vertical_deg)?], factors.to_vec())?;
        Some(Self { angular_type, table, peak: factors.iter().copied().fold(0.0, f32::max) })
    }

    /// The largest factor.
    pub fn peak(&self) -> f32 {
        self.peak
    }

    /// How two angles make a direction.
    pub fn angular_type(&self) -> AngularType {
        self.angular_type
    }

    /// The tabulated horizontal and vertical angles in radians.
    pub fn angles(&self) -> [&[f32]; 2] {
        let [horizontal, vertical] = self.table.axes();
        [horizontal.knots(), vertical.knots()]
    }

    /// The factor in a direction of any length in the luminaire's frame.
    #[inline(always)]
    pub fn factor<L: Lanes>(&self, l: L, direction: Vec3<L>) -> F<L> {
        let Vec3 { x, y, z } = direction;
        let [horizontal, vertical] = match self.angular_type {
            AngularType::C => {
                let plane = y.atan2(x);
                [plane.lt(0.0).select(plane + TAU, plane), beside(x, y).atan2(-z)]
            }
            AngularType::B => [y.atan2(beside(x, z)), x.atan2(-z)],
            AngularType::A => [y.atan2(-z), x.atan2(beside(y, z))],
        };
        let [across, down] = self.table.axes();
        let inside = within(across, horizontal) & within(down, vertical);
        self.table.value(l, [horizontal, vertical]).keep_if(inside)
    }
}

/// Slack in radians at the ends of an axis.
const SLACK: f32 = 1e-6;

/// Whether an angle is between an axis' ends; directions come with rounding.
#[inline(always)]
fn within<L: Lanes>(axis: &Axis, angle: F<L>) -> M<L> {
    let [first, last] = axis.range();
    angle.ge(first - SLACK) & angle.le(last + SLACK)
}

/// Distance from the third axis.
#[inline(always)]
fn beside<L: Lanes>(x: F<L>, y: F<L>) -> F<L> {
    (x * x + y * y).sqrt()
}
