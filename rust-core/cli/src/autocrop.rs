//! `--autocrop`: the part of a picture that shows something.

use gonio::{
    Error, Result,
    film::{Image, Layer},
    scene::{Aov, Crop},
};
use gonio_usd::render_variable::aov_by_name;

/// Limits all layers to the box around what is not zero in the layers named; a picture of nothing keeps one pixel.
pub(super) fn crop(image: &mut Image, names: &[String]) -> Result<()> {
    if names.is_empty() {
        return Ok(());
    }
    let looked_at: Vec<usize> = (0..image.layers.len()).filter(|&at| names.iter().any(|name| is_named(&image.layers[at], name))).collect();
    if looked_at.is_empty() {
        let there: Vec<&str> = image.layers.iter().map(|layer| layer.name.as_str()).collect();
        return Err(Error::setting(
            "autocrop",
            format!("'{}' was found, expected passes of the picture: {}", names.join(","), there.join(", ")),
        ));
    }
    let size = image.size();
    let boxes = looked_at.iter().filter_map(|&at| bounds(&image.layers[at], names, size));
    let [min, max] = boxes.reduce(joined).unwrap_or([[0, 0], [1, 1]]);
    for layer in &mut image.layers {
        layer.values = part(layer, size[0], min, max);
    }
    let at = |corner: [usize; 2]| [0, 1].map(|axis| image.window.min[axis] + corner[axis] as u32);
    image.window = Crop { min: at(min), max: at(max) };
    Ok(())
}

/// Whether husk's or gonio's name means the layer; C and A are both in the colour.
fn is_named(layer: &Layer, name: &str) -> bool {
    let name = name.trim();
    name == "*"
        || layer.name == name
        || matches!(aov_by_name(name), Some(aov) if aov == layer.aov || aov == Aov::Alpha && layer.aov == Aov::Color)
}

/// First pixel and the one behind the last that are not zero, if there are any.
fn bounds(layer: &Layer, names: &[String], [width, _]: [usize; 2]) -> Option<[[usize; 2]; 2]> {
    // Coverage alone tells where a black surface stands.
    let is_coverage_alone = layer.aov == Aov::Color && names.iter().all(|name| aov_by_name(name.trim()) == Some(Aov::Alpha));
    let first = if is_coverage_alone { layer.channels.saturating_sub(1) } else { 0 };
    let mut found: Option<[[usize; 2]; 2]> = None;
    for (number, pixel) in layer.values.chunks_exact(layer.channels).enumerate() {
        if pixel[first..].iter().any(|value| *value != 0.0 && value.is_finite()) {
            let at = [number % width, number / width];
            let one = [at, at.map(|x| x + 1)];
            found = Some(found.map_or(one, |found| joined(found, one)));
        }
    }
    found
}

fn joined([a, b]: [[usize; 2]; 2], [c, d]: [[usize; 2]; 2]) -> [[usize; 2]; 2] {
    [[a[0].min(c[0]), a[1].min(c[1])], [b[0].max(d[0]), b[1].max(d[1])]]
}

fn part(layer: &Layer, width: usize, min: [usize; 2], max: [usize; 2]) -> Vec<f32> {
    let row = |y: usize| &layer.values[(y * width + min[0]) * layer.channels..(y * width + max[0]) * layer.channels];
    (min[1]..max[1]).flat_map(row).copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio::film::{Backdrop, Frame};

    #[test]
    fn what_is_empty_around_is_left_out() {
        let mut values = vec![0.0; 5 * 4 * 4];
        values[(5 + 2) * 4 + 1] = 1.0;
        values[(2 * 5 + 3) * 4 + 3] = 0.5;
        let layer = Layer { aov: Aov::Color, name: "color".into(), values, channels: 4 };
        let window = Crop { min: [10, 20], max: [15, 24] };
        let (frame, backdrop, manifests) = (Frame::default(), Backdrop::default(), Default::default());
        let image = Image {
            resolution: [64, 64],
            window,
            frame,
            backdrop,
            layers: vec![layer],
            samples: 1,
            mean_samples: 1.0,
            manifests,
            deep: None,
        };
        let mut whole = image.clone();
        crop(&mut whole, &["C".into()]).expect("there");
        assert_eq!(whole.window, Crop { min: [12, 21], max: [14, 23] });
        assert_eq!(whole.layers[0].values.len(), 2 * 2 * 4);
        let mut coverage = image.clone();
        crop(&mut coverage, &["A".into()]).expect("there");
        assert_eq!(coverage.window, Crop { min: [13, 22], max: [14, 23] });
        assert!(crop(&mut image.clone(), &["nothing".into()]).is_err());
    }
}
