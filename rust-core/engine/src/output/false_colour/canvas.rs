//! A picture under construction.

use super::font;

/// 8-bit RGBA, rows from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canvas {
    /// Four bytes a pixel.
    pub rgba: Vec<u8>,
    /// Columns and rows.
    pub size: [usize; 2],
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(size: [usize; 2], colour: [u8; 4]) -> Self {
        Self { rgba: colour.repeat(size[0] * size[1]), size }
    }

    /// Sets a pixel; those outside do not matter.
    pub fn set(&mut self, [x, y]: [usize; 2], colour: [u8; 4]) {
        if x < self.size[0] && y < self.size[1] {
            let at = 4 * (y * self.size[0] + x);
            self.rgba[at..at + 4].copy_from_slice(&colour);
        }
    }

    /// Copies another canvas to a place; what lies outside does not matter.
    pub fn put(&mut self, other: &Self, [left, top]: [usize; 2]) {
        let width = other.size[0].min(self.size[0].saturating_sub(left));
        for y in 0..other.size[1].min(self.size[1].saturating_sub(top)) {
            let (from, to) = (4 * y * other.size[0], 4 * ((top + y) * self.size[0] + left));
            self.rgba[to..to + 4 * width].copy_from_slice(&other.rgba[from..from + 4 * width]);
        }
    }

    /// Fills a rectangle.
    pub fn fill(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2], colour: [u8; 4]) {
        (top..top + height).for_each(|y| (left..left + width).for_each(|x| self.set([x, y], colour)));
    }

    /// Lays a colour over a rectangle by its alpha.
    pub fn shade(&mut self, [left, top]: [usize; 2], [width, height]: [usize; 2], colour: [u8; 4]) {
        for y in top..(top + height).min(self.size[1]) {
            (left..(left + width).min(self.size[0])).for_each(|x| self.mix([x, y], colour, u32::from(colour[3])));
        }
    }

    /// Lays a colour over a pixel by a share of 255; those outside do not matter.
    fn mix(&mut self, [x, y]: [usize; 2], [r, g, b, _]: [u8; 4], share: u32) {
        if x < self.size[0] && y < self.size[1] {
            let mixed = |below: u8, above: u8| ((u32::from(below) * (255 - share) + u32::from(above) * share) / 255) as u8;
            let at = 4 * (y * self.size[0] + x);
            let pixel = &mut self.rgba[at..at + 4];
            pixel.copy_from_slice(&[mixed(pixel[0], r), mixed(pixel[1], g), mixed(pixel[2], b), pixel[3]]);
        }
    }

    /// Writes a text whose digits are so many pixels high.
    pub fn write(&mut self, text: &str, [left, top]: [usize; 2], height: usize, colour: [u8; 4]) {
        font::draw(text, height as f32, |x, y, share| self.mix([left + x, top + y], colour, (share * 255.0) as u32));
    }

    /// Pixels across a text and down it.
    pub fn text_size(text: &str, height: usize) -> [usize; 2] {
        [(font::width(text) * height as f32).ceil() as usize, height]
    }
}
