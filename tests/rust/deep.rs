//! Deep pictures flatten to the flat ones, and hold surfaces at their depths.

use gonio::{
    compile::compile,
    deep::DeepPicture,
    film::{BEHIND_ALL, Image},
    output::{ExrOptions, write_deep_exr},
    render::Render,
    scene::{Antialiasing, Aov, Background, Integrator, Scene},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{self, compiled, settings},
    scenes::{cut_out, varied},
};
use std::sync::{Arc, atomic::AtomicBool};

fn deep_scene(mut scene: Scene) -> Scene {
    scene.settings = settings(40, 32, &[Aov::Color, Aov::Deep]);
    scene
}

fn render(scene: &Scene) -> (Image, Arc<DeepPicture>) {
    let image = picture::render(&compiled(scene), &scene.settings, Execution::best());
    let deep = image.deep.clone().expect("asked for");
    (image, deep)
}

fn check_flattens(image: &Image, deep: &DeepPicture) {
    let flat = &image.layer(Aov::Color).expect("the colour").values;
    let brightest = flat.iter().copied().fold(1.0, f32::max);
    let found = deep.flattened();
    assert_eq!(found.len(), flat.len());
    let worst = found.iter().zip(flat).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
    assert!(worst < 1e-4 * brightest, "{worst} of {brightest}");
}

#[test]
fn what_is_cut_out_covers_its_share_before_what_is_behind() {
    let mut scene = deep_scene(cut_out(0.25));
    scene.settings.samples = 256;
    scene.settings.background = Background::Transparent;
    let (image, deep) = render(&scene);
    check_flattens(&image, &deep);
    assert!(deep.counts.iter().all(|count| *count == 1), "the floor is level");
    let mean = deep.samples.iter().map(|sample| f64::from(sample.rgba[3])).sum::<f64>() / deep.samples.len() as f64;
    assert!((mean - 0.25).abs() < 0.005, "{mean}");
    assert!(deep.samples.iter().all(|sample| (sample.depth[0] - 5.0).abs() < 1e-4 && sample.depth[0] <= sample.depth[1]));
}

#[test]
fn pictures_flatten_whatever_is_in_them() {
    let mut scene = deep_scene(varied());
    for (integrator, background) in [
        (Integrator::Path, Background::Seen),
        (Integrator::Path, Background::Covering),
        (Integrator::Path, Background::Transparent),
        (Integrator::Whitted, Background::Seen),
    ] {
        (scene.settings.integrator, scene.settings.background) = (integrator, background);
        let (image, deep) = render(&scene);
        check_flattens(&image, &deep);
        let mut rest = deep.samples.as_slice();
        for count in &deep.counts {
            let (pixel, behind) = rest.split_at(*count as usize);
            rest = behind;
            assert!(pixel.iter().all(|sample| (0.0..=1.0).contains(&sample.rgba[3]) && sample.depth[0] <= sample.depth[1]));
            assert!(pixel.windows(2).all(|pair| pair[0].depth[1] < pair[1].depth[0]), "{pixel:?}");
            assert!(pixel.iter().all(|sample| sample.depth[0] == BEHIND_ALL || (4.0..5.1).contains(&sample.depth[0])), "{pixel:?}");
        }
    }
}

#[test]
fn the_picture_is_the_same_for_any_number_of_threads_and_with_the_pass() {
    let mut scene = deep_scene(varied());
    let (image, deep) = render(&scene);
    scene.settings.threads = 1;
    let (again, deep_again) = render(&scene);
    assert_eq!(deep, deep_again);
    assert_eq!(image.layers, again.layers);
    scene.settings.aovs = vec![Aov::Color];
    let flat = picture::render(&compiled(&scene), &scene.settings, Execution::best());
    assert_eq!(flat.layers, image.layers);
    assert!(flat.deep.is_none());
    let folder = std::env::temp_dir();
    let error = write_deep_exr(&folder.join("gonio-no-deep.exr"), &flat, &ExrOptions::default()).expect_err("no deep picture");
    assert!(error.to_string().contains("without the pass 'deep'"), "{error}");
}

#[test]
fn what_has_no_depth_is_refused_by_name() {
    let mut scene = deep_scene(varied());
    scene.settings.set_antialiasing(Antialiasing::Adaptive);
    scene.settings.integrator = Integrator::Whitted;
    let refused = |scene: &Scene| {
        let compiled = Arc::new(compile(scene, None, &AtomicBool::new(false)).expect("compiles"));
        Render::start(compiled, &scene.settings, Execution::best()).err().map(|error| error.to_string()).unwrap_or_default()
    };
    assert!(refused(&scene).contains("antialiasing"));
    let mut scene = deep_scene(varied());
    scene.instances[0].shadow_catcher = true;
    assert!(refused(&scene).contains("shadow catchers"));
    let mut scene = deep_scene(varied());
    scene.settings.deep_tolerance = f32::NAN;
    assert!(refused(&scene).contains("deep_tolerance"));
}
