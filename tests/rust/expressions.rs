//! Light path expressions that are followed along paths: parts sum up to the whole, and light falls as closed forms say.

use gonio::{
    film::Image,
    scene::{Aov, Camera, Integrator, LightShape, Material, Origin, Scene, Settings, Transform},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{self, compiled, settings},
    scenes::{add_triangles, facing_down, light, varied},
};

fn render(scene: &mut Scene, samples: u32, names: &[&str]) -> Image {
    let Settings { integrator, threads, .. } = scene.settings;
    scene.settings = Settings { integrator, threads, ..settings(40, samples, &[Aov::Color]) };
    let passes: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    scene.settings.set_passes(&passes).expect("known passes");
    picture::render(&compiled(scene), &scene.settings, Execution::best())
}

/// Whether expressions sum up to the first pass, which is the colour; and which of them show light.
fn check_sum(scene: &mut Scene, expressions: &[&str]) -> Vec<bool> {
    let names: Vec<&str> = ["color"].into_iter().chain(expressions.iter().copied()).collect();
    let image = render(scene, 16, &names);
    let [colour, parts @ ..] = image.layers.as_slice() else { panic!("no passes") };
    let colour: Vec<f32> = colour.values.chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    let brightest = colour.iter().copied().fold(0.0, f32::max);
    let worst = colour.iter().enumerate().map(|(at, colour)| (parts.iter().map(|part| part.values[at]).sum::<f32>() - colour).abs());
    let worst = worst.fold(0.0, f32::max);
    assert!(worst < 2e-5 * brightest, "{expressions:?}: {worst} of {brightest}");
    parts.iter().map(|part| part.values.iter().any(|value| *value > 1e-5 * brightest)).collect()
}

fn lit() -> Scene {
    let mut scene = varied();
    let mut key = light(LightShape::Disk { radius: 0.3 }, facing_down([0.0, 2.5, 0.5]), [5.0, 2.0, 1.0]);
    key.group = "key".into();
    scene.lights.push(key);
    scene
}

#[test]
fn parts_by_scatterings_sum_up_to_the_colour() {
    let mut scene = lit();
    for integrator in [Integrator::Path, Integrator::Whitted] {
        scene.settings.integrator = integrator;
        check_sum(&mut scene, &["lpe:CL", "lpe:C<RD>L", "lpe:C<RD>D.*L", "lpe:C<RD>[^D]+.*L", "lpe:C[^D].*L", "lpe:C<TD>.*L"]);
        check_sum(&mut scene, &["lpe:CL", "lpe:C.L", "lpe:C.{2}L", "lpe:C.{3}L", "lpe:C.{4,}L"]);
        check_sum(&mut scene, &["lpe:C[^D]*L", "lpe:C[^D]*D[^D]*L", "lpe:C[^D]*D[^D]*D.*L"]);
        let sharp = check_sum(&mut scene, &["lpe:C<R[GS]>.*L|C<T[GS]>.*L", "lpe:C[^GS].*L", "lpe:CL"]);
        assert_eq!(sharp, [true, true, false]);
    }
}

#[test]
fn mirrors_are_sharp_and_not_glossy() {
    let seen = check_sum(&mut lit(), &["lpe:CS.*L|C<RG>V", "lpe:CG.*L|C<RS>V", "lpe:CD.*L", "lpe:CL"]);
    // The scene has smooth surfaces alone.
    assert_eq!(seen, [true, false, true, false]);
}

#[test]
fn groups_of_lights_are_told_apart_with_their_paths() {
    let parts = ["lpe:C<RD>+<L.'key'>", "lpe:C<RD>+<L.[^'key']>", "lpe:C<RD>*[GST].*<L.'key'>", "lpe:C<RD>*[GST].*<L.'other'>", "lpe:CL"];
    assert_eq!(check_sum(&mut lit(), &parts), [true, true, true, true, false]);
    let image = render(&mut lit(), 16, &["lightgroup:key", parts[0], parts[2]]);
    let [group, one, other] = image.layers.as_slice() else { panic!("three passes") };
    let brightest = group.values.iter().copied().fold(0.0, f32::max);
    assert!(group.values.iter().enumerate().all(|(at, value)| (one.values[at] + other.values[at] - value).abs() < 2e-5 * brightest));
}

#[test]
fn the_colour_is_the_same_with_expressions_and_without() {
    let plain = render(&mut lit(), 16, &["color"]);
    for threads in [1, 3] {
        let mut scene = lit();
        scene.settings.threads = threads;
        let image = render(&mut scene, 16, &["color", "lpe:C<RD><RD>L", "lpe:C.*<L.[^'key']>"]);
        assert_eq!(image.layers[0].values, plain.layers[0].values);
    }
}

/// In a closed box whose walls emit E and reflect a, light that was scattered n times is E aⁿ.
#[test]
fn light_in_a_furnace_falls_with_each_scattering() {
    let (albedo, emitted) = (0.6_f32, 2.0_f32);
    let mut wall = Material::diffuse(Origin::new("wall"), [albedo; 3]);
    wall.closures[0].set_colour("emission_color", [emitted; 3]);
    let corners: Vec<[f32; 3]> = (0..8).map(|i| [0, 1, 2].map(|axis| if i >> axis & 1 == 0 { -1.0 } else { 1.0 })).collect();
    let faces = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    let mut scene = Scene::default();
    add_triangles(&mut scene, &corners, &triangles, wall);
    scene.cameras.push(Camera::perspective(Origin::new("camera"), Transform::IDENTITY, 40.0, 1.0));
    let names = ["color", "lpe:CO", "lpe:C.O", "lpe:C.{2}O", "lpe:C.{3}O", "lpe:C.{4}O"];
    let image = render(&mut scene, 64, &names);
    for (count, layer) in image.layers[1..].iter().enumerate() {
        let mean = layer.values.iter().map(|value| f64::from(*value)).sum::<f64>() / layer.values.len() as f64;
        let expected = f64::from(emitted * albedo.powi(count as i32));
        assert!((mean / expected - 1.0).abs() < 0.02, "{}: {mean}, expected {expected}", layer.name);
    }
}
