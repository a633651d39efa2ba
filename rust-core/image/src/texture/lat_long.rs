//! Dome light textures brought to one layout, latitude against longitude.
//!
//! Layout of OpenEXR's environment maps: the top row looks to +Y, the centre to +Z, longitude grows to the left, so that +X lies a quarter of the
//! width left of the centre.

use super::error::TextureError;
use super::image::Image;
use super::limits::check_room;
use super::resolve::Conversion;
use crate::colour::ColourSpace;
use rayon::prelude::*;
use std::f64::consts::PI;

/// What a texel of a light's image takes until it can be sampled: colours, a copy of them, and sums of probabilities.
const TEXEL_BYTES: u64 = 40;

/// How an image maps directions, by the names of UsdLux's `texture:format`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DomeFormat {
    /// Latitude and longitude.
    #[default]
    LatLong,
    /// A photograph of a mirroring ball from far away: the centre shows what lies behind the camera, +Z, and the right side +X.
    MirroredBall,
    /// As the mirroring ball, but the distance from the centre is proportional to the angle from +Z.
    Angular,
    /// The faces of a cube unfolded to a cross of 3 × 4: +Y above +Z above −Y above −Z (upside down), +X left and −X right of +Z, all seen from
    /// inside.
    CubeMapVerticalCross,
}

/// Linear Rec.709 radiance by latitude (rows, +90° at the top) and longitude (columns, +180° at the left).
#[derive(Clone, Debug, PartialEq)]
pub struct LatLong {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Texels row by row, `width * height` of them.
    pub rgb: Vec<[f32; 3]>,
}

impl LatLong {
    /// Converts an image of a format whose numbers mean `space`. A lat-long image keeps its texels, others are resampled bilinearly at a
    /// like density.
    pub fn from_image(image: &Image, format: DomeFormat, space: ColourSpace) -> Result<Self, TextureError> {
        if image.is_empty() || image.texels.len() != image.len() * image.channels as usize {
            return Err(TextureError::malformed("the image has no texels"));
        }
        check_room(TEXEL_BYTES * image.len() as u64, u64::from(image.width), u64::from(image.height))?;
        let conversion = Conversion::resolve(space, image);
        let linear = |index: usize| {
            let [r, g, b, _] = conversion.texel(image, index);
            [r, g, b]
        };
        let rgb: Vec<_> = (0..image.len()).into_par_iter().map(linear).collect();
        let source = Self { width: image.width as usize, height: image.height as usize, rgb };
        Ok(match format {
            DomeFormat::LatLong => source,
            _ => source.resampled(format),
        })
    }

    /// The direction that the point at `x`, `y` texels from the top left looks to.
    pub fn direction(&self, x: f64, y: f64) -> [f64; 3] {
        let (longitude, latitude) = ((0.5 - x / self.width as f64) * 2.0 * PI, (0.5 - y / self.height as f64) * PI);
        [longitude.sin() * latitude.cos(), latitude.sin(), longitude.cos() * latitude.cos()]
    }

    /// Reads `self` as an image of another format.
    fn resampled(&self, format: DomeFormat) -> Self {
        let height = match format {
            // A face of the cross spans a quarter turn.
            DomeFormat::CubeMapVerticalCross => self.height / 2,
            _ => self.height,
        };
        let height = height.clamp(2, 16_384);
        let mut out = Self { width: 2 * height, height, rgb: vec![[0.0; 3]; 2 * height * height] };
        let layout = Self { rgb: Vec::new(), ..out };
        out.rgb.par_chunks_mut(2 * height).enumerate().for_each(|(y, row)| {
            for (x, texel) in row.iter_mut().enumerate() {
                *texel = self.average(format, &layout, [x as f64, y as f64]);
            }
        });
        out
    }

    /// The mean over four points of a texel, against aliasing where the source is denser.
    fn average(&self, format: DomeFormat, layout: &Self, [x, y]: [f64; 2]) -> [f32; 3] {
        let mut sum = [0.0; 3];
        for [dx, dy] in [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]] {
            let direction = layout.direction(x + dx, y + dy);
            let value = match format {
                DomeFormat::CubeMapVerticalCross => self.cross(direction),
                _ => self.bilinear(disc(format, direction).map(|c| 0.5 + 0.5 * c), [0.0, 0.0], [1.0, 1.0]),
            };
            for (s, v) in sum.iter_mut().zip(value) {
                *s += 0.25 * v;
            }
        }
        sum
    }

    fn cross(&self, [x, y, z]: [f64; 3]) -> [f32; 3] {
        let (ax, ay, az) = (x.abs(), y.abs(), z.abs());
        // Column and row of the face, and the direction's place on it: right and down from the face's centre.
        let (column, row, right, down) = if az >= ax && az >= ay {
            if z > 0.0 { (1.0, 1.0, -x / az, -y / az) } else { (1.0, 3.0, -x / az, y / az) }
        } else if ay >= ax {
            if y > 0.0 { (1.0, 0.0, -x / ay, z / ay) } else { (1.0, 2.0, -x / ay, -z / ay) }
        } else if x > 0.0 {
            (0.0, 1.0, z / ax, -y / ax)
        } else {
            (2.0, 1.0, -z / ax, -y / ax)
        };
        let (low, high) = ([column / 3.0, row / 4.0], [(column + 1.0) / 3.0, (row + 1.0) / 4.0]);
        self.bilinear([(column + 0.5 + 0.5 * right) / 3.0, (row + 0.5 + 0.5 * down) / 4.0], low, high)
    }

    /// The image at fractions of its width and height, mixing no texel outside the rectangle from `low` to `high`.
    fn bilinear(&self, at: [f64; 2], low: [f64; 2], high: [f64; 2]) -> [f32; 3] {
        let size = [self.width, self.height];
        let mut texels = [[0_usize; 2]; 2];
        let mut shares = [0.0_f32; 2];
        for axis in 0..2 {
            let length = size[axis] as f64;
            let (first, last) = ((low[axis] * length).round(), ((high[axis] * length).round() - 1.0).min(length - 1.0));
            let x = at[axis] * length - 0.5;
            shares[axis] = (x - x.floor()) as f32;
            let held = |texel: f64| texel.min(last).max(first).max(0.0) as usize;
            texels[axis] = [held(x.floor()), held(x.floor() + 1.0)];
        }
        let mut sum = [0.0; 3];
        for (j, y) in texels[1].into_iter().enumerate() {
            for (i, x) in texels[0].into_iter().enumerate() {
                let share = |axis: usize, upper: usize| if upper == 1 { shares[axis] } else { 1.0 - shares[axis] };
                let (weight, value) = (share(0, i) * share(1, j), self.rgb[y * self.width + x]);
                for (s, v) in sum.iter_mut().zip(value) {
                    *s += weight * v;
                }
            }
        }
        sum
    }
}

/// The place on the unit disc (right, down) at which a ball or an angular map shows a direction.
fn disc(format: DomeFormat, [x, y, z]: [f64; 3]) -> [f64; 2] {
    let angle = z.clamp(-1.0, 1.0).acos();
    let radius = match format {
        DomeFormat::Angular => angle / PI,
        // The ball's normal halves the angle between the direction and the camera.
        _ => (0.5 * angle).sin(),
    };
    let across = (x * x + y * y).sqrt();
    if across < 1e-12 { [radius, 0.0] } else { [x / across * radius, -y / across * radius] }
}
