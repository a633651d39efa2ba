//! Filtered lookups in one mip map.

use super::mip_map::{Levels, MipMap};
use super::paged::TileReader;
use super::texel::{Byte, Float, Grey, Half, LinearCode, Rgba, SrgbCode, TableCode, Texel, TexelFormat};
use super::texels::{InMemory, InTiles, Level, Quad, Texels};
use super::wrap::{Filter, Wrap};
use crate::colour::{Transfer, srgb_to_linear};
use gonio_simd::{F, Lanes, M, Vec2};

/// What lies beyond the image, along each axis.
pub(crate) type Wraps = [Wrap; 2];

/// Where lanes look.
#[derive(Clone, Copy)]
struct Place<L: Lanes> {
    /// In the unit square, from the image's top left.
    position: Vec2<L>,
    /// The footprint.
    width: F<L>,
    /// Lanes whose texels count.
    wanted: M<L>,
}

impl Levels {
    /// Level 0 in every lane.
    #[inline(always)]
    fn finest<L: Lanes>(&self, l: L) -> Level<L> {
        Level { number: l.u(0), width: l.f(self.widths[0]), height: l.f(self.heights[0]), offset: l.u(0) }
    }

    /// A level for each lane.
    #[inline(always)]
    fn at<L: Lanes>(&self, l: L, level: F<L>) -> Level<L> {
        let index = level.to_i32();
        Level {
            number: index,
            width: l.lookup32(&self.widths, index),
            height: l.lookup32(&self.heights, index),
            offset: l.lookup32(&self.offsets, index).to_bits(),
        }
    }

    /// A footprint of `width` (in uv units) in texels of the finest level, and whether a coarser one has such.
    #[inline(always)]
    fn texels<L: Lanes>(&self, width: F<L>) -> (F<L>, M<L>) {
        let texels = width * self.widths[0].max(self.heights[0]);
        (texels, texels.gt(if self.count > 1 { 1.0 } else { f32::INFINITY }))
    }

    /// The level, with fraction, whose texels are as wide as a footprint of `width` (in uv units).
    #[inline(always)]
    fn level_of<L: Lanes>(&self, l: L, width: F<L>) -> F<L> {
        let (texels, coarse) = self.texels(width);
        if !coarse.any() {
            return l.f(0.0);
        }
        // Comparisons first: a NaN footprint reads the finest level.
        coarse.select(texels, l.f(1.0)).min(f32::MAX).log2().clamp(0.0, (self.count - 1) as f32)
    }
}

impl MipMap {
    /// The texture at `uv` (origin at the image's bottom left) over a footprint of `width` in uv units, 0 for the finest level: linear RGBA.
    ///
    /// Any `uv` and `width` are safe, NaN included.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, l: L, uv: Vec2<L>, width: F<L>, wrap: [Wrap; 2], filter: Filter) -> [F<L>; 4] {
        self.look_up(l, &mut InMemory { words: &self.words }, uv, width, (wrap, filter), l.m(true))
    }

    /// The same for a texture that is paged, in the lanes of `wanted`; the others get numbers without meaning.
    #[inline(always)]
    pub(crate) fn sample_tiles<L: Lanes>(
        &self,
        l: L,
        reader: &mut TileReader,
        uv: Vec2<L>,
        width: F<L>,
        how: (Wraps, Filter),
        wanted: M<L>,
    ) -> [F<L>; 4] {
        let Some(paged) = &self.paged else { return [l.f(0.0); 4] };
        reader.attach(paged.memory());
        self.look_up(l, &mut InTiles { paged, reader }, uv, width, how, wanted)
    }

    #[inline(always)]
    fn look_up<L: Lanes>(
        &self,
        l: L,
        texels: &mut impl Texels<L>,
        uv: Vec2<L>,
        width: F<L>,
        (wrap, filter): (Wraps, Filter),
        wanted: M<L>,
    ) -> [F<L>; 4] {
        // Splines reach over the edge, so that how far beyond it a place lies counts.
        let along = wrap.map(|wrap| if wrap == Wrap::Clamp && filter.is_cubic() { Wrap::Black } else { wrap });
        let position = Vec2 { x: along[0].position(uv.x), y: 1.0 - along[1].position(uv.y) };
        // Beyond its edges a clamped image is that edge alone, into which coarser levels mix what lies inside.
        let mut width = width;
        for (axis, coordinate) in [uv.x, uv.y].into_iter().enumerate() {
            if wrap[axis] == Wrap::Clamp {
                width = (coordinate.lt(0.0) | coordinate.gt(1.0)).select(l.f(0.0), width);
            }
        }
        let place = Place { position, width, wanted };
        match (self.format, self.transfer) {
            (TexelFormat::Byte, Transfer::Srgb) if filter.mixes_codes() => self.codes_or_light(l, texels, place, wrap, filter.is_cubic()),
            (TexelFormat::Byte, Transfer::Linear) => self.filtered::<L, Byte<LinearCode>>(l, texels, place, wrap, filter),
            (TexelFormat::Byte, Transfer::Srgb) => self.filtered::<L, Byte<SrgbCode>>(l, texels, place, wrap, filter),
            (TexelFormat::Byte, _) => self.filtered::<L, Byte<TableCode>>(l, texels, place, wrap, filter),
            (TexelFormat::Grey, _) => self.filtered::<L, Grey>(l, texels, place, wrap, filter),
            (TexelFormat::Half, _) => self.filtered::<L, Half>(l, texels, place, wrap, filter),
            (TexelFormat::Float, _) => self.filtered::<L, Float>(l, texels, place, wrap, filter),
        }
    }

    #[inline(always)]
    fn filtered<L: Lanes, T: Texel>(&self, l: L, texels: &mut impl Texels<L>, place: Place<L>, wrap: Wraps, filter: Filter) -> Rgba<L> {
        match filter {
            Filter::Nearest => self.nearest::<L, T>(l, texels, place, wrap),
            _ => self.trilinear::<L, T>(l, texels, place, wrap, filter.is_cubic()),
        }
    }

    #[inline(always)]
    fn nearest<L: Lanes, T: Texel>(&self, l: L, texels: &mut impl Texels<L>, place: Place<L>, wrap: Wraps) -> Rgba<L> {
        let level = self.levels.finest(l);
        let (x, inside_x) = wrap[0].nearest(place.position.x, level.width);
        let (y, inside_y) = wrap[1].nearest(place.position.y, level.height);
        texels.prepare(&level, &Quad { x: [x, x], y: [y, y] }, place.wanted);
        let mut texel = texels.one::<T>(l, &self.table, &level, x, y);
        for channel in &mut texel {
            *channel = channel.keep_if(inside_x & inside_y);
        }
        texel
    }

    #[inline(always)]
    fn trilinear<L: Lanes, T: Texel>(&self, l: L, texels: &mut impl Texels<L>, place: Place<L>, wrap: Wraps, cubic: bool) -> Rgba<L> {
        let level = self.levels.level_of(l, place.width);
        let is_finest = !level.gt(0.0).any();
        let finer = level.floor();
        let fraction = level - finer;
        let mut sum = [l.f(0.0); 4];
        for (step, weight) in [(0.0, 1.0 - fraction), (1.0, fraction)] {
            // The last level has no fraction: the place behind it in the tables is filled, and read with no weight.
            if !weight.gt(0.0).any() {
                continue;
            }
            let level = if is_finest { self.levels.finest(l) } else { self.levels.at(l, finer + step) };
            let place = Place { wanted: place.wanted & weight.gt(0.0), ..place };
            let texel = self.in_level::<L, T>(l, texels, place, level, wrap, cubic);
            for (channel, value) in sum.iter_mut().zip(texel) {
                *channel = value.mul_add(weight, *channel);
            }
        }
        sum
    }

    /// Bytes of sRGB: the finest level is mixed as it is encoded and then decoded, all others the other way round.
    #[inline(always)]
    fn codes_or_light<L: Lanes>(&self, l: L, texels: &mut impl Texels<L>, place: Place<L>, wrap: Wraps, cubic: bool) -> Rgba<L> {
        let light = place.wanted & self.levels.texels(place.width).1;
        let mut sum = [l.f(0.0); 4];
        if light.any() {
            sum = self.trilinear::<L, Byte<SrgbCode>>(l, texels, Place { wanted: light, ..place }, wrap, cubic);
        }
        if light.all() {
            return sum;
        }
        let (level, place) = (self.levels.finest(l), Place { wanted: place.wanted.and_not(light), ..place });
        let [r, g, b, a] = self.in_level::<L, Byte<LinearCode>>(l, texels, place, level, wrap, cubic);
        for (channel, value) in sum.iter_mut().zip([srgb_to_linear(r), srgb_to_linear(g), srgb_to_linear(b), a]) {
            *channel = light.select(*channel, value);
        }
        sum
    }

    /// Filtered in one level.
    #[inline(always)]
    fn in_level<L: Lanes, T: Texel>(
        &self,
        l: L,
        texels: &mut impl Texels<L>,
        place: Place<L>,
        level: Level<L>,
        wrap: Wraps,
        cubic: bool,
    ) -> Rgba<L> {
        if cubic { self.cubic::<L, T>(l, texels, place, level, wrap) } else { self.bilinear::<L, T>(l, texels, place, level, wrap) }
    }

    /// Sixteen texels by four lookups between texels, each at the place that gives two texels their weights (Sigg and Hadwiger, 2005).
    #[inline(always)]
    fn cubic<L: Lanes, T: Texel>(&self, l: L, texels: &mut impl Texels<L>, at: Place<L>, level: Level<L>, wrap: Wraps) -> Rgba<L> {
        let (x, y) = (cubic_places(at.position.x, level.width), cubic_places(at.position.y, level.height));
        let mut sum = [l.f(0.0); 4];
        for (row, row_weight) in y {
            for (column, column_weight) in x {
                let position = Vec2 { x: wrap[0].position(column), y: wrap[1].position(row) };
                let weight = row_weight * column_weight;
                let place = Place { position, ..at };
                for (channel, value) in sum.iter_mut().zip(self.bilinear::<L, T>(l, texels, place, level, wrap)) {
                    *channel = value.mul_add(weight, *channel);
                }
            }
        }
        sum
    }

    #[inline(always)]
    fn bilinear<L: Lanes, T: Texel>(&self, l: L, texels: &mut impl Texels<L>, place: Place<L>, level: Level<L>, wrap: Wraps) -> Rgba<L> {
        let (x, y) = (wrap[0].taps(place.position.x, level.width), wrap[1].taps(place.position.y, level.height));
        let adjacent = x.high.eq(x.low + 1).all();
        texels.prepare(&level, &Quad { x: [x.low, x.high], y: [y.low, y.high] }, place.wanted);
        let mut sum = [l.f(0.0); 4];
        for (row, (at, row_weight)) in [(y.low, y.weights[0]), (y.high, y.weights[1])].into_iter().enumerate() {
            let [a, b] = texels.pair::<T>(l, &self.table, &level, (row, at), [x.low, x.high], adjacent);
            let (weight_a, weight_b) = (x.weights[0] * row_weight, x.weights[1] * row_weight);
            for (channel, value) in sum.iter_mut().enumerate() {
                *value = a[channel].mul_add(weight_a, b[channel].mul_add(weight_b, *value));
            }
        }
        sum
    }
}

/// Two places on an axis of `size` texels, each between two of the four texels about a position, and their weights.
#[inline(always)]
fn cubic_places<L: Lanes>(position: F<L>, size: F<L>) -> [(F<L>, F<L>); 2] {
    let x = position.mul_add(size, -0.5);
    let below = x.floor();
    let t = x - below;
    let (squared, rest) = (t * t, 1.0 - t);
    // B-splines of the outer texels and of the second one; the four sum to 1.
    let first = rest * rest * rest * (1.0 / 6.0);
    let second = (squared * (t - 2.0)).mul_add(0.5, 2.0 / 3.0);
    let last = squared * t * (1.0 / 6.0);
    let low = first + second;
    let high = 1.0 - low;
    let middle = below + 0.5;
    [((middle + second / low - 1.0) / size, low), ((middle + last / high + 1.0) / size, high)]
}
