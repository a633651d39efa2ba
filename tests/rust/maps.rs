//! Illumination maps against closed forms.

use gonio::{
    compile::compile,
    light_paths::Watch,
    map::{Chart, IlluminationMaps, Looks, MapOptions, Quantity, TexelSize, illumination_maps, view},
    scene::{LightShape, Material, Mesh, Origin, Primvar, PrimvarInterpolation, Scene, Settings, Transform},
};
use gonio_simd::Execution;
use gonio_tests::scenes::{add_quad, camera_from_above, cut_out, light};
use std::{f64::consts::PI, sync::Arc, sync::atomic::AtomicBool};

fn mapped(scene: &Scene, options: &MapOptions) -> gonio::Result<IlluminationMaps> {
    let compiled = compile(scene, None, &AtomicBool::new(false)).expect("a scene");
    let mut watch = Watch { cancel: &AtomicBool::new(false), progress: &mut |_| true };
    illumination_maps(scene, &compiled, options, Execution::best(), &mut watch)
}

fn options(texel: f64, paths: u64) -> MapOptions {
    MapOptions { texel: TexelSize::Metres(texel), error: 0.0, paths, ..MapOptions::default() }
}

/// A floor of 4 m by 4 m about the origin under a point of 1000 cd at 2 m; its coordinates leave a border.
fn floor(reflectance: f32) -> Scene {
    let mut scene = Scene::default();
    add_quad(&mut scene, [-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0], Material::diffuse(Origin::new("floor"), [reflectance; 3]));
    let values = [0.1, 0.1, 0.9, 0.1, 0.9, 0.9, 0.1, 0.9];
    let uv =
        Primvar { name: "st".into(), interpolation: PrimvarInterpolation::Vertex, components: 2, values: Arc::from(values), indices: None };
    scene.meshes[0] = Mesh { primvars: vec![uv], ..scene.meshes[0].clone() };
    scene.instances[0].origin = Origin::new("/Room/Floor");
    scene.lights.push(light(LightShape::Point, Transform::translation([0.0, 2.0, 0.0]), [1000.0; 3]));
    scene.settings.threads = 2;
    scene
}

/// A closed box of 3 by 2 by 2.5 m whose insides have a reflectance, lit by a point of 1000 lm.
fn furnace(reflectance: f32) -> Scene {
    let mut scene = Scene::default();
    let matt = || Material::diffuse(Origin::new("wall"), [reflectance; 3]);
    let (x, y, z) = (3.0, 2.0, 2.5);
    for (corner, u, v) in [
        ([0.0, 0.0, 0.0], [0.0, 0.0, z], [x, 0.0, 0.0]),
        ([0.0, y, 0.0], [x, 0.0, 0.0], [0.0, 0.0, z]),
        ([0.0, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]),
        ([x, 0.0, 0.0], [0.0, 0.0, z], [0.0, y, 0.0]),
        ([0.0, 0.0, 0.0], [x, 0.0, 0.0], [0.0, y, 0.0]),
        ([0.0, 0.0, z], [0.0, y, 0.0], [x, 0.0, 0.0]),
    ] {
        add_quad(&mut scene, corner, u, v, matt());
    }
    let strength = (1000.0 / (4.0 * PI)) as f32;
    scene.lights.push(light(LightShape::Point, Transform::translation([0.7, 1.1, 1.6]), [strength; 3]));
    scene.settings.threads = 2;
    scene
}

/// Mean of I h / d³ over a square about x, z.
fn under_the_point([x, z]: [f64; 2], side: f64) -> f64 {
    const PARTS: usize = 8;
    let offset = |i: usize| ((i as f64 + 0.5) / PARTS as f64 - 0.5) * side;
    let at = |i: usize| 1000.0 * 2.0 / ((x + offset(i % PARTS)).powi(2) + (z + offset(i / PARTS)).powi(2) + 4.0).powf(1.5);
    (0..PARTS * PARTS).map(at).sum::<f64>() / (PARTS * PARTS) as f64
}

#[test]
fn texels_obey_the_inverse_square_law() {
    // 20 texels a side, of which 16 are of the floor: 0.25 m each.
    let options = MapOptions { uv: Some("st".into()), texel: TexelSize::Resolution([20, 20]), ..options(1.0, 1 << 22) };
    let maps = mapped(&floor(0.0), &options).expect("a map");
    let map = &maps.surfaces[0];
    let front = map.sides[0].as_ref().expect("light");
    assert!(map.sides[1].is_none());
    let (mut known, mut squares) = (0, 0.0);
    for (texel, lux) in front.illuminance.iter().enumerate().filter(|(_, lux)| lux.is_finite()) {
        let [x, z] = [texel % 20, texel / 20].map(|at| (at as f64 + 0.5) * 0.25 - 2.5);
        let expected = under_the_point([x, z], 0.25);
        let deviation = f64::from(*lux) / expected - 1.0;
        let error = f64::from(front.standard_error[texel]) / expected;
        assert!(deviation.abs() < 5.0 * error && error < 0.03, "{x} {z}: {lux} instead of {expected}, {error}");
        squares += (deviation / error).powi(2);
        known += 1;
    }
    assert_eq!(known, 256);
    // Errors are told as if arrivals were independent; nets do better.
    assert!(squares / 256.0 < 1.3, "{}", squares / 256.0);
    let total = &maps.surfaces[0].summaries[0];
    assert!((total.mean() / under_the_point([0.0; 2], 4.0) - 1.0).abs() < 5e-3, "{total:?}");
}

#[test]
fn a_white_furnace_is_as_bright_as_its_walls_return() {
    // E = Φ / (A (1 − ρ)), and Φ / A straight from the lamp.
    let maps = mapped(&furnace(0.5), &options(0.25, 1 << 20)).expect("maps");
    let area: f64 = maps.surfaces.iter().map(|map| map.surface.area()).sum();
    let lumens = |pick: &dyn Fn(&gonio::map::Summary) -> f64| maps.surfaces.iter().map(|map| pick(&map.summaries[0])).sum::<f64>();
    assert!((area - 37.0).abs() < 1e-4);
    assert!((lumens(&|s| s.flux) / area / (1000.0 / (area * 0.5)) - 1.0).abs() < 5e-3, "{}", lumens(&|s| s.flux) / area);
    assert!((lumens(&|s| s.direct) / 1000.0 - 1.0).abs() < 1e-3, "{}", lumens(&|s| s.direct));
    assert!((maps.emitted / 1000.0 - 1.0).abs() < 1e-3 && maps.cut_off < 0.1);
    assert!(maps.surfaces.iter().all(|map| map.sides[1].is_none()), "nothing leaves the box");
}

#[test]
fn texels_and_triangles_agree() {
    let scene = floor(0.4);
    let texels = MapOptions { uv: Some("st".into()), texel: TexelSize::Metres(0.1), ..options(0.1, 1 << 21) };
    let (texels, cells) = (mapped(&scene, &texels).expect("a map"), mapped(&scene, &options(0.1, 1 << 21)).expect("a map"));
    // The same paths have left the same flux.
    let [a, b] = [&texels, &cells].map(|maps| maps.surfaces[0].summaries[0].flux);
    assert!((a / b - 1.0).abs() < 1e-6, "{a} {b}");
    let places = (0..200).map(|i| [i % 20, i / 20]).filter(|[x, y]| x + y < 20).map(|place| place.map(|at| (at as f32 + 0.3) / 21.0));
    let ratios: Vec<f64> = places
        .map(|place| {
            let [a, b] = [&texels, &cells].map(|maps| f64::from(maps.surfaces[0].at(0, 0, place, Quantity::Illuminance)));
            assert!((a / b - 1.0).abs() < 0.3, "{place:?}: {a} {b}");
            a / b
        })
        .collect();
    assert!((ratios.iter().sum::<f64>() / ratios.len() as f64 - 1.0).abs() < 0.015);
}

#[test]
fn maps_are_the_same_for_any_threads() {
    let with = |threads| {
        let mut scene = furnace(0.5);
        scene.settings.threads = threads;
        let options = MapOptions { error: 0.2, colours: true, ..options(0.2, 1 << 19) };
        let maps = mapped(&scene, &options).expect("maps");
        (maps.paths, maps.surfaces.into_iter().map(|map| map.sides[0].clone().expect("light").colour).collect::<Vec<_>>())
    };
    assert_eq!(with(1), with(2));
}

#[test]
fn triangles_are_divided_where_light_is_enough() {
    let sharp = MapOptions { error: 0.05, ..options(0.02, 1 << 20) };
    let maps = mapped(&floor(0.0), &sharp).expect("a map");
    let map = &maps.surfaces[0];
    let front = map.sides[0].as_ref().expect("light");
    let Chart::Cells(chart) = &map.chart else { panic!("triangles") };
    let finest = chart.level(0);
    assert!(front.level.iter().all(|level| *level < finest && *level > 1), "{finest}");
    // Quarters may be held against the mean of the part that they are of.
    let worst = front.standard_error.iter().zip(&front.illuminance).map(|(error, lux)| error / lux).fold(0.0, f32::max);
    assert!(worst < 0.06, "{worst}");
}

#[test]
fn cameras_see_finished_maps() {
    let mut scene = floor(0.0);
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 4.0));
    let compiled = compile(&scene, None, &AtomicBool::new(false)).expect("a scene");
    let maps = mapped(&scene, &options(0.25, 1 << 22)).expect("a map");
    let settings = Settings { resolution: [16, 16], ..scene.settings.clone() };
    let looks = Looks { side: 4, smooth: false };
    let (values, size) = view(&maps, &compiled, &settings, Quantity::Illuminance, looks, Execution::best()).expect("a view");
    assert_eq!(size, [16, 16]);
    for (pixel, lux) in values.iter().enumerate() {
        let [x, z] = [pixel % 16, pixel / 16].map(|at| (at as f64 + 0.5) * 0.25 - 2.0);
        let expected = under_the_point([x, z], 0.25);
        assert!((f64::from(*lux) / expected - 1.0).abs() < 0.12, "{pixel}: {lux} instead of {expected}");
    }
}

#[test]
fn openings_let_direct_light_through() {
    // What is there by a share keeps that share.
    let [whole, part] =
        [1.0, 0.25].map(|opacity| mapped(&cut_out(opacity), &options(0.5, 1 << 18)).expect("a map").surfaces[0].summaries[0].direct);
    assert!((part / whole / 0.25 - 1.0).abs() < 0.02, "{part} {whole}");
}

#[test]
fn what_makes_no_map_is_told() {
    let scene = floor(0.5);
    let complain = |options: MapOptions| mapped(&scene, &options).expect_err("no map").to_string();
    let with = |change: &dyn Fn(&mut MapOptions)| {
        let mut options = options(0.5, 4096);
        change(&mut options);
        complain(options)
    };
    assert!(with(&|o| o.prims = vec!["/Nowhere".into()]).contains("/Nowhere"));
    assert!(with(&|o| o.uv = Some("map9".into())).contains("it has st"));
    assert!(with(&|o| (o.texel, o.memory) = (TexelSize::Metres(1e-3), 1 << 20)).contains("1 are allowed"));
    assert!(with(&|o| o.texel = TexelSize::Metres(f64::NAN)).contains("texel"));
    assert!(with(&|o| o.error = 1.0).contains("error"));
    assert!(with(&|o| o.paths = 0).contains("paths"));
    let dark = Scene { lights: Vec::new(), ..scene.clone() };
    assert!(mapped(&dark, &options(0.5, 4096)).expect_err("no light").to_string().contains("light"));
}

#[test]
fn a_million_triangles_take_what_is_stated() {
    let side = 708;
    let points: Vec<[f32; 3]> = (0..=side).flat_map(|z| (0..=side).map(move |x| [x as f32, 0.0, -(z as f32)])).collect();
    let at = |x: u32, z: u32| z * (side + 1) + x;
    let squares = (0..side).flat_map(|z| (0..side).map(move |x| (x, z)));
    let triangles: Vec<[u32; 3]> =
        squares.flat_map(|(x, z)| [[at(x, z), at(x + 1, z), at(x + 1, z + 1)], [at(x, z), at(x + 1, z + 1), at(x, z + 1)]]).collect();
    let mut scene = floor(0.5);
    scene.meshes[0] = Mesh { points: Arc::from(points), triangles: Arc::from(triangles), ..Mesh::default() };
    scene.lights[0] = light(LightShape::Point, Transform::translation([354.0, 200.0, -354.0]), [1000.0; 3]);
    let maps = mapped(&scene, &MapOptions { paths: 1 << 16, ..MapOptions::default() }).expect("a map");
    assert_eq!(maps.surfaces[0].chart.len(), 1_002_528);
    assert!(maps.memory < 112 << 20, "{}", maps.memory);
}
