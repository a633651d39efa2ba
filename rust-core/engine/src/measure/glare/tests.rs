//! Against closed forms of uniform disks.

use super::*;

const SIDE: usize = 800;

fn view(projection: FisheyeProjection) -> FisheyeView {
    FisheyeView::new(projection, 180.0, [SIDE; 2]).expect("a view")
}

/// A disk of a half angle around a direction, `inside` bright on a background.
fn picture(view: &FisheyeView, middle: [f64; 3], half_deg: f64, inside: f32, background: f32) -> Vec<f32> {
    let value = |index: usize| {
        let Some(pixel) = view.pixel([index % SIDE, index / SIDE]) else { return f32::NAN };
        let cosine: f64 = (0..3).map(|i| pixel.direction[i] * middle[i]).sum();
        if cosine > half_deg.to_radians().cos() { inside } else { background }
    };
    (0..SIDE * SIDE).map(value).collect()
}

fn up(degrees: f64) -> [f64; 3] {
    [0.0, degrees.to_radians().sin(), degrees.to_radians().cos()]
}

#[test]
fn a_uniform_hemisphere_is_two_pi_wide_and_brings_pi_l() {
    for (projection, _) in FisheyeProjection::NAMES {
        let view = view(projection);
        let solid_angle: f64 = (0..SIDE * SIDE).filter_map(|i| view.pixel([i % SIDE, i / SIDE])).map(|pixel| pixel.solid_angle).sum();
        // The circle's edge is cut into whole pixels, where an orthographic view crowds its solid angle.
        let tolerance = if projection == FisheyeProjection::Hemispherical { 3e-2 } else { 1e-3 };
        assert!((solid_angle / (2.0 * PI) - 1.0).abs() < tolerance, "{projection:?}: {solid_angle}");
        let glare = Glare::new(&vec![100.0; SIDE * SIDE], &view, &GlareOptions::default()).expect("a picture");
        assert!((glare.eye_illuminance / (100.0 * PI) - 1.0).abs() < 1e-3, "{projection:?}: {}", glare.eye_illuminance);
        assert!(glare.sources.is_empty() && glare.ugr().is_none());
        // Without sources: 5.87e-5 · 314.16 + 0.16.
        assert!((glare.dgp() - 0.178_441).abs() < 2e-5);
    }
}

#[test]
fn a_disk_ahead_gives_the_hand_computed_ugr_and_dgp() {
    // L = 20,000 cd/m² within 5° of 20° above the line of sight, 50 cd/m² around.
    let (half, elevation, bright, dim) = (5f64.to_radians(), 20.0, 20_000.0, 50.0);
    for projection in [FisheyeProjection::Equidistant, FisheyeProjection::Equisolid] {
        let view = view(projection);
        let glare =
            Glare::new(&picture(&view, up(elevation), 5.0, bright as f32, dim as f32), &view, &GlareOptions::default()).expect("a picture");
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
        assert!((glare.eye_illuminance / eye - 1.0).abs() < 5e-3, "{}", glare.eye_illuminance);
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
        assert!((glare.dgp() - dgp).abs() < 1e-3, "{} instead of {dgp}", glare.dgp());
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
    let view = view(FisheyeProjection::Equidistant);
    let places = [[0.0, 20.0], [0.0, 75.0], [80.0, 0.0], [0.0, -20.0]];
    let mut all = vec![10.0f32; SIDE * SIDE];
    for [right, up] in places.map(|place| place.map(f64::to_radians)) {
        let middle = [right.sin() * up.cos(), up.sin(), right.cos() * up.cos()];
        all.iter_mut().zip(picture(&view, middle, 3.0, 9000.0, 0.0)).for_each(|(a, b)| *a = a.max(b));
    }
    let options = GlareOptions { threshold: Threshold::Luminance(2000.0), ..GlareOptions::default() };
    let glare = Glare::new(&all, &view, &options).expect("a picture");
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
    let view = view(FisheyeProjection::Equidistant);
    let two = |apart: f64| {
        let a = picture(&view, up(10.0), 2.0, 9000.0, 10.0);
        let b = picture(&view, up(10.0 + apart), 2.0, 9000.0, 10.0);
        a.iter().zip(b).map(|(a, b)| a.max(b)).collect::<Vec<_>>()
    };
    let options = GlareOptions { threshold: Threshold::Luminance(2000.0), ..GlareOptions::default() };
    let count = |picture: &[f32]| Glare::new(picture, &view, &options).expect("a picture").sources.len();
    assert_eq!((count(&two(8.0)), count(&two(30.0))), (1, 2));
    let apart = GlareOptions { radius: 0.0, ..options };
    assert_eq!(Glare::new(&two(8.0), &view, &apart).expect("a picture").sources.len(), 2);
}

#[test]
fn pictures_that_say_too_little_are_errors() {
    let narrow = FisheyeView::new(FisheyeProjection::Equidistant, 120.0, [8; 2]).expect("a view");
    assert!(Glare::new(&[1.0; 64], &narrow, &GlareOptions::default()).is_err());
    assert!(Glare::new(&[1.0; 63], &view(FisheyeProjection::Equisolid), &GlareOptions::default()).is_err());
    assert!(FisheyeView::new(FisheyeProjection::Hemispherical, 200.0, [8; 2]).is_err());
    let empty = FisheyeView::new(FisheyeProjection::Equidistant, 180.0, [0; 2]).expect("a view");
    assert!(Glare::new(&[], &empty, &GlareOptions::default()).is_err());
    let black = Glare::new(&vec![0.0; SIDE * SIDE], &view(FisheyeProjection::Equidistant), &GlareOptions::default()).expect("a picture");
    assert_eq!((black.sources.len(), black.dgp()), (0, 0.16));
}

#[test]
fn options_that_are_none_are_errors_that_name_them() {
    let view = FisheyeView::new(FisheyeProjection::Equidistant, 180.0, [8; 2]).expect("a view");
    let default = GlareOptions::default();
    let problem = |options: GlareOptions| Glare::new(&[1.0; 64], &view, &options).expect_err("no options").to_string();
    for threshold in [Threshold::Luminance(f64::NAN), Threshold::Luminance(-1.0), Threshold::TimesMean(f64::INFINITY)] {
        assert!(problem(GlareOptions { threshold, ..default }).contains("threshold"));
    }
    for radius in [f64::NAN, -0.1, 7.0] {
        assert!(problem(GlareOptions { radius, ..default }).contains("radius"));
    }
}
