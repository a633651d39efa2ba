//! OpenVDB: what no program at hand writes any more, and streams.

use crate::Bytes;
use gonio_volume::{Grid, Sampler, VolumeFile, from_bytes};
use miniz_oxide::deflate::compress_to_vec_zlib;

fn header(version: u32, offsets: bool, zip: bool, grids: u32) -> Bytes {
    let mut file = Bytes::default();
    file.add(b" BDV\0\0\0\0").u32(version).u32(3).u32(0).add([offsets.into()]);
    if version < 222 {
        file.add([u8::from(zip)]);
    }
    file.add([b'0'; 36]).u32(0).u32(grids);
    file
}

/// Name, type and parent, and places that a stream does not tell.
fn descriptor(file: &mut Bytes, name: &str, kind: &str, parent: &str) {
    file.text(name).text(kind).text(parent).reals(&[0.0; 3]);
}

fn array(file: &mut Bytes, values: &[f32], zip: bool) {
    let plain: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
    if zip {
        let packed = compress_to_vec_zlib(&plain, 6);
        file.add((packed.len() as i64).to_le_bytes()).add(packed);
    } else {
        file.add(plain);
    }
}

/// One leaf at (8, 0, 0) whose voxels are their places, of which the first 64 are active, and a tile of 8³ before it.
fn tree(file: &mut Bytes, version: u32, zip: bool) {
    let old = version < 222;
    file.u32(1).floats([0.5]).u32(0).u32(1).add([0; 12]);
    file.mask(512, 1).mask(512, 0);
    let values = |file: &mut Bytes, places: usize, first: f32| {
        let mut values = vec![0.5; places - usize::from(old)];
        values[0] = first;
        if !old {
            file.add([6]);
        }
        array(file, &values, zip);
    };
    values(file, 32768, 0.5);
    // The second child in x.
    let mut children = vec![0u8; 512];
    children[256 / 8] = 1;
    let mut active = vec![0u8; 512];
    active[0] = 1;
    file.add(&children).add(&active);
    values(file, 4096, 2.0);
    file.mask(8, u64::MAX);
    // The voxels.
    file.mask(8, u64::MAX);
    if old {
        file.u32(8).u32(0).u32(0).add([2]);
    } else {
        file.add([6]);
    }
    let voxels: Vec<f32> = (0..512).map(|n| n as f32).collect();
    array(file, &voxels, zip);
    if old {
        // The second buffer.
        array(file, &[9.0; 512], zip);
    }
}

fn check(grid: &Grid) {
    let sampler = Sampler::new(grid);
    assert_eq!(grid.bricks.len(), 1);
    assert_eq!(sampler.value([8, 0, 0])[0], 0.0);
    assert_eq!(sampler.value([15, 7, 7])[0], 511.0);
    assert_eq!(sampler.value([9, 2, 3])[0], 64.0 + 16.0 + 3.0);
    assert!(sampler.is_active([8, 7, 7]) && !sampler.is_active([9, 0, 0]));
    assert_eq!((sampler.value([7, 7, 7])[0], sampler.is_active([0, 0, 0])), (2.0, true));
    assert_eq!((sampler.value([0, 8, 0])[0], sampler.value([5000, 0, 0])[0]), (0.5, 0.5));
    assert_eq!(grid.active_voxels(), 64 + 512);
    assert_eq!(grid.bounds(), Some([[0, 0, 0], [8, 7, 7]]));
}

fn open(file: Bytes) -> VolumeFile {
    from_bytes(file.0, "layout.vdb").unwrap()
}

#[test]
fn versions_220_and_221_are_read() {
    for (version, zip) in [(220, false), (220, true), (221, true)] {
        let mut file = header(version, false, zip, 1);
        descriptor(&mut file, "density", "Tree_float_5_4_3", "");
        file.u32(0).text("UniformScaleTranslateMap").reals(&[1.0, 2.0, 3.0, 0.5, 0.5, 0.5]).reals(&[0.0; 12]);
        tree(&mut file, version, zip);
        let file = open(file);
        assert_eq!(file.grids()[0].refused, None);
        let grid = file.read(0).unwrap();
        check(&grid);
        assert_eq!(grid.transform.point([2.0, 0.0, 0.0]), [2.0, 2.0, 3.0]);
    }
}

/// A frustum that is refused, a grid, one that shares its voxels, and points, behind which the end cannot be found.
#[test]
fn streams_of_several_grids() {
    let mut file = header(224, false, false, 5);
    descriptor(&mut file, "frustum", "Tree_float_5_4_3", "");
    file.u32(1).u32(0).text("NonlinearFrustumMap").reals(&[0.0; 8]).text("ScaleMap").reals(&[1.0; 15]);
    tree(&mut file, 224, true);
    descriptor(&mut file, "density\u{1e}0", "Tree_float_5_4_3", "");
    file.u32(0).u32(1).text("class").text("string").text("fog volume").text("ScaleMap").reals(&[2.0; 15]);
    tree(&mut file, 224, false);
    descriptor(&mut file, "density\u{1e}1", "Tree_float_5_4_3", "density\u{1e}0");
    file.u32(0).u32(0).text("TranslationMap").reals(&[1.0, 2.0, 3.0]);
    descriptor(&mut file, "points", "Tree_ptdataidx32_5_4_3", "");
    file.u32(0).u32(0).text("ScaleMap").reals(&[1.0; 15]).u32(77);
    let file = open(file);
    let names: Vec<&str> = file.grids().iter().map(|info| info.name.as_str()).collect();
    assert_eq!(names, ["frustum", "density", "density", "points"]);
    let refused = |index: usize| file.grids()[index].refused.clone().unwrap_or_default();
    assert!(refused(0).contains("frustum"), "{}", refused(0));
    assert!(file.read(0).is_err());
    check(&file.read(1).unwrap());
    assert_eq!(file.grids()[1].class.name(), "fog volume");
    let shared = file.read(2).unwrap();
    check(&shared);
    assert_eq!(shared.transform.point([0.0; 3]), [1.0, 2.0, 3.0]);
    assert_eq!(file.grids()[2].instance_of.as_deref(), Some("density 0"));
    assert!(refused(3).contains("points"), "{}", refused(3));
    assert!(file.notes()[0].starts_with("1 grids after 'points' cannot be found"), "{:?}", file.notes());
}

#[test]
fn types_that_are_not_read_are_named() {
    let mut file = header(224, false, false, 1);
    descriptor(&mut file, "names", "Tree_string_5_4_3", "");
    file.u32(0).u32(0).text("ScaleMap").reals(&[1.0; 15]);
    let refused = open(file).grids()[0].refused.clone().unwrap();
    assert!(refused.contains("grids of string are not read"), "{refused}");
}
