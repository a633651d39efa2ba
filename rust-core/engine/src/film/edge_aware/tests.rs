//! What the filter takes away and what it leaves.

use super::*;
use crate::{
    film::{Frame, Layer},
    scene::Crop,
};

const SIZE: [usize; 2] = [70, 50];

/// A picture by the pixel: colour, albedo and normal.
fn picture(mut pixel: impl FnMut(usize, usize) -> [[f32; 3]; 3]) -> Image {
    let mut layers = [(Aov::Color, 4), (Aov::DenoisingAlbedo, 3), (Aov::DenoisingNormal, 3)].map(|(aov, channels)| Layer {
        aov,
        name: aov.name().into(),
        values: Vec::new(),
        channels,
    });
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            for (layer, value) in layers.iter_mut().zip(pixel(x, y)) {
                layer.values.extend(value);
            }
            layers[0].values.push(x as f32 / SIZE[0] as f32);
        }
    }
    let resolution = SIZE.map(|side| side as u32);
    Image {
        resolution,
        window: Crop { min: [0, 0], max: resolution },
        frame: Frame::default(),
        backdrop: Default::default(),
        layers: layers.into(),
        samples: 1,
        mean_samples: 1.0,
        manifests: Default::default(),
        deep: None,
    }
}

/// Even numbers in [0, 1).
fn numbers() -> impl FnMut() -> f32 {
    let mut state = 7_u32;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    }
}

/// Red of the pixels of some columns.
fn red(colours: &[f32], columns: std::ops::Range<usize>) -> Vec<f32> {
    colours.chunks_exact(4 * SIZE[0]).flat_map(|row| columns.clone().map(|x| row[4 * x])).collect()
}

fn mean_and_deviation(values: &[f32]) -> (f32, f32) {
    let count = values.len() as f32;
    let mean = values.iter().sum::<f32>() / count;
    (mean, (values.iter().map(|v| (v - mean).powi(2)).sum::<f32>() / count).sqrt())
}

const UP: [f32; 3] = [0.0, 0.0, 1.0];
const ASIDE: [f32; 3] = [1.0, 0.0, 0.0];

#[test]
fn noise_goes_and_its_mean_stays_at_every_level() {
    let mut number = numbers();
    let noisy = picture(|_, _| [[0.5 + number(); 3], [0.5; 3], UP]);
    for execution in Execution::all() {
        let smooth = edge_aware(&noisy, execution).expect("all passes");
        let ((before, wide), (after, narrow)) =
            (mean_and_deviation(&red(&noisy.layers[0].values, 0..SIZE[0])), mean_and_deviation(&red(&smooth, 0..SIZE[0])));
        assert!((before - after).abs() < 0.02, "{before} became {after} at {}", execution.name());
        assert!(narrow < 0.2 * wide, "{wide} became {narrow} at {}", execution.name());
        assert!(smooth.chunks_exact(4).zip(noisy.layers[0].values.chunks_exact(4)).all(|(a, b)| a[3] == b[3]));
    }
}

#[test]
fn light_does_not_cross_from_surface_to_surface() {
    let mut number = numbers();
    // Noise as large as the light of the dark half a hundred times.
    let noisy = picture(|x, _| if x < 30 { [[1.0 + number(); 3], [0.5; 3], UP] } else { [[0.01; 3], [0.5; 3], ASIDE] });
    let smooth = edge_aware(&noisy, Execution::best()).expect("all passes");
    assert!(red(&smooth, 30..SIZE[0]).iter().all(|value| (value - 0.01).abs() < 1e-6));
    assert!(red(&smooth, 0..30).iter().all(|value| *value > 1.2));
}

#[test]
fn no_light_goes_to_where_nothing_is() {
    let mut number = numbers();
    // Samples of guides are others than those of light: beside an edge they may see a surface where light saw none.
    let mut noisy =
        picture(|x, _| if x < 30 { [[0.5 + number(); 3], [0.5; 3], UP] } else { [[0.0; 3], [0.5; 3], if x < 34 { UP } else { [0.0; 3] }] });
    for (index, pixel) in noisy.layers[0].values.chunks_exact_mut(4).enumerate() {
        pixel[3] = if index % SIZE[0] < 30 { 1.0 } else { 0.0 };
    }
    let smooth = edge_aware(&noisy, Execution::best()).expect("all passes");
    assert!(red(&smooth, 30..SIZE[0]).iter().all(|value| *value == 0.0));
}

#[test]
fn textures_stay() {
    let mut number = numbers();
    let albedo = |x: usize| 0.2 + 0.1 * (x % 5) as f32;
    let noisy = picture(|x, _| [[albedo(x) * (0.8 + 0.4 * number()); 3], [albedo(x); 3], UP]);
    let smooth = edge_aware(&noisy, Execution::best()).expect("all passes");
    for (x, value) in red(&smooth, 0..SIZE[0]).iter().enumerate() {
        let exact = albedo(x % SIZE[0]);
        assert!((value / exact - 1.0).abs() < 0.15, "{value} where {exact} was expected");
    }
}

#[test]
fn edges_of_shadows_stay() {
    // Slanted, with noise of a ninth of the step; two columns on either side are where it is seen as noise.
    let mut number = numbers();
    let lit = |x: usize, y: usize| 2 * x > y + 40;
    let noisy = picture(|x, y| [[if lit(x, y) { 1.0 } else { 0.1 } + 0.1 * (number() - 0.5); 3], [0.5; 3], UP]);
    let smooth = edge_aware(&noisy, Execution::best()).expect("all passes");
    for (y, row) in smooth.chunks_exact(4 * SIZE[0]).enumerate() {
        for x in (0..SIZE[0]).filter(|x| (2 * x).abs_diff(y + 40) > 4) {
            let exact = if lit(x, y) { 1.0 } else { 0.1 };
            assert!((row[4 * x] - exact).abs() < 0.1, "{} at {x}, {y} where {exact} was expected", row[4 * x]);
        }
    }
}

#[test]
fn what_is_no_number_stays_alone() {
    let broken = picture(|x, y| if (x, y) == (20, 20) { [[f32::NAN; 3], [f32::NAN; 3], UP] } else { [[0.5; 3], [0.5; 3], UP] });
    let smooth = edge_aware(&broken, Execution::best()).expect("all passes");
    assert!(smooth.iter().all(|value| value.is_finite()));
    assert!((smooth[4 * (20 * SIZE[0] + 22)] - 0.5).abs() < 1e-5);
}

#[test]
fn without_guides_there_is_nothing_to_go_by() {
    let mut picture = picture(|_, _| [[1.0; 3]; 3]);
    picture.layers.pop();
    assert_eq!(edge_aware(&picture, Execution::best()), None);
}
