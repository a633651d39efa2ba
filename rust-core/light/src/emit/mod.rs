//! Rays that lights send: the start of light paths. A light is chosen by its power; then place and direction are drawn by what it sends.
//!
//! What a ray carries is [`LightTable::le`] over the density of its being drawn, so light paths and light sampling agree whatever a light is like.
//! Lights with a place draw the direction by their far field and the place even over what they show to it, which leaves no noise where the
//! far field is tabulated finely. pbrt calls it `Light::SampleLe`, Mitsuba `sample_ray`.

mod aim;
mod beams;
mod body;
mod build;
mod choice;
mod facing;
mod finite;
mod image;
mod infinite;
mod place;
mod profile;
mod row;

pub use aim::AIMED;

use super::dome::DomeDistribution;
use super::row::{Reader, flag};
use super::table::LightTable;
use aim::Targets;
use beams::Beams;
use choice::Choice;
use finite::Start;
use gonio_simd::{F, Lanes, Rgb, U, Vec3};
use gonio_table::Distribution2D;
use row::Own;

/// How light paths choose lights: by power, and where infinite lights send their rays.
#[derive(Clone, Debug)]
pub struct EmissionSampler {
    /// One row of [`row::WIDTH`] values a light, and a few more to read.
    rows: Vec<f32>,
    choice: Choice,
    powers: Vec<[f64; 3]>,
    beams: Beams,
    /// Of textured rectangles, by texture.
    places: Vec<Distribution2D>,
    /// Textured domes.
    domes: Vec<(u32, DomeDistribution)>,
    targets: Targets,
    /// Centre and radius.
    scene: ([f32; 3], f32),
}

/// A ray that carries light away from a light.
#[derive(Clone, Copy, Debug)]
pub struct EmittedRay<L: Lanes> {
    /// Where it starts, in rebased world space and metres; of infinite lights a point outside the scene's sphere.
    pub origin: Vec3<L>,
    /// Unit normal of the emitting surface at the origin, on the side of `direction`; zero where there is none (points, infinite lights).
    pub normal: Vec3<L>,
    /// Unit direction.
    pub direction: Vec3<L>,
    /// What the ray carries, in cd/m² · m² · sr: radiance times cosine over the density of light, place and direction. The sum over n rays divided by
    /// n is what the lights send. Zero: no ray.
    pub flux: Rgb<L>,
    /// Index of the light in the table.
    pub light: U<L>,
    /// Way in metres before which the ray carries nothing yet: what it meets sooner blocks it and stays dark. Zero for all lights but facing disks,
    /// which points near the disk's plane see less of.
    pub clear: F<L>,
}

impl EmissionSampler {
    /// Whether nothing emits.
    pub fn is_empty(&self) -> bool {
        self.choice.is_empty()
    }

    /// What a light sends by component in cd·sr; infinite lights: through the disk of the scene's sphere, or of the targets where there are any.
    /// Zero for lights that were not chosen or send nothing. What takes light away counts like what sends it.
    pub fn power(&self, light: u32) -> [f64; 3] {
        self.powers.get(light as usize).copied().unwrap_or_default()
    }

    /// The sum of all lights' powers.
    pub fn total_power(&self) -> [f64; 3] {
        self.powers.iter().fold([0.0; 3], |sum, power| [0, 1, 2].map(|k| sum[k] + power[k]))
    }

    /// A ray of one of the lights, for numbers in `[0, 1)`. `table` is the one that the sampler was made of.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, table: &LightTable, u_light: F<L>, u_place: [F<L>; 2], u_direction: [F<L>; 2]) -> EmittedRay<L> {
        if self.is_empty() {
            return EmittedRay::nothing(l);
        }
        let chosen = self.choice.sample(l, u_light);
        let light = table.reader(l, chosen.0);
        // What all lanes share stays so all the way down, as in light sampling.
        match light.common() {
            Some(common) => self.emit(l, table, &common, chosen, u_place, u_direction),
            None => self.emit(l, table, &light, chosen, u_place, u_direction),
        }
    }

    #[inline(always)]
    fn emit<L: Lanes>(
        &self,
        l: L,
        table: &LightTable,
        light: &Reader<'_, L>,
        (index, probability): (U<L>, F<L>),
        u_place: [F<L>; 2],
        u_direction: [F<L>; 2],
    ) -> EmittedRay<L> {
        let infinite = light.flag(flag::INFINITE);
        let mut start = Start::nowhere(l);
        if !infinite.all() {
            let own = Own::new(l, &self.rows, index);
            start = self.start_finite(l, table, light, &own, u_place, u_direction);
        }
        if infinite.any() {
            let far = self.start_infinite(l, table, light, index, u_place, u_direction);
            start = start.where_is(infinite, far);
        }
        let weight = start.weight / probability;
        let valid = weight.gt(0.0) & weight.is_finite() & probability.gt(0.0);
        let sent = table.le(l, light, -start.direction, start.uv);
        let sent = table.filtered(l, index, start.origin, start.direction, l.f(f32::MAX), sent);
        EmittedRay {
            origin: start.origin,
            normal: start.normal,
            direction: start.direction,
            flux: (sent * weight).keep_if(valid),
            light: index,
            clear: start.clear,
        }
    }
}

impl<L: Lanes> Start<L> {
    #[inline(always)]
    fn nowhere(l: L) -> Self {
        let (zero, up) = (l.f(0.0), Vec3::splat(l, [0.0, 0.0, 1.0]));
        Self { origin: Vec3::splat(l, [0.0; 3]), normal: Vec3::splat(l, [0.0; 3]), direction: up, weight: zero, uv: [zero; 2], clear: zero }
    }
    #[inline(always)]
    fn where_is(self, mask: gonio_simd::M<L>, other: Self) -> Self {
        Self {
            origin: mask.select(other.origin, self.origin),
            normal: mask.select(other.normal, self.normal),
            direction: mask.select(other.direction, self.direction),
            weight: mask.select(other.weight, self.weight),
            uv: [mask.select(other.uv[0], self.uv[0]), mask.select(other.uv[1], self.uv[1])],
            clear: mask.select(other.clear, self.clear),
        }
    }
}

impl<L: Lanes> EmittedRay<L> {
    /// No ray.
    #[inline(always)]
    fn nothing(l: L) -> Self {
        let (nowhere, zero) = (Vec3::splat(l, [0.0; 3]), l.f(0.0));
        let up = Vec3::splat(l, [0.0, 0.0, 1.0]);
        Self { origin: nowhere, normal: nowhere, direction: up, flux: Rgb::zero(l), light: l.u(0), clear: zero }
    }
}
