//! Comparing two images: relative mean squared error, and differences of block means that noise does not hide.

use std::collections::BTreeMap;

/// How a channel differs.
#[derive(Clone, Debug, PartialEq)]
pub struct ChannelDifference {
    /// The channel's name.
    pub name: String,
    /// Mean of (a − b)² / (b² + 1 % of the mean of b²).
    pub relative_mse: f64,
    /// Largest |a − b|.
    pub largest: f64,
    /// Means of a and of b.
    pub means: [f64; 2],
    /// Median and 95th percentile of the block differences.
    pub blocks: [f64; 2],
    /// Pixels in which exactly one image is not finite.
    pub not_finite: usize,
}

/// A comparison of all channels that both images have.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Channel by channel.
    pub channels: Vec<ChannelDifference>,
    /// Names that only one image has.
    pub unmatched: Vec<String>,
}

impl Comparison {
    /// The largest 95th percentile of block differences.
    pub fn worst(&self) -> f64 {
        self.channels.iter().map(|c| if c.not_finite > 0 { f64::INFINITY } else { c.blocks[1] }).fold(0.0, f64::max)
    }
}

/// Side of a block in pixels.
const BLOCK: usize = 16;

/// Compares `a` with the reference `b`, both `width` × `height`.
///
/// The block difference is |Δ| / (reference + 1 % of the image mean) over means of 16 × 16 pixels.
pub fn compare(a: &[(String, Vec<f32>)], b: &[(String, Vec<f32>)], width: usize, height: usize) -> Comparison {
    let known: BTreeMap<&str, &[f32]> = b.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect();
    let mut channels = Vec::new();
    let mut unmatched: Vec<String> = b.iter().map(|(name, _)| name.clone()).filter(|n| !a.iter().any(|(m, _)| m == n)).collect();
    for (name, values) in a {
        match known.get(name.as_str()) {
            Some(reference) => channels.push(channel(name, values, reference, width, height)),
            None => unmatched.push(name.clone()),
        }
    }
    Comparison { channels, unmatched }
}

fn channel(name: &str, a: &[f32], b: &[f32], width: usize, height: usize) -> ChannelDifference {
    let pairs = || a.iter().zip(b).map(|(a, b)| (f64::from(*a), f64::from(*b)));
    let finite = || pairs().filter(|(a, b)| a.is_finite() && b.is_finite());
    let n = finite().count().max(1) as f64;
    let mean_square = finite().map(|(_, b)| b * b).sum::<f64>() / n;
    let floor = (0.01 * mean_square).max(f64::MIN_POSITIVE);
    ChannelDifference {
        name: name.to_owned(),
        relative_mse: finite().map(|(a, b)| (a - b).powi(2) / (b * b + floor)).sum::<f64>() / n,
        largest: finite().map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
        means: [finite().map(|(a, _)| a).sum::<f64>() / n, finite().map(|(_, b)| b).sum::<f64>() / n],
        blocks: blocks(a, b, width, height),
        not_finite: pairs().filter(|(a, b)| a.is_finite() != b.is_finite()).count(),
    }
}

fn blocks(a: &[f32], b: &[f32], width: usize, height: usize) -> [f64; 2] {
    let mean = |values: &[f32], x0: usize, y0: usize| {
        let (x1, y1) = ((x0 + BLOCK).min(width), (y0 + BLOCK).min(height));
        let sum: f64 = (y0..y1).flat_map(|y| &values[y * width + x0..y * width + x1]).map(|v| f64::from(*v)).sum();
        sum / ((x1 - x0) * (y1 - y0)) as f64
    };
    let image_mean = b.iter().map(|v| f64::from(v.abs())).sum::<f64>() / b.len().max(1) as f64;
    let mut differences = Vec::new();
    for y in (0..height).step_by(BLOCK) {
        for x in (0..width).step_by(BLOCK) {
            let (found, reference) = (mean(a, x, y), mean(b, x, y));
            let scale = reference.abs() + 0.01 * image_mean;
            differences.push(if scale > 0.0 { (found - reference).abs() / scale } else { 0.0 });
        }
    }
    differences.retain(|d| d.is_finite());
    differences.sort_by(f64::total_cmp);
    let quantile = |q: f64| differences.get(((differences.len() as f64 - 1.0) * q).round().max(0.0) as usize).copied().unwrap_or(0.0);
    [quantile(0.5), quantile(0.95)]
}

/// Where the images differ: red where `a` is brighter, blue where it is darker, full at 10 % of the reference; 8-bit RGBA.
pub fn difference_picture(a: &[(String, Vec<f32>)], b: &[(String, Vec<f32>)]) -> Vec<u8> {
    let luminance = |image: &[(String, Vec<f32>)], i: usize| {
        let value = |name: &str| image.iter().find(|(n, _)| n == name).map_or(0.0, |(_, v)| f64::from(v[i]));
        crate::colour::luminance(["R", "G", "B"].map(value))
    };
    let pixels = a.first().map_or(0, |(_, v)| v.len()).min(b.first().map_or(0, |(_, v)| v.len()));
    let mean = (0..pixels).map(|i| luminance(b, i)).sum::<f64>() / pixels.max(1) as f64;
    (0..pixels)
        .flat_map(|i| {
            let (found, reference) = (luminance(a, i), luminance(b, i));
            let relative = (found - reference) / (reference.abs() + 0.01 * mean).max(1e-30);
            let strength = (relative.abs() * 10.0).min(1.0) * 255.0;
            if relative > 0.0 { [strength as u8, 0, 0, 255] } else { [0, 0, strength as u8, 255] }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_images_do_not_differ() {
        let image = vec![("R".to_owned(), vec![0.5; 1024])];
        let comparison = compare(&image, &image, 32, 32);
        assert_eq!(comparison.worst(), 0.0);
        assert_eq!(comparison.channels[0].relative_mse, 0.0);
    }

    #[test]
    fn a_constant_factor_shows_in_every_block() {
        let a = vec![("R".to_owned(), vec![1.1; 1024])];
        let b = vec![("R".to_owned(), vec![1.0; 1024])];
        let [median, _] = compare(&a, &b, 32, 32).channels[0].blocks;
        assert!((median - 0.1 / 1.01).abs() < 1e-6);
    }

    #[test]
    fn names_without_a_partner_are_told() {
        let a = vec![("R".to_owned(), vec![1.0; 256]), ("depth.Z".to_owned(), vec![1.0; 256])];
        let b = vec![("R".to_owned(), vec![1.0; 256])];
        assert_eq!(compare(&a, &b, 16, 16).unmatched, ["depth.Z"]);
    }
}
