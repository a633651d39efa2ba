//! A render that is interrupted, or done in parts, has the bits of one that is not; what does not belong together is refused.

use gonio::{
    checkpoint::{Checkpoint, Identity, merge, write_checkpoint},
    film::Image,
    render::Render,
    scene::{Aov, LightShape, Scene, Settings},
};
use gonio_simd::Execution;
use gonio_tests::{
    picture::{compiled, render, settings},
    scenes::{camera_from_above, facing_down, floor, light},
};
use std::{
    fs,
    path::{Path, PathBuf},
    time::Duration,
};

fn scene(pixels: u32, samples: u32) -> Scene {
    let mut scene = floor(0.8);
    scene.cameras.push(camera_from_above([0.0, 5.0, 0.0], 4.0));
    scene.lights.push(light(LightShape::Rectangle { width: 1.0, height: 1.0 }, facing_down([0.0, 2.0, 0.0]), [1.0; 3]));
    scene.lights.push(light(LightShape::Sphere { radius: 0.2 }, facing_down([1.0, 1.0, 0.0]), [4.0; 3]));
    scene.settings = settings(pixels, samples, &[Aov::Color, Aov::Illuminance, Aov::PrimId, Aov::SampleCount]);
    scene
}

/// A folder of a test's own, gone when it ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("gonio-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        Self(path)
    }
    fn file(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left is in the system's folder for such things.
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn identity(scene: &Scene) -> Identity {
    Identity::new(scene, Execution::best(), Vec::new())
}

/// Renders a range of the samples and keeps it.
fn keep_part(scene: &Scene, range: [u32; 2], path: &Path) {
    let part = Scene { settings: Settings { sample_range: Some(range), ..scene.settings.clone() }, ..scene.clone() };
    let mut render = Render::start(compiled(&part), &part.settings, Execution::best()).expect("the render starts");
    render.finish().expect("the render ends well");
    write_checkpoint(path, &identity(&part), render.film()).expect("a checkpoint");
}

/// Renders with an interruption after every few tiles, each time from the checkpoint.
fn with_interruptions(scene: &Scene, path: &Path) -> (Image, u32) {
    let (compiled, identity) = (compiled(scene), identity(scene));
    for interruptions in 0.. {
        let settings = Settings { threads: 1 + interruptions % 3, ..scene.settings.clone() };
        let mut render = if interruptions == 0 {
            Render::start(compiled.clone(), &settings, Execution::best()).expect("the render starts")
        } else {
            let film = Checkpoint::resume(path, &identity).expect("the checkpoint");
            Render::resume(compiled.clone(), &settings, Execution::best(), film).expect("the render goes on")
        };
        for _ in 0..5 {
            let _ = render.next_tile(Duration::from_millis(200));
        }
        write_checkpoint(path, &identity, render.film()).expect("a checkpoint");
        if render.is_finished() {
            render.finish().expect("the render ends well");
            return (render.film().develop(), interruptions);
        }
        render.cancel();
    }
    unreachable!("the render ends");
}

#[test]
fn interruptions_do_not_change_a_bit() {
    let folder = Folder::new("interrupted");
    for noise_threshold in [0.0, 0.05] {
        let mut scene = scene(130, 288);
        scene.settings.noise_threshold = noise_threshold;
        let whole = render(&compiled(&scene), &scene.settings, Execution::best());
        let (resumed, interruptions) = with_interruptions(&scene, &folder.file("a.checkpoint"));
        assert!(interruptions > 3, "{interruptions}");
        assert!(whole == resumed, "threshold {noise_threshold}");
    }
}

#[test]
fn parts_merge_to_the_whole() {
    let folder = Folder::new("parts");
    // Ends within groups, at groups, and past the first two.
    let scene = scene(70, 600);
    let whole = render(&compiled(&scene), &scene.settings, Execution::best());
    let ends = [0, 1, 16, 48, 256, 272, 528, 600];
    let ranges: Vec<[u32; 2]> = ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let mut paths: Vec<PathBuf> = ranges.iter().map(|range| folder.file(&format!("{}.part", range[0]))).collect();
    ranges.iter().zip(&paths).for_each(|(range, path)| keep_part(&scene, *range, path));
    paths.reverse();
    let merged = merge(&paths).expect("parts of one render");
    assert_eq!(merged.film.range(), 0..600);
    assert!(merged.film.develop() == whole);
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let folder = Folder::new("refused");
    let scene = scene(16, 64);
    let [first, middle, last] = ["first", "middle", "last"].map(|name| folder.file(name));
    keep_part(&scene, [0, 16], &first);
    keep_part(&scene, [16, 32], &middle);
    keep_part(&scene, [32, 64], &last);
    let refusal =
        |paths: &[&PathBuf]| merge(&paths.iter().map(|path| (*path).clone()).collect::<Vec<_>>()).expect_err("refused").to_string();
    assert!(refusal(&[&first, &last]).contains("samples 16:32 are missing"));
    assert!(refusal(&[&first, &middle, &middle]).contains("samples 16:32 are there twice"));
    let resume = |change: &dyn Fn(&mut Scene)| {
        let mut other = Scene { settings: Settings { sample_range: Some([0, 16]), ..scene.settings.clone() }, ..scene.clone() };
        change(&mut other);
        Checkpoint::resume(&first, &identity(&other)).map(|_| String::new()).unwrap_or_else(|error| error.to_string())
    };
    assert_eq!(resume(&|_| {}), "");
    assert_eq!(resume(&|other| other.settings.threads = 7), "");
    assert!(resume(&|other| other.settings.seed = 3).contains("its seed is 0, 3 was asked for"));
    assert!(resume(&|other| other.settings.sample_range = None).contains("its sample range is [0,16], null was asked for"));
    assert!(resume(&|other| other.lights[0].emission.radiance[1] = 2.0).contains("another scene"));
    let mut bytes = fs::read(&first).expect("a file");
    let middle_byte = bytes.len() / 2;
    bytes[middle_byte] ^= 4;
    fs::write(&middle, &bytes).expect("a file");
    assert!(refusal(&[&middle]).contains("damaged"));
    fs::write(&middle, &bytes[..middle_byte]).expect("a file");
    assert!(refusal(&[&middle]).contains("ends before its time"));
    fs::write(&middle, b"gonio checkpoint 9\nno").expect("a file");
    assert!(refusal(&[&middle]).contains("its first line is not"));
}
