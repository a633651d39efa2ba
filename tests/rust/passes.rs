//! Passes for compositing: cryptomattes, light path expressions, first surfaces.

use gonio::{
    checkpoint::{Identity, merge, write_checkpoint},
    film::Image,
    output::{ExrOptions, write_exr},
    render::Render,
    scene::{Aov, Closure, Integrator, LightShape, Material, MatteKind, MatteName, Model, Origin, Scene, Settings, matte_id},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{self, compiled, settings},
    scenes::{add_quad, camera_from_above, facing_down, light, varied},
};

/// Name, asset, material, opacity, corner and edges of sheets over one another, from the lowest to the highest.
type Sheet = (&'static str, &'static str, &'static str, f32, [[f32; 3]; 3]);
const SHEETS: [Sheet; 4] = [
    ("floor", "room", "stone", 1.0, [[-2.0, 0.0, 2.0], [4.0, 0.0, 0.0], [0.0, 0.0, -4.0]]),
    ("Größe", "things", "paint", 1.0, [[-1.0, 0.4, 0.7], [1.3, 0.0, 0.4], [0.3, 0.0, -1.4]]),
    ("gauze", "things", "gauze", 0.4, [[-0.3, 0.8, 0.9], [1.2, 0.0, 0.2], [-0.2, 0.0, -1.3]]),
    ("wire", "wire", "paint", 1.0, [[-1.2, 1.2, 0.1], [2.4, 0.0, -0.3], [0.0, 0.0, -0.04]]),
];

/// The sheets from above; those that are `lit` shine, and nothing else does.
fn sheets(lit: impl Fn(&Sheet) -> bool, samples: u32) -> Scene {
    let mut scene = Scene::default();
    for sheet in &SHEETS {
        let (name, asset, material, opacity, [corner, u, v]) = *sheet;
        let mut closure = Closure { model: Model::OpenPbr, ..Closure::default() };
        for (parameter, value) in [("specular_weight", 0.0), ("geometry_opacity", opacity)] {
            closure.set(parameter, value);
        }
        closure.set_colour("base_color", [0.0; 3]);
        closure.set_colour("emission_color", [if lit(sheet) { 1.0 } else { 0.0 }; 3]);
        add_quad(&mut scene, corner, u, v, Material::of(Origin::new(material), closure));
        let placed = scene.instances.last_mut().expect("just added");
        placed.matte_names = vec![MatteName { first: 0, object: name.into(), asset: asset.into() }];
    }
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 3.0));
    scene.settings = settings(48, samples, &[Aov::Color]);
    scene
}

fn render(scene: &Scene) -> Image {
    picture::render(&compiled(scene), &scene.settings, Execution::best())
}

fn with_mattes(mut scene: Scene) -> Scene {
    for (kind, ..) in MatteKind::NAMES {
        let layers = scene.settings.matte_layers(kind);
        scene.settings.aovs.extend(layers);
    }
    scene
}

/// How much of each pixel a name covers.
fn coverage(image: &Image, kind: MatteKind, name: &str) -> Vec<f32> {
    let id = matte_id(name);
    let layers = image.layers.iter().filter(|layer| matches!(layer.aov, Aov::Cryptomatte(known, _) if known == kind));
    let mut total = vec![0.0; 48 * 48];
    for layer in layers {
        for (total, pixel) in total.iter_mut().zip(layer.values.chunks_exact(4)) {
            *total += pixel.chunks_exact(2).filter(|pair| pair[0].to_bits() == id).map(|pair| pair[1]).sum::<f32>();
        }
    }
    total
}

fn bits(image: &Image) -> Vec<u32> {
    image.layers.iter().flat_map(|layer| &layer.values).map(|value| value.to_bits()).collect()
}

#[test]
fn mattes_are_the_masks_that_are_rendered_alone() {
    for integrator in [Integrator::Path, Integrator::Whitted] {
        let wanted = |mut scene: Scene| {
            scene.settings.integrator = integrator;
            render(&scene)
        };
        let image = wanted(with_mattes(sheets(|_| false, 32)));
        for (kind, names) in [
            (MatteKind::Object, ["floor", "Größe", "gauze", "wire"].as_slice()),
            (MatteKind::Material, &["stone", "paint", "gauze"]),
            (MatteKind::Asset, &["room", "things", "wire"]),
        ] {
            for name in names {
                let is_named = |sheet: &Sheet| [sheet.0, sheet.2, sheet.1][kind as usize] == *name;
                let alone = wanted(sheets(is_named, 32));
                let mask = alone.layer(Aov::Color).expect("the colour").values.chunks_exact(4).map(|pixel| pixel[0]);
                let found = coverage(&image, kind, name);
                let worst = found.iter().zip(mask).map(|(found, mask)| (found - mask).abs()).fold(0.0, f32::max);
                assert!(worst <= 1.0 / 255.0, "{integrator:?} {kind:?} {name}: {worst}");
                assert!(found.iter().copied().fold(0.0, f32::max) > 0.35, "{name}");
            }
        }
    }
}

#[test]
fn threads_and_parts_give_the_same_mattes() {
    let scene = with_mattes(sheets(|_| false, 300));
    let threaded = |threads| render(&Scene { settings: Settings { threads, ..scene.settings.clone() }, ..scene.clone() });
    let whole = threaded(1);
    assert_eq!(bits(&whole), bits(&threaded(2)));
    let folder = std::env::temp_dir();
    let parts = [[0, 48], [48, 256], [256, 300]].map(|range| {
        let path = folder.join(format!("gonio-mattes-{}-{}.part", std::process::id(), range[0]));
        let part = Scene { settings: Settings { sample_range: Some(range), ..scene.settings.clone() }, ..scene.clone() };
        let mut under_way = Render::start(compiled(&part), &part.settings, Execution::best()).expect("it starts");
        under_way.finish().expect("it ends well");
        write_checkpoint(&path, &Identity::new(&part, Execution::best(), Vec::new()), under_way.film()).expect("a checkpoint");
        path
    });
    let joined = merge(&parts).expect("parts of one render").film.develop();
    parts.iter().for_each(|path| std::fs::remove_file(path).expect("it is there"));
    assert_eq!(bits(&whole), bits(&joined));
    assert_eq!(joined.manifests.names(MatteKind::Asset).len(), 3);
}

#[test]
fn files_say_which_names_there_are() {
    let mut scene = sheets(|_| false, 1);
    scene.settings.aovs.extend(scene.settings.matte_layers(MatteKind::Object));
    let path = std::env::temp_dir().join(format!("gonio-mattes-{}.exr", std::process::id()));
    write_exr(&path, &render(&scene), &ExrOptions { half: true, ..ExrOptions::default() }).expect("a file");
    let bytes = std::fs::read(&path).expect("it is there");
    std::fs::remove_file(&path).expect("it is there");
    let says = |text: &str| bytes.windows(text.len()).any(|window| window == text.as_bytes());
    // The layer's key by another implementation of the hash.
    for text in [
        "cryptomatte/3ae39a5/name",
        "cryptomatte/3ae39a5/manifest",
        "MurmurHash3_32",
        "uint32_to_float32",
        "CryptoObject02.a",
        "\"Größe\":\"",
    ] {
        assert!(says(text), "{text}");
    }
}

#[test]
fn parts_of_the_light_sum_up_to_the_colour() {
    let names = [
        "color",
        "lpe:C<RD>L",
        "lpe:C<RD>.+L",
        "lpe:C<R[GS]>L",
        "lpe:C<R[GS]>.+L",
        "lpe:C<T[GS]>.*L",
        "lpe:C[LOB]",
        "lpe:C.*",
        "lpe:C.+[LO]",
    ];
    let mut scene = varied();
    scene.lights.push(light(LightShape::Disk { radius: 0.3 }, facing_down([0.0, 2.5, 0.5]), [5.0, 2.0, 1.0]));
    scene.settings = settings(48, 16, &[Aov::Color]);
    scene.settings.set_passes(&names.map(str::to_owned)).expect("known passes");
    let image = render(&scene);
    assert_eq!(image.layers.iter().map(|layer| layer.name.as_str()).collect::<Vec<_>>(), names);
    let colour: Vec<f32> = image.layers[0].values.chunks_exact(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    let brightest = colour.iter().copied().fold(0.0, f32::max);
    let differs = |what: &str, of: &[usize]| {
        let worst = colour.iter().enumerate().map(|(at, colour)| {
            let sum: f32 = of.iter().map(|layer| image.layers[*layer].values[at]).sum();
            (sum - colour).abs()
        });
        let worst = worst.fold(0.0, f32::max);
        assert!(worst < 1e-5 * brightest, "{what}: {worst} of {brightest}");
    };
    differs("all parts", &[1, 2, 3, 4, 5, 6]);
    differs("C.*", &[7]);
    differs("scattered and seen", &[6, 8]);
    for layer in [1, 2, 4, 5] {
        assert!(image.layers[layer].values.iter().any(|value| *value > 1e-4 * brightest), "{}", image.layers[layer].name);
    }
}

#[test]
fn more_passes_leave_the_colour_as_it_is() {
    let mut scene = varied();
    scene.settings = settings(48, 8, &[Aov::Color]);
    let alone = render(&scene).layers[0].values.clone();
    let more = [
        "color",
        "cryptomatte_object",
        "lpe:C<RD>L",
        "Neye",
        "Peye",
        "primvars:st",
        "ambient_occlusion",
        "cost",
        "instanceId",
        "elementId",
    ];
    scene.settings.set_passes(&more.map(str::to_owned)).expect("known passes");
    assert_eq!(alone, render(&scene).layers[0].values);
}

#[test]
fn passes_of_first_surfaces_are_those_of_the_camera() {
    let mut scene = sheets(|_| false, 4);
    let names = ["Neye", "Peye", "depth", "elementId", "instanceId", "ambient_occlusion"];
    scene.settings.set_passes(&names.map(str::to_owned)).expect("known passes");
    let image = render(&scene);
    let corner = |layer: usize| &image.layers[layer].values[..image.layers[layer].channels];
    let near = |found: &[f32], expected: &[f32]| found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4);
    assert!(near(corner(0), &[0.0, 0.0, 1.0, 1.0]), "{:?}", corner(0));
    assert!(near(&corner(1)[2..3], &[-5.0]) && near(corner(2), &[5.0]), "{:?}", corner(1));
    assert!([0.0, 1.0].contains(&corner(3)[0]) && corner(4)[0] == 0.0 && (0.0..=1.0).contains(&corner(5)[0]));
}
