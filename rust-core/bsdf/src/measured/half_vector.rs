//! Sampling by tables over half vectors, conditional on the view: the reference's [`HalfVectorTable`] on lanes.
//!
//! Directions are those of the front; transmission is mirrored in the surface.

use super::angles::{azimuth, elevation, normal_of, sine, solid_angle_per_square, square_of, through, turned, unturned};
use super::warp::{Blend, MOST_SLICES, Warp};
use crate::diffuse::DiffuseLobe;
use core::f32::consts::{FRAC_1_PI, FRAC_2_PI, TAU};
use gonio_formats::bsdf::{HalfVectorTable, Lobe};
use gonio_simd::{F, Lanes, M, Vec3};

/// The tables for both sides of a material.
#[derive(Clone, Debug)]
pub(super) struct HalfVectors {
    /// Slices along the view's polar angle, which is faster, and azimuth.
    slices: [u32; 2],
    cosine_share: f32,
    /// For a view at the front and at the back, reflection and transmission, where there are.
    lobes: [[Option<HalfVectorLobe>; 2]; 2],
}

#[derive(Clone, Debug)]
struct HalfVectorLobe {
    /// For each slice, the lobe's share among those of its side.
    share: Vec<f32>,
    warp: Warp,
}

impl HalfVectorLobe {
    fn new(found: &Lobe) -> Option<Self> {
        Some(Self { share: found.share.clone(), warp: Warp::new(&found.warp)? })
    }

    /// The blended density of a normal for each solid angle of the direction that it mirrors the view to.
    #[inline(always)]
    fn density<L: Lanes>(&self, l: L, normal: Vec3<L>, cosine: F<L>, blend: &Blend<L>) -> F<L> {
        let square = square_of(normal);
        let area = solid_angle_per_square(square[0], sine(normal)) * cosine * 4.0;
        (self.warp.density(l, square, blend) / area.max(f32::MIN_POSITIVE)).keep_if(cosine.gt(0.0))
    }
}

impl HalfVectors {
    /// The reference's tables. `None` if they have 2³¹ values or more.
    pub(super) fn new(found: &HalfVectorTable) -> Option<Self> {
        let mut lobes = [[None, None], [None, None]];
        for (side, found) in lobes.iter_mut().zip(&found.lobes) {
            for (lobe, found) in side.iter_mut().zip(found) {
                if let Some(found) = found {
                    *lobe = Some(HalfVectorLobe::new(found)?);
                }
            }
        }
        Some(Self { slices: found.slices.map(|n| n as u32), cosine_share: found.cosine_share as f32, lobes })
    }

    /// The slices around a view direction.
    #[inline(always)]
    fn around<L: Lanes>(&self, wo: Vec3<L>) -> Blend<L> {
        let [columns, rows] = self.slices;
        let x = (elevation(wo) * FRAC_2_PI).min(1.0) * (columns - 1) as f32;
        let low = x.to_i32().min(columns - 2);
        let t = x - low.i32_to_float();
        if rows == 1 {
            return Blend { slice: [low, low + 1, low, low], weight: [1.0 - t, t, t * 0.0, t * 0.0], count: 2 };
        }
        let turn = wo.y.atan2(wo.x) * TAU.recip();
        let y = (turn - turn.floor()) * rows as f32;
        let near = y.to_i32().min(rows - 1);
        let s = y - near.i32_to_float();
        let far = near.eq(rows - 1).select(near.lanes().u(0), near + 1);
        let (near, far) = (near * columns + low, far * columns + low);
        Blend {
            slice: [near, near + 1, far, far + 1],
            weight: [(1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t],
            count: MOST_SLICES,
        }
    }

    /// A normal in the frame that the tables are in: azimuths are relative to the view's for isotropic materials.
    #[inline(always)]
    fn in_table<L: Lanes>(&self, normal: Vec3<L>, wo: Vec3<L>) -> Vec3<L> {
        if self.slices[1] == 1 { unturned(normal, azimuth(wo)) } else { normal }
    }

    /// A direction at the front for a view at the front, whether it is meant for the other side, and whether there is any.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, side: usize, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, [M<L>; 2]) {
        let around = self.around(wo);
        let (mut slice, mut rest, mut left, mut found) = (around.slice[0], u[0], u[0], l.m(false));
        for (number, weight) in around.slice.iter().zip(&around.weight).take(around.count) {
            let here = left.lt(*weight).and_not(found);
            slice = here.select(*number, slice);
            rest = here.select(left / weight.max(1e-20), rest);
            found |= here;
            left -= *weight;
        }
        let [reflecting, transmitting] = &self.lobes[side];
        let mut transmitted = l.m(reflecting.is_none());
        if let (Some(lobe), Some(_)) = (reflecting, transmitting) {
            let share = l.gather(&lobe.share, slice);
            transmitted = rest.ge(share);
            rest = transmitted.select((rest - share) / (1.0 - share).max(1e-6), rest / share.max(1e-6));
        }
        let mut wi = DiffuseLobe::sample([u[1], u[2]]);
        let by_half = rest.ge(self.cosine_share);
        for (lobe, chosen) in [(reflecting, l.m(true).and_not(transmitted)), (transmitting, transmitted)] {
            let Some(lobe) = lobe else { continue };
            if (chosen & by_half).any() {
                let mut normal = normal_of(lobe.warp.sample(l, [u[1], u[2]], &Blend::one(slice)));
                if self.slices[1] == 1 {
                    normal = turned(normal, azimuth(wo));
                }
                let mirrored = wo.reflect(normal);
                wi = (chosen & by_half).select(Vec3::new(mirrored.x, mirrored.y, mirrored.z.abs()), wi);
            }
        }
        (wi, [transmitted, l.m(reflecting.is_some() || transmitting.is_some())])
    }

    /// The density of [`Self::sample`] for a direction of that side.
    #[inline(always)]
    pub(super) fn pdf<L: Lanes>(&self, l: L, side: usize, transmitted: bool, wi: Vec3<L>, wo: Vec3<L>) -> F<L> {
        let Some(lobe) = &self.lobes[side][usize::from(transmitted)] else { return l.f(0.0) };
        let mut blend = self.around(wo);
        let mut share = l.f(0.0);
        for (slice, weight) in blend.slice.iter().zip(&mut blend.weight).take(blend.count) {
            *weight *= l.gather(&lobe.share, *slice);
            share += *weight;
        }
        let mut by_half = l.f(0.0);
        for wi in [wi, through(wi)] {
            let half = (wi + wo).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
            // A half vector that points down has its opposite in the square: it mirrors alike.
            let normal = half.z.lt(0.0).select(-half, half);
            by_half += lobe.density(l, self.in_table(normal, wo), wo.dot(normal).abs(), &blend);
        }
        (share * wi.z * (FRAC_1_PI * self.cosine_share)) + by_half * (1.0 - self.cosine_share)
    }
}
