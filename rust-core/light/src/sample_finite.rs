//! Sampling directions to finite lights, those that have a place.

use super::cylinder::Cylinder;
use super::disk::Disk;
use super::emitter::{Aim, Emitter};
use super::facing_disk::FacingDisk;
use super::light_kind::LightKind;
use super::rectangle::Rectangle;
use super::row::{Reader, field};
use super::sphere::Sphere;
use super::table::LightTable;
use super::triangle::Triangle;
use gonio_simd::{F, Lanes, Vec3};

impl LightTable {
    /// Samples a direction to finite lights.
    #[inline(always)]
    pub(super) fn sample_finite<L: Lanes>(&self, l: L, light: &Reader<'_, L>, p: &Vec3<L>, u: &[F<L>; 2], aim: &mut Aim<L>) {
        self.sample_kind(
            LightKind::Rectangle,
            light,
            aim,
            #[inline(always)]
            || Rectangle::sample(l, light, *p, *u),
        );
        self.sample_kind(
            LightKind::Disk,
            light,
            aim,
            #[inline(always)]
            || Disk::sample(l, light, *p, *u),
        );
        self.sample_kind(
            LightKind::Sphere,
            light,
            aim,
            #[inline(always)]
            || Sphere::sample(l, light, *p, *u),
        );
        self.sample_kind(
            LightKind::Cylinder,
            light,
            aim,
            #[inline(always)]
            || Cylinder::sample(l, light, *p, *u),
        );
        self.sample_kind(
            LightKind::Triangle,
            light,
            aim,
            #[inline(always)]
            || Triangle::sample(l, light, *p, *u),
        );
        self.sample_kind(
            LightKind::FacingDisk,
            light,
            aim,
            #[inline(always)]
            || FacingDisk::sample(l, light, *p, *u),
        );
        self.sample_kind(
            LightKind::Point,
            light,
            aim,
            #[inline(always)]
            || Aim { pdf: l.f(1.0), ..Aim::towards(light.vector(field::ORIGIN) - *p) },
        );
    }

    /// Runs one kind's sampling where some lane has it.
    #[inline(always)]
    fn sample_kind<L: Lanes>(&self, kind: LightKind, light: &Reader<'_, L>, aim: &mut Aim<L>, sample: impl FnOnce() -> Aim<L>) {
        // First of all: of nothing but such comparisons the compiler makes one jump.
        if let Some(common) = light.common_kind() {
            if common == kind as u32 {
                *aim = sample();
            }
            return;
        }
        if !self.has(kind) {
            return;
        }
        let of_kind = light.is_kind(kind);
        if of_kind.any() {
            let new = sample();
            aim.wi = of_kind.select(new.wi, aim.wi);
            aim.distance = of_kind.select(new.distance, aim.distance);
            aim.pdf = of_kind.select(new.pdf, aim.pdf);
            aim.uv = [of_kind.select(new.uv[0], aim.uv[0]), of_kind.select(new.uv[1], aim.uv[1])];
        }
    }
}
