//! The pass of motion vectors: closed forms of cameras, instances and geometry that move, in pixels, x to the right and y upwards.

use gonio::{
    film::Image,
    scene::{
        Aov, CurveBasis, Curves, LightShape, Material, MeshKey, Origin, PointKey, Points, Primvar, Scene, Settings, Shutter, Transform,
    },
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, render, settings},
    scenes::{camera_from_above, facing_down, floor, light, place},
};

const PIXELS: u32 = 24;
/// Metres across the picture, seen from above in parallel.
const SIZE: f64 = 4.0;
const PIXELS_A_METRE: f64 = PIXELS as f64 / SIZE;

/// A floor under a camera; x is to the right, −z upwards.
fn stage() -> Scene {
    let mut scene = floor(0.5);
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.0, 3.0, 0.0]), [2.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], SIZE));
    scene
}

fn wanted() -> Settings {
    let shutter = Shutter { blur: false, ..Shutter::default() };
    Settings { shutter, max_bounces: 1, ..settings(PIXELS, 64, &[Aov::Motion, Aov::Alpha, Aov::P]) }
}

fn shown(mut scene: Scene) -> Image {
    scene.settings = wanted();
    render(&compiled(&scene), &wanted(), Execution::best())
}

/// The four numbers at a pixel from the left and the top.
fn at(image: &Image, x: u32, y: u32) -> [f64; 4] {
    let layer = image.layer(Aov::Motion).expect("the pass was asked for");
    let first = 4 * (y * PIXELS + x) as usize;
    std::array::from_fn(|k| f64::from(layer.values[first + k]))
}

/// The place that a pixel's middle shows on the floor.
fn place_of(x: u32, y: u32) -> [f64; 2] {
    let metres = |pixel: u32| (f64::from(pixel) + 0.5) / PIXELS_A_METRE - 0.5 * SIZE;
    [metres(x), metres(y)]
}

fn near(found: [f64; 4], expected: [f64; 4], within: f64) -> bool {
    found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= within)
}

const SEEN: [(u32, u32); 4] = [(2, 3), (11, 12), (20, 7), (23, 23)];

#[test]
fn what_stands_still_has_none() {
    let image = shown(stage());
    for (x, y) in SEEN {
        assert_eq!(at(&image, x, y), [0.0; 4]);
    }
}

#[test]
fn instances_that_move_say_where_they_were_and_will_be() {
    let mut scene = stage();
    let key = |x: f64, z: f64| vec![Transform::translation([x, 0.0, z])];
    scene.instances[0].motion = vec![key(-0.5, 0.0), key(0.25, -0.5)];
    let image = shown(scene);
    for (x, y) in SEEN {
        let found = at(&image, x, y);
        // It was three pixels to the left; it will be one and a half to the right and three higher.
        assert!(near(found, [-3.0, 0.0, -1.5, -3.0], 1e-3), "{found:?}");
    }
}

#[test]
fn cameras_that_move_leave_everything_behind() {
    let mut scene = stage();
    let eye = |x: f64, y: f64| camera_from_above([x, y, 0.0], SIZE).transform;
    scene.cameras[0].motion = vec![eye(-0.5, 5.0), eye(0.0, 5.0), eye(1.0, 4.0)];
    let image = shown(scene);
    for (x, y) in SEEN {
        let found = at(&image, x, y);
        assert!(near(found, [3.0, 0.0, 6.0, 0.0], 1e-3), "{found:?}");
    }
}

#[test]
fn a_lens_that_comes_nearer_draws_everything_apart() {
    let mut scene = stage();
    let eye = |y: f64| Transform { columns: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [0.0, y, 0.0]] };
    scene.cameras[0].projection = gonio::scene::Projection::Perspective { focal_length: 1.0 };
    // Four metres wide at five metres.
    scene.cameras[0].aperture = [SIZE / 5.0; 2];
    scene.cameras[0].motion = vec![eye(6.0), eye(4.0)];
    let image = shown(scene);
    for (x, y) in SEEN {
        let [right, down] = place_of(x, y).map(|metres| metres * PIXELS_A_METRE);
        let [before, after] = [5.0 / 6.0 - 1.0, 1.0 - 5.0 / 4.0];
        let found = at(&image, x, y);
        assert!(near(found, [right * before, -down * before, right * after, -down * after], 0.02), "{found:?} {right} {down}");
    }
}

#[test]
fn what_turns_has_the_closed_form_of_a_turn() {
    let turned = |angle: f64| {
        let (sin, cos) = angle.sin_cos();
        vec![Transform { columns: [[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos], [0.0; 3]] }]
    };
    let mut scene = stage();
    scene.instances[0].transforms = turned(0.4);
    scene.instances[0].motion = vec![turned(0.1), turned(0.9)];
    let image = shown(scene);
    for (x, y) in SEEN {
        let [right, down] = place_of(x, y);
        let away = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            [cos * right + sin * down - right, sin * right - cos * down + down].map(|metres| metres * PIXELS_A_METRE)
        };
        let ([a, b], [c, d]) = (away(-0.3), away(0.5));
        let found = at(&image, x, y);
        assert!(near(found, [a, b, -c, -d], 0.03), "{found:?} in place of {:?}", [a, b, -c, -d]);
    }
}

#[test]
fn meshes_that_change_their_form_take_their_points_along() {
    let mut scene = stage();
    let sheared = |share: f32| scene.meshes[0].points.iter().map(|[x, y, z]| [x + share * z, *y, *z]).collect::<Vec<_>>();
    let keys = [-0.5, 1.0].map(|share| MeshKey { points: sheared(share).into(), normals: None });
    scene.meshes[0].motion = keys.into();
    let image = shown(scene);
    for (x, y) in SEEN {
        let down = place_of(x, y)[1] * PIXELS_A_METRE;
        let found = at(&image, x, y);
        assert!(near(found, [-0.5 * down, 0.0, -down, 0.0], 0.02), "{found:?} {down}");
    }
}

#[test]
fn curves_and_points_move_too() {
    let points: [[f32; 3]; 4] = [[-1.5, 0.5, 0.0], [-0.5, 0.5, 0.0], [0.5, 0.5, 0.0], [1.5, 0.5, 0.0]];
    let key = |x: f32| PointKey { points: points.map(|p| [p[0] + x, p[1], p[2]]).into() };
    let motion = vec![key(-0.25), key(0.5)];
    let widths = Primvar::constant("widths", 0.6);
    let curves = Curves {
        points: points.into(),
        motion: motion.clone(),
        counts: [4].into(),
        basis: CurveBasis::CatmullRom,
        wrap: gonio::scene::CurveWrap::Pinned,
        widths: widths.clone(),
        ..Curves::default()
    };
    let cloud = Points { points: points.into(), motion, widths, ..Points::default() };
    for which in 0..2 {
        let mut scene = stage();
        let geometry: gonio::scene::Geometry =
            if which == 0 { scene.add_curves(curves.clone()).into() } else { scene.add_points(cloud.clone()).into() };
        place(&mut scene, geometry, Material::diffuse(Origin::new("skin"), [0.5; 3]));
        let image = shown(scene);
        let found = at(&image, 9, 11);
        assert!(near(found, [-1.5, 0.0, -3.0, 0.0], 1e-3), "{which}: {found:?}");
        assert_eq!(at(&image, 9, 2), [0.0; 4], "the floor");
    }
}

#[test]
fn edges_show_the_vectors_of_what_is_there() {
    let mut scene = Scene::default();
    let corners = [[-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0]];
    gonio_tests::scenes::add_quad(&mut scene, corners[0], corners[1], corners[2], Material::diffuse(Origin::new("card"), [0.5; 3]));
    scene.instances[0].transforms = vec![Transform::translation([0.08, 0.0, 0.0])];
    scene.instances[0].motion = [-0.42, 0.08].map(|x| vec![Transform::translation([x, 0.0, 0.0])]).into();
    scene.lights = stage().lights;
    scene.cameras = stage().cameras;
    let image = shown(scene);
    // The background has none, and takes nothing off.
    let alpha = image.layer(Aov::Alpha).expect("coverage");
    let edge = (0..PIXELS).find(|x| (0.05..0.95).contains(&alpha.values[(12 * PIXELS + x) as usize])).expect("an edge");
    assert!(near(at(&image, edge, 12), [-3.0, 0.0, 0.0, 0.0], 1e-3), "{:?}", at(&image, edge, 12));
    assert_eq!(at(&image, 0, 0), [0.0; 4]);
}

#[test]
fn blurred_pictures_have_none_and_say_so() {
    let mut scene = stage();
    scene.instances[0].motion = [-0.5, 0.5].map(|x| vec![Transform::translation([x, 0.0, 0.0])]).into();
    scene.settings = Settings { shutter: Shutter::default(), ..wanted() };
    let blurred = gonio::compile::compile(&scene, None, &false.into()).expect("it compiles");
    assert!(blurred.diagnostics.iter().any(|line| line.to_string().contains("exclude each other")), "{:?}", blurred.diagnostics);
    let image = render(&blurred.into(), &scene.settings, Execution::best());
    assert_eq!(at(&image, 11, 12), [0.0; 4]);
}

#[test]
fn keys_that_cannot_be_used_count_as_rest() {
    let mut scene = stage();
    scene.instances[0].motion = vec![vec![Transform::scale(f64::NAN)]; 2];
    scene.meshes[0].motion = vec![MeshKey { points: [[0.0; 3]; 3].into(), normals: None }; 2];
    scene.settings = wanted();
    let odd = gonio::compile::compile(&scene, None, &false.into()).expect("it compiles");
    assert_eq!(odd.diagnostics.iter().filter(|line| line.severity == gonio::Severity::Warning).count(), 2, "{:?}", odd.diagnostics);
    assert_eq!(at(&render(&odd.into(), &wanted(), Execution::best()), 11, 12), [0.0; 4]);
}

#[test]
fn levels_and_threads_agree() {
    let mut scene = stage();
    scene.instances[0].motion = [-0.5, 0.5].map(|x| vec![Transform::translation([x, 0.2, 0.1])]).into();
    scene.settings = wanted();
    let compiled = compiled(&scene);
    let one = render(&compiled, &Settings { threads: 1, ..wanted() }, Execution::best());
    assert!(one == render(&compiled, &Settings { threads: 3, ..wanted() }, Execution::best()));
    for execution in Execution::all() {
        let other = render(&compiled, &wanted(), execution);
        assert!(near(at(&other, 5, 5), at(&one, 5, 5), 1e-3), "{}", execution.name());
    }
}
