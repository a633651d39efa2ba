//! Meters and grids against closed forms.

use gonio::{
    measure::{Measurements, Reading, Watch, measure},
    scene::{
        DomeFormat, Field, Grid, GridArea, Lattice, LightShape, Material, Measurand, Medium, Mesh, MeshId, Meter, Origin, Scene, Transform,
        Visibility,
    },
};
use gonio_simd::Execution;
use gonio_tests::scenes::{add_quad, add_triangles, facing_down, floor, light};
use std::{f64::consts::PI, sync::atomic::AtomicBool};

fn measured_at(scene: &Scene, execution: Execution) -> Measurements {
    let mut watch = Watch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    measure(scene, execution, &mut watch).expect("readings")
}

fn measured(scene: &Scene) -> Measurements {
    measured_at(scene, Execution::best())
}

/// With so many samples a point.
fn sampled(mut scene: Scene, samples: u32) -> Scene {
    scene.settings.samples = samples;
    scene.settings.threads = 2;
    scene
}

fn uniform_sky(radiance: f32) -> gonio::scene::Light {
    light(LightShape::Dome { format: DomeFormat::Automatic }, Transform::IDENTITY, [radiance; 3])
}

/// A level meter in a scene whose up is y.
fn meter(position: [f64; 3], measurand: Measurand) -> Meter {
    Meter { position, measurand, normal: [0.0, 1.0, 0.0], facing: [0.0, 0.0, -1.0], ..Meter::default() }
}

fn reading(scene: &Scene, meter: Meter) -> Reading {
    measured(&Scene { meters: vec![meter], ..scene.clone() }).meters[0].reading
}

/// Within five standard errors and a share of rounding.
fn assert_near(found: Reading, expected: f64) {
    let allowed = 5.0 * found.standard_error + 2e-5 * expected;
    assert!((found.value - expected).abs() <= allowed, "{found:?} instead of {expected}");
}

#[test]
fn a_point_source_obeys_the_inverse_square_law_on_a_grid() {
    // E = I h / d³ under a point of 1000 cd at a height of 2.2 m.
    let mut scene = sampled(Scene::default(), 16);
    scene.lights.push(light(LightShape::Point, Transform::translation([0.3, 3.0, -0.4]), [1000.0; 3]));
    let area = GridArea::Rectangle { corner: [-2.0, 0.0, 2.0], edges: [[4.0, 0.0, 0.0], [0.0, 0.0, -4.0]] };
    scene.grids.push(Grid { area, spacing: 4.0 / 7.0, height: 0.8, ..Grid::default() });
    let grid = &measured(&scene).grids[0];
    assert_eq!((grid.size, grid.summary.points), ([7, 7], 49));
    for point in &grid.points {
        let ([x, y, z], reading) = point.expect("the whole rectangle");
        let (across, height) = ((x - 0.3).hypot(z + 0.4), 3.0 - y);
        let expected = 1000.0 * height / across.hypot(height).powi(3);
        assert!((reading.value / expected - 1.0).abs() < 2e-5, "{reading:?} instead of {expected}");
    }
}

#[test]
fn cylinders_under_a_point_source() {
    // E_z = I sin θ / π d², and (1 + cos α) times that for half a cylinder (EN 13201-3); θ from the axis, α from where it faces.
    let mut scene = sampled(Scene::default(), 4096);
    let lamp = [0.8, 4.0, -1.1];
    scene.lights.push(light(LightShape::Point, Transform::translation(lamp), [1000.0; 3]));
    let position = [-0.5, 1.2, 0.2];
    let [x, y, z] = [0, 1, 2].map(|i| lamp[i] - position[i]);
    let square = x * x + y * y + z * z;
    let whole = 1000.0 * x.hypot(z) / (PI * square.powf(1.5));
    let cosine = -z / x.hypot(z);
    for (measurand, expected) in [(Measurand::Cylindrical, whole), (Measurand::Semicylindrical, whole * (1.0 + cosine))] {
        let found = reading(&scene, meter(position, measurand));
        assert_near(found, expected);
        assert!(found.standard_error < 0.01 * expected, "{measurand:?}: {found:?}");
    }
}

#[test]
fn under_a_disk_source() {
    // E = π L r² / (r² + h²).
    let mut scene = sampled(Scene::default(), 4096);
    scene.lights.push(light(LightShape::Disk { radius: 0.5 }, facing_down([0.0, 1.5, 0.0]), [100.0; 3]));
    let found = reading(&scene, meter([0.0; 3], Measurand::Illuminance));
    assert_near(found, 100.0 * PI * 0.25 / 2.5);
    assert!(found.standard_error < 0.05, "{found:?}");
}

#[test]
fn everything_under_a_uniform_sky() {
    // Luminance L all around: E = E_z = E_sz = π L.
    let mut scene = sampled(Scene::default(), 4096);
    scene.lights.push(uniform_sky(50.0));
    for measurand in [Measurand::Illuminance, Measurand::Cylindrical, Measurand::Semicylindrical] {
        assert_near(reading(&scene, meter([3.0, 1.0, 2.0], measurand)), 50.0 * PI);
    }
    scene.lights[0].visibility = Visibility::default();
    assert_near(reading(&scene, meter([0.0; 3], Measurand::Luminance)), 50.0);
}

#[test]
fn luminance_meters_see_lit_surfaces() {
    // L = ρ E / π of a Lambertian floor under the disk of 0.5 m at 1.5 m.
    let mut scene = sampled(floor(0.4), 4096);
    scene.lights.push(light(LightShape::Disk { radius: 0.5 }, facing_down([0.0, 1.5, 0.0]), [100.0; 3]));
    let looking = Meter { facing: [0.0, -1.0, 0.0], ..meter([0.0, 1.0, 0.0], Measurand::Luminance) };
    assert_near(reading(&scene, looking), 0.4 * 100.0 * 0.25 / 2.5);
}

#[test]
fn half_a_sky_is_a_daylight_factor_of_fifty() {
    // A black wall that fills half of the sky; the lamp and the glowing wall do not count.
    let mut scene = sampled(Scene::default(), 4096);
    let mut wall = Material::diffuse(Origin::new("wall"), [0.0; 3]);
    wall.closures[0].set_colour("emission_color", [500.0; 3]);
    add_quad(&mut scene, [-1e4, -1.0, -0.01], [2e4, 0.0, 0.0], [0.0, 1e4, 0.0], wall);
    scene.lights.push(uniform_sky(7.0));
    scene.lights.push(light(LightShape::Point, Transform::translation([0.0, 2.0, 1.0]), [1000.0; 3]));
    let found = reading(&scene, meter([0.0; 3], Measurand::DaylightFactor));
    assert!((found.value - 50.0).abs() < 5.0 * found.standard_error + 0.01, "{found:?}");
    assert!(found.standard_error < 0.5, "{found:?}");
    let mut dark = scene.clone();
    dark.lights.remove(0);
    dark.meters.push(meter([0.0; 3], Measurand::DaylightFactor));
    let mut watch = Watch { previous: None, cancel: &AtomicBool::new(false), progress: &mut |_| true };
    let error = measure(&dark, Execution::best(), &mut watch).expect_err("no sky").to_string();
    assert!(error.contains("sky"), "{error}");
}

/// A sky through haze and smoke with fire in it, which lie above the origin and send so much radiance a metre.
fn through_what_glows(radiance: f32) -> Scene {
    let emission = [radiance; 3];
    let mut scene = sampled(floor(0.3), 4096);
    scene.lights.push(uniform_sky(7.0));
    // Of all space: nothing would come of the sky through what takes light away.
    scene.atmosphere = Medium { emission, ..Medium::default() };
    let smoke = Medium { emission, absorption: [0.3; 3], scattering: [0.2; 3], ..Medium::default() };
    let lattice = || Lattice::of_values(&[0.5, 1.0, 2.0, 0.5, 1.0, 1.5, 0.2, 0.9], [2; 3]).expect("a lattice");
    let to_world = Transform::translation([-0.5, 1.0, -0.5]);
    let field = Field { density: lattice(), heat: Some(lattice()), hottest: 2.0, to_world, ..Field::default() };
    scene.add_volume(field, smoke);
    scene
}

#[test]
fn no_medium_that_glows_is_daylight() {
    // An even sky through a slab without bounds that absorbs alone: 2 E₃(τ) of it arrives, 44.3209 % of it at τ = 0.5 (Abramowitz and Stegun 5.1).
    let mut scene = sampled(Scene::default(), 4096);
    scene.lights.push(uniform_sky(7.0));
    let slab = Medium { emission: [40.0; 3], absorption: [0.5; 3], ..Medium::default() };
    scene.add_filled(Mesh::of_box([-1e3, 0.5, -1e3], [1e3, 1.5, 1e3]), slab, Transform::IDENTITY);
    let found = reading(&scene, meter([0.0; 3], Measurand::DaylightFactor));
    assert!(found.standard_error < 0.5, "{found:?}");
    assert_near(found, 44.3209);
    // What absorbs and scatters stays, and all else is the same scene.
    let factor = |radiance| reading(&through_what_glows(radiance), meter([0.0, 0.1, 0.0], Measurand::DaylightFactor));
    let (dark, glowing) = (factor(0.0), factor(500.0));
    assert!(dark.value > 50.0 && dark.value < 95.0 && dark.standard_error < 1.0, "{dark:?}");
    assert_near(glowing, dark.value);
}

#[test]
fn the_mean_over_a_closed_rooms_walls_is_the_series() {
    // A lamp in the middle of a cube of 4 m: all its flux Φ lands on the walls, and ρ of it again and again: mean E = Φ / (S (1 − ρ)).
    let (mut scene, reflectance, half) = (Scene::default(), 0.5, 2.0f32);
    let corners: Vec<[f32; 3]> = (0..8u8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -half } else { half })).collect();
    let quads: [[u32; 4]; 6] = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    for quad in quads {
        let points = quad.map(|corner| corners[corner as usize]);
        let wall = Material::diffuse(Origin::new("wall"), [reflectance; 3]);
        // Wound so that the walls face the room, and luxmeters on them too.
        add_triangles(&mut scene, &points, &[[0, 2, 1], [0, 3, 2]], wall);
    }
    scene.lights.push(light(LightShape::Point, Transform::IDENTITY, [100.0; 3]));
    scene.settings.max_bounces = 64;
    let area = |mesh| GridArea::Mesh { mesh: MeshId(mesh), transform: Transform::IDENTITY };
    scene.grids = (0..6).map(|mesh| Grid { area: area(mesh), spacing: 0.25, ..Grid::default() }).collect();
    let found = measured(&sampled(scene, 1024));
    let mean: f64 = found.grids.iter().map(|grid| grid.summary.average.value).sum::<f64>() / 6.0;
    let expected = 400.0 * PI / (96.0 * (1.0 - f64::from(reflectance)));
    // The lattice of 16 × 16 midpoints integrates the direct part within 0.1 %.
    assert!((mean / expected - 1.0).abs() < 2e-3, "{mean} instead of {expected}");
}

#[test]
fn readings_are_the_same_at_every_level_and_number_of_threads() {
    let mut scene = sampled(floor(0.5), 256);
    scene.lights.push(uniform_sky(1.0));
    scene.lights.push(light(LightShape::Disk { radius: 0.5 }, facing_down([0.0, 1.5, 0.0]), [100.0; 3]));
    let area = GridArea::Rectangle { corner: [-2.0, 0.5, 2.0], edges: [[4.0, 0.0, 0.0], [0.0, 0.0, -4.0]] };
    scene.grids.push(Grid { area, spacing: 0.2, ..Grid::default() });
    let values = |threads, execution| {
        let mut scene = scene.clone();
        scene.settings.threads = threads;
        measured_at(&scene, execution).grids[0].clone()
    };
    let reference = values(1, Execution::best());
    assert_eq!(reference, values(3, Execution::best()));
    let scalar = values(2, Execution::Scalar);
    let (a, b) = (reference.summary.average, scalar.summary.average);
    assert!((a.value / b.value - 1.0).abs() < 1e-3, "{a:?} {b:?}");
}
