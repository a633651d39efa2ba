//! Path guiding: the same mean as without, a closed form, the same bits for any number of threads and parts, less noise behind a gap.

use gonio::{
    camera::sampler::hash,
    checkpoint::{Identity, merge, write_checkpoint},
    compile::CompiledScene,
    film::Image,
    render::Render,
    scene::{Aov, DomeFormat, Guiding, LightPart, LightShape, Material, Origin, ScatteringKind, Scene, Settings, Transform},
    transport::{GuidingField, GuidingNote, Learning},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, mean, settings},
    scenes::{add_quad, add_triangles, camera_from_above, layered, light},
};
use std::{f32::consts::PI, sync::Arc};

const DIFFUSE: Aov = Aov::Light(ScatteringKind::Diffuse, LightPart::Indirect);
const GLOSSY: Aov = Aov::Light(ScatteringKind::Glossy, LightPart::Indirect);

/// A dark room, z > 0, that gets its light from a bright one through a gap; seen is the dark one's floor.
fn two_rooms(wall: &Material) -> Scene {
    let mut scene = Scene::default();
    let (x, h, z) = (2.0, 2.5, 3.0);
    add_quad(&mut scene, [-x, 0.0, z], [2.0 * x, 0.0, 0.0], [0.0, 0.0, -2.0 * z], wall.clone());
    add_quad(&mut scene, [-x, h, -z], [2.0 * x, 0.0, 0.0], [0.0, 0.0, 2.0 * z], wall.clone());
    add_quad(&mut scene, [-x, 0.0, -z], [2.0 * x, 0.0, 0.0], [0.0, h, 0.0], wall.clone());
    add_quad(&mut scene, [x, 0.0, z], [-2.0 * x, 0.0, 0.0], [0.0, h, 0.0], wall.clone());
    add_quad(&mut scene, [-x, 0.0, z], [0.0, 0.0, -2.0 * z], [0.0, h, 0.0], wall.clone());
    add_quad(&mut scene, [x, 0.0, -z], [0.0, 0.0, 2.0 * z], [0.0, h, 0.0], wall.clone());
    add_quad(&mut scene, [-x, 0.0, 0.0], [2.0 * x - 0.3, 0.0, 0.0], [0.0, h, 0.0], wall.clone());
    scene.lights.push(light(LightShape::Sphere { radius: 0.1 }, Transform::translation([-1.0, 1.8, -1.8]), [2000.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 2.4, 1.5], 2.6));
    scene
}

fn diffuse() -> Material {
    Material::diffuse(Origin::new("wall"), [0.7, 0.65, 0.6])
}

fn guided(pixels: u32, samples: u32, guiding: Guiding, seed: u32) -> Settings {
    let aovs = [Aov::Color, DIFFUSE, GLOSSY];
    Settings { guiding, seed, max_bounces: 8, ..settings(pixels, samples, &aovs) }
}

/// The picture, and what was told of guiding.
fn render(scene: &Arc<CompiledScene>, settings: &Settings) -> (Image, Option<String>) {
    let mut render = Render::start(scene.clone(), settings, Execution::best()).expect("the render starts");
    render.finish().expect("the render ends well");
    (render.film().develop(), render.guiding().map(str::to_owned))
}

fn is_followed(told: Option<&str>) -> bool {
    told.is_some_and(|told| told.contains("cells are followed") && !told.contains("given up"))
}

/// Every part of a sphere sees every other alike: with a part f open to a sky L₀, L = ρ (f L₀ + (1 − f) L).
#[test]
fn an_integrating_sphere_is_as_bright_as_its_closed_form() {
    const OPEN: f32 = 0.01;
    const WHITE: f32 = 0.7;
    const RINGS: u32 = 64;
    const SECTORS: u32 = 96;
    let first = (1.0 - 2.0 * OPEN).acos();
    let place = |ring: u32, sector: u32| {
        let (theta, phi) = (first + (PI - first) * ring as f32 / RINGS as f32, 2.0 * PI * sector as f32 / SECTORS as f32);
        [theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin()]
    };
    let points: Vec<[f32; 3]> = (0..=RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| place(ring, sector))).collect();
    let mut triangles = Vec::new();
    for (ring, sector) in (0..RINGS).flat_map(|ring| (0..SECTORS).map(move |sector| (ring, sector))) {
        let next = (sector + 1) % SECTORS;
        let [a, b, c, d] = [[ring, sector], [ring, next], [ring + 1, next], [ring + 1, sector]].map(|[r, s]| r * SECTORS + s);
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let mut scene = Scene::default();
    add_triangles(&mut scene, &points, &triangles, Material::diffuse(Origin::new("white"), [WHITE; 3]));
    scene.lights.push(light(LightShape::Dome { format: DomeFormat::LatLong }, Transform::IDENTITY, [1.0; 3]));
    scene.cameras.push(camera_from_above([0.0, 0.5, 0.0], 0.8));
    let settings = Settings { max_bounces: 200, ..guided(128, 64, Guiding::On, 0) };
    let (image, told) = render(&compiled(&scene), &settings);
    assert!(is_followed(told.as_deref()), "{told:?}");
    let expected = f64::from(WHITE * OPEN / (1.0 - WHITE * (1.0 - OPEN)));
    let found = mean(&image, Aov::Color, 0);
    assert!((found / expected - 1.0).abs() < 0.01, "{found} in place of {expected}");
}

/// Some pictures with guiding or without.
fn pictures(scene: &Arc<CompiledScene>, guiding: Guiding) -> Vec<Image> {
    let picture = |seed| {
        let (image, told) = render(scene, &guided(64, 64, guiding, seed));
        assert!(guiding == Guiding::Off || is_followed(told.as_deref()), "{told:?}");
        image
    };
    (0..8).map(picture).collect()
}

/// The mean of pictures and its standard error.
fn mean_of(pictures: &[Image], aov: Aov) -> [f64; 2] {
    let count = pictures.len() as f64;
    let found: Vec<f64> = pictures.iter().map(|image| mean(image, aov, 0)).collect();
    let mean = found.iter().sum::<f64>() / count;
    let square = found.iter().map(|one| (one - mean).powi(2)).sum::<f64>() / (count - 1.0);
    [mean, (square / count).sqrt()]
}

#[test]
fn the_mean_is_that_of_paths_without() {
    let glossy = layered([0.7, 0.65, 0.6], &[("specular_weight", 1.0), ("specular_roughness", 0.3)]);
    for (name, wall, aovs) in [("diffuse", diffuse(), vec![Aov::Color]), ("glossy", glossy, vec![Aov::Color, DIFFUSE, GLOSSY])] {
        let scene = compiled(&two_rooms(&wall));
        let both = [Guiding::Off, Guiding::On].map(|guiding| pictures(&scene, guiding));
        for aov in aovs {
            let [off, on] = both.each_ref().map(|pictures| mean_of(pictures, aov));
            let error = off[1].hypot(on[1]);
            assert!((off[0] - on[0]).abs() < 4.0 * error, "{name} {aov:?}: {off:?} and {on:?}");
            assert!(error < 0.03 * off[0], "{name} {aov:?}: {off:?} and {on:?} tell too little");
        }
    }
}

/// Mean squared difference of the colour.
fn apart(a: &Image, b: &Image) -> f64 {
    let [a, b] = [a, b].map(|image| &image.layer(Aov::Color).expect("colour").values);
    a.iter().zip(b.iter()).map(|(a, b)| f64::from(a - b).powi(2)).sum::<f64>() / a.len() as f64
}

#[test]
fn noise_is_less_behind_a_gap() {
    let scene = compiled(&two_rooms(&diffuse()));
    // Its own noise, an eighth of what is without, adds to both sides.
    let (long, _) = render(&scene, &guided(64, 2048, Guiding::Off, 99));
    let errors = [Guiding::Off, Guiding::On, Guiding::Auto].map(|guiding| {
        let (image, _) = render(&scene, &guided(64, 256, guiding, 0));
        apart(&image, &long)
    });
    assert!(errors[1] < 0.7 * errors[0], "{errors:?}");
}

#[test]
fn threads_and_parts_do_not_change_a_bit() {
    let mut scene = two_rooms(&diffuse());
    scene.settings = guided(130, 32, Guiding::On, 0);
    let compiled = compiled(&scene);
    let (whole, told) = render(&compiled, &scene.settings);
    assert!(is_followed(told.as_deref()), "{told:?}");
    assert!(whole == render(&compiled, &Settings { threads: 1, ..scene.settings.clone() }).0);
    let folder = std::env::temp_dir().join(format!("gonio-guiding-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut files = Vec::new();
    for (number, samples) in [[0, 16], [16, 32]].into_iter().enumerate() {
        let part = Settings { sample_range: Some(samples), ..scene.settings.clone() };
        let mut part_render = Render::start(compiled.clone(), &part, Execution::best()).expect("a render");
        part_render.finish().expect("an end");
        files.push(folder.join(format!("{number}.gonio")));
        let identity = Identity::new(&Scene { settings: part, ..scene.clone() }, Execution::best(), Vec::new());
        write_checkpoint(&files[number], &identity, part_render.film()).expect("a file");
    }
    let merged = merge(&files).expect("a film").film.develop();
    std::fs::remove_dir_all(&folder).expect("gone");
    assert!(merged == whole);
}

#[test]
fn what_was_not_learned_is_told() {
    let scene = compiled(&two_rooms(&diffuse()));
    let (off, nothing) = render(&scene, &guided(32, 4, Guiding::Off, 0));
    assert_eq!(nothing, None);
    let (auto, told) = render(&scene, &guided(32, 4, Guiding::Auto, 0));
    assert!(told.is_some_and(|told| told.contains("samples are too few")));
    assert!(off == auto);
}

/// On a floor, paths that went everywhere and found light within a cone about `bright`.
fn notes(bright: [f32; 3]) -> Vec<GuidingNote> {
    let number = |n: u32| (hash(n) >> 8) as f32 / 16_777_216.0;
    let note = |n: u32| {
        let (z, turn) = (number(4 * n).sqrt(), 2.0 * PI * number(4 * n + 1));
        let r = (1.0 - z * z).sqrt();
        let direction = [r * turn.cos(), r * turn.sin(), z];
        let cosine = (0..3).map(|axis| direction[axis] * bright[axis]).sum::<f32>();
        GuidingNote {
            position: [0.1 * number(4 * n + 2), 0.1 * number(4 * n + 3), 0.0],
            normal: [0.0, 0.0, 1.0],
            direction,
            pdf: z / PI,
            throughput: 0.5,
            bounces: 1,
            half: n.is_multiple_of(2),
            distance: 3.0,
            found: if cosine > 0.95 { 10.0 } else { 0.1 },
        }
    };
    (0..4000).map(note).collect()
}

#[test]
fn light_from_one_side_is_followed_and_even_light_is_not() {
    let Learning { gain, cells, .. } = GuidingField::learn(&notes([0.6, 0.0, 0.8])).expect("notes tell something");
    assert!(gain > 2.0 && cells[1] > 0, "gain {gain}, cells {cells:?}");
    let even: Vec<GuidingNote> = notes([0.0, 0.0, 1.0]).into_iter().map(|note| GuidingNote { found: 1.0, ..note }).collect();
    let gain = GuidingField::learn(&even).expect("notes tell something").gain;
    assert!(gain < 1.2, "gain {gain}");
    assert!(GuidingField::learn(&[]).is_none());
}
