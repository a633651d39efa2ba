//! Requests, sets of tiles and messages.

use super::made::{bytes, png};
use crate::colour::ColourSpace;
use crate::texture::{Source, TextureErrorKind, TextureRequest, find_tiles, is_udim, load_image, load_set, tile_path};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("gonio-texture-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn equal_requests_are_loaded_once() {
    let folder = folder("set");
    let path = folder.join("a.png");
    std::fs::write(&path, png(&bytes(8, 8, 3, 1))).unwrap();
    let requests = [
        TextureRequest::path(&path, ColourSpace::Auto),
        TextureRequest::path(folder.join("missing.png"), ColourSpace::Auto),
        TextureRequest::path(&path, ColourSpace::Auto),
        TextureRequest::path(&path, ColourSpace::Raw),
        TextureRequest::bytes("pkg.usdz[a.png]", png(&bytes(8, 8, 3, 1)), ColourSpace::Raw),
    ];
    let loaded = load_set(&requests, &AtomicBool::new(false));
    let map = |i: usize| loaded[i].as_ref().unwrap();
    assert!(Arc::ptr_eq(map(0), map(2)) && !Arc::ptr_eq(map(0), map(3)));
    assert_eq!(map(3).texel(0, 3, 3), map(4).texel(0, 3, 3));
    let error = loaded[1].as_ref().unwrap_err();
    assert_eq!(error.kind, TextureErrorKind::Unreadable);
    assert!(error.to_string().starts_with(&*error.path) && error.path.ends_with("missing.png"), "{error}");
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_raised_flag_stops_loading() {
    let request = TextureRequest::bytes("a.png", png(&bytes(8, 8, 3, 1)), ColourSpace::Auto);
    let loaded = load_set(&[request], &AtomicBool::new(true));
    assert_eq!(loaded[0].as_ref().unwrap_err().kind, TextureErrorKind::Cancelled);
}

#[test]
fn folders_and_bad_bytes_are_named() {
    let error = load_image(&Source::Path(std::env::temp_dir())).unwrap_err();
    assert_eq!(error.kind, TextureErrorKind::Unreadable);
    let error = load_image(&Source::Bytes { name: Arc::from("x.png"), bytes: Arc::from(&b"8BPS"[..]) }).unwrap_err();
    assert_eq!(
        error.to_string(),
        "x.png: the file is a Photoshop file, expected PNG, JPEG, TIFF, OpenEXR, Radiance HDR, WebP, AVIF, TGA, BMP, GIF or DDS; convert it to one of these"
    );
}

#[test]
fn tiles_of_a_set() {
    assert!(is_udim("wood.<UDIM>.png") && is_udim("wood.<udim>.png") && !is_udim("wood.1001.png"));
    assert_eq!(tile_path("wood.<udim>.png", 1012), "wood.1012.png");
    assert_eq!(tile_path("wood.png", 1012), "wood.png");
    let folder = folder("udim");
    for name in ["wood.1002.png", "wood.1001.png", "wood.1012.png", "wood.0999.png", "wood.10030.png", "wood.abcd.png", "other.1001.png"] {
        std::fs::write(folder.join(name), b"").unwrap();
    }
    let pattern = folder.join("wood.<UDIM>.png");
    let tiles = find_tiles(pattern.to_str().unwrap());
    assert_eq!(tiles.iter().map(|(tile, _)| *tile).collect::<Vec<_>>(), [1001, 1002, 1012]);
    assert_eq!(tiles[2].1, folder.join("wood.1012.png"));
    assert!(find_tiles("/no/such/folder/a.<UDIM>.png").is_empty() && find_tiles("wood.png").is_empty());
    std::fs::remove_dir_all(folder).unwrap();
}
