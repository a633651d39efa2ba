//! Curves and points that move while the shutter is open, against the mean of single moments; and keys that make no sense.

use gonio::{
    compile::compile,
    scene::{
        Aov, CurveBasis, CurveShape, CurveWrap, Curves, Geometry, LightShape, Material, Origin, PointKey, PointShape, Points, Primvar,
        Scene, Settings,
    },
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, render, settings},
    scenes::{camera_from_above, facing_down, floor, light, place},
};
use std::sync::Arc;

const MOMENTS: usize = 48;
const SIDE: usize = 24;

/// A kind of fibres.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Curves(CurveShape, CurveBasis),
    Points(PointShape),
}

const KINDS: [Kind; 5] = [
    Kind::Curves(CurveShape::Round, CurveBasis::CatmullRom),
    Kind::Curves(CurveShape::Round, CurveBasis::Linear),
    Kind::Curves(CurveShape::Ribbon, CurveBasis::BSpline),
    Kind::Points(PointShape::Sphere),
    Kind::Points(PointShape::Disc),
];

/// Five points of three strands over the floor: they sway, the more the farther along they are, the second half of the time back.
fn points(time: f32) -> Vec<[f32; 3]> {
    let sway = if time < 0.5 { 2.0 * time } else { 2.0 - 2.0 * time };
    let point = |strand: usize, i: usize| {
        let (s, along) = (strand as f32 - 1.0, i as f32 / 4.0);
        [1.6 * along - 0.8 + 0.2 * s * sway, 0.3 + 0.2 * along, 0.5 * s + 0.7 * sway * along * along]
    };
    (0..15).map(|i| point(i / 5, i % 5)).collect()
}

fn scene(kind: Kind, moment: Option<f32>) -> Scene {
    let mut scene = floor(0.6);
    let motion: Vec<PointKey> = match moment {
        Some(_) => Vec::new(),
        None => [0.0, 0.5, 1.0].map(|time| PointKey { points: points(time).into() }).into(),
    };
    let (at, widths) = (points(moment.unwrap_or(0.5)).into(), Primvar::constant("widths", 0.25));
    let geometry: Geometry = match kind {
        Kind::Curves(shape, basis) => {
            let wrap = CurveWrap::Pinned;
            scene.add_curves(Curves { points: at, motion, counts: [5; 3].into(), basis, wrap, shape, widths, ..Curves::default() }).into()
        }
        Kind::Points(shape) => scene.add_points(Points { points: at, motion, widths, shape, ..Points::default() }).into(),
    };
    place(&mut scene, geometry, Material::diffuse(Origin::new("skin"), [0.7, 0.2, 0.1]));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.4, 3.0, 0.3]), [3.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 2.4));
    scene
}

fn wanted(samples: u32, seed: u32) -> Settings {
    Settings { seed, max_bounces: 1, ..settings(SIDE as u32, samples, &[Aov::Color]) }
}

/// Means of blocks of four by four pixels.
fn blocks(image: &gonio::film::Image) -> Vec<f64> {
    let layer = image.layer(Aov::Color).expect("colour");
    let mut sums = vec![0.0; 36 * 3];
    for (at, values) in layer.values.chunks(layer.channels).enumerate() {
        let (x, y) = (at % SIDE / 4, at / SIDE / 4);
        for (channel, value) in values.iter().take(3).enumerate() {
            sums[(6 * y + x) * 3 + channel] += f64::from(*value) / 16.0;
        }
    }
    sums
}

#[test]
fn blur_is_the_mean_of_moments() {
    for kind in KINDS {
        let moving = compiled(&scene(kind, None));
        let mut moments = vec![0.0; 36 * 3];
        for moment in 0..MOMENTS {
            let still = compiled(&scene(kind, Some((moment as f32 + 0.5) / MOMENTS as f32)));
            let found = blocks(&render(&still, &wanted(32, 100 + moment as u32), Execution::best()));
            moments.iter_mut().zip(found).for_each(|(sum, x)| *sum += x / MOMENTS as f64);
        }
        let blurred: Vec<Vec<f64>> = (0..2).map(|seed| blocks(&render(&moving, &wanted(512, seed), Execution::best()))).collect();
        let rest = blocks(&render(&compiled(&scene(kind, Some(0.5))), &wanted(256, 5), Execution::best()));
        let level = moments.iter().sum::<f64>() / moments.len() as f64;
        let mut apart = 0.0f64;
        for (place, moment) in moments.iter().enumerate() {
            let mean = blurred.iter().map(|picture| picture[place]).sum::<f64>() / 2.0;
            assert!((mean - moment).abs() < 0.03 * level, "{kind:?}, block {place}: {mean} in place of {moment}, of {level}");
            apart = apart.max((rest[place] - moment).abs());
        }
        assert!(apart > 0.1 * level, "{kind:?}: it moves");
    }
}

#[test]
fn threads_do_not_change_a_bit_and_levels_agree() {
    for kind in KINDS {
        let moving = compiled(&scene(kind, None));
        let one = render(&moving, &Settings { threads: 1, ..wanted(64, 1) }, Execution::best());
        assert!(one == render(&moving, &Settings { threads: 3, ..wanted(64, 1) }, Execution::best()), "{kind:?}");
        for execution in Execution::all() {
            let other = blocks(&render(&moving, &wanted(64, 1), execution));
            let (found, expected) = (other.iter().sum::<f64>(), blocks(&one).iter().sum::<f64>());
            assert!((found / expected - 1.0).abs() < 0.005, "{kind:?}, {}: {found} in place of {expected}", execution.name());
        }
    }
}

#[test]
fn keys_that_cannot_be_used_are_told_once_and_the_shape_stands_still() {
    for kind in [KINDS[0], KINDS[3]] {
        let still = render(&compiled(&scene(kind, Some(0.5))), &wanted(8, 3), Execution::best());
        let bent = |change: fn(&mut Vec<PointKey>)| {
            let mut odd = scene(kind, None);
            odd.curves.iter_mut().for_each(|curves| change(&mut curves.motion));
            odd.points.iter_mut().for_each(|points| change(&mut points.motion));
            compile(&odd, None, &false.into()).expect("it compiles")
        };
        let lost: [fn(&mut Vec<PointKey>); 3] = [
            |keys| keys[1].points = Arc::from([[f32::NAN; 3]; 15]),
            |keys| keys[2].points = Arc::from([[0.0; 3]; 14]),
            |keys| keys.truncate(1),
        ];
        for change in lost {
            let odd = bent(change);
            let told = odd.diagnostics.iter().filter(|line| line.to_string().contains("stands still")).count();
            assert_eq!(told, 1, "{:?}", odd.diagnostics);
            assert!(render(&odd.into(), &wanted(8, 3), Execution::best()) == still);
        }
    }
}

#[test]
fn what_moved_leaves_no_trace_in_what_stands_still() {
    let kind = KINDS[0];
    let alone = render(&compiled(&scene(kind, Some(0.5))), &wanted(8, 3), Execution::best());
    let mut both = scene(kind, None);
    let moving = Arc::new(compile(&both, None, &false.into()).expect("it compiles"));
    // The same arrays, without keys.
    both.curves[0].motion.clear();
    let again = Arc::new(compile(&both, Some(&moving), &false.into()).expect("it compiles"));
    assert!(render(&again, &wanted(8, 3), Execution::best()) == alone);
}
