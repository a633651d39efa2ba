//! NanoVDB: blocks laid out by the offsets in `NanoVDB.h`.

use crate::Bytes;
use gonio_volume::{Grid, Sampler, from_bytes};
use miniz_oxide::deflate::compress_to_vec_zlib;

const VERSION: u32 = 32 << 21 | 6 << 10;
/// Sizes for values of four bytes: grid and tree, the root with its one entry, an upper node, a lower node.
const ROOT: usize = 672 + 64;
const UPPER: usize = ROOT + 64 + 32;
const LOWER: usize = UPPER + 8256 + 8 * 32768;
const LEAF: usize = LOWER + 1088 + 8 * 4096;

/// A block with one leaf at (0, -8, 8): `flags` are the leaf's, `voxels` all from its least value and step on.
fn block(kind: u32, flags: u8, voxels: &[u8]) -> Vec<u8> {
    let mut block = vec![0u8; LEAF];
    let mut put = |at: usize, bytes: &[u8]| block[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, b"NanoVDB1");
    put(16, &VERSION.to_le_bytes());
    put(40, b"density");
    // A matrix for columns, and a translation.
    [0.5f64, 0.1, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5].iter().enumerate().for_each(|(n, x)| put(384 + 8 * n, &x.to_le_bytes()));
    [1.0f64, 2.0, 3.0].iter().enumerate().for_each(|(n, x)| put(528 + 8 * n, &x.to_le_bytes()));
    put(632, &2u32.to_le_bytes());
    put(636, &kind.to_le_bytes());
    put(672 + 24, &((ROOT - 672) as i64).to_le_bytes());
    put(ROOT + 24, &1u32.to_le_bytes());
    put(ROOT + 28, &0.25f32.to_le_bytes());
    // The entry's key: y is -4096.
    put(ROOT + 64, &(0xf_ffffu64 << 21).to_le_bytes());
    put(ROOT + 72, &((UPPER - ROOT) as i64).to_le_bytes());
    // The upper node's last child along y, and the same of the lower one, second along z.
    let (upper, lower) = (31 << 5, 15 << 4 | 1);
    put(UPPER + 32 + 4096 + upper / 8, &[1 << (upper % 8)]);
    (0..32768).for_each(|n| put(UPPER + 8256 + 8 * n, &0.25f32.to_le_bytes()));
    put(UPPER + 8256 + 8 * upper, &((LOWER - UPPER) as i64).to_le_bytes());
    put(LOWER + 32 + 512 + lower / 8, &[1 << (lower % 8)]);
    (0..4096).for_each(|n| put(LOWER + 1088 + 8 * n, &0.25f32.to_le_bytes()));
    // A tile of 2 that is active, at the lower node's origin.
    put(LOWER + 32, &[1]);
    put(LOWER + 1088, &2.0f32.to_le_bytes());
    put(LOWER + 1088 + 8 * lower, &((LEAF - LOWER) as i64).to_le_bytes());
    let mut leaf = Bytes::default();
    leaf.add([0; 15]).add([flags]).mask(8, u64::MAX).add(voxels);
    leaf.0.resize(leaf.0.len().next_multiple_of(32), 0);
    block.extend(leaf.0);
    let size = (block.len() as u64).to_le_bytes();
    block[32..40].copy_from_slice(&size);
    block
}

fn file(kind: u32, block: &[u8], zip: bool) -> Vec<u8> {
    let packed = if zip { compress_to_vec_zlib(block, 6) } else { Vec::new() };
    let on_disk = if zip { packed.len() + 8 } else { block.len() };
    let mut file = Bytes::default();
    file.add(b"NanoVDB2").u32(VERSION).add(1u16.to_le_bytes()).add(u16::from(zip).to_le_bytes());
    file.add((block.len() as u64).to_le_bytes()).add((on_disk as u64).to_le_bytes()).add([0; 16]).u32(kind).u32(2).add([0; 96]);
    file.u32(8).add([0; 28]).add(u16::from(zip).to_le_bytes()).add([0; 2]).u32(VERSION).add(b"density\0");
    if zip {
        file.add((packed.len() as u64).to_le_bytes()).add(packed);
    } else {
        file.add(block);
    }
    file.0
}

fn check(grid: &Grid, value: impl Fn(usize) -> f32) {
    let sampler = Sampler::new(grid);
    for n in 0..512 {
        let voxel = [(n / 64) as i32, (n / 8 % 8) as i32 - 8, (n % 8) as i32 + 8];
        assert_eq!(sampler.value(voxel)[0], value(n), "{n}");
        assert_eq!(sampler.is_active(voxel), n < 64);
    }
    assert_eq!((sampler.value([0, -128, 0])[0], sampler.is_active([7, -121, 7])), (2.0, true));
    assert_eq!((sampler.value([0, 0, 0])[0], sampler.value([100_000; 3])[0]), (0.25, 0.25));
    assert_eq!((grid.bricks.len(), grid.tiles.len()), (1, 1));
    assert_eq!(grid.transform.point([0.0, 1.0, 0.0]), [1.1, 2.5, 3.0]);
    assert_eq!(grid.class.name(), "fog volume");
}

fn floats() -> Vec<u8> {
    let mut voxels = Bytes::default();
    voxels.floats([0.0; 4]).floats((0..512).map(|n| n as f32));
    voxels.0
}

#[test]
fn floats_plain_packed_and_raw() {
    let block = block(1, 0, &floats());
    for bytes in [file(1, &block, false), file(1, &block, true), block.clone(), [file(1, &block, true), file(1, &block, false)].concat()] {
        let read = from_bytes(bytes, "layout.nvdb").unwrap();
        assert!(read.format().starts_with("NanoVDB 32.6"), "{}", read.format());
        for index in 0..read.grids().len() {
            let info = &read.grids()[index];
            assert_eq!((info.name.as_str(), info.value_type.as_str(), &info.refused), ("density", "float", &None));
            let grid = read.read(index).unwrap();
            check(&grid, |n| n as f32);
            assert_eq!((info.memory, info.active_voxels), (grid.memory(), 64 + 512));
        }
    }
}

/// Codes of every width: 1 to 16 bits, times the step 0.5, over the least value 3.
#[test]
fn quantised_voxels() {
    for (kind, flags, bits) in
        [(13, 0, 4), (14, 0, 8), (15, 0, 16), (16, 0, 1), (16, 1 << 5, 2), (16, 2 << 5, 4), (16, 3 << 5, 8), (16, 4 << 5, 16)]
    {
        let code = |n: usize| (n * 37) as u64 & ((1 << bits) - 1);
        let mut codes = vec![0u8; 64 * bits];
        (0..512)
            .for_each(|n| (0..bits).for_each(|bit| codes[(n * bits + bit) / 8] |= ((code(n) >> bit & 1) as u8) << ((n * bits + bit) % 8)));
        let mut voxels = Bytes::default();
        voxels.floats([3.0, 0.5]).add([0; 8]).add(codes);
        let read = from_bytes(file(kind, &block(kind, flags, &voxels.0), false), "layout.nvdb").unwrap();
        check(&read.read(0).unwrap(), |n| 3.0 + 0.5 * code(n) as f32);
    }
}

#[test]
fn what_is_not_read_is_named() {
    let refused = |bytes: Vec<u8>| from_bytes(bytes, "layout.nvdb").unwrap().grids()[0].refused.clone().unwrap_or_default();
    assert!(refused(file(19, &block(19, 0, &floats()), false)).contains("grids of Index are not read"));
    // A block that claims a terabyte, and a child outside it.
    let mut bytes = file(1, &block(1, 0, &floats()), false);
    bytes[16..24].copy_from_slice(&(1u64 << 40).to_le_bytes());
    assert!(refused(bytes).contains("a block of 1099511627776 bytes"));
    let mut wrong = block(1, 0, &floats());
    wrong[ROOT + 72..ROOT + 80].copy_from_slice(&i64::MAX.to_le_bytes());
    assert!(refused(file(1, &wrong, false)).contains("outside the grid"));
    let mut old = file(1, &block(1, 0, &floats()), false);
    old[8..12].copy_from_slice(&(31u32 << 21).to_le_bytes());
    let error = from_bytes(old, "layout.nvdb").unwrap_err().to_string();
    assert!(error.contains("version 31.0; versions 32.x are read"), "{error}");
}
