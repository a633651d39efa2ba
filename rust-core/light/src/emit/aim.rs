//! Spheres that light paths are aimed at: the things that cast caustics.

use crate::vector::{Vector, add, length, narrow, scale, widen};
use gonio_simd::{F, Frame, Lanes, M, Vec3};
use std::f32::consts::TAU;

/// Share of the paths that are aimed where there is something to aim at; the others go as the light alone would send them.
pub const AIMED: f32 = 0.5;
/// Each density asks all of them.
const MOST: usize = 16;
/// The rim belongs to the cone for all its rounding: a share of it, and a chord.
const RIM: [f32; 2] = [1.001, 4e-7];

/// At most [`MOST`] spheres, as likely as one another.
#[derive(Clone, Debug, Default)]
pub(super) struct Targets {
    pub(super) spheres: Vec<([f32; 3], f32)>,
}

/// A sphere around spheres.
fn around(group: &[(Vector, f64)]) -> (Vector, f64) {
    let reach = |k: usize, sign: f64| group.iter().map(|(c, r)| sign * c[k] + r).fold(f64::NEG_INFINITY, f64::max);
    let centre = [0, 1, 2].map(|k| (reach(k, 1.0) - reach(k, -1.0)) / 2.0);
    let radius = group.iter().map(|(c, r)| length(add(*c, scale(centre, -1.0))) + r).fold(0.0, f64::max);
    if let [one] = group { *one } else { (centre, radius) }
}

/// Two halves, left and right of the middle along the widest axis.
fn halves(mut group: Vec<(Vector, f64)>) -> [Vec<(Vector, f64)>; 2] {
    let extent = |k: usize| {
        let ends = group.iter().map(|(c, _)| c[k]).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        ends[1] - ends[0]
    };
    let axis = (0..3).max_by(|a, b| extent(*a).total_cmp(&extent(*b))).unwrap_or(0);
    group.sort_by(|(a, _), (b, _)| a[axis].total_cmp(&b[axis]));
    let right = group.split_off(group.len() / 2);
    [group, right]
}

impl Targets {
    /// The given spheres, or fewer around them all.
    pub(super) fn new(spheres: &[([f32; 3], f32)]) -> Self {
        let usable = |(c, r): &&([f32; 3], f32)| c.iter().all(|x| x.is_finite()) && *r > 0.0 && r.is_finite();
        let all: Vec<(Vector, f64)> = spheres.iter().filter(usable).map(|(c, r)| (widen(*c), f64::from(*r))).collect();
        let mut groups = Vec::new();
        if all.len() <= MOST {
            groups.extend(all.into_iter().map(|one| vec![one]));
        } else {
            groups.push(all);
        }
        while groups.len() < MOST {
            let size = |group: &Vec<(Vector, f64)>| if group.len() > 1 { around(group).1 } else { 0.0 };
            let largest = (0..groups.len()).max_by(|a, b| size(&groups[*a]).total_cmp(&size(&groups[*b])));
            let Some(largest) = largest.filter(|at| groups[*at].len() > 1) else { break };
            let group = groups.swap_remove(largest);
            groups.extend(halves(group));
        }
        Self { spheres: groups.iter().map(|group| around(group)).map(|(c, r)| (narrow(c), r as f32)).collect() }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.spheres.is_empty()
    }

    /// Splits a number: whether the path is aimed, and the number that is left.
    #[inline(always)]
    pub(super) fn split<L: Lanes>(&self, l: L, u: F<L>) -> (M<L>, F<L>) {
        if self.is_empty() {
            return (l.m(false), u);
        }
        let aimed = u.lt(AIMED);
        let left = aimed.select(u * (1.0 / AIMED), (u - AIMED) * (1.0 / (1.0 - AIMED)));
        (aimed, left.max(0.0).min(1.0 - f32::EPSILON))
    }

    /// One of the spheres, and the number that is left; there must be one.
    #[inline(always)]
    pub(super) fn choose<L: Lanes>(&self, l: L, u: F<L>) -> (Vec3<L>, F<L>, F<L>) {
        let place = u * self.spheres.len() as f32;
        let number = place.floor();
        let (mut centre, mut radius) = (Vec3::splat(l, self.spheres[0].0), l.f(self.spheres[0].1));
        for (k, (c, r)) in self.spheres.iter().enumerate().skip(1) {
            let this = number.ge(k as f32);
            centre = this.select(Vec3::splat(l, *c), centre);
            radius = this.select(l.f(*r), radius);
        }
        (centre, radius, (place - number).max(0.0).min(1.0 - f32::EPSILON))
    }

    /// A direction from `p` into the cone around one of the spheres.
    #[inline(always)]
    pub(super) fn direction<L: Lanes>(&self, l: L, p: Vec3<L>, u: [F<L>; 2]) -> Vec3<L> {
        let (centre, radius, left) = self.choose(l, u[0]);
        direction_to(l, centre - p, radius, [left, u[1]])
    }

    /// Density per solid angle of [`Self::direction`].
    #[inline(always)]
    pub(super) fn density<L: Lanes>(&self, l: L, p: Vec3<L>, direction: Vec3<L>) -> F<L> {
        let mut sum = l.f(0.0);
        for (centre, radius) in &self.spheres {
            sum += density_to(l, Vec3::splat(l, *centre) - p, l.f(*radius), direction);
        }
        sum * (1.0 / self.spheres.len().max(1) as f32)
    }

    /// Density per solid angle of a direction from a place of a round body about `body`, over that of the place by itself, where each target has the
    /// half of the body that faces it for its own. One that holds the body's middle has all of it, and the place or the `opposite` one that faces
    /// the direction. `normal` may be of any length.
    #[inline(always)]
    pub(super) fn round_density<L: Lanes>(
        &self,
        l: L,
        body: Vec3<L>,
        [place, opposite]: [Vec3<L>; 2],
        normal: Vec3<L>,
        direction: Vec3<L>,
    ) -> F<L> {
        let mut sum = l.f(0.0);
        for (centre, radius) in &self.spheres {
            let (centre, radius) = (Vec3::splat(l, *centre), l.f(*radius));
            let holds = holds(centre - body, radius);
            let here = density_to(l, centre - place, radius, direction);
            let mut other = here;
            if holds.any() {
                other = holds.select(density_to(l, centre - opposite, radius, direction), here);
            }
            sum += (here + other).keep_if(holds | normal.dot(centre - body).ge(0.0));
        }
        sum * (1.0 / self.spheres.len().max(1) as f32)
    }

    /// Density per area, across `direction`, of drawing `y` on the disk of one of the spheres.
    #[inline(always)]
    pub(super) fn disk_density<L: Lanes>(&self, l: L, y: Vec3<L>, direction: Vec3<L>) -> F<L> {
        let mut sum = l.f(0.0);
        for (centre, radius) in &self.spheres {
            let off = y - Vec3::splat(l, *centre);
            let across = (off - direction * off.dot(direction)).length_squared();
            let area = radius * radius;
            sum += l.f(1.0 / (area * std::f32::consts::PI)).keep_if(across.le(area * RIM[0]));
        }
        sum * (1.0 / self.spheres.len().max(1) as f32)
    }
}

/// Whether a sphere at `v` holds a point.
#[inline(always)]
pub(super) fn holds<L: Lanes>(v: Vec3<L>, radius: F<L>) -> M<L> {
    v.length_squared().lt(radius * radius)
}

/// A direction, even over the cone around a sphere at `v`.
#[inline(always)]
pub(super) fn direction_to<L: Lanes>(l: L, v: Vec3<L>, radius: F<L>, u: [F<L>; 2]) -> Vec3<L> {
    let (ahead, fall) = cone(l, v, radius);
    let drawn = fall * u[0];
    let sine = (drawn * (2.0 - drawn)).safe_sqrt();
    let (sine_turn, cosine_turn) = u[1].sin_cos_turns();
    Frame::from_normal(ahead).to_world(Vec3::new(sine * cosine_turn, sine * sine_turn, 1.0 - drawn))
}

/// Density of [`direction_to`].
#[inline(always)]
pub(super) fn density_to<L: Lanes>(l: L, v: Vec3<L>, radius: F<L>, direction: Vec3<L>) -> F<L> {
    let (ahead, fall) = cone(l, v, radius);
    // The squared chord is 2 (1 − cos) without its cancellation.
    let chord = (direction - ahead).length_squared();
    let within = chord.le((fall * 2.0).mul_add(RIM[0], (fall * 2.0).sqrt() * RIM[1]));
    (fall * TAU).recip().keep_if(within)
}

/// The direction to a sphere at `v`, and 1 − cos of the half angle of the cone around it; 2, all directions, from within.
#[inline(always)]
fn cone<L: Lanes>(l: L, v: Vec3<L>, radius: F<L>) -> (Vec3<L>, F<L>) {
    let ahead = v.normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
    let sine_squared = radius * radius / v.length_squared().max(f32::MIN_POSITIVE);
    let inside = sine_squared.ge(1.0);
    let fall = sine_squared / ((1.0 - sine_squared).safe_sqrt() + 1.0);
    (ahead, inside.select(l.f(2.0), fall))
}
