//! From scene-linear light to display values, on lanes.

use crate::{film::Image, scene::Aov};
use gonio_simd::{Execution, F, Lanes, Rgb, dispatch, padded};

/// How radiance becomes display values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ToneMap {
    /// The sRGB curve alone, values above one clipped.
    None,
    /// The photographic operator (Reinhard et al. 2002) on the log-average luminance.
    #[default]
    Photographic,
    /// A fixed exposure: luminance 1.2 · 2^EV100 becomes white, then as `None`.
    Ev100(f32),
}

/// Grey that the log-average luminance is brought to.
pub(crate) const KEY: f32 = 0.18;
/// Multiple of the key at which the photographic operator reaches white.
pub(crate) const WHITE: f32 = 6.0;

/// The colour pass as 8-bit sRGB RGBA, rows from the top; `stops` brightens by powers of two.
pub fn display(image: &Image, tone_map: ToneMap, stops: f32, execution: Execution) -> Vec<u8> {
    let Some(layer) = image.layer(Aov::Color) else { return Vec::new() };
    let pixels = layer.values.len() / 4;
    let mut channels: [Vec<f32>; 4] = std::array::from_fn(|c| layer.values.iter().skip(c).step_by(4).copied().collect());
    channels.iter_mut().for_each(|channel| channel.resize(padded(pixels), 0.0));
    let scale = stops.exp2()
        * match tone_map {
            ToneMap::None => 1.0,
            ToneMap::Photographic => KEY / log_average(&channels, pixels),
            ToneMap::Ev100(ev) => 1.0 / (1.2 * ev.exp2()),
        };
    let compress = tone_map == ToneMap::Photographic;
    dispatch!(execution, l => map_batch(l, &mut channels, scale, compress));
    let byte = |x: f32| (x * 255.0 + 0.5) as u8;
    (0..pixels).flat_map(|i| [byte(channels[0][i]), byte(channels[1][i]), byte(channels[2][i]), byte(channels[3][i])]).collect()
}

/// The geometric mean of the luminance of a low-resolution copy: blocks of pixels first averaged, black ones left out.
fn log_average(channels: &[Vec<f32>; 4], pixels: usize) -> f32 {
    const BLOCK: usize = 16;
    let luminance = |i: usize| 0.2126 * f64::from(channels[0][i]) + 0.7152 * f64::from(channels[1][i]) + 0.0722 * f64::from(channels[2][i]);
    let (mut sum, mut count) = (0.0, 0.0);
    for first in (0..pixels).step_by(BLOCK) {
        let last = (first + BLOCK).min(pixels);
        let mean = (first..last).map(luminance).sum::<f64>() / (last - first) as f64;
        if mean > 1e-9 && mean.is_finite() {
            sum += mean.ln();
            count += 1.0;
        }
    }
    if count > 0.0 { (sum / count).exp() as f32 } else { KEY }
}

#[inline(always)]
fn map_batch<L: Lanes>(l: L, channels: &mut [Vec<f32>; 4], scale: f32, compress: bool) {
    let [red, green, blue, alpha] = channels;
    for at in (0..red.len()).step_by(L::COUNT) {
        let colour = Rgb::new(l.load(red, at), l.load(green, at), l.load(blue, at));
        map_lanes(colour, scale, compress).store([red, green, blue], at);
        l.load(alpha, at).saturate().store(alpha, at);
    }
}

/// Display values in [0, 1] of a register of scene-linear colours.
#[inline(always)]
pub(crate) fn map_lanes<L: Lanes>(colour: Rgb<L>, scale: f32, compress: bool) -> Rgb<L> {
    let mut colour = colour.max(0.0) * scale;
    if compress {
        let y = colour.luminance();
        let factor = (y * (1.0 / (WHITE * WHITE)) + 1.0) / (y + 1.0);
        colour = colour * factor;
    }
    Rgb::new(srgb(colour.r), srgb(colour.g), srgb(colour.b))
}

/// The sRGB curve (IEC 61966-2-1) of a value clipped to [0, 1].
#[inline(always)]
fn srgb<L: Lanes>(x: F<L>) -> F<L> {
    let x = x.saturate();
    x.lt(0.003_130_8).select(x * 12.92, x.max(1e-8).pow(1.0 / 2.4).mul_add(1.055, -0.055))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{film::Layer, scene::Crop};

    fn grey(values: &[f32]) -> Image {
        let values: Vec<f32> = values.iter().flat_map(|v| [*v, *v, *v, 1.0]).collect();
        let width = (values.len() / 4) as u32;
        let window = Crop { min: [0, 0], max: [width, 1] };
        Image {
            resolution: [width, 1],
            window,
            layers: vec![Layer { aov: Aov::Color, name: "color".into(), values, channels: 4 }],
            samples: 1,
            mean_samples: 1.0,
        }
    }

    #[test]
    fn plain_display_is_the_srgb_curve_at_every_level() {
        let values: Vec<f32> = (0..=1000u16).map(|i| f32::from(i) / 1000.0).collect();
        for execution in Execution::all() {
            let bytes = display(&grey(&values), ToneMap::None, 0.0, execution);
            for (value, pixel) in values.iter().zip(bytes.chunks_exact(4)) {
                let v = f64::from(*value);
                let exact = 255.0 * if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
                assert!((f64::from(pixel[0]) - exact).abs() <= 0.501, "{value} at {}", execution.name());
            }
        }
    }

    #[test]
    fn photographic_mapping_does_not_depend_on_the_unit() {
        let values: Vec<f32> = (1..200u16).map(|i| f32::from(i) * 0.01).collect();
        let scaled: Vec<f32> = values.iter().map(|v| v * 4096.0).collect();
        let show = |values: &[f32]| display(&grey(values), ToneMap::Photographic, 0.0, Execution::best());
        for (a, b) in show(&values).iter().zip(show(&scaled)) {
            assert!(a.abs_diff(b) <= 1);
        }
    }

    #[test]
    fn not_a_number_shows_black() {
        let bytes = display(&grey(&[f32::NAN, 0.5]), ToneMap::None, 0.0, Execution::best());
        assert!(bytes[4] > 100);
    }
}
