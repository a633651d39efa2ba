//! Motion blur against the mean of single moments; threads, levels and the workspaces that renders share.

use gonio::scene::{Aov, LightShape, Material, Mesh, MeshKey, Origin, Scene, Settings, Transform};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{add_triangles, camera_from_above, facing_down, floor, light},
};
use std::sync::Arc;

const POINTS: [[f32; 3]; 4] = [[-0.5, 0.0, 0.5], [0.5, 0.0, 0.5], [0.5, 0.6, -0.5], [-0.5, 0.6, -0.5]];
const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];
const MOMENTS: usize = 32;

/// A turn about the vertical by radians, somewhere.
fn turned(angle: f64, at: [f64; 3]) -> Transform {
    let (sin, cos) = angle.sin_cos();
    Transform { columns: [[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos], at] }
}

fn board(share: f64) -> Transform {
    turned(1.6 * share, [share - 0.5, 0.4, 0.2])
}

fn bent(share: f32) -> Vec<[f32; 3]> {
    POINTS.iter().map(|[x, y, z]| [*x, y + share * x.abs(), z + share * y]).collect()
}

fn eye(share: f64) -> Transform {
    let at = Transform { columns: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [0.2 * share, 5.0, 0.0]] };
    turned(0.4 * share, [0.0; 3]).after(&at)
}

/// A board that turns, bends and moves over a floor, below a camera that moves too; or all of it at a moment.
fn scene(moment: Option<f64>) -> Scene {
    scene_of(moment, 0.0)
}

/// The same over a lamp that moves by some metres.
fn scene_of(moment: Option<f64>, reach: f64) -> Scene {
    let mut scene = floor(0.6);
    let at = moment.unwrap_or(0.5);
    add_triangles(&mut scene, &bent(at as f32), &TRIANGLES, Material::diffuse(Origin::new("board"), [0.7, 0.2, 0.1]));
    let set = &mut scene.instances[1];
    set.transforms = vec![board(at), turned(0.3, [0.8, 0.3, -0.9])];
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 4.0));
    scene.cameras[0].transform = eye(at);
    scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, Transform::translation([0.5 + reach * (at - 0.5), 2.5, 0.0]), [20.0; 3]));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([-0.5, 3.0, 0.5]), [2.0; 3]));
    if moment.is_none() {
        set_motion(&mut scene, &[0.0, 0.5, 1.0], reach);
    }
    scene
}

fn set_motion(scene: &mut Scene, keys: &[f64], reach: f64) {
    if reach > 0.0 {
        scene.lights[0].motion = keys.iter().map(|share| Transform::translation([0.5 + reach * (share - 0.5), 2.5, 0.0])).collect();
        return;
    }
    scene.instances[1].motion = keys.iter().map(|share| vec![board(*share), turned(0.3, [0.8, 0.3, -0.9])]).collect();
    scene.meshes[1].motion = keys.iter().map(|share| MeshKey { points: bent(*share as f32).into(), normals: None }).collect();
    scene.cameras[0].motion = keys.iter().map(|share| eye(*share)).collect();
}

fn wanted(samples: u32, seed: u32) -> Settings {
    Settings { seed, max_bounces: 2, ..settings(24, samples, &[Aov::Color]) }
}

/// Means of blocks of four by four pixels.
fn blocks(image: &gonio::film::Image) -> Vec<f64> {
    let layer = image.layer(Aov::Color).expect("colour");
    let mut sums = vec![0.0; 36 * 3];
    for (at, values) in layer.values.chunks(layer.channels).enumerate() {
        let (x, y) = (at % 24 / 4, at / 24 / 4);
        for (channel, value) in values.iter().take(3).enumerate() {
            sums[(6 * y + x) * 3 + channel] += f64::from(*value) / 16.0;
        }
    }
    sums
}

#[test]
fn blur_is_the_mean_of_moments() {
    holds_the_mean(0.0);
}

/// A lamp that moves is laid out along its way, which is right for what stands still.
#[test]
fn lamps_light_from_their_whole_way() {
    holds_the_mean(2.0);
}

fn holds_the_mean(reach: f64) {
    let moving = compiled(&scene_of(None, reach));
    let mut moments = vec![0.0; 36 * 3];
    for moment in 0..MOMENTS {
        let at = (moment as f64 + 0.5) / MOMENTS as f64;
        // With the lamp alone all else stands at the middle.
        let mut still = scene_of(Some(if reach > 0.0 { 0.5 } else { at }), reach);
        still.lights[0].transform.columns[3][0] = 0.5 + reach * (at - 0.5);
        let still = compiled(&still);
        let found = blocks(&render(&still, &wanted(32, 100 + moment as u32), Execution::best()));
        moments.iter_mut().zip(found).for_each(|(sum, x)| *sum += x / MOMENTS as f64);
    }
    let blurred: Vec<Vec<f64>> = (0..3).map(|seed| blocks(&render(&moving, &wanted(512, seed), Execution::best()))).collect();
    let level = moments.iter().sum::<f64>() / moments.len() as f64;
    for (place, moment) in moments.iter().enumerate() {
        let mean = blurred.iter().map(|picture| picture[place]).sum::<f64>() / 3.0;
        // About five standard deviations of these blocks.
        assert!((mean - moment).abs() < 0.03 * level, "block {place}: {mean} in place of {moment}, of {level}");
    }
}

#[test]
fn threads_do_not_change_a_bit_and_levels_agree() {
    let moving = compiled(&scene(None));
    let one = render(&moving, &Settings { threads: 1, ..wanted(64, 1) }, Execution::best());
    let three = render(&moving, &Settings { threads: 3, ..wanted(64, 1) }, Execution::best());
    assert!(one == three);
    for execution in Execution::all() {
        let other = render(&moving, &wanted(64, 1), execution);
        for channel in 0..3 {
            let (found, expected) = (mean(&other, Aov::Color, channel), mean(&one, Aov::Color, channel));
            assert!((found / expected - 1.0).abs() < 0.005, "{}: {found} in place of {expected}", execution.name());
        }
    }
}

#[test]
fn what_moves_leaves_no_trace_in_what_stands_still() {
    let (still, moving) = (compiled(&scene(Some(0.5))), scene(None));
    let alone = render(&still, &wanted(16, 3), Execution::best());
    // The workspaces of the first scene are taken up by the second, and the other way round.
    let moving = Arc::new(gonio::compile::compile(&moving, Some(&still), &false.into()).expect("it compiles"));
    render(&moving, &wanted(16, 3), Execution::best());
    let again = Arc::new(gonio::compile::compile(&scene(Some(0.5)), Some(&moving), &false.into()).expect("it compiles"));
    assert!(render(&again, &wanted(16, 3), Execution::best()) == alone);
}

#[test]
fn keys_that_cannot_be_used_are_told_and_stand_still() {
    let mut odd = scene(None);
    odd.instances[1].motion[1].pop();
    odd.meshes[1].motion[2].points = Arc::from([[0.0; 3]; 3]);
    odd.cameras[0].motion.truncate(1);
    odd.lights[0].motion = vec![Transform::scale(f64::NAN); 2];
    let odd = gonio::compile::compile(&odd, None, &false.into()).expect("it compiles");
    let told: Vec<String> = odd.diagnostics.iter().map(ToString::to_string).collect();
    for what in ["places 1 times", "other numbers of points", "stands still", "the light stands still"] {
        assert!(told.iter().any(|line| line.contains(what)), "{what}: {told:?}");
    }
    let picture = render(&Arc::new(odd), &wanted(16, 3), Execution::best());
    let still = render(&compiled(&scene(Some(0.5))), &wanted(16, 3), Execution::best());
    assert!(picture == still);
    assert_eq!(Mesh::default().key_problem(), None);
}
