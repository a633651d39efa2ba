//! Files of public scenes, where they are at hand.

use crate::colour::ColourSpace;
use crate::texture::{TextureRequest, load_set};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

fn shared() -> PathBuf {
    std::env::var_os("GONIO_SHARED").map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"), PathBuf::from)
}

fn images(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            images(&path, found);
        } else if path.extension().is_some_and(|extension| {
            ["png", "jpg", "jpeg", "hdr", "exr", "tif", "tiff", "tx", "tga", "bmp", "webp", "gif"]
                .iter()
                .any(|known| extension.eq_ignore_ascii_case(known))
        }) {
            found.push(path);
        }
    }
}

#[test]
fn images_of_public_scenes_load() {
    let mut paths = Vec::new();
    images(&shared().join("data/usd"), &mut paths);
    if paths.is_empty() {
        eprintln!("skipped: no images under {}", shared().join("data/usd").display());
        return;
    }
    let requests: Vec<_> = paths.iter().map(|path| TextureRequest::path(path, ColourSpace::Auto)).collect();
    for (path, loaded) in paths.iter().zip(load_set(&requests, &AtomicBool::new(false))) {
        let map = loaded.unwrap_or_else(|error| panic!("{error}"));
        let last = map.texel(map.level_count() - 1, 0, 0).expect("a pyramid ends in one texel");
        assert!(last.iter().all(|x| x.is_finite()), "{}: {last:?}", path.display());
        eprintln!("{}: {:?} {:?} {} KiB, mean {last:?}", path.display(), map.resolution(), map.format(), map.bytes() >> 10);
    }
}
