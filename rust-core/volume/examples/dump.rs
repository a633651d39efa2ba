#![allow(clippy::print_stdout, reason = "what it is for")]
//! Says of each grid of a file what it holds, as numbers that other readers are compared by.
//!
//! `cargo run --profile quick -p gonio-volume --example dump -- FILE...`. One line a grid: name, type, active voxels, bounds, bricks, and the hash of all active
//! voxels: the sum over them of `(x, y, z, bits of the values)` mixed by FNV-1a, which no order changes. Vectors have three values.

use gonio_volume::{Grid, Storage, VolumeFile};
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut worst = ExitCode::SUCCESS;
    for path in std::env::args().skip(1) {
        match gonio_volume::open(&path) {
            Ok(file) => dump(&file),
            Err(error) => {
                println!("error {error}");
                worst = ExitCode::FAILURE;
            }
        }
    }
    worst
}

fn dump(file: &VolumeFile) {
    for note in file.notes() {
        println!("note {note}");
    }
    for (index, info) in file.grids().iter().enumerate() {
        let start = std::time::Instant::now();
        match file.read(index) {
            Ok(grid) => {
                let same = grid.memory() == info.memory && grid.active_voxels() == info.active_voxels && grid.bounds() == info.bounds;
                let told = if same { "" } else { " LISTED OTHERWISE" };
                println!(
                    "grid {} {} active {} bounds {:?} bricks {} tiles {} hash {:016x} transform {:?} seconds {:.3}{told}",
                    info.name.replace(' ', "_"),
                    info.value_type.replace(' ', "_"),
                    info.active_voxels,
                    info.bounds.map_or([0; 6], |[a, b]| [a[0], a[1], a[2], b[0], b[1], b[2]]),
                    info.bricks,
                    info.tiles,
                    hash(&grid),
                    grid.transform.0,
                    start.elapsed().as_secs_f64(),
                );
            }
            Err(error) => println!("refused {} {} {error}", info.name, info.value_type),
        }
    }
}

fn hash(grid: &Grid) -> u64 {
    let components = if grid.values.storage() == Storage::Vector { 3 } else { 1 };
    let mut sum = 0u64;
    let mut add = |voxel: [i32; 3], value: [f32; 3]| {
        let words = voxel.iter().map(|x| *x as u32).chain(value[..components].iter().map(|x| x.to_bits()));
        sum = sum.wrapping_add(fnv(words));
    };
    for (n, brick) in grid.bricks.iter().enumerate() {
        for place in 0..512usize {
            if brick.active[place / 64] >> (place % 64) & 1 != 0 {
                let [x, y, z] = [place / 64, place / 8 % 8, place % 8].map(|p| p as i32);
                add([brick.origin[0] + x, brick.origin[1] + y, brick.origin[2] + z], grid.values.get(n * 512 + place));
            }
        }
    }
    // A tile counts as one voxel at its origin, with its size.
    for tile in grid.tiles.iter().filter(|tile| tile.active) {
        add([tile.origin[0] ^ i32::from(tile.log2_edge), tile.origin[1], tile.origin[2]], tile.value);
    }
    sum
}

fn fnv(words: impl Iterator<Item = u32>) -> u64 {
    let bytes = words.flat_map(u32::to_le_bytes);
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
