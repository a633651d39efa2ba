//! Display values against the formulas in double precision, at every level.

use super::*;
use crate::{
    film::{Backdrop, Frame, Layer},
    scene::Crop,
};

/// Half an 8-bit step, and what single precision may add.
const HALF_STEP: f64 = 0.502;

fn picture(pixels: &[[f32; 3]], width: u32) -> Image {
    let values = pixels.iter().flat_map(|[r, g, b]| [*r, *g, *b, 1.0]).collect();
    let resolution = [width, pixels.len() as u32 / width];
    let layers = vec![Layer { aov: Aov::Color, name: "color".into(), values, channels: 4 }];
    Image {
        resolution,
        window: Crop { min: [0, 0], max: resolution },
        frame: Frame::default(),
        backdrop: Backdrop::default(),
        layers,
        samples: 1,
        mean_samples: 1.0,
        manifests: Default::default(),
        deep: None,
    }
}

fn grey(values: &[f32]) -> Image {
    picture(&values.iter().map(|v| [*v; 3]).collect::<Vec<_>>(), values.len() as u32)
}

/// Colours over six decades, some black, some out of all gamuts.
fn colours(count: u32) -> Vec<[f32; 3]> {
    let mut state = 7_u32;
    let mut uniform = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / 16_777_216.0
    };
    let mut one = || if uniform() < 0.02 { 0.0 } else { 10_f32.powf(6.0 * uniform() - 3.0) };
    (0..count).map(|_| [one(), one(), one()]).collect()
}

fn luminance(c: [f64; 3]) -> f64 {
    0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]
}

/// The formulas.
fn exact(colour: [f32; 3], look: &Look, average: f64) -> [f64; 3] {
    let exposure = match look.tone_map {
        ToneMap::None => 1.0,
        ToneMap::Ev100(ev) => 1.0 / (1.2 * f64::from(ev).exp2()),
        ToneMap::Photographic | ToneMap::Local => 0.18 / average,
    };
    let mut c = colour.map(|x| f64::from(x).max(0.0) * exposure * f64::from(look.stops).exp2());
    let (peak, white, y) = (f64::from(look.space.peak()), f64::from(look.white), luminance(c));
    if look.tone_map == ToneMap::Photographic {
        let rise = (peak * (1.0 + white) / white - 1.0) / white;
        c = c.map(|x| x * (1.0 + rise * y) / (1.0 + y));
    }
    let turned = |m: &[[f32; 3]; 3]| m.map(|row| (0..3).map(|k| f64::from(row[k]) * c[k]).sum::<f64>());
    let srgb = |x: f64| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    let pq = |x: f64| {
        let p = (x * 203.0 / 10_000.0).clamp(0.0, 1.0).powf(2610.0 / 16_384.0);
        ((3424.0 / 4096.0 + 2413.0 / 128.0 * p) / (1.0 + 2392.0 / 128.0 * p)).powf(2523.0 / 32.0)
    };
    match look.space {
        DisplaySpace::Srgb => c.map(|x| srgb(x.min(1.0))),
        DisplaySpace::DisplayP3 => turned(&DisplaySpace::TO_DISPLAY_P3).map(|x| srgb(x.min(1.0))),
        DisplaySpace::Rec2020Pq => turned(&DisplaySpace::TO_REC2020).map(pq),
    }
}

#[test]
fn every_operator_and_space_is_within_half_a_step_at_every_level() {
    let colours = colours(3000);
    let image = picture(&colours, 100);
    let operators = [ToneMap::None, ToneMap::Photographic, ToneMap::Ev100(3.0)];
    let spaces = [DisplaySpace::Srgb, DisplaySpace::DisplayP3, DisplaySpace::Rec2020Pq];
    for (tone_map, space) in operators.into_iter().flat_map(|operator| spaces.map(|space| (operator, space))) {
        for look in [Look { tone_map, space, ..Look::default() }, Look { tone_map, space, stops: -1.5, white: 20.0, adapted: Some(3.0) }] {
            for execution in Execution::all() {
                let average = look.adapted.map_or_else(|| f64::from(log_average(&image, execution)), f64::from);
                let (bytes, words) = (display(&image, &look, execution), display_deep(&image, &look, execution));
                for (index, colour) in colours.iter().enumerate() {
                    let exact = exact(*colour, &look, average);
                    for (channel, exact) in exact.iter().enumerate() {
                        let at = 4 * index + channel;
                        assert!((f64::from(bytes[at]) - 255.0 * exact).abs() <= HALF_STEP, "{colour:?} {look:?} {}", execution.name());
                        assert!((f64::from(words[at]) / 65_535.0 - exact).abs() <= 5e-5, "{colour:?} {look:?} {}", execution.name());
                    }
                }
            }
        }
    }
}

#[test]
fn linear_light_is_what_the_display_shows() {
    let image = picture(&colours(3000), 100);
    let shown = |x: f32| if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 };
    for tone_map in [ToneMap::None, ToneMap::Photographic, ToneMap::Local, ToneMap::Ev100(3.0)] {
        // The space is the host's.
        let look = Look { tone_map, space: DisplaySpace::Rec2020Pq, ..Look::default() };
        for execution in Execution::all() {
            let bytes = display(&image, &Look { space: DisplaySpace::Srgb, ..look }, execution);
            let linear = display_linear(&image, &look, execution);
            assert_eq!(linear.len(), bytes.len());
            for (byte, linear) in bytes.iter().zip(linear) {
                assert!((f32::from(*byte) - 255.0 * shown(linear)).abs() <= 0.51, "{byte} {linear} {tone_map:?} {}", execution.name());
            }
        }
    }
}

#[test]
fn the_average_is_that_of_the_formula_at_every_level() {
    let colours = colours(10_007);
    let image = picture(&colours, 10_007);
    let blocks = colours.chunks(16).map(|block| block.iter().map(|c| luminance(c.map(f64::from))).sum::<f64>() / block.len() as f64);
    let (sum, count) = blocks.filter(|mean| *mean > 1e-9).fold((0.0, 0.0), |(sum, count), mean| (sum + mean.ln(), count + 1.0));
    for execution in Execution::all() {
        let found = f64::from(log_average(&image, execution));
        assert!((found / (sum / count).exp() - 1.0_f64).abs() < 1e-5, "{found} at {}", execution.name());
    }
    assert_eq!(log_average(&grey(&[0.0; 20]), Execution::best()), KEY);
}

#[test]
fn photographic_mapping_does_not_depend_on_the_unit() {
    let values: Vec<f32> = (1..200u16).map(|i| f32::from(i) * 0.01).collect();
    let scaled: Vec<f32> = values.iter().map(|v| v * 4096.0).collect();
    for tone_map in [ToneMap::Photographic, ToneMap::Local] {
        let show = |values: &[f32]| display(&grey(values), &Look { tone_map, ..Look::default() }, Execution::best());
        for (a, b) in show(&values).iter().zip(show(&scaled)) {
            assert!(a.abs_diff(b) <= 1);
        }
    }
}

#[test]
fn white_is_white() {
    for (space, expected) in [(DisplaySpace::Srgb, 255.0), (DisplaySpace::DisplayP3, 255.0), (DisplaySpace::Rec2020Pq, 255.0 * 0.7518)] {
        // 1000 cd/m² are 0.7518 of PQ's curve.
        let look = Look { white: 11.0, adapted: Some(0.18), space, ..Look::default() };
        let bytes = display(&grey(&[11.0]), &look, Execution::best());
        assert!((f64::from(bytes[0]) - expected).abs() < 0.6, "{space:?} {bytes:?}");
    }
}

#[test]
fn the_local_operator_is_the_global_one_where_all_is_even() {
    let even = picture(&[[3.0, 2.0, 1.0]; 70 * 9], 70);
    let show = |tone_map| display(&even, &Look { tone_map, adapted: Some(0.5), ..Look::default() }, Execution::best());
    let (local, global) = (show(ToneMap::Local), show(ToneMap::Photographic));
    assert!(local.iter().zip(global).all(|(a, b)| a.abs_diff(b) <= 1));
}

#[test]
fn the_local_operator_keeps_detail_in_bright_surroundings() {
    // Stripes of 20 % contrast, dark on the left, a thousand times as bright on the right.
    let pixel = |i: usize| (if i % 64 < 32 { 0.1 } else { 100.0 }) * (if i % 4 < 2 { 1.0 } else { 1.2 });
    let image = picture(&(0..64 * 64).map(|i| [pixel(i); 3]).collect::<Vec<_>>(), 64);
    for execution in Execution::all() {
        let contrast = |tone_map| {
            let bytes = display(&image, &Look { tone_map, white: 1e4, ..Look::default() }, execution);
            let at = |x: usize| i32::from(bytes[4 * (32 * 64 + x)]);
            at(50) - at(48)
        };
        let (local, global) = (contrast(ToneMap::Local), contrast(ToneMap::Photographic));
        assert!(local > 2 * global.max(1), "{local} and {global} at {}", execution.name());
    }
}

#[test]
fn eyes_adapt_in_their_time() {
    let mut eye = Adaptation::new(2.0);
    assert_eq!(eye.follow(10.0, 1.0), 10.0);
    let after = f64::from(eye.follow(1000.0, 3.0));
    assert!((after.ln() - (10_f64.ln() + (1.0 - (-1.0_f64).exp()) * 100_f64.ln())).abs() < 1e-6);
    assert_eq!(Adaptation::new(0.0).follow(5.0, 0.0), 5.0);
    let (mut quick, mut still) = (Adaptation::new(0.0), Adaptation::new(f64::INFINITY));
    for (level, time) in [(1.0, 0.0), (100.0, 1.0), (7.0, 2.0)] {
        assert!((quick.follow(level, time) / level - 1.0).abs() < 1e-6);
        assert_eq!(still.follow(level, time), 1.0);
    }
}

#[test]
fn not_a_number_shows_black() {
    let bytes = display(&grey(&[f32::NAN, 0.5]), &Look { tone_map: ToneMap::None, ..Look::default() }, Execution::best());
    assert!(bytes[4] > 100);
}

#[test]
fn names_of_operators_and_spaces() {
    assert_eq!(ToneMap::by_name("ev100=12.5").ok(), Some(ToneMap::Ev100(12.5)));
    assert_eq!(ToneMap::by_name("local").ok(), Some(ToneMap::Local));
    assert!(ToneMap::by_name("ev100=nan").is_err() && ToneMap::by_name("filmic").is_err());
    assert_eq!(DisplaySpace::by_name("rec2020-pq").ok(), Some(DisplaySpace::Rec2020Pq));
    assert!(DisplaySpace::by_name("p3").is_err());
}
