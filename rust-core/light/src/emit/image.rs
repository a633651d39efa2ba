//! Images on lights, between their pixels: how much they send, and where.

use crate::dome::{LARGEST, cells};
use crate::record::LightTexture;
use gonio_table::Distribution2D;
use std::f64::consts::{PI, TAU};

/// Images of fewer rows are read between their pixels, to as many.
const FINE: usize = 256;
/// Share of the mean that each place of a rectangle keeps.
const FLOOR: f64 = 0.02;

/// The pixels around a place along one axis, and how far it is on the way from the first to the second.
fn between(place: f64, count: usize, wraps: bool) -> (usize, usize, f32) {
    let at = place * count as f64 - 0.5;
    let low = at.floor();
    let keep = |x: f64| if wraps { x.rem_euclid(count as f64) as usize } else { x.clamp(0.0, count as f64 - 1.0) as usize };
    (keep(low), keep(low + 1.0), (at - low) as f32)
}

/// A small image with more pixels, linear between those it had; `wraps` joins its left edge to the right one.
pub(super) fn refined(image: &LightTexture, wraps: bool) -> LightTexture {
    let parts = FINE.div_ceil(image.height.max(1));
    let (width, height) = (image.width * parts, image.height * parts);
    let mut rgb = Vec::with_capacity(3 * width * height);
    for y in 0..height {
        let (upper, lower, down) = between((y as f64 + 0.5) / height as f64, image.height, false);
        for x in 0..width {
            let (left, right, across) = between((x as f64 + 0.5) / width as f64, image.width, wraps);
            for k in 0..3 {
                let pixel = |x: usize, y: usize| image.rgb[3 * (y * image.width + x) + k];
                let line = |y: usize| pixel(left, y) * (1.0 - across) + pixel(right, y) * across;
                rgb.push(line(upper) * (1.0 - down) + line(lower) * down);
            }
        }
    }
    LightTexture { width, height, rgb }
}

/// Integral over the sphere of a fine latitude–longitude image by component, of magnitudes.
pub(super) fn over_sphere(image: &LightTexture) -> [f64; 3] {
    let height = image.height as f64;
    let mut sum = [0.0; 3];
    for (y, row) in image.rgb.chunks_exact(3 * image.width).enumerate() {
        let solid = (PI * y as f64 / height).cos() - (PI * (y + 1) as f64 / height).cos();
        let mean = mean(row);
        (0..3).for_each(|k| sum[k] += mean[k] * solid * TAU);
    }
    sum
}

/// Mean colour of some pixels, of magnitudes.
pub(super) fn mean(rgb: &[f32]) -> [f64; 3] {
    let pixels = rgb.as_chunks::<3>().0;
    let sum = pixels.iter().fold([0.0; 3], |sum, pixel| [0, 1, 2].map(|k| sum[k] + f64::from(pixel[k]).abs()));
    sum.map(|sum| sum / pixels.len().max(1) as f64)
}

/// Places on a rectangle by its image's luminance.
pub(super) fn by_luminance(image: &LightTexture) -> Distribution2D {
    let image = refined(image, false);
    let size = [image.width.min(LARGEST[0]), image.height.min(LARGEST[1])];
    let luminance = cells(&image, size);
    let floor = FLOOR * luminance.iter().sum::<f64>() / luminance.len().max(1) as f64;
    let weights: Vec<f32> = luminance.iter().map(|v| (v + floor) as f32).collect();
    Distribution2D::new(&weights, size[0])
}
