//! Next event estimation (NEE): sampling a light and a direction towards it.

use super::context::LightSampleContext;
use super::emitter::Aim;
use super::facing_disk;
use super::light_kind::LightKind;
use super::row::{Reader, flag};
use super::table::LightTable;
use super::tree::LightCache;
use gonio_simd::{F, Lanes, M, Rgb, U, Vec3};

/// Light that may arrive at a point.
#[derive(Clone, Copy, Debug)]
pub struct LightSample<L: Lanes> {
    /// Unit direction to the light.
    pub wi: Vec3<L>,
    /// Way to the light's point in metres, `f32::MAX` for infinite lights.
    pub distance: F<L>,
    /// Radiance towards the point with shaping and texture, zero where `pdf` is; for delta lights the illuminance on a facing surface.
    pub radiance: Rgb<L>,
    /// Density per solid angle times the probability of the light; for delta lights that probability alone. Zero where nothing arrives.
    pub pdf: F<L>,
    /// Lights that no ray from here can hit: the sample stands for all of their light.
    pub delta: M<L>,
    /// Index of the light.
    pub light: U<L>,
    /// Whether things block the light.
    pub casts_shadow: M<L>,
}

impl LightTable {
    /// Samples a light and a direction to it from a point, for `u_light` and `u` in `[0, 1)`. Most lights are those that the `light_cache` has learned to
    /// arrive there, where there is one.
    #[inline(always)]
    pub fn sample_li<L: Lanes>(
        &self,
        l: L,
        light_cache: Option<&LightCache>,
        from: &LightSampleContext<L>,
        u_light: F<L>,
        u: &[F<L>; 2],
    ) -> LightSample<L> {
        if self.count == 0 {
            return LightSample::nothing(l);
        }
        let chosen = self.sample_light(l, light_cache, from, u_light);
        self.sample_li_of(l, chosen, from, u)
    }

    /// Samples a direction to a light that has been selected with some probability.
    #[inline(always)]
    pub fn sample_li_of<L: Lanes>(&self, l: L, chosen: (U<L>, F<L>), from: &LightSampleContext<L>, u: &[F<L>; 2]) -> LightSample<L> {
        let light = self.reader(l, chosen.0);
        // What all lanes share stays so all the way down: no gathers, no kind of light but one.
        match light.common() {
            Some(common) => self.sample_row(l, &common, chosen, from, u),
            None => self.sample_row(l, &light, chosen, from, u),
        }
    }

    #[inline(always)]
    fn sample_row<L: Lanes>(
        &self,
        l: L,
        light: &Reader<'_, L>,
        (index, probability): (U<L>, F<L>),
        from: &LightSampleContext<L>,
        u: &[F<L>; 2],
    ) -> LightSample<L> {
        let p = &from.position;
        let mut aim = Aim { wi: Vec3::splat(l, [0.0, 0.0, 1.0]), distance: l.f(f32::MAX), pdf: l.f(0.0), uv: [l.f(0.0); 2] };
        self.sample_finite(l, light, p, u, &mut aim);
        self.sample_infinite(l, light, index, from, u, &mut aim);
        let sent = self.le(l, light, aim.wi, aim.uv);
        let point = light.is_kind(LightKind::Point);
        let radiance = if point.any() {
            let squared = (aim.distance * aim.distance).max(f32::MIN_POSITIVE);
            point.select(sent * squared.recip(), sent)
        } else {
            sent
        };
        let radiance = self.fallen(l, index, aim.wi * aim.distance, radiance);
        let radiance = self.filtered(l, index, aim.wi * aim.distance + *p, -aim.wi, aim.distance, radiance);
        let radiance = self.seen_outside(l, index, radiance);
        let pdf = aim.pdf * probability;
        let facing = light.is_kind(LightKind::FacingDisk);
        let enclosed = if facing.any() { facing & facing_disk::encloses(light, *p) } else { facing };
        let valid = pdf.gt(0.0) & pdf.is_finite() & aim.distance.gt(0.0) & self.faces(light, *p, aim.wi) & light.flag(flag::LIT);
        LightSample {
            wi: valid.select(aim.wi, Vec3::splat(l, [0.0, 0.0, 1.0])),
            distance: valid.select(aim.distance, l.f(f32::MAX)),
            radiance: radiance.keep_if(valid),
            pdf: pdf.keep_if(valid),
            delta: light.flag(flag::DELTA | flag::ALONE) | enclosed,
            light: index,
            casts_shadow: light.flag(flag::CASTS_SHADOW),
        }
    }
}

impl<L: Lanes> LightSample<L> {
    /// A radiance of 1 from infinitely far, as if it were the only light.
    #[inline(always)]
    pub fn from_direction(l: L, wi: Vec3<L>) -> Self {
        Self { wi, radiance: Rgb::grey(l.f(1.0)), pdf: l.f(1.0), delta: l.m(true), ..Self::nothing(l) }
    }
    /// No light.
    #[inline(always)]
    fn nothing(l: L) -> Self {
        Self {
            wi: Vec3::splat(l, [0.0, 0.0, 1.0]),
            distance: l.f(f32::MAX),
            radiance: Rgb::zero(l),
            pdf: l.f(0.0),
            delta: l.m(false),
            light: l.u(0),
            casts_shadow: l.m(true),
        }
    }
}
