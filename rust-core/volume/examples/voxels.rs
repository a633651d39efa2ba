//! Hands the voxels of files to other programs, which compare them.
//!
//! - `voxels dense FILE NAME OUT` writes the active box of a grid as single-precision numbers, x slowest and z fastest, and prints its bounds.
//! - `voxels copy FILE none|zip OUT` writes all grids of a file anew.
//! - `voxels time FILE` reads all grids, and prints seconds.

#![allow(clippy::print_stdout, reason = "what it is for")]

use gonio_volume::{Grid, Packing, Result, Sampler, Storage, VolumeError, VolumeFile, open, write};
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match *words.as_slice() {
        ["dense", file, name, out] => dense(file, name, out),
        ["copy", file, packing, out] => copy(file, if packing == "zip" { Packing::Zip } else { Packing::None }, out),
        ["time", file] => time(file),
        _ => {
            eprintln!("usage: voxels dense FILE NAME OUT | copy FILE none|zip OUT | time FILE");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn dense(file: &str, name: &str, out: &str) -> Result<()> {
    let grid = open(file)?.read_named(name)?;
    let [min, max] = grid.bounds().unwrap_or([[0; 3], [-1; 3]]);
    let components = if grid.values.storage() == Storage::Vector { 3 } else { 1 };
    let sampler = Sampler::new(&grid);
    let mut bytes = Vec::new();
    for x in min[0]..=max[0] {
        for y in min[1]..=max[1] {
            for z in min[2]..=max[2] {
                sampler.value([x, y, z])[..components].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
            }
        }
    }
    println!("{} {} {} {} {} {} {} {components}", min[0], min[1], min[2], max[0], max[1], max[2], grid.active_voxels());
    std::fs::write(out, bytes).map_err(|error| VolumeError { file: out.into(), byte: None, problem: error.to_string() })
}

fn all(file: &VolumeFile) -> Result<Vec<Grid>> {
    (0..file.grids().len()).map(|index| file.read(index)).collect()
}

fn copy(file: &str, packing: Packing, out: &str) -> Result<()> {
    let grids = all(&open(file)?)?;
    write(out, &grids.iter().collect::<Vec<_>>(), packing)
}

fn time(file: &str) -> Result<()> {
    let start = Instant::now();
    let listed = open(file)?;
    let after = start.elapsed();
    let grids = all(&listed)?;
    let (listing, reading) = (after.as_secs_f64(), (start.elapsed() - after).as_secs_f64());
    println!("{listing:.3} s to list, {reading:.3} s to read {} voxels", grids.iter().map(Grid::active_voxels).sum::<u64>());
    Ok(())
}
