//! Disks and ellipses, in the frame where they are unit disks: by area from afar; from near by rays around the foot of the perpendicular, each ray's
//! stretch by its solid angle, which bounds what a sample can weigh. A beam with a spread cuts the stretches to the part it can come from.

use super::emitter::{Aim, Emitter};
use super::row::{Reader, field};
use gonio_simd::{F, Lanes, M, Vec3};
use std::f32::consts::{PI, TAU};

/// Heights and distances of the foot from the centre, in radii, below which a point is near.
const NEAR: [f32; 2] = [0.6, 2.5];
/// Reach over height below which stretches are drawn by area: there the solid angle's digits run out and the two differ little.
const THIN: f32 = 0.3;

/// The unit disk as seen from a point at height `h` over a foot at distance `f` from the centre.
struct Seen<L: Lanes> {
    h: F<L>,
    f: F<L>,
    /// Direction in the plane from the foot to the centre.
    centre: [F<L>; 2],
    /// Whether the foot lies on the disk.
    inside: M<L>,
    near: M<L>,
    /// How far from the foot the beam still reaches the point.
    reach: F<L>,
    /// Where that is so little that points of a stretch are drawn by area.
    thin: M<L>,
}

/// The stretch of a ray from the foot that lies on the disk.
struct Stretch<L: Lanes> {
    /// Distances of its ends from the foot, and from the point.
    ends: [F<L>; 2],
    slants: [F<L>; 2],
    /// Difference of the ends' squares.
    squares: F<L>,
    /// Density of the ray around the foot, per radian.
    around: F<L>,
    pdf: F<L>,
}

impl<L: Lanes> Seen<L> {
    #[inline(always)]
    fn new(l: L, from: Vec3<L>, reach: F<L>) -> Self {
        let squared = from.x * from.x + from.y * from.y;
        let h = from.z.abs();
        let off = squared.gt(0.0);
        let inverse = off.select(squared, l.f(1.0)).inverse_root();
        let f = squared * inverse;
        let centre = [off.select(-from.x * inverse, l.f(1.0)), -from.y * inverse];
        let thin = reach.lt(THIN);
        let reach = h * reach;
        let cut = reach.lt(f + 1.0);
        let near = (h.lt(NEAR[0]) & f.lt(NEAR[1])) | cut;
        Self { h, f, centre, inside: f.lt(1.0), near, reach, thin }
    }
    /// The stretch of the ray at an angle from the direction to the centre, and the density of directions in it.
    #[inline(always)]
    fn stretch(&self, sine: F<L>, cosine: F<L>) -> Stretch<L> {
        let across = self.f * sine;
        let half_chord = (1.0 - across * across).safe_sqrt();
        let middle = self.f * cosine;
        let ends = [(middle - half_chord).max(0.0), middle + half_chord];
        let ends = [ends[0].keep_if(!self.inside), ends[1]];
        let cut = ends[1].gt(self.reach);
        let ends = [ends[0].min(self.reach), ends[1].min(self.reach)];
        let height = self.h * self.h;
        let slants = [(ends[0] * ends[0] + height).sqrt(), (ends[1] * ends[1] + height).sqrt()];
        let whole = self.inside.select(ends[1] * ends[1], middle * half_chord * 4.0);
        let squares = cut.select((ends[1] - ends[0]) * (ends[1] + ends[0]), whole);
        // Difference of the cosines at the ends, without cancellation.
        let fall = self.h * squares / (slants[0] * slants[1] * (slants[0] + slants[1]));
        let around = self.inside.select(middle.lanes().f(1.0 / TAU), middle * 0.5);
        Stretch { ends, slants, squares, around, pdf: around / fall }
    }
    /// Density per solid angle of the frame towards the vector `v` from the point to the disk.
    #[inline(always)]
    fn density(&self, v: Vec3<L>) -> F<L> {
        let squared = v.length_squared();
        let by_area = squared * squared.sqrt() / (self.h * PI);
        if !self.near.any() {
            return by_area;
        }
        let level = (v.x * v.x + v.y * v.y).max(f32::MIN_POSITIVE);
        let inverse = level.inverse_root();
        let length = level * inverse;
        let [x, y] = self.centre;
        let (cosine, sine) = ((v.x * x + v.y * y) * inverse, (v.y * x - v.x * y) * inverse);
        let stretch = self.stretch(sine, cosine);
        let by_stretch_area = stretch.around * 2.0 * squared * squared.sqrt() / (stretch.squares * self.h);
        let by_stretch = self.thin.select(by_stretch_area, stretch.pdf).keep_if(length.le(self.reach));
        self.near.select(by_stretch, by_area)
    }
    /// A point of the disk relative to the foot.
    #[inline(always)]
    fn near_point(&self, u: [F<L>; 2]) -> [F<L>; 2] {
        let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
        let sine_wedge = (u[1] * 2.0 - 1.0) / self.f.max(1.0);
        let sine = self.inside.select(sine_turn, sine_wedge);
        let cosine = self.inside.select(cosine_turn, (1.0 - sine_wedge * sine_wedge).safe_sqrt());
        let stretch = self.stretch(sine, cosine);
        let slant = stretch.slants[0].recip().lerp(stretch.slants[1].recip(), u[0]).recip();
        let by_solid_angle = ((slant - self.h) * (slant + self.h)).safe_sqrt();
        let by_area = stretch.squares.mul_add(u[0], stretch.ends[0] * stretch.ends[0]).safe_sqrt();
        let length = self.thin.select(by_area, by_solid_angle).clamp(stretch.ends[0], stretch.ends[1]);
        let [x, y] = self.centre;
        [length * (x * cosine - y * sine), length * (y * cosine + x * sine)]
    }
}

/// Disks and ellipses.
pub(crate) struct Disk;

impl Emitter for Disk {
    #[inline(always)]
    fn sample<L: Lanes>(l: L, light: &Reader<'_, L>, p: Vec3<L>, u: [F<L>; 2]) -> Aim<L> {
        let from = light.in_frame(p - light.vector(field::ORIGIN));
        let seen = Seen::new(l, from, light.value(field::REACH));
        let radius = u[0].sqrt();
        let (sine, cosine) = u[1].sin_cos_turns();
        let mut local = Vec3::new(radius * cosine - from.x, radius * sine - from.y, -from.z);
        if seen.near.any() {
            let [x, y] = seen.near_point(u);
            local = seen.near.select(Vec3::new(x, y, -from.z), local);
        }
        let aim = Aim::towards(local.transform(light.frame()));
        Aim { pdf: seen.density(local) * light.solid_angle_ratio(aim.wi), ..aim }
    }
    #[inline(always)]
    fn density<L: Lanes>(l: L, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>, hit: Vec3<L>) -> (F<L>, [F<L>; 2]) {
        let origin = light.vector(field::ORIGIN);
        let from = light.in_frame(from - origin);
        let on = light.in_frame(hit - origin);
        // The hit's height over the disk is rounding; the point's own is known better.
        let local = Vec3::new(on.x - from.x, on.y - from.y, -from.z);
        (Seen::new(l, from, light.value(field::REACH)).density(local) * light.solid_angle_ratio(wi), [l.f(0.0); 2])
    }
}
