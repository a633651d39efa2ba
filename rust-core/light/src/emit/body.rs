//! One finite light's far field in double precision: how much it shows of itself to a direction, and what its beam makes of that.

use crate::light_kind::LightKind;
use crate::row::{field, flag};
use crate::table::LightTable;
use crate::vector::{Vector, add, cross, dot, length, scale, unit_or};
use gonio_simd::{Lanes, One, Vec3};
use std::f64::consts::PI;

/// A light of the table, about its pole.
pub(super) struct Body<'a> {
    table: &'a LightTable,
    light: u32,
    pub(super) row: &'a [f32],
    pub(super) kind: LightKind,
    pub(super) flags: u32,
    /// Axes x and y across the pole, and the pole.
    pub(super) frame: [Vector; 3],
    /// Area of flat lights and facing disks, 1 for points, and what makes other bodies' size.
    pub(super) size: f64,
}

/// Three values of a row.
fn triple(row: &[f32], at: usize) -> Vector {
    [0, 1, 2].map(|k| f64::from(row[at + k]))
}

/// Emitting area of flat lights and of facing disks in m², 1 for points; of round bodies a measure of their size.
fn size(kind: LightKind, row: &[f32]) -> f64 {
    let value = |at: usize| f64::from(row[at]);
    let determinant = 1.0 / value(field::DENSITY);
    match kind {
        LightKind::Rectangle => 4.0 * value(field::HALF) * value(field::HALF + 1) * determinant,
        LightKind::Disk => PI * determinant.powf(2.0 / 3.0),
        LightKind::Triangle => determinant / 2.0,
        LightKind::FacingDisk => PI * value(field::HALF).powi(2),
        LightKind::Sphere | LightKind::Cylinder => determinant.powf(2.0 / 3.0),
        LightKind::Point | LightKind::Distant | LightKind::Dome => 1.0,
    }
}

impl<'a> Body<'a> {
    pub(super) fn new(table: &'a LightTable, light: u32, row: &'a [f32]) -> Self {
        let flags = row[field::FLAGS].to_bits();
        let kind = LightKind::ALL[((flags & flag::KIND) as usize).min(LightKind::ALL.len() - 1)];
        let mut body = Self { table, light, row, kind, flags, frame: [[0.0; 3]; 3], size: size(kind, row) };
        body.frame = body.axes();
        body
    }

    fn triple(&self, at: usize) -> Vector {
        triple(self.row, at)
    }

    /// Whether a flag is set.
    pub(super) fn is(&self, bit: u32) -> bool {
        self.flags & bit != 0
    }

    /// Whether the radiance differs by direction.
    pub(super) fn has_beam(&self) -> bool {
        self.is(flag::SHAPED | flag::OPENING) || self.has_goniogram()
    }

    pub(super) fn has_goniogram(&self) -> bool {
        self.row[field::GONIOGRAM].to_bits() != 0
    }

    /// Whether cone, focus or spot narrow the beam about the shaping axis.
    fn is_narrowed(&self) -> bool {
        self.is(flag::SPOT) || self.row[field::CUTOFF].is_finite() || self.row[field::FOCUS] > 0.0
    }

    /// The axis that what is sent has most to do with, and two across.
    fn axes(&self) -> [Vector; 3] {
        let axis = self.triple(field::AXIS);
        let beam = self.is(flag::OPENING) || self.has_goniogram() || self.is_narrowed();
        let pole = match self.kind {
            LightKind::Rectangle | LightKind::Disk | LightKind::Triangle if !beam || self.is(flag::SPREAD) => self.triple(field::NORMAL),
            LightKind::Cylinder if !beam => unit_or(self.triple(field::FRAME), axis),
            _ => axis,
        };
        if pole == axis {
            return [self.triple(field::LEVEL_X), self.triple(field::LEVEL_Y), axis];
        }
        let level = |v: Vector| unit_or(add(v, scale(pole, -dot(v, pole))), [0.0; 3]);
        let sides = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let x = sides.into_iter().min_by(|a, b| dot(*a, pole).abs().total_cmp(&dot(*b, pole).abs())).map_or([0.0; 3], level);
        [x, cross(pole, x), pole]
    }

    /// A world vector about the pole.
    fn local(&self, v: Vector) -> Vector {
        self.frame.map(|axis| dot(axis, v))
    }

    /// A direction about the pole in the world.
    pub(super) fn world(&self, v: Vector) -> Vector {
        [0, 1, 2].map(|k| (0..3).map(|axis| self.frame[axis][k] * v[axis]).sum())
    }

    /// Projected area towards unit `w` in m²; 1 for points.
    pub(super) fn shown(&self, w: Vector) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|k| dot(self.triple(field::INVERSE + 3 * k), w));
        let determinant = 1.0 / f64::from(self.row[field::DENSITY]);
        match self.kind {
            LightKind::Rectangle | LightKind::Disk | LightKind::Triangle => {
                let cosine = dot(self.triple(field::NORMAL), w);
                self.size * if self.is(flag::TWO_SIDED) { cosine.abs() } else { cosine.max(0.0) }
            }
            LightKind::Sphere => PI * determinant * length([x, y, z]),
            LightKind::Cylinder => 4.0 * determinant * y.hypot(z),
            LightKind::FacingDisk => self.size,
            LightKind::Point | LightKind::Distant | LightKind::Dome => 1.0,
        }
    }

    /// Components of what is sent towards unit `w`, per radiance and [`Self::unit`].
    pub(super) fn sent(&self, w: Vector) -> Vector {
        let shown = self.shown(w) / self.unit();
        if shown <= 0.0 || !self.has_beam() {
            return [shown; 3];
        }
        let l = One;
        let light = self.table.reader(l, l.u(self.light));
        let beam = self.table.beam(l, &light, Vec3::splat(l, w.map(|x| x as f32)));
        let mut sent = [0.0; 3];
        for (k, sent) in sent.iter_mut().enumerate() {
            let [r, g, b] = [0, 1, 2].map(|component| if component == k { 1.0 } else { 0.0 });
            *sent = shown * f64::from(beam.r.mul_add(r, beam.g.mul_add(g, beam.b * b)).to_array()[0]);
        }
        sent
    }

    /// What [`Self::sent`] is measured in: m², or 1 where the radiance is an intensity.
    pub(super) fn unit(&self) -> f64 {
        if self.is(flag::OPENING) { 1.0 } else { self.size }
    }

    /// Whether what is sent is the same all around the pole.
    pub(super) fn is_round(&self) -> bool {
        let along = |v: Vector| length(cross(v, self.frame[2])) <= 1e-4 * length(v);
        let same = |a: f64, b: f64| (a - b).abs() <= 1e-4 * a.abs().max(b.abs());
        let rows = [0, 1, 2].map(|k| self.triple(field::INVERSE + 3 * k));
        let [x, y, z] = rows.map(|row| dot(row, row));
        let straight = |a: Vector, b: Vector| dot(a, b).abs() <= 1e-4 * length(a) * length(b);
        let section = same(y, z) && straight(rows[1], rows[2]);
        let shape = match self.kind {
            LightKind::Rectangle | LightKind::Disk | LightKind::Triangle => along(self.triple(field::NORMAL)),
            LightKind::Sphere => self.is_ball(),
            LightKind::Cylinder => section && along(rows[0]) && straight(rows[0], rows[1]) && straight(rows[0], rows[2]) && x > 0.0,
            LightKind::FacingDisk | LightKind::Point | LightKind::Distant | LightKind::Dome => true,
        };
        let stretches = [field::SPOT_X, field::SPOT_Y].map(|at| length(self.triple(at)));
        let spot = !self.is(flag::SPOT) || same(stretches[0], stretches[1]);
        shape && spot && !self.has_goniogram() && !self.is(flag::OPENING) && (!self.is_narrowed() || along(self.triple(field::AXIS)))
    }

    /// Whether a sphere is one.
    pub(super) fn is_ball(&self) -> bool {
        let rows = [0, 1, 2].map(|k| self.triple(field::INVERSE + 3 * k));
        let size = dot(rows[0], rows[0]);
        (0..3).all(|i| (0..3).all(|j| (dot(rows[i], rows[j]) - if i == j { size } else { 0.0 }).abs() <= 1e-4 * size))
    }

    /// What tells lights apart that send differently about their poles, but for colour and size, to four digits.
    pub(super) fn key(&self) -> Vec<u32> {
        const TOLD: u32 = flag::KIND
            | flag::TWO_SIDED
            | flag::SHAPED
            | flag::SPOT
            | flag::SPREAD
            | flag::OPENING
            | flag::ROUND
            | flag::ALL_ROUND
            | flag::FLAT;
        let mut key = vec![self.flags & TOLD, self.row[field::GONIOGRAM].to_bits()];
        let mut put = |x: f64| key.push(if x.abs() < 1e-6 { 0 } else { ((x as f32).to_bits() + 0x200) & !0x3ff });
        let vectors = [field::AXIS, field::LEVEL_X, field::LEVEL_Y, field::NORMAL, field::SPOT_X, field::SPOT_Y];
        vectors.iter().flat_map(|at| self.local(self.triple(*at))).for_each(&mut put);
        let inverse = [0, 1, 2].map(|k| scale(self.local(self.triple(field::INVERSE + 3 * k)), self.size.sqrt()));
        if matches!(self.kind, LightKind::Sphere | LightKind::Cylinder) {
            inverse.iter().flatten().copied().for_each(&mut put);
        }
        if self.is(flag::OPENING) {
            let sides = [0, 3, 6, 9].map(|k| scale(self.local(self.triple(field::OPENING_SIDES + k)), 1.0 / self.size));
            sides.iter().flatten().copied().for_each(&mut put);
        }
        let numbers = [field::CUTOFF, field::SMOOTH_START, field::FOCUS, field::SPOT_COSINE, field::SPOT_STEEPNESS, field::SPREAD_TANGENT];
        numbers.iter().map(|at| f64::from(self.row[*at])).for_each(&mut put);
        self.triple(field::TINT).into_iter().for_each(&mut put);
        key
    }
}
