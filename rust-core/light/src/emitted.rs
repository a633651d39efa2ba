//! What lights send, and to which side.

use super::projected_area::per_area;
use super::record::LightKind;
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

    /// Radiance sent against `wi`, with shaping and texture.
    #[inline(always)]
    pub(super) fn emitted<L: Lanes>(&self, l: L, light: &Reader<'_, L>, wi: Vec3<L>, uv: [F<L>; 2]) -> Rgb<L> {
        let plain = light.colour(field::RADIANCE);
        if !light.flag(flag::VARIED).any() {
            return plain;
        }
        let shaped = plain * (shaping(l, light, -wi, l.m(true)) * self.measured(l, light, -wi) * per_area(l, light, -wi));
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
}
