//! The area that a body shows to a direction: what a luminaire's intensity in that direction is spread over.

use super::light_kind::LightKind;
use super::row::{Reader, field, flag};
use super::vector::{Vector, add, cross, dot, narrow, scale, widen};
use gonio_simd::{F, Lanes, Vec3};
use std::f64::consts::PI;

/// What the sides make together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outline {
    /// Flat faces: |a·w| + |b·w| + |c·w| + t·w.
    Faces,
    /// A round side with two caps: |a·w| + √((b·w)² + (c·w)²).
    Cylinder,
    /// √((a·w)² + (b·w)² + (c·w)²).
    Ellipsoid,
}

/// The projected area in m² of a convex body, or of one-sided faces that do not hide one another, towards unit w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProjectedArea {
    /// Which formula holds.
    pub outline: Outline,
    /// The vectors a, b and c.
    pub sides: [[f32; 3]; 3],
    /// The vector t: what faces show to the one side more than to the other.
    pub tilt: [f32; 3],
}

impl ProjectedArea {
    /// Of one-sided faces: the axis that each is across, one of three, and its area times its outward normal. Faces across the same axis are parallel.
    pub fn of_faces(faces: &[(usize, [f64; 3])]) -> Self {
        let (mut sides, mut tilt) = ([[0.0; 3]; 3], [0.0; 3]);
        for (axis, face) in faces {
            let half = scale(*face, 0.5);
            let along = if dot(sides[*axis], half) < 0.0 { scale(half, -1.0) } else { half };
            sides[*axis] = add(sides[*axis], along);
            tilt = add(tilt, half);
        }
        Self { outline: Outline::Faces, sides: sides.map(narrow), tilt: narrow(tilt) }
    }

    /// Of a cylinder with caps: half its length along x, the half axes of its section y and z.
    pub fn of_cylinder([x, y, z]: [[f64; 3]; 3]) -> Self {
        let sides = [scale(cross(y, z), PI), scale(cross(z, x), 4.0), scale(cross(x, y), 4.0)];
        Self { outline: Outline::Cylinder, sides: sides.map(narrow), tilt: [0.0; 3] }
    }

    /// Of an ellipsoid with these half axes.
    pub fn of_ellipsoid([x, y, z]: [[f64; 3]; 3]) -> Self {
        let sides = [cross(y, z), cross(z, x), cross(x, y)].map(|side| narrow(scale(side, PI)));
        Self { outline: Outline::Ellipsoid, sides, tilt: [0.0; 3] }
    }

    /// Of an emitter of a kind by its axes, its front alone where it is flat; `None` for what has no area.
    pub(super) fn of_emitter(kind: LightKind, axes: [Vector; 3], normal: Vector, area: f64) -> Option<Self> {
        match kind {
            LightKind::Rectangle | LightKind::Disk | LightKind::Triangle => Some(Self::of_faces(&[(0, scale(normal, area))])),
            LightKind::Cylinder => {
                let whole = Self::of_cylinder(axes);
                Some(Self { sides: [[0.0; 3], whole.sides[1], whole.sides[2]], ..whole })
            }
            LightKind::Sphere => Some(Self::of_ellipsoid(axes)),
            LightKind::FacingDisk => {
                let radius = dot(axes[0], axes[0]).sqrt();
                Some(Self::of_ellipsoid([[radius, 0.0, 0.0], [0.0, radius, 0.0], [0.0, 0.0, radius]]))
            }
            LightKind::Distant | LightKind::Dome | LightKind::Point => None,
        }
    }

    /// Towards unit `w`, in m².
    pub fn towards(&self, w: [f64; 3]) -> f64 {
        let [a, b, c] = self.sides.map(|side| dot(widen(side), w).abs());
        match self.outline {
            Outline::Faces => (a + b + c + dot(widen(self.tilt), w)).max(0.0),
            Outline::Cylinder => a + b.hypot(c),
            Outline::Ellipsoid => a.hypot(b).hypot(c),
        }
    }

    pub(super) fn fill(&self, row: &mut [f32]) {
        for (k, side) in self.sides.iter().enumerate() {
            row[field::OPENING_SIDES + 3 * k..field::OPENING_SIDES + 3 * k + 3].copy_from_slice(side);
        }
        row[field::OPENING_TILT..field::OPENING_TILT + 3].copy_from_slice(&self.tilt);
    }
}

/// The area that the side at a place of the row shows to unit `direction`; a function, as closures that `map` calls may stay calls, without lanes.
#[inline(always)]
fn side<L: Lanes>(light: &Reader<'_, L>, place: usize, direction: Vec3<L>) -> F<L> {
    light.vector(field::OPENING_SIDES + place).dot(direction).abs()
}

/// One over the area that a light's opening shows to unit `direction`, 0 where it shows none; 1 for lights that are no openings.
#[inline(always)]
pub(super) fn per_area<L: Lanes>(l: L, light: &Reader<'_, L>, direction: Vec3<L>) -> F<L> {
    let opening = light.flag(flag::OPENING);
    if !opening.any() {
        return l.f(1.0);
    }
    let (a, b, c) = (side(light, 0, direction), side(light, 3, direction), side(light, 6, direction));
    let tilt = light.vector(field::OPENING_TILT).dot(direction);
    let round = b * b + c * c;
    let cylinder = a + round.sqrt();
    let ellipsoid = (a * a + round).sqrt();
    let curved = light.flag(flag::ALL_ROUND).select(ellipsoid, cylinder);
    let area = light.flag(flag::ROUND).select(curved, a + b + c + tilt);
    let shown = area.gt(f32::MIN_POSITIVE);
    opening.select(area.recip().keep_if(shown), l.f(1.0))
}
