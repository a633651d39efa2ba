//! Sampling by tables over half vectors, conditional on the view direction.
//!
//! For each of some view directions (slices) a density over the square of normals, in proportion to luminance × cosine. Between slices one
//! is chosen at random, and the density is the blend. Transmission is mirrored in the surface, so that straight passage is what mirror
//! reflection is. A share of all samples follows the cosine alone: the tables may miss what lies between their points.
//!
//! A normal whose mirrored view would be below the surface gives that direction mirrored back up. So every sample counts, and the density,
//! the sum of both ways to get to a direction, integrates to exactly one.

use core::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::super::direction::{
    Direction, angles_of, azimuth, combination, cosine_direction, dot, elevation, normalized, reflected, spherical, square_of, through,
    wrapped,
};
use super::super::hemispheres::Hemispheres;
use super::super::measured::Measured;
use super::super::warp::Blend;
use super::lobe::{Lobe, around_node};

/// How fine the tables are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Slices along the view's polar angle.
    pub theta: usize,
    /// Slices along the view's azimuth; one for an isotropic material.
    pub phi: usize,
    /// Nodes along the half vector's polar angle.
    pub columns: usize,
    /// Nodes along its azimuth.
    pub rows: usize,
    /// Evaluations along each side of the area around a node.
    pub points: usize,
    /// The share of samples that follow the cosine.
    pub cosine_share: f64,
}

impl Resolution {
    /// Of an isotropic material: samples vary less than by the warp of an RGL file.
    pub const ISOTROPIC: Self = Self { theta: 32, phi: 1, columns: 48, rows: 64, points: 2, cosine_share: 0.01 };

    /// Of an anisotropic material, whose warps in files are coarser too.
    pub const ANISOTROPIC: Self = Self { phi: 16, columns: 32, ..Self::ISOTROPIC };

    /// What suits a measurement.
    pub fn of(measured: &Measured) -> Self {
        if measured.is_isotropic() { Self::ISOTROPIC } else { Self::ANISOTROPIC }
    }
}

/// The least share of a lobe that is there: its density never vanishes where it scatters.
const LEAST_SHARE: f32 = 0.02;

/// Tables over half vectors for both sides of a material.
#[derive(Clone, Debug, PartialEq)]
pub struct HalfVectorTable {
    /// Slices along the view's polar angle (equal steps from 0 to just above the surface) and azimuth (equal steps of a full turn); the
    /// polar angle is faster.
    pub slices: [usize; 2],
    /// The share of samples that follow the cosine.
    pub cosine_share: f64,
    /// For a view at the front and at the back, reflection and transmission, where there are.
    pub lobes: [[Option<Lobe>; 2]; 2],
}

/// Slices around a view direction.
struct Slices {
    index: [usize; 4],
    weight: [f64; 4],
}

impl HalfVectorTable {
    /// The tables of a measurement.
    pub fn new(measured: &Measured, resolution: &Resolution) -> Self {
        let slices = [resolution.theta.max(2), resolution.phi.max(1)];
        let cosine_share = resolution.cosine_share.clamp(0.0, 1.0);
        let mut table = Self { slices, cosine_share, lobes: [[None, None], [None, None]] };
        let weights = measured.channels().luminance_weights();
        for side in 0..2 {
            let lobes = pairs(side).map(|pair| measured.has(pair).then(|| table.lobe(measured, &weights, pair, resolution)));
            table.lobes[side] = lobes;
            share_out(&mut table.lobes[side]);
        }
        table
    }

    /// One lobe's densities for all slices.
    fn lobe(&self, measured: &Measured, luminance: &[f64], pair: Hemispheres, resolution: &Resolution) -> Lobe {
        let nodes = [resolution.columns.max(2), resolution.rows.max(2)];
        let points = resolution.points.max(1);
        let (slices, slice_len) = (self.slices[0] * self.slices[1], nodes[0] * nodes[1]);
        let mut weights = vec![0.0; slices * slice_len];
        let left = Mutex::new(weights.chunks_exact_mut(slice_len).enumerate());
        let next = || left.lock().unwrap_or_else(PoisonError::into_inner).next();
        let work = || {
            while let Some((slice, weights)) = next() {
                let wo = self.view(slice);
                for (node, weight) in weights.iter_mut().enumerate() {
                    let place = [node % nodes[0], node / nodes[0]];
                    let scattered = around_node(place, nodes, points)
                        .map(|(angles, area)| area * self.scattered(measured, luminance, pair, angles, wo));
                    *weight = (scattered.sum::<f64>() / (points * points) as f64) as f32;
                }
            }
        };
        thread::scope(|scope| {
            // The system may have no more threads to give.
            let others = thread::available_parallelism().map_or(1, usize::from).min(slices);
            (1..others).for_each(|_| drop(thread::Builder::new().spawn_scoped(scope, work)));
            work();
        });
        Lobe::new(nodes[0], nodes[1], weights)
    }

    /// Luminance × cosine of the direction that a normal mirrors the view to, for each solid angle of normals.
    fn scattered(&self, measured: &Measured, luminance: &[f64], pair: Hemispheres, angles: (f64, f64), wo: Direction) -> f64 {
        let half = self.normal(angles, wo);
        let wi = reflected(wo, half);
        if wi[2] <= 0.0 {
            return 0.0;
        }
        let [wi_side, wo_side] = to_sides(pair, wi, wo);
        measured.luminance(luminance, wi_side, wo_side).max(0.0) * 4.0 * dot(wo, half)
    }

    /// Whether only the difference of azimuths counts.
    fn is_isotropic(&self) -> bool {
        self.slices[1] == 1
    }

    /// The view direction of a slice, at the front.
    fn view(&self, slice: usize) -> Direction {
        let theta = FRAC_PI_2 * (slice % self.slices[0]) as f64 / (self.slices[0] - 1) as f64;
        let phi = TAU * (slice / self.slices[0]) as f64 / self.slices[1] as f64;
        spherical(theta.min(FRAC_PI_2 * 0.999), phi)
    }

    /// The slices around a view direction at the front.
    fn around(&self, wo: Direction) -> Slices {
        let x = (elevation(wo) / FRAC_PI_2).min(1.0) * (self.slices[0] - 1) as f64;
        let low = (x as usize).min(self.slices[0] - 2);
        let t = x - low as f64;
        let y = wrapped(azimuth(wo) / TAU, 0.0, 1.0) * self.slices[1] as f64;
        let near = (y as usize).min(self.slices[1] - 1);
        let s = if self.is_isotropic() { 0.0 } else { y - near as f64 };
        let [near, far] = [near, (near + 1) % self.slices[1]].map(|row| row * self.slices[0] + low);
        let weight = [(1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t];
        Slices { index: [near, near + 1, far, far + 1], weight }
    }

    /// The normal of angles in the square: azimuths are relative to the view's for isotropic materials.
    fn normal(&self, (theta, phi): (f64, f64), wo: Direction) -> Direction {
        spherical(theta, phi + if self.is_isotropic() { azimuth(wo) } else { 0.0 })
    }

    /// A normal's place in the square.
    fn square(&self, normal: Direction, wo: Direction) -> [f64; 2] {
        square_of(elevation(normal), azimuth(normal) - if self.is_isotropic() { azimuth(wo) } else { 0.0 })
    }

    /// A direction, from three uniform numbers.
    pub(crate) fn sample(&self, wo: Direction, u: [f64; 3]) -> Option<(Direction, f64)> {
        let side = usize::from(wo[2] < 0.0);
        let up = if wo[2] < 0.0 { through(wo) } else { wo };
        let slices = self.around(up);
        let (i, rest) = choose(&slices.weight, u[0]);
        let slice = slices.index[i];
        let shares = [0, 1].map(|i| self.lobes[side][i].as_ref().map_or(0.0, |lobe| f64::from(lobe.share[slice])));
        let (kind, rest) = choose(&shares, rest);
        let lobe = self.lobes[side][kind].as_ref()?;
        let direction = if rest < self.cosine_share {
            cosine_direction([u[1], u[2]])
        } else {
            let normal = self.normal(angles_of(lobe.sample(slice, [u[1], u[2]])), up);
            let wi = reflected(up, normal);
            if wi[2] < 0.0 { through(wi) } else { wi }
        };
        let [wi, _] = to_sides(pairs(side)[kind], direction, up);
        let pdf = self.pdf(wo, wi);
        (pdf > 0.0 && pdf.is_finite()).then_some((wi, pdf))
    }

    /// The density of [`HalfVectorTable::sample`], per solid angle.
    pub(crate) fn pdf(&self, wo: Direction, wi: Direction) -> f64 {
        let Some(pair) = Hemispheres::of(wi, wo) else { return 0.0 };
        let Some(lobe) = &self.lobes[usize::from(wo[2] < 0.0)][usize::from(!pair.is_reflection())] else { return 0.0 };
        let (wi, wo) = pair.to_front(wi, wo);
        let slices = self.around(wo);
        let weighted = |i: usize| (slices.index[i], slices.weight[i] * f64::from(lobe.share[slices.index[i]]));
        let weighted = [0, 1, 2, 3].map(weighted);
        let share: f64 = weighted.iter().map(|(_, weight)| weight).sum();
        let blend = Blend::new(&weighted);
        let ways = [wi, through(wi)].map(|wi| self.way(wi, wo));
        let by_half: f64 = ways.iter().flatten().map(|&(square, jacobian)| lobe.density(&blend, square) / jacobian).sum();
        self.cosine_share * share * wi[2] / PI + (1.0 - self.cosine_share) * by_half
    }

    /// The normal that mirrors `wo` to `wi`, in the square, and the solid angle of `wi` for one of the normal.
    fn way(&self, wi: Direction, wo: Direction) -> Option<([f64; 2], f64)> {
        let half = normalized(combination(1.0, wi, 1.0, wo))?;
        // A half vector that points down has its opposite in the square: it mirrors alike.
        let normal = if half[2] < 0.0 { half.map(|x| -x) } else { half };
        let jacobian = 4.0 * dot(wo, normal).abs();
        (jacobian > 0.0).then(|| (self.square(normal, wo), jacobian))
    }
}

/// Reflection and transmission to a view at the front (0) or the back (1).
fn pairs(side: usize) -> [Hemispheres; 2] {
    match side {
        0 => [Hemispheres::ReflectionFront, Hemispheres::TransmissionBack],
        _ => [Hemispheres::ReflectionBack, Hemispheres::TransmissionFront],
    }
}

/// Directions at the front (wi, wo) moved to the sides of a pair.
fn to_sides(pair: Hemispheres, wi: Direction, wo: Direction) -> [Direction; 2] {
    let to_front = pair.is_from_front() == pair.is_reflection();
    [if pair.is_from_front() { wi } else { through(wi) }, if to_front { wo } else { through(wo) }]
}

/// Turns sums into shares of one.
fn share_out(lobes: &mut [Option<Lobe>; 2]) {
    let [first, second] = lobes;
    match (first, second) {
        (Some(a), Some(b)) => {
            for (a, b) in a.share.iter_mut().zip(&mut b.share) {
                let share = if *a + *b > 0.0 { *a / (*a + *b) } else { 0.5 };
                *a = share.clamp(LEAST_SHARE, 1.0 - LEAST_SHARE);
                *b = 1.0 - *a;
            }
        }
        (Some(lobe), None) | (None, Some(lobe)) => lobe.share.fill(1.0),
        (None, None) => {}
    }
}

/// The element that `u` falls on in proportion to weights that sum to one, and `u` stretched over it.
fn choose(weights: &[f64], u: f64) -> (usize, f64) {
    let mut rest = u;
    let mut last = (0, 0.0);
    for (i, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
        if rest < weight {
            return (i, rest / weight);
        }
        last = (i, 1.0 - f64::EPSILON);
        rest -= weight;
    }
    last
}
