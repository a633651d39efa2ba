//! Images on lights: one pool, bilinear lookups.

use super::record::LightTexture;
use gonio_simd::{F, Lanes, Rgb, U};

/// All images, pixel after pixel.
#[derive(Clone, Debug, Default)]
pub(crate) struct TexturePool {
    values: Vec<f32>,
}

/// An image's place in the pool.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Placed {
    /// First value.
    pub(crate) first: u32,
    /// Pixels across.
    pub(crate) width: u32,
    /// Pixels down.
    pub(crate) height: u32,
}

impl TexturePool {
    /// Takes in an image; `None` for one whose size and values disagree, or which has no room.
    pub(crate) fn insert(&mut self, image: &LightTexture) -> Option<Placed> {
        let expected = image.width.checked_mul(image.height)?.checked_mul(3)?;
        let end = expected.checked_add(self.values.len())?;
        if expected == 0 || image.rgb.len() != expected || i32::try_from(end).is_err() {
            return None;
        }
        let first = self.values.len() as u32;
        self.values.extend(image.rgb.iter().map(|v| if v.is_finite() { *v } else { 0.0 }));
        // Room to read four values where three stand.
        self.values.push(0.0);
        Some(Placed { first, width: image.width as u32, height: image.height as u32 })
    }
    /// An image by itself.
    pub(crate) fn image(&self, placed: Placed) -> LightTexture {
        let Placed { first, width, height } = placed;
        let (first, width, height) = (first as usize, width as usize, height as usize);
        LightTexture { width, height, rgb: self.values[first..first + 3 * width * height].to_vec() }
    }
    /// Bilinear; `wrap` joins the left edge to the right one, other edges repeat their last pixel. `place` is in the unit square from the top left.
    #[inline(always)]
    pub(crate) fn lookup<L: Lanes>(&self, l: L, first: U<L>, size: [U<L>; 2], place: [F<L>; 2], wrap: bool) -> Rgb<L> {
        let [width, height] = size;
        let ((left, across), (top, down)) = (between(place[0], width), between(place[1], height));
        let (x0, x1) = if wrap { (turn(left, width), turn(left + 1.0, width)) } else { (hold(left, width), hold(left + 1.0, width)) };
        let (y0, y1) = (hold(top, height) * width, hold(top + 1.0, height) * width);
        let upper = self.pixel(l, first + (y0 + x0) * 3).lerp(self.pixel(l, first + (y0 + x1) * 3), across);
        let lower = self.pixel(l, first + (y1 + x0) * 3).lerp(self.pixel(l, first + (y1 + x1) * 3), across);
        upper.lerp(lower, down)
    }
    #[inline(always)]
    fn pixel<L: Lanes>(&self, l: L, at: U<L>) -> Rgb<L> {
        Rgb::gather(l, &self.values, at)
    }
}

/// The pixel below a place in the unit interval, and how far the place is on the way to the next.
#[inline(always)]
fn between<L: Lanes>(x: F<L>, count: U<L>) -> (F<L>, F<L>) {
    let at = x.saturate() * count.to_float() - 0.5;
    let low = at.floor();
    (low, at - low)
}

/// A pixel number kept on the image.
#[inline(always)]
fn hold<L: Lanes>(x: F<L>, count: U<L>) -> U<L> {
    x.max(0.0).min(count.to_float() - 1.0).to_i32()
}

/// A pixel number up to one beyond the image's edge taken round to the other.
#[inline(always)]
fn turn<L: Lanes>(x: F<L>, count: U<L>) -> U<L> {
    let count = count.to_float();
    let x = x.lt(0.0).select(x + count, x);
    x.ge(count).select(x - count, x).max(0.0).to_i32()
}
