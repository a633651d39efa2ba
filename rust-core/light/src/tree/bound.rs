//! Bounds of a light, or of several together, from which the light tree is built: where, how strong, which way.
//!
//! Conty Estevez and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018, section 4.

use crate::row::{field, flag};
use crate::vector::{Vector, add, dot, length, scale, unit_or, widen};
use std::f64::consts::{FRAC_PI_2, PI};

/// Directions within `spread` of an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cone {
    pub(super) axis: Vector,
    /// Half angle in radians, π for all directions.
    pub(super) spread: f64,
}

impl Cone {
    const ALL: Self = Self { axis: [0.0, 0.0, 1.0], spread: PI };

    /// The narrowest cone around two.
    fn union(self, other: Self) -> Self {
        let (wide, narrow) = if self.spread >= other.spread { (self, other) } else { (other, self) };
        let between = dot(wide.axis, narrow.axis).clamp(-1.0, 1.0).acos();
        if between + narrow.spread <= wide.spread {
            return wide;
        }
        let spread = (wide.spread + between + narrow.spread) / 2.0;
        let aside = add(narrow.axis, scale(wide.axis, -dot(wide.axis, narrow.axis)));
        if spread >= PI || length(aside) == 0.0 {
            return Self::ALL;
        }
        let turn = spread - wide.spread;
        let axis = add(scale(wide.axis, turn.cos()), scale(unit_or(aside, [0.0; 3]), turn.sin()));
        Self { axis: unit_or(axis, wide.axis), spread }
    }
}

/// A light or a set of lights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bound {
    pub(super) low: Vector,
    pub(super) high: Vector,
    /// The box's middle.
    pub(super) centre: Vector,
    /// Bound of intensity in cd, added up.
    pub(super) strength: f64,
    /// Where surfaces face, or beams go.
    pub(super) normals: Cone,
    /// Beyond the normals' cone by more than this angle nothing is sent.
    pub(super) edge: f64,
    /// Whether all emitters are flat: what they send falls with the cosine.
    pub(super) cosine: bool,
    /// Whether all emitters are flat and send both ways: the axis is a line.
    pub(super) two_sided: bool,
}

impl Bound {
    /// Of a light with a place, from its row.
    pub(super) fn of_row(row: &[f32]) -> Self {
        let vector = |at: usize| widen([row[at], row[at + 1], row[at + 2]]);
        let flags = row[field::FLAGS].to_bits();
        let flat = flags & flag::FLAT != 0;
        let (normal, axis) = (vector(field::NORMAL), vector(field::AXIS));
        let cone = f64::from(row[field::CONE_COSINE]).clamp(-1.0, 1.0).acos();
        let tangent = f64::from(row[field::SPREAD_TANGENT]);
        let gain = tangent * f64::from(row[field::SPREAD_GAIN]);
        let (mut normals, mut edge) = if flat { (Cone { axis: normal, spread: 0.0 }, FRAC_PI_2) } else { (Cone::ALL, PI) };
        if flat && gain > 1.0 {
            edge = tangent.atan();
        }
        // A beam tells more than the side that a surface faces, unless both say the same.
        let beam = cone < edge;
        if beam {
            (normals, edge) = (Cone { axis, spread: 0.0 }, cone);
        }
        let (centre, radius) = (vector(field::BOUND_CENTRE), f64::from(row[field::BOUND_RADIUS]));
        let half = if flat { normal.map(|x| radius * (1.0 - x * x).max(0.0).sqrt()) } else { [radius; 3] };
        Self {
            low: std::array::from_fn(|k| centre[k] - half[k]),
            high: std::array::from_fn(|k| centre[k] + half[k]),
            centre,
            strength: f64::from(row[field::STRENGTH]) * gain.max(1.0),
            normals,
            edge,
            cosine: flat && (!beam || dot(axis, normal) > 0.999),
            two_sided: flat && !beam && flags & flag::TWO_SIDED != 0,
        }
    }

    /// Half of the box's edges.
    pub(super) fn half(&self) -> Vector {
        scale(add(self.high, scale(self.low, -1.0)), 0.5)
    }

    /// Both together.
    pub(super) fn union(&self, other: &Self) -> Self {
        let low: Vector = std::array::from_fn(|k| self.low[k].min(other.low[k]));
        let high: Vector = std::array::from_fn(|k| self.high[k].max(other.high[k]));
        let mut theirs = other.normals;
        let two_sided = self.two_sided && other.two_sided;
        if two_sided && dot(self.normals.axis, theirs.axis) < 0.0 {
            theirs.axis = scale(theirs.axis, -1.0);
        }
        // Light of one side among light of both goes everywhere.
        let mixed = self.two_sided != other.two_sided;
        Self {
            low,
            high,
            centre: scale(add(low, high), 0.5),
            strength: self.strength + other.strength,
            normals: if mixed { Cone::ALL } else { self.normals.union(theirs) },
            edge: self.edge.max(other.edge),
            cosine: self.cosine && other.cosine && !mixed,
            two_sided,
        }
    }

    /// What a set costs: its strength, times the square of its extent, times the solid angle it may emit into.
    pub(super) fn cost(&self) -> f64 {
        let extent = add(self.high, scale(self.low, -1.0));
        let Cone { spread, .. } = self.normals;
        let reach = (spread + self.edge).min(PI);
        // 2π ∫ of the cosine beyond the normals' cone, section 4.4.
        let fading = 2.0 * reach * spread.sin() - (spread - 2.0 * reach).cos() - 2.0 * spread * spread.sin() + spread.cos();
        let solid = 2.0 * PI * (1.0 - spread.cos()) + FRAC_PI_2 * fading;
        self.strength * dot(extent, extent) * solid
    }
}
