//! From luma and chroma to red, green and blue (ITU-T H.273, section 8.3).

use re_rav1d::{Picture, PixelLayout, PlanarImageComponent, Plane};

/// The matrix coefficients of H.273 that are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Matrix {
    /// Green, blue and red themselves.
    Identity,
    /// Green's and orange's difference to luma.
    YCgCo,
    /// Luma of red and blue; green's is the rest.
    Luma(f32, f32),
}

impl Matrix {
    /// By the number of H.273; nothing for those that are not known.
    pub(super) fn from_code_point(number: u16) -> Option<Self> {
        Some(match number {
            0 => Self::Identity,
            1 => Self::Luma(0.2126, 0.0722),
            4 => Self::Luma(0.30, 0.11),
            // Unspecified means Rec.601, as the image file format has it.
            2 | 5 | 6 => Self::Luma(0.299, 0.114),
            7 => Self::Luma(0.212, 0.087),
            8 => Self::YCgCo,
            9 => Self::Luma(0.2627, 0.0593),
            _ => return None,
        })
    }

    /// Red, green and blue of luma in 0 to 1 and chroma in −0.5 to 0.5.
    pub(super) fn rgb(self, [y, u, v]: [f32; 3]) -> [f32; 3] {
        match self {
            Self::Identity => [v, y, u],
            Self::YCgCo => [y - u + v, y + u, y - u - v],
            Self::Luma(red, blue) => {
                let (r, b) = (y + 2.0 * (1.0 - red) * v, y + 2.0 * (1.0 - blue) * u);
                [r, (y - red * r - blue * b) / (1.0 - red - blue), b]
            }
        }
    }
}

/// A plane of a decoded picture, with values as numbers.
pub(super) struct Samples {
    plane: Plane,
    stride: usize,
    /// The last column and the last row.
    last: [usize; 2],
    is_wide: bool,
    zero: f32,
    scale: f32,
    /// Texels of the picture for one of the plane.
    step: [f32; 2],
}

impl Samples {
    /// `is_full` says whether numbers use their full range, `is_chroma` whether they lie around their middle.
    pub(super) fn new(picture: &Picture, component: PlanarImageComponent, is_full: bool, is_chroma: bool) -> Self {
        let is_luma = component == PlanarImageComponent::Y;
        let halved = match picture.pixel_layout() {
            _ if is_luma => [false; 2],
            PixelLayout::I420 => [true; 2],
            PixelLayout::I422 => [true, false],
            PixelLayout::I400 | PixelLayout::I444 => [false; 2],
        };
        let side = |size: u32, is_halved: bool| size.div_ceil(1 + u32::from(is_halved)) as usize - 1;
        let bits = picture.bit_depth() as i32;
        let unit = 2_f32.powi(bits - 8);
        let (zero, scale) = match (is_full, is_chroma) {
            (true, false) => (0.0, 2_f32.powi(bits) - 1.0),
            (true, true) => (128.0 * unit, 2_f32.powi(bits) - 1.0),
            (false, false) => (16.0 * unit, 219.0 * unit),
            (false, true) => (128.0 * unit, 224.0 * unit),
        };
        Self {
            plane: picture.plane(component),
            stride: picture.stride(component) as usize,
            last: [side(picture.width(), halved[0]), side(picture.height(), halved[1])],
            is_wide: bits > 8,
            zero,
            scale: 1.0 / scale,
            step: halved.map(|is_halved| if is_halved { 0.5 } else { 1.0 }),
        }
    }

    fn at(&self, x: usize, y: usize) -> f32 {
        let bytes: &[u8] = self.plane.as_ref();
        let start = y * self.stride;
        let value = if self.is_wide {
            let at = start + 2 * x;
            u16::from_ne_bytes([bytes[at], bytes[at + 1]])
        } else {
            u16::from(bytes[start + x])
        };
        (f32::from(value) - self.zero) * self.scale
    }

    /// The value at a texel of the picture, between four samples where the plane has fewer.
    pub(super) fn value(&self, x: u32, y: u32) -> f32 {
        if self.step == [1.0; 2] {
            return self.at(x as usize, y as usize);
        }
        let [(x0, x1, s), (y0, y1, t)] = [0, 1].map(|axis| {
            let place = (([x, y][axis] as f32 + 0.5) * self.step[axis] - 0.5).max(0.0);
            let low = (place as usize).min(self.last[axis]);
            (low, (low + 1).min(self.last[axis]), place - low as f32)
        });
        let row = |y| self.at(x0, y) * (1.0 - s) + self.at(x1, y) * s;
        row(y0) * (1.0 - t) + row(y1) * t
    }
}
