//! Against closed forms of uniform disks.

use super::*;
use crate::film::PictureView;

const SIDE: usize = 800;
const FISHEYES: [&str; 3] = ["equidistant", "equisolid", "hemispherical"];

fn view(projection: &str) -> EyeView {
    sized(projection, 180.0, [SIDE; 2])
}

fn sized(projection: &str, fov_deg: f64, size: [usize; 2]) -> EyeView {
    let picture = PictureView::by_name(projection, fov_deg, size[0] as f64 / size[1] as f64).expect("a picture");
    EyeView::new(picture, size).expect("a view")
}

/// From so many cd/m² on.
fn from(threshold: f64) -> GlareOptions {
    GlareOptions { threshold: Threshold::Luminance(threshold), ..GlareOptions::default() }
}

/// A disk of a half angle around a direction, `inside` bright on a background.
fn picture(view: &EyeView, middle: [f64; 3], half_deg: f64, inside: f32, background: f32) -> Vec<f32> {
    let [width, height] = view.size();
    let value = |index: usize| {
        let Some(pixel) = view.pixel([index % width, index / width]) else { return f32::NAN };
        let cosine: f64 = (0..3).map(|i| pixel.direction[i] * middle[i]).sum();
        if cosine > half_deg.to_radians().cos() { inside } else { background }
    };
    (0..width * height).map(value).collect()
}

fn up(degrees: f64) -> [f64; 3] {
    [0.0, degrees.to_radians().sin(), degrees.to_radians().cos()]
}

#[test]
fn a_uniform_hemisphere_is_two_pi_wide_and_brings_pi_l() {
    for projection in FISHEYES {
        let view = view(projection);
        let solid_angle: f64 = (0..SIDE * SIDE).filter_map(|i| view.pixel([i % SIDE, i / SIDE])).map(|pixel| pixel.solid_angle).sum();
        // The circle's edge is cut into whole pixels, where an orthographic view crowds its solid angle.
        let tolerance = if projection == "hemispherical" { 3e-2 } else { 1e-3 };
        assert!((solid_angle / (2.0 * PI) - 1.0).abs() < tolerance, "{projection:?}: {solid_angle}");
        let glare = Glare::new(&vec![100.0; SIDE * SIDE], &view, &GlareOptions::default()).expect("a picture");
        let eye = glare.eye_illuminance.expect("a hemisphere");
        assert!((eye / (100.0 * PI) - 1.0).abs() < 1e-3 && glare.seen == 1.0, "{projection:?}: {eye}");
        assert!(glare.sources.is_empty() && glare.ugr().is_none());
        // Without sources: 5.87e-5 · 314.16 + 0.16.
        assert!((glare.dgp().expect("known") - 0.178_441).abs() < 2e-5);
    }
}

#[test]
fn a_disk_ahead_gives_the_hand_computed_ugr_and_dgp() {
    // L = 20,000 cd/m² within 5° of 20° above the line of sight, 50 cd/m² around.
    let (half, elevation, bright, dim) = (5f64.to_radians(), 20.0, 20_000.0, 50.0);
    for projection in ["equidistant", "equisolid"] {
        let view = view(projection);
        let glare =
            Glare::new(&picture(&view, up(elevation), 5.0, bright as f32, dim as f32), &view, &GlareOptions::default()).expect("a picture");
        let found = glare.eye_illuminance.expect("a hemisphere");
        let [source] = glare.sources[..] else { panic!("{} sources", glare.sources.len()) };
        let solid_angle = 2.0 * PI * (1.0 - half.cos());
        assert!((source.solid_angle / solid_angle - 1.0).abs() < 5e-3, "{projection:?}: {}", source.solid_angle);
        assert!((source.luminance / bright - 1.0).abs() < 1e-6);
        // σ = 20°, τ = 0: ln P = (35.2 − 1.22) 10⁻³ · 20 + 21·10⁻⁵ · 400 = 0.6796 + 0.084.
        let index = 0.7636f64.exp();
        assert!((source.position_index / index - 1.0).abs() < 2e-3, "{}", source.position_index);
        // E of a disk: π L sin² half · cos elevation; the rest of the hemisphere brings π L_dim.
        let of_disk = |luminance: f64| PI * luminance * half.sin().powi(2) * 20f64.to_radians().cos();
        let eye = of_disk(bright - dim) + PI * dim;
        assert!((found / eye - 1.0).abs() < 5e-3, "{found}");
        let background = (eye - of_disk(bright)) / PI;
        let strength = bright * bright * solid_angle;
        // CIE 117's table at T/R = 0, H/R = tan 20° = 0.364: between 1.90 and 2.35.
        let cie = 1.9 + (20f64.to_radians().tan() - 0.3) * 4.5;
        assert!((source.cie_position_index().expect("an index") / cie - 1.0).abs() < 2e-3);
        let ugr = 8.0 * (0.25 / background * strength / (cie * cie)).log10();
        assert_eq!(glare.coverage().note(), None);
        let sum = strength / (index * index);
        assert!((glare.ugr().expect("a source") - ugr).abs() < 0.05, "{:?} instead of {ugr}", glare.ugr());
        let dgp = 5.87e-5 * eye + 0.0918 * (1.0 + sum / eye.powf(1.87)).log10() + 0.16;
        assert!((glare.dgp().expect("known") - dgp).abs() < 1e-3, "{:?} instead of {dgp}", glare.dgp());
    }
}

#[test]
fn the_position_index_of_daylight_is_evalglares() {
    assert!((position_index([0.0, 0.0, 1.0]) - 1.0).abs() < 1e-12);
    // To the side: τ = 90°, σ = 30°: (35.2 − 28.7001 − 0) 10⁻³ · 30 + (21 + 24.0003 − 24.0003) 10⁻⁵ · 900 = 0.194997 + 0.189.
    let side = [30f64.to_radians().sin(), 0.0, 30f64.to_radians().cos()];
    assert!((position_index(side) - 0.383_997f64.exp()).abs() < 1e-3, "{}", position_index(side));
    // Below: what evalglare 3.06 prints, for τ and σ in degrees, of disks of a degree.
    for (tau, sigma, printed) in [
        (180.0, 10.0, 1.1076),
        (180.0, 30.0, 1.5771),
        (180.0, 50.0, 2.6148),
        (180.0, 70.0, 4.8304),
        (135.0, 40.0, 1.9129),
        (100.0, 40.0, 1.8158),
        (180.0, 85.0, 8.1859),
        (60.0, 40.0, 2.8822),
    ] {
        let (t, s) = (f64::to_radians(tau), f64::to_radians(sigma));
        let found = position_index([s.sin() * t.sin(), s.sin() * t.cos(), s.cos()]);
        assert!((found / printed - 1.0).abs() < 7e-3, "{tau} {sigma}: {found} instead of {printed}");
    }
    // One curve at the horizon.
    assert!((position_index([0.6, -1e-9, 0.8]) / position_index([0.6, 1e-9, 0.8]) - 1.0).abs() < 1e-3);
    assert_eq!(position_index([0.0, -1.0, 0.0]), MOST_INDEX);
}

#[test]
fn sources_beyond_the_table_are_left_out_of_ugr_and_told() {
    let view = view("equidistant");
    let places = [[0.0, 20.0], [0.0, 75.0], [80.0, 0.0], [0.0, -20.0]];
    let mut all = vec![10.0f32; SIDE * SIDE];
    for [right, up] in places.map(|place| place.map(f64::to_radians)) {
        let middle = [right.sin() * up.cos(), up.sin(), right.cos() * up.cos()];
        all.iter_mut().zip(picture(&view, middle, 3.0, 9000.0, 0.0)).for_each(|(a, b)| *a = a.max(b));
    }
    let glare = Glare::new(&all, &view, &GlareOptions::default()).expect("a picture");
    let coverage = glare.coverage();
    assert_eq!((coverage.sources, coverage.high, coverage.aside, coverage.below), (4, 1, 1, 1));
    // By cosines: 0.94 rated of 0.94 + 0.26 + 0.17 + 0.94.
    assert!((coverage.share_left_out() - 1.373 / 2.313).abs() < 0.02, "{coverage:?}");
    let note = coverage.note().expect("a note");
    assert!(note.starts_with("3 of 4 sources left out (CIE 117): 1 too high"), "{note}");
    let [low] = glare.sources.iter().filter(|source| source.cie_position_index().is_some()).collect::<Vec<_>>()[..] else {
        panic!("{:?}", glare.sources)
    };
    let sum = low.luminance.powi(2) * low.solid_angle / low.cie_position_index().expect("an index").powi(2);
    let ugr = 8.0 * (0.25 / glare.background_luminance * sum).log10();
    assert!((glare.ugr().expect("a rating") - ugr).abs() < 1e-9);
    // Daylight glare knows them all.
    assert!(glare.sources.iter().all(|source| source.position_index >= 1.0));
}

const MOST_INDEX: f64 = 16.0;

#[test]
fn near_sources_are_one_and_far_ones_are_not() {
    let view = view("equidistant");
    // Gaps of 4, 10 and 26 degrees: 0.07, 0.17 and 0.45 radians.
    let two = |apart: f64| {
        let a = picture(&view, up(10.0), 2.0, 9000.0, 10.0);
        let b = picture(&view, up(10.0 + apart), 2.0, 9000.0, 10.0);
        a.iter().zip(b).map(|(a, b)| a.max(b)).collect::<Vec<_>>()
    };
    let count = |picture: &[f32], radius: f64| {
        Glare::new(picture, &view, &GlareOptions { radius, ..GlareOptions::default() }).expect("a picture").sources.len()
    };
    // The circle about a pixel opens by the radius, as evalglare's: half of it lies to each side.
    assert_eq!([8.0, 14.0, 30.0].map(|apart| count(&two(apart), 0.2)), [1, 2, 2]);
    assert_eq!([8.0, 14.0, 30.0].map(|apart| count(&two(apart), 0.4)), [1, 1, 2]);
    assert_eq!([count(&two(8.0), 0.0), count(&two(3.0), 0.0)], [2, 1]);
}

#[test]
fn peaks_of_a_source_are_sources_of_their_own() {
    let view = view("equidistant");
    // The sun in a window, and a second peak a long way off.
    let window = picture(&view, up(10.0), 20.0, 4000.0, 100.0);
    let sun = picture(&view, up(15.0), 2.5, 60_000.0, 0.0);
    let other = picture(&view, up(-5.0), 1.0, 70_000.0, 0.0);
    let all: Vec<f32> = (0..window.len()).map(|i| window[i].max(sun[i]).max(other[i])).collect();
    let found = |peak| Glare::new(&all, &view, &GlareOptions { peak, ..GlareOptions::default() }).expect("a picture");
    let [window, bright] = [found(None), found(Some(50_000.0))];
    assert_eq!((window.sources.len(), bright.sources.len()), (1, 3));
    let luminances: Vec<f64> = bright.sources.iter().map(|source| (source.luminance / 100.0).round() * 100.0).collect();
    let mut sorted = luminances.clone();
    sorted.sort_by(f64::total_cmp);
    assert_eq!(sorted, [4000.0, 60_000.0, 70_000.0], "{luminances:?}");
    // Σ L² ω / p² is that of the parts, not of their mean: the rating grows.
    assert!(bright.ugr().expect("sources") > window.ugr().expect("a source") + 2.0);
    assert!((bright.background_luminance - window.background_luminance).abs() < 1e-6);
}

#[test]
fn a_perspective_is_rated_by_its_own_projection() {
    // What both show is the same: sources and their position, and the light that they bring.
    let (flat, round) = (sized("perspective", 90.0, [960, 540]), view("equidistant"));
    let rated =
        |view: &EyeView, options: &GlareOptions| Glare::new(&picture(view, up(15.0), 4.0, 9000.0, 50.0), view, options).expect("a picture");
    let (a, b) = (rated(&flat, &from(2000.0)), rated(&round, &from(2000.0)));
    let ([one], [other]) = (&a.sources[..], &b.sources[..]) else { panic!("{} and {} sources", a.sources.len(), b.sources.len()) };
    assert!((one.solid_angle / other.solid_angle - 1.0).abs() < 1e-2, "{} and {}", one.solid_angle, other.solid_angle);
    assert!((one.position_index / other.position_index - 1.0).abs() < 4e-3);
    // ∫ cos over the rectangle of ±1 by ±9/16, by the exact form of a view factor, over π.
    let side = |x: f64, y: f64| x / (1.0 + x * x).sqrt() * (y / (1.0 + x * x).sqrt()).atan();
    let seen = 4.0 * 0.5 * (side(1.0, 0.5625) + side(0.5625, 1.0)) / PI;
    assert!((a.seen - seen).abs() < 1e-3, "{} instead of {seen}", a.seen);
    // What the eye gets is not known, so there is no DGP; the background is the mean of what is seen.
    assert_eq!((a.eye_illuminance, a.dgp(), a.dgp_low_light()), (None, None, None));
    assert!((a.background_luminance / 50.0 - 1.0).abs() < 0.05 && a.ugr().is_some(), "{}", a.background_luminance);
    let stated = rated(&flat, &GlareOptions { illuminance: b.eye_illuminance, ..from(2000.0) });
    assert!((stated.dgp().expect("stated") - b.dgp().expect("a hemisphere")).abs() < 1e-3);
    assert!((stated.ugr().expect("rated") - b.ugr().expect("rated")).abs() < 0.08);
}

#[test]
fn pictures_that_say_too_little_are_errors() {
    let whole = view("equisolid");
    assert!(Glare::new(&[1.0; 63], &sized("equisolid", 180.0, [8; 2]), &GlareOptions::default()).is_err());
    let narrow = Glare::new(&[1.0; 4096], &sized("equidistant", 120.0, [64; 2]), &GlareOptions::default()).expect("a picture");
    assert_eq!(narrow.dgp(), None);
    assert!((narrow.seen - 0.75).abs() < 0.02, "sin² 60°: {}", narrow.seen);
    for (name, fov) in [("hemispherical", 200.0), ("perspective", 180.0), ("equidistant", f64::NAN), ("mercator", 90.0)] {
        assert!(PictureView::by_name(name, fov, 1.0).is_err(), "{name} {fov}");
    }
    assert!(Glare::new(&[], &sized("equidistant", 180.0, [0; 2]), &GlareOptions::default()).is_err());
    let black = Glare::new(&vec![0.0; SIDE * SIDE], &whole, &GlareOptions::default()).expect("a picture");
    assert_eq!((black.sources.len(), black.dgp()), (0, Some(0.16)));
}

#[test]
fn options_that_are_none_are_errors_that_name_them() {
    let view = sized("equidistant", 180.0, [8; 2]);
    let default = GlareOptions::default();
    let problem = |options: GlareOptions| Glare::new(&[1.0; 64], &view, &options).expect_err("no options").to_string();
    for threshold in [Threshold::Luminance(f64::NAN), Threshold::Luminance(-1.0), Threshold::TimesMean(f64::INFINITY)] {
        assert!(problem(GlareOptions { threshold, ..default }).contains("threshold"));
    }
    for radius in [f64::NAN, -0.1, 7.0] {
        assert!(problem(GlareOptions { radius, ..default }).contains("radius"));
    }
    for wrong in [f64::NAN, -1.0, 0.0, f64::INFINITY] {
        assert!(problem(GlareOptions { peak: Some(wrong), ..default }).contains("peak"));
        assert!(problem(GlareOptions { illuminance: Some(wrong), ..default }).contains("illuminance"));
    }
}
