//! Mutates honeybee models and Radiance scenes and reads them.
//!
//! `cargo run --profile quick -p gonio-models --example fuzz -- hbjson|rad SECONDS [SEED] [FILE...]`. The seeds are a small model of each kind, and the
//! files that are named.
//!
//! A panic, more than two seconds for one input, or more memory than 256 times the input's size and 64 MB is a finding: its bytes are written to
//! `fuzz-READER-SEED.hbjson` or `.rad`, and the run ends with status 1. Arrays of `xform` and round bodies make much of few words.

#[path = "../../formats/examples/fuzz/memory.rs"]
mod memory;
#[path = "../../formats/examples/fuzz/mutate.rs"]
mod mutate;

use mutate::Random;
use std::{
    fs,
    panic::catch_unwind,
    path::{Path, PathBuf},
    process::ExitCode,
    time::{Duration, Instant},
};

const SLOW: Duration = Duration::from_secs(2);
const MEMORY_FACTOR: usize = 256;
const MEMORY_FIXED: usize = 64 << 20;

const MODEL: &str = include_str!("../../../examples/models/office.hbjson");
const SCENE: &str = "# rvu -vtv -vp 1 -2 1.5 -vd 0 1 0 -vu 0 0 1 -vh 45 -vv 30\nvoid plastic wall\n0\n0\n5 0.5 0.4 0.3 0.05 0.1\n\
void glass pane\n0\n0\n3 0.9 0.9 0.9\nvoid light lamp\n0\n0\n3 100 100 100\nwall polygon floor\n0\n0\n12 0 0 0 4 0 0 4 3 0 0 3 0\n\
pane ring hole\n0\n0\n8 1 1 2 0 0 1 0.1 0.4\nlamp sphere bulb\n0\n0\n4 2 1.5 2.5 0.1\nwall cylinder post\n0\n0\n7 1 1 0 1 1 2 0.1\n\
wall cone hat\n0\n0\n8 3 1 0 3 1 2 0.4 0.1\nvoid alias other wall\nother source sun\n0\n0\n4 0 0 1 0.5\n!genbox wall box 1 2 3 -r 0.1\n\
!genbox other crate 1 1 1 | xform -n a -t 2 0 0 -rz 30 -a 3 -i 2 -s 0.5 -mx\nvoid mixfunc mix\n4 wall pane 0.5 .\n0\n0\nvoid trans leaf\n0\n0\n7 .3 .4 .2 0 0 .5 .2\n";

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let kind = arguments.first().filter(|kind| ["hbjson", "rad"].contains(&kind.as_str()));
    let seconds = arguments.get(1).and_then(|text| text.parse::<f64>().ok()).filter(|seconds| (0.0..1e6).contains(seconds));
    let seed = arguments.get(2).map_or(Some(1), |text| text.parse::<u64>().ok());
    let (Some(kind), Some(seconds), Some(seed)) = (kind, seconds, seed) else {
        eprintln!("usage: fuzz hbjson|rad SECONDS [SEED] [FILE...]");
        return ExitCode::from(2);
    };
    let own = if kind == "rad" { SCENE } else { MODEL };
    let named = arguments.iter().skip(3).filter_map(|path| fs::read(path).ok());
    let seeds: Vec<Vec<u8>> = std::iter::once(own.as_bytes().to_vec()).chain(named).collect();
    // Panics are findings, told once and in one line.
    std::panic::set_hook(Box::new(|_| {}));
    // Readers go by the name's ending.
    let path = PathBuf::from(format!("fuzz-{kind}-{seed}.{kind}"));
    match run(&seeds, Duration::from_secs_f64(seconds), (seed, &path)) {
        Ok([count, good]) => {
            drop(fs::remove_file(&path));
            eprintln!("{kind}: {count} inputs, {good} of them good, in {seconds} s from seed {seed}, no finding");
            ExitCode::SUCCESS
        }
        Err(problem) => {
            eprintln!("{kind}: {problem}; the input is in {}", path.display());
            ExitCode::FAILURE
        }
    }
}

/// How many inputs there were, and how many could be read; or what is wrong with the reader.
fn run(seeds: &[Vec<u8>], duration: Duration, (seed, path): (u64, &Path)) -> Result<[u64; 2], String> {
    let (mut random, start, mut counts) = (Random::new(seed), Instant::now(), [0; 2]);
    let inputs = std::iter::from_fn(|| Some(mutate::input(seeds, &mut random)));
    for input in seeds.iter().cloned().chain(inputs) {
        if start.elapsed() > duration {
            break;
        }
        fs::write(path, &input).map_err(|error| error.to_string())?;
        counts[0] += 1;
        counts[1] += u64::from(attempt(path, input.len())?);
    }
    Ok(counts)
}

/// Reads once: whether the input was good, or what is wrong with the reader.
fn attempt(path: &Path, size: usize) -> Result<bool, String> {
    let (started, before) = (Instant::now(), memory::restart());
    let result = catch_unwind(|| gonio_models::read(path, &gonio_models::Options::default()).is_ok());
    let (elapsed, memory) = (started.elapsed(), memory::peak().saturating_sub(before));
    match result {
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
            Err(format!("panic: {}", text.unwrap_or("without a text")))
        }
        Ok(_) if elapsed > SLOW => Err(format!("{:.1} s for {size} bytes", elapsed.as_secs_f64())),
        Ok(_) if memory > MEMORY_FACTOR * size + MEMORY_FIXED => Err(format!("{memory} bytes of memory for {size} bytes")),
        Ok(good) => Ok(good),
    }
}
