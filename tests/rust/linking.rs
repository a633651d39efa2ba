//! Light and shadow linking against closed forms, and against scenes that hold the linked lights alone.

use gonio::{
    compile::compile,
    light::{LightKind, LightLinks, LightRecord, LightSampleContext, LightTable, LightTexture},
    light_paths::Watch,
    map::{MapOptions, TexelSize, illumination_maps},
    measure::{Watch as MeterWatch, measure},
    scene::{
        Aov, DomeFormat, Filter, Integrator, Light, LightShape, Link, Linking, Material, Measurand, Meter, Origin, Scene, Settings,
        Transform, Visibility,
    },
};
use gonio_simd::{Execution, Lanes, One, Vec3};
use gonio_tests::{
    picture::{compiled, mean, render, settings},
    scenes::{add_quad, camera_from_above, facing_down, layered, light},
};
use std::{f64::consts::PI, sync::atomic::AtomicBool};

const LEFT: u32 = 0;
const RIGHT: u32 = 1;

/// Two white floors side by side in a black world: the instances [`LEFT`] about x = −2 and [`RIGHT`] about x = 2, 2 m by 2 m each.
fn floors() -> Scene {
    let mut scene = Scene::default();
    for x in [-3.0, 1.0] {
        let white = Material::diffuse(Origin::new("floor"), [1.0; 3]);
        add_quad(&mut scene, [x, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], white);
    }
    scene
}

/// A black board of 2 m by 2 m at a height over the middle of a floor.
fn add_board(scene: &mut Scene, floor: u32, height: f32, opacity: f32) {
    let x = if floor == LEFT { -3.0 } else { 1.0 };
    let black = layered([0.0; 3], &[("specular_weight", 0.0), ("geometry_opacity", opacity)]);
    add_quad(scene, [x, height, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], black);
}

/// A board of 0.5 m by 0.5 m over the left floor that shines down and up with 10 cd/m².
fn add_shining(scene: &mut Scene, height: f32) {
    let mut material = layered([0.0; 3], &[("specular_weight", 0.0)]);
    material.closures[0].set_colour("emission_color", [10.0; 3]);
    add_quad(scene, [-0.25, height, 0.25], [0.5, 0.0, 0.0], [0.0, 0.0, -0.5], material);
}

fn only(sets: &[u32]) -> Link {
    Link::Only(sets.to_vec())
}

fn lights_only(lamp: Light, sets: &[u32]) -> Light {
    Light { linking: Linking { receivers: only(sets), ..Linking::default() }, ..lamp }
}

fn blocked_by(lamp: Light, blockers: Link) -> Light {
    Light { linking: Linking { blockers, ..Linking::default() }, ..lamp }
}

fn lamp(shape: LightShape, position: [f64; 3], strength: f32) -> Light {
    light(shape, facing_down(position), [strength; 3])
}

fn sky() -> Light {
    light(LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY, [2.0; 3])
}

/// Illuminance in the middle of a floor, by the pass and by the colour of a white floor.
fn lux_with(scene: &Scene, floor: u32, settings: &Settings) -> [f64; 2] {
    let mut scene = scene.clone();
    scene.cameras = vec![camera_from_above([if floor == LEFT { -2.0 } else { 2.0 }, 0.01, 0.0], 1e-3)];
    let image = render(&compiled(&scene), settings, Execution::best());
    [mean(&image, Aov::Illuminance, 0), mean(&image, Aov::Color, 0) * PI]
}

fn lux(scene: &Scene, floor: u32, samples: u32) -> [f64; 2] {
    lux_with(scene, floor, &settings(16, samples, &[Aov::Color, Aov::Illuminance]))
}

fn check(found: [f64; 2], expected: f64, relative: f64) {
    for found in found {
        assert!((found - expected).abs() <= relative * expected, "{found} instead of {expected}");
    }
}

#[test]
fn each_of_two_floors_gets_the_light_of_its_own_lamp() {
    let mut scene = floors();
    scene.lights.push(lights_only(lamp(LightShape::Point, [0.0, 1.5, 0.0], 100.0), &[LEFT]));
    let other = lamp(LightShape::Point, [0.0, 2.0, 0.0], 30.0);
    scene.lights.push(Light { linking: Linking { receivers: Link::Except(vec![LEFT]), ..Linking::default() }, ..other });
    // E = I h / d³.
    let expected = |candela: f64, height: f64| candela * height / (4.0 + height * height).powf(1.5);
    check(lux(&scene, LEFT, 16), expected(100.0, 1.5), 2e-4);
    check(lux(&scene, RIGHT, 16), expected(30.0, 2.0), 2e-4);
    let whitted = Settings { integrator: Integrator::Whitted, filter: Filter::Box, ..settings(8, 1, &[Aov::Color, Aov::Illuminance]) };
    check(lux_with(&scene, LEFT, &whitted), expected(100.0, 1.5), 2e-4);
    check(lux_with(&scene, RIGHT, &whitted), expected(30.0, 2.0), 2e-4);
}

#[test]
fn lamps_of_all_kinds_light_what_they_are_linked_to() {
    let shapes = [
        LightShape::Rectangle { width: 1.0, height: 0.7 },
        LightShape::Disk { radius: 0.5 },
        LightShape::Sphere { radius: 0.4 },
        LightShape::Cylinder { radius: 0.2, length: 1.0 },
        LightShape::FacingDisk { radius: 0.3 },
        LightShape::Distant { angle_deg: 20.0 },
        LightShape::Dome { format: DomeFormat::Automatic },
    ];
    for shape in shapes {
        let transform = if let LightShape::Dome { .. } = shape { Transform::IDENTITY } else { facing_down([0.0, 1.2, 0.0]) };
        let plain = light(shape, transform, [3.0; 3]);
        let mut scene = floors();
        // Another lamp, so that there is a choice.
        scene.lights.push(lights_only(lamp(LightShape::Point, [0.0, 2.0, 0.0], 5.0), &[RIGHT]));
        let without = floors();
        let alone = lux(&Scene { lights: vec![plain.clone()], ..without }, LEFT, 256);
        scene.lights.push(lights_only(plain, &[LEFT]));
        check(lux(&scene, LEFT, 256), 0.5 * (alone[0] + alone[1]), 1e-2);
        check(lux(&scene, RIGHT, 16), 5.0 * 2.0 / 8.0_f64.powf(1.5), 2e-4);
    }
}

#[test]
fn a_mesh_that_shines_lights_what_it_is_linked_to_alone() {
    let mut scene = floors();
    add_shining(&mut scene, 0.8);
    let unlinked = lux(&scene, LEFT, 1024);
    assert!(unlinked[0] > 0.05);
    scene.instances[2].linking.receivers = only(&[LEFT]);
    check(lux(&scene, LEFT, 1024), 0.5 * (unlinked[0] + unlinked[1]), 1e-2);
    assert_eq!(lux(&scene, RIGHT, 64), [0.0; 2]);
    // The camera sees it all the same.
    scene.cameras = vec![camera_from_above([0.0, 3.0, 0.0], 0.1)];
    let seen = mean(&render(&compiled(&scene), &settings(8, 4, &[Aov::Color]), Execution::best()), Aov::Color, 0);
    assert!((seen - 10.0).abs() < 1e-3, "{seen}");
}

#[test]
fn a_mirror_shows_the_lights_that_light_it() {
    // A level mirror under a panel: what its rays meet is weighed by no light sample.
    let mut scene = Scene::default();
    let mirror = layered([1.0; 3], &[("metalness", 1.0), ("specular_roughness", 0.0)]);
    add_quad(&mut scene, [-1.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], mirror);
    scene.lights.push(lamp(LightShape::Rectangle { width: 2.0, height: 2.0 }, [0.0, 2.0, 0.0], 3.0));
    scene.cameras = vec![camera_from_above([0.0, 0.5, 0.0], 0.1)];
    let seen = |scene: &Scene| mean(&render(&compiled(scene), &settings(8, 4, &[Aov::Color]), Execution::best()), Aov::Color, 0);
    assert!((seen(&scene) - 3.0).abs() < 0.05);
    scene.lights[0].linking.receivers = Link::Except(vec![0]);
    assert_eq!(seen(&scene), 0.0);
}

#[test]
fn a_dome_lights_what_it_is_linked_to_alone() {
    let mut scene = floors();
    scene.lights.push(lights_only(sky(), &[LEFT]));
    check(lux(&scene, LEFT, 256), 2.0 * PI, 2e-3);
    assert_eq!(lux(&scene, RIGHT, 16), [0.0; 2]);
}

#[test]
fn what_does_not_block_a_light_lets_all_of_it_by() {
    let shapes = [
        LightShape::Point,
        LightShape::Rectangle { width: 0.6, height: 0.6 },
        LightShape::Sphere { radius: 0.3 },
        LightShape::Distant { angle_deg: 5.0 },
    ];
    for opacity in [1.0, 0.4] {
        for shape in shapes {
            let mut scene = floors();
            let plain = lamp(shape, [-2.0, 2.0, 0.0], 10.0);
            let open = lux(&Scene { lights: vec![plain.clone()], ..scene.clone() }, LEFT, 256);
            let open = 0.5 * (open[0] + open[1]);
            let passed = open * f64::from(1.0 - opacity);
            add_board(&mut scene, LEFT, 0.5, opacity);
            let with = |link: Link| lux(&Scene { lights: vec![blocked_by(plain.clone(), link)], ..scene.clone() }, LEFT, 256);
            check(with(Link::Except(vec![2])), open, 1e-2);
            check(with(only(&[LEFT])), open, 1e-2);
            check(with(only(&[])), open, 1e-2);
            let tolerance = if opacity < 1.0 { 3e-2 } else { 0.0 };
            check(with(only(&[2])), passed, tolerance);
            check(with(Link::Except(vec![LEFT])), passed, tolerance);
        }
    }
}

#[test]
fn lights_with_blockers_of_their_own_do_not_share_them() {
    // Three boards over the left floor, three points: each is blocked by another board, or by none.
    let mut scene = floors();
    for height in [0.3, 0.5, 0.7] {
        add_board(&mut scene, LEFT, height, 1.0);
    }
    let point = |candela: f32| lamp(LightShape::Point, [-2.0, 2.0, 0.0], candela);
    scene.lights.push(blocked_by(point(4.0), Link::Except(vec![2, 3, 4])));
    scene.lights.push(blocked_by(point(40.0), only(&[LEFT, RIGHT])));
    scene.lights.push(blocked_by(point(400.0), Link::Except(vec![2, 3])));
    scene.lights.push(blocked_by(point(4000.0), only(&[3])));
    scene.lights.push(point(40000.0));
    // E = I / h², of the first two.
    check(lux(&scene, LEFT, 4096), 11.0, 3e-2);
    let only_plain: f64 = 44444.0 * 2.0 / (16.0 + 4.0_f64).powf(1.5);
    check(lux(&scene, RIGHT, 256), only_plain, 2e-2);
}

#[test]
fn a_sky_with_blockers_of_its_own_lights_through_what_does_not_block_it() {
    let mut scene = floors();
    add_board(&mut scene, LEFT, 0.05, 1.0);
    scene.lights.push(blocked_by(sky(), Link::Except(vec![2])));
    check(lux(&scene, LEFT, 1024), 2.0 * PI, 1e-2);
}

/// A hundred lamps for the one floor and a hundred for the other: each has a light tree, and what is learned of arrivals is learned of both apart.
#[test]
fn trees_of_linked_lights_select_their_own_lights() {
    let mut scene = floors();
    let mut by_floor = [Vec::new(), Vec::new()];
    for i in 0..200_u32 {
        let floor = i % 2;
        let place = [f64::from(i % 20) * 0.4 - 4.0, 1.0 + 0.1 * f64::from(i % 7), f64::from(i / 20) * 0.4 - 2.0];
        let plain = lamp(LightShape::Sphere { radius: 0.05 }, place, if floor == 0 { 10.0 } else { 30.0 });
        by_floor[floor as usize].push(plain.clone());
        scene.lights.push(lights_only(plain, &[floor]));
    }
    for floor in [LEFT, RIGHT] {
        let own = by_floor[floor as usize].clone();
        let alone = lux(&Scene { lights: own, ..floors() }, floor, 512);
        check(lux(&scene, floor, 512), 0.5 * (alone[0] + alone[1]), 1e-2);
        check(lux(&scene, floor, 8), 0.5 * (alone[0] + alone[1]), 8e-2);
    }
}

/// A lamp that diffuse rays do not see lights no diffuse floor; glossy rays see all of it, and mirrors.
#[test]
fn lights_are_hidden_from_kinds_of_rays() {
    let hidden = |shape, diffuse, glossy| {
        let transform = if let LightShape::Dome { .. } = shape { Transform::IDENTITY } else { facing_down([-2.0, 1.5, 0.0]) };
        let visibility = Visibility { camera: false, diffuse, glossy, ..Visibility::default() };
        Light { visibility, ..light(shape, transform, [3.0; 3]) }
    };
    for shape in [LightShape::Rectangle { width: 3.0, height: 3.0 }, LightShape::Dome { format: DomeFormat::Automatic }] {
        let lit = |lamp: Light| lux(&Scene { lights: vec![lamp], ..floors() }, LEFT, 64);
        let plain = lit(hidden(shape, true, true));
        assert!(lit(hidden(shape, false, true)).iter().all(|lux| *lux < 1e-4));
        check(lit(hidden(shape, true, false)), 0.5 * (plain[0] + plain[1]), 2e-2);
        for roughness in [0.0, 0.4] {
            let mut scene = Scene::default();
            let metal = layered([1.0; 3], &[("metalness", 1.0), ("specular_roughness", roughness)]);
            add_quad(&mut scene, [-3.0, 0.0, 1.0], [2.0, 0.0, 0.0], [0.0, 0.0, -2.0], metal);
            let seen = |lamp: Light| lux(&Scene { lights: vec![lamp], ..scene.clone() }, LEFT, 64)[1];
            let plain = seen(hidden(shape, true, true));
            check([seen(hidden(shape, false, true)); 2], plain, 1e-2);
            assert!(seen(hidden(shape, true, false)) < 1e-4);
        }
    }
}

#[test]
fn links_that_name_all_change_no_light() {
    let mut scene = floors();
    scene.lights.push(lamp(LightShape::Rectangle { width: 1.0, height: 1.0 }, [-1.0, 2.0, 0.0], 5.0));
    scene.lights.push(lamp(LightShape::Sphere { radius: 0.2 }, [-2.5, 1.5, 0.0], 5.0));
    let plain = lux(&scene, LEFT, 256);
    scene.lights[0].linking = Linking { receivers: only(&[LEFT, RIGHT]), blockers: only(&[LEFT, RIGHT]) };
    scene.lights[1].linking = Linking { receivers: Link::Except(vec![]), ..Linking::default() };
    check(lux(&scene, LEFT, 256), 0.5 * (plain[0] + plain[1]), 1e-2);
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let mut scene = floors();
    add_board(&mut scene, LEFT, 0.5, 0.5);
    scene.lights.push(blocked_by(lamp(LightShape::Sphere { radius: 0.3 }, [-2.0, 2.0, 0.0], 5.0), only(&[2])));
    scene.lights.push(blocked_by(lamp(LightShape::Sphere { radius: 0.3 }, [-1.0, 2.0, 0.0], 5.0), only(&[LEFT])));
    scene.lights.push(lights_only(lamp(LightShape::Sphere { radius: 0.3 }, [1.0, 2.0, 0.0], 5.0), &[RIGHT]));
    scene.cameras = vec![camera_from_above([0.0, 3.0, 0.0], 6.0)];
    let scene = compiled(&scene);
    let base = settings(130, 8, &[Aov::Color, Aov::Illuminance]);
    let one = render(&scene, &Settings { threads: 1, ..base.clone() }, Execution::best());
    assert!(one == render(&scene, &Settings { threads: 2, ..base }, Execution::best()));
}

#[test]
fn maps_know_links_and_meters_see_all_lights() {
    let mut scene = floors();
    scene.lights.push(lights_only(lamp(LightShape::Point, [0.0, 1.5, 0.0], 100.0), &[LEFT]));
    scene.settings.threads = 2;
    scene.settings.samples = 16;
    let compiled = compile(&scene, None, &AtomicBool::new(false)).expect("a scene");
    let mut watch = Watch { cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let options = MapOptions { texel: TexelSize::Automatic, error: 0.0, paths: 100_000, ..MapOptions::default() };
    let maps = illumination_maps(&scene, &compiled, &options, Execution::best(), &mut watch).expect("maps");
    let [left, right] = [0, 1].map(|surface: usize| maps.surfaces[surface].sides.iter().any(Option::is_some));
    assert!(left && !right);
    let position = [2.0, 0.1, 0.0];
    scene.meters.push(Meter { position, measurand: Measurand::Illuminance, normal: [0.0, 1.0, 0.0], ..Meter::default() });
    let mut watch = MeterWatch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let found = measure(&scene, Execution::best(), &mut watch).expect("readings").meters[0].reading.value;
    let expected = 100.0 * 1.4 / (4.0_f64 + 1.96).powf(1.5);
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} instead of {expected}");
}

/// Lights are drawn as often as their probabilities say, which add up to one over those that a class sees.
#[test]
fn classes_draw_the_lights_that_they_see() {
    let record = |i: u32| {
        let mut record = LightRecord::new(LightKind::Sphere);
        record.to_world = [[0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1], [i as f32 * 0.3 - 20.0, 2.0, (i % 7) as f32]];
        record
    };
    let records: Vec<LightRecord> = (0..150).map(record).collect();
    let set_of_light: Vec<u32> = (0..150).map(|i| if i < 3 { 1 } else { 2 + i % 2 }).collect();
    let mut links = LightLinks::new(set_of_light, 4, 4);
    // One with three lights, one with a tree of 150 less half, one with both; none sees those of set 0, as there are none.
    for (class, set) in [(1, 1), (2, 2), (3, 1), (3, 3)] {
        links.allow(class, set);
    }
    let table = LightTable::build(&records, &[] as &[LightTexture], &[]).with_links(links.clone());
    let [position, normal] = [[0.5, 0.0, 0.5], [0.0, 1.0, 0.0]].map(|v| Vec3::splat(One, v));
    for class in 0..4 {
        let from = LightSampleContext { position, normal, receiver: One.u(class) };
        let pmf = |light: u32| f64::from(table.light_pmf(One, None, &from, One.u(light)).to_array()[0]);
        let sum: f64 = (0..150).map(pmf).sum();
        assert!((sum - 1.0).abs() < 1e-4, "{sum} of class {class}");
        let mut counts = [0; 150];
        for i in 0..20_000 {
            let u = (i as f32 + 0.5) / 20_000.0;
            let (light, probability) = table.sample_light(One, None, &from, One.f(u));
            let light = light.to_array()[0];
            assert!(links.allows(class, links.set_of_light[light as usize]));
            assert!((f64::from(probability.to_array()[0]) / pmf(light) - 1.0).abs() < 1e-3);
            counts[light as usize] += 1;
        }
        for (light, count) in (0..).zip(counts) {
            assert!((f64::from(count) / 20_000.0 - pmf(light)).abs() < 1e-3, "light {light} of class {class}");
        }
    }
}

#[test]
fn links_to_what_is_not_there_are_reported() {
    let mut scene = floors();
    scene.lights.push(lights_only(lamp(LightShape::Point, [0.0, 1.5, 0.0], 100.0), &[7]));
    let found = compile(&scene, None, &AtomicBool::new(false)).expect("a scene").diagnostics;
    assert!(found.iter().any(|d| d.message.contains("receivers name the instances 7, the scene has 2 sets")), "{found:?}");
}
