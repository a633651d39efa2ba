//! Le, the emitted radiance: what lights send, and to which side.

use super::light_kind::LightKind;
use super::projected_area::per_area;
use super::row::{Reader, field, flag};
use super::shaping::shaping;
use super::table::LightTable;
use gonio_simd::{F, Lanes, M, Rgb, Vec3};

impl LightTable {
    /// Whether a flat light's emitting side looks at the point that sees it along `wi`; other lights are kept by their densities.
    #[inline(always)]
    pub(super) fn faces<L: Lanes>(&self, light: &Reader<'_, L>, from: Vec3<L>, wi: Vec3<L>) -> M<L> {
        let one_sided = light.flag(flag::FLAT).and_not(light.flag(flag::TWO_SIDED));
        if !one_sided.any() {
            return !one_sided;
        }
        let normal = light.vector(field::NORMAL);
        let in_front = normal.dot(from - light.vector(field::ORIGIN)).gt(0.0) & normal.dot(wi).lt(0.0);
        !one_sided | in_front
    }

    /// Le: radiance sent against `wi`, with shaping, goniogram and texture.
    #[inline(always)]
    pub(super) fn le<L: Lanes>(&self, l: L, light: &Reader<'_, L>, wi: Vec3<L>, uv: [F<L>; 2]) -> Rgb<L> {
        let plain = light.colour(field::RADIANCE);
        if !light.flag(flag::VARIED).any() {
            return plain;
        }
        let shaped = plain * self.beam(l, light, -wi);
        let width = light.integer(field::TEXTURE_WIDTH);
        let textured = width.ne(0);
        if !textured.any() {
            return shaped;
        }
        let (first, height) = (light.integer(field::TEXTURE), light.integer(field::TEXTURE_HEIGHT));
        let size = [width.max(1), height.max(1)];
        let dome = textured & light.is_kind(LightKind::Dome);
        let flat = textured.and_not(light.is_kind(LightKind::Dome));
        let mut image = Rgb::grey(l.f(1.0));
        if flat.any() {
            image = flat.select(self.textures.lookup(l, first, size, uv, false), image);
        }
        if dome.any() {
            image = dome.select(self.textures.lookup(l, first, size, uv, true), image);
        }
        shaped * image
    }

    /// Factor on the radiance towards unit `direction`: shaping, goniogram and opening.
    #[inline(always)]
    pub(super) fn beam<L: Lanes>(&self, l: L, light: &Reader<'_, L>, direction: Vec3<L>) -> Rgb<L> {
        shaping(l, light, direction, l.m(true)) * self.goniogram_factor(l, light, direction) * per_area(l, light, direction)
    }

    /// Factor of each light's goniogram towards unit `direction`; 1 for lights without one.
    #[inline(always)]
    fn goniogram_factor<L: Lanes>(&self, l: L, light: &Reader<'_, L>, direction: Vec3<L>) -> F<L> {
        let mut factor = l.f(1.0);
        if self.goniograms.is_empty() {
            return factor;
        }
        let number = light.integer(field::GONIOGRAM);
        let mut left = number.ne(0);
        if !left.any() {
            return factor;
        }
        let (x, y) = (light.vector(field::LEVEL_X), light.vector(field::LEVEL_Y));
        let local = Vec3::new(x.dot(direction), y.dot(direction), -light.vector(field::AXIS).dot(direction));
        // Each goniogram that some lane has, for all lanes that have it: its axes are the same for them all.
        while left.any() {
            let one = number.to_array()[left.bits().trailing_zeros() as usize];
            let same = left & number.eq(one);
            if let Some(goniogram) = self.goniograms.get(one as usize - 1) {
                factor = same.select(goniogram.factor(l, local), factor);
            }
            left = left.and_not(same);
        }
        factor
    }
}
