//! Whole measurements of samples.

mod closed_forms;

use super::{Options, Orientation, Progress, SampleReading, Stop, Window, measure};
use crate::light_paths::test_scenes::add;
use crate::{
    error::{Error, Result},
    scene::{Closure, Light, LightShape, Material, Model, Origin, Scene, Transform},
};
use gonio_formats::bsdf::{Basis, Hemispheres, Measured, read, xml};
use gonio_simd::Execution;
use std::{f64::consts::PI, sync::atomic::AtomicBool};

fn options(rays: u64) -> Options {
    Options {
        orientation: Orientation::default(),
        window: Some(Window { min: [-0.5; 2], max: [0.5; 2] }),
        repeats: 0,
        basis: Basis::known("LBNL/Klems Quarter").expect("a known basis"),
        sides: [true; 2],
        colour: false,
        stop: Stop { error: 0.0, rays, time: None },
        seed: 1,
        threads: 2,
    }
}

fn measured(scene: &Scene, options: &Options) -> Result<SampleReading> {
    measure(scene, options, Execution::best(), &AtomicBool::new(false), &mut |_: &Progress| true)
}

/// A square in the plane z, whose normal looks up or down.
fn square(scene: &mut Scene, half: f32, z: f32, up: bool, material: Material) {
    let points = [[-half, -half, z], [half, -half, z], [half, half, z], [-half, half, z]];
    let triangles = if up { [[0, 1, 2], [0, 2, 3]] } else { [[0, 2, 1], [0, 3, 2]] };
    add(scene, &points, &triangles, material);
}

fn material(colour: [f32; 3], parameters: &[(&str, f32)]) -> Material {
    let mut closure = Closure::default();
    closure.set_colour("base_color", colour);
    parameters.iter().for_each(|(name, value)| closure.set(name, *value));
    Material::of(Origin::new("material"), closure)
}

fn mirror(reflectance: f32) -> Material {
    let mut closure = Closure::default();
    closure.set_colour("base_color", [reflectance; 3]);
    closure.set_colour("specular_color", [reflectance; 3]);
    closure.set("metalness", 1.0);
    closure.set("specular_roughness", 0.0);
    Material::of(Origin::new("mirror"), closure)
}

fn near(found: f64, expected: f64, relative: f64, what: &str) {
    assert!((found / expected - 1.0).abs() < relative, "{what}: {found} instead of {expected}");
}

/// A large sheet in the plane z = 0.
fn sheet(material: Material) -> Scene {
    let mut scene = Scene::default();
    square(&mut scene, 10.0, 0.0, true, material);
    scene
}

#[test]
fn the_file_holds_what_was_measured() {
    let sheet = sheet(material([0.7, 0.6, 0.5], &[("specular_roughness", 0.3)]));
    let reading = measured(&sheet, &options(1 << 14)).expect("a reading");
    let patches = reading.patches().expect("matrices");
    let again = read(xml::write_patches(&patches, "sheet").as_bytes(), "sheet.xml").expect("a file");
    let Measured::Patches(again) = again else { panic!("other than matrices") };
    for side in &reading.sides {
        let hemispheres = if side.from_front { Hemispheres::ReflectionFront } else { Hemispheres::ReflectionBack };
        let matrix = again.matrix(hemispheres, gonio_formats::bsdf::Band::Visible).expect("a matrix");
        for (found, from) in again.totals(matrix).iter().zip(&side.from) {
            near(*found, from.reflected.value, 1e-4, "totals");
            assert!(from.reflected.value <= 1.0 + 4.0 * from.reflected.error);
        }
    }
}

#[test]
fn readings_are_the_same_on_any_number_of_threads() {
    let bits = |threads| {
        let options = Options { threads, stop: Stop { error: 0.025, rays: 1 << 18, time: None }, ..options(0) };
        let reading = measured(&sheet(material([0.7; 3], &[("specular_roughness", 0.5)])), &options).expect("a reading");
        let values = reading.sides.iter().flat_map(|side| side.reflected.as_flattened().iter().chain(&side.reflected_errors));
        (values.map(|value| value.to_bits()).collect::<Vec<_>>(), reading.paths, reading.converged)
    };
    let [one, two] = [1, 2].map(bits);
    assert!(one == two);
    assert!(one.2 && one.1 < 82 << 18, "{}", one.1);
}

#[test]
fn samples_may_lie_in_any_plane() {
    let mut scene = Scene::default();
    // The front looks along −x, and is red there; the back is blue.
    let points = [[0.0, -2.0, -2.0], [0.0, -2.0, 2.0], [0.0, 2.0, 2.0], [0.0, 2.0, -2.0]];
    add(&mut scene, &points, &[[0, 1, 2], [0, 2, 3]], mirror(0.5));
    let orientation = Orientation { front: [-1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };
    let reading = measured(&scene, &Options { orientation, window: None, ..options(1 << 13) }).expect("a reading");
    assert_eq!(reading.window.size(), [4.0, 4.0]);
    near(reading.sides[0].reflected[5 * 41 + 5][0], 0.5, 0.02, "the mirrored patch");
}

#[test]
fn what_is_lost_sideways_is_told() {
    let mut scene = Scene::default();
    // Two panes that are not there, far apart.
    let air = || material([0.0; 3], &[("geometry_opacity", 0.0)]);
    square(&mut scene, 0.5, 0.5, true, air());
    square(&mut scene, 0.5, -0.5, true, air());
    scene.lights.push(Light::new(Origin::new("lamp"), LightShape::Point, Transform::IDENTITY));
    let reading = measured(&scene, &options(1 << 13)).expect("a reading");
    let told: Vec<String> = reading.diagnostics.iter().map(ToString::to_string).collect();
    assert!(told.iter().any(|text| text.contains("leaves sideways")) && told.iter().any(|text| text.contains("lamp")), "{told:?}");
    // Opposite unit squares at distance 1: a view factor of 0.1998.
    let through = reading.of_diffuse(&reading.sides[0], |from| from.transmitted);
    assert!((through.value - 0.1998).abs() < 0.003, "{through:?}");
    assert!((through.value + reading.of_diffuse(&reading.sides[0], |from| from.lost).value - 1.0).abs() < 1e-3);
}

#[test]
fn what_cannot_be_measured_is_told() {
    let told = |scene: &Scene, options: &Options| measured(scene, options).expect_err("no reading").to_string();
    let sheet = sheet(mirror(1.0));
    assert!(told(&Scene::default(), &options(1)).contains("no geometry"));
    let window = |min, max| Options { window: Some(Window { min, max }), ..options(1) };
    assert!(told(&sheet, &window([0.0; 2], [0.0, 1.0])).contains("window"));
    assert!(told(&sheet, &window([20.0; 2], [21.0; 2])).contains("beside the sample"));
    let edge_on = Orientation { front: [1.0, 0.0, 0.0], up: [0.0, 0.0, 1.0] };
    assert!(told(&sheet, &Options { orientation: edge_on, window: None, ..options(1) }).contains("does the front look that way"));
    assert!(told(&sheet, &Options { repeats: 100_000, ..options(1) }).contains("repeat"));
    assert!(told(&sheet, &Options { sides: [false; 2], ..options(1) }).contains("neither"));
    let stopped = measure(&sheet, &options(1 << 30), Execution::best(), &AtomicBool::new(false), &mut |progress| progress.paths == 0);
    assert!(matches!(stopped, Err(Error::Cancelled)), "{stopped:?}");
}
