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
        Some(Placed { first, width: image.width as u32, height: image.height as u32 })
    }
    /// Bilinear; `wrap` joins the left edge to the right one, other edges repeat their last pixel. `place` is in the unit square from the top left.
    #[inline(always)]
    pub(crate) fn lookup<L: Lanes>(&self, l: L, first: U<L>, size: [U<L>; 2], place: [F<L>; 2], wrap: bool) -> Rgb<L> {
        let [width, height] = size;
        let axis = |x: F<L>, count: U<L>| {
            let at = x.saturate() * count.to_float() - 0.5;
            let low = at.floor();
            (low, at - low)
        };
        let ((left, across), (top, down)) = (axis(place[0], width), axis(place[1], height));
        let hold = |x: F<L>, count: U<L>| x.max(0.0).min(count.to_float() - 1.0).to_i32();
        let turn = |x: F<L>| {
            let count = width.to_float();
            let x = x.lt(0.0).select(x + count, x);
            x.ge(count).select(x - count, x).max(0.0).to_i32()
        };
        let column = |x: F<L>| if wrap { turn(x) } else { hold(x, width) };
        let (x0, x1) = (column(left), column(left + 1.0));
        let (y0, y1) = (hold(top, height) * width, hold(top + 1.0, height) * width);
        let pixel = |y: U<L>, x: U<L>| Rgb::gather(l, &self.values, first + (y + x) * 3);
        pixel(y0, x0).lerp(pixel(y0, x1), across).lerp(pixel(y1, x0).lerp(pixel(y1, x1), across), down)
    }
}
