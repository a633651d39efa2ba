//! Mutates volume files and reads them.
//!
//! `cargo run --profile quick -p gonio-volume --example fuzz -- SECONDS [SEED] [FILE...]`. The seeds are files that the crate writes, and those named.
//!
//! A panic, more than two seconds for one input, or more memory than 256 times the input's size and 16 MB is a finding: its bytes are
//! written to `fuzz-volume-SEED.bin`, and the run ends with status 1. A node makes 4096 tiles of a kilobyte of masks: those need the factor.

#[path = "../../../formats/examples/fuzz/memory.rs"]
mod memory;
mod mutate;
mod seeds;

use gonio_volume::{Sampler, from_bytes};
use mutate::Random;
use std::panic::catch_unwind;
use std::process::ExitCode;
use std::time::{Duration, Instant};

const SLOW: Duration = Duration::from_secs(2);
const MEMORY_FACTOR: usize = 256;
const MEMORY_FIXED: usize = 16 << 20;

/// What became of the inputs.
#[derive(Default)]
struct Tally {
    inputs: u64,
    listed: u64,
    read: u64,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let seconds = arguments.first().and_then(|text| text.parse::<f64>().ok()).filter(|seconds| (0.0..1e6).contains(seconds));
    let seed = arguments.get(1).map_or(Some(1), |text| text.parse::<u64>().ok());
    let (Some(seconds), Some(seed)) = (seconds, seed) else {
        eprintln!("usage: fuzz SECONDS [SEED] [FILE...]");
        return ExitCode::from(2);
    };
    let mut seeds = seeds::seeds();
    seeds.extend(arguments.iter().skip(2).filter_map(|path| std::fs::read(path).ok()));
    // Panics are findings, told once and in one line.
    std::panic::set_hook(Box::new(|_| {}));
    match run(&seeds, Duration::from_secs_f64(seconds), seed) {
        Ok(tally) => {
            eprintln!(
                "{} inputs, {} listed, {} grids read, {seconds} s from seed {seed}, no finding",
                tally.inputs, tally.listed, tally.read
            );
            ExitCode::SUCCESS
        }
        Err((problem, input)) => {
            let path = format!("fuzz-volume-{seed}.bin");
            let written = std::fs::write(&path, input);
            eprintln!("{problem}; {}", written.map_or_else(|error| error.to_string(), |()| format!("the input is in {path}")));
            ExitCode::FAILURE
        }
    }
}

fn run(seeds: &[Vec<u8>], duration: Duration, seed: u64) -> Result<Tally, (String, Vec<u8>)> {
    let (mut random, start, mut tally) = (Random::new(seed), Instant::now(), Tally::default());
    let good = seeds.len() as u64;
    while start.elapsed() < duration || tally.inputs < good {
        let input = seeds.get(tally.inputs as usize).cloned().unwrap_or_else(|| mutate::input(seeds, &mut random));
        if let Err(problem) = attempt(&input, &mut tally) {
            return Err((problem, input));
        }
        tally.inputs += 1;
    }
    Ok(tally)
}

/// Reads once, and says what is wrong with the reader.
fn attempt(input: &[u8], tally: &mut Tally) -> Result<(), String> {
    // The bytes themselves are not the reader's doing.
    let bytes: std::sync::Arc<[u8]> = input.into();
    let (start, before) = (clock(), memory::restart());
    let result = catch_unwind(|| read(bytes));
    let memory = memory::peak().saturating_sub(before);
    let elapsed = clock().saturating_sub(start);
    let (listed, grids) = result.map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
        format!("panic: {}", text.unwrap_or("without a text"))
    })?;
    (tally.listed, tally.read) = (tally.listed + u64::from(listed), tally.read + grids);
    if elapsed > SLOW {
        return Err(format!("{:.1} s for {} bytes", elapsed.as_secs_f64(), input.len()));
    }
    if memory > MEMORY_FACTOR * input.len() + MEMORY_FIXED {
        return Err(format!("{memory} bytes of memory for {}", input.len()));
    }
    Ok(())
}

/// Lists and reads everything, and uses what was read; whether there was a list, and how many grids.
fn read(bytes: std::sync::Arc<[u8]>) -> (bool, u64) {
    let Ok(file) = from_bytes(bytes, "input") else {
        return (false, 0);
    };
    let mut read = 0;
    // Grids that share their voxels would all take the time of one.
    for index in 0..file.grids().len().min(32) {
        let Ok(grid) = file.read(index) else { continue };
        let info = &file.grids()[index];
        assert!(grid.memory() == info.memory, "{} bytes, listed {}", grid.memory(), info.memory);
        let (_, _) = (grid.not_finite(), grid.bounds());
        let sampler = Sampler::new(&grid);
        for brick in grid.bricks.iter().take(4) {
            let range = sampler.range(brick.origin);
            let value = sampler.trilinear(brick.origin.map(|x| f64::from(x) + 0.5))[0];
            let within = value >= f64::from(range.min[0]) - 1e-3 * value.abs() && value <= f64::from(range.max[0]) + 1e-3 * value.abs();
            assert!(within || !value.is_finite() || grid.not_finite() > 0, "{value} beside {range:?}");
        }
        read += 1;
    }
    (true, read)
}

/// The thread's own time where the system tells it: on a busy machine anything takes long.
fn clock() -> Duration {
    static START: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let own = told.and_then(|text| text.split(' ').next()?.parse().ok()).map(Duration::from_nanos);
    own.unwrap_or_else(|| START.get_or_init(Instant::now).elapsed())
}
