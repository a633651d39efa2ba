//! Fuzzing of the readers on stable Rust: `cargo run --release -p gonio-formats --example fuzz -- READER SECONDS [SEED]`.
//!
//! Good files are broken in the ways that files break, and worse. A panic, more than a second for one input, or more memory than 64 times
//! the input's size and a fixed part is a finding: its bytes are written to `fuzz-READER-SEED.bin`, and the run ends with status 1.

mod bsdf;
mod gdtf;
mod gldf;
mod memory;
mod mutate;
mod photometry;
mod polygons;
mod rays;
mod weather;

use mutate::Random;
use std::panic::catch_unwind;
use std::process::ExitCode;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

/// The longest that one input may take.
const SLOW: Duration = Duration::from_secs(1);

/// After this an input counts as never ending.
const STUCK: Duration = Duration::from_secs(60);

/// Bytes of memory for each byte of input.
const MEMORY_FACTOR: usize = 64;

/// What is fuzzed.
#[derive(Clone, Copy, Debug)]
pub struct Reader {
    /// Its name on the command line.
    pub name: &'static str,
    /// Good files to start from.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Reads, and says whether that went well.
    pub read: fn(&[u8]) -> bool,
    /// Bytes of memory allowed beside 64 times the input's size.
    pub memory: usize,
}

/// All readers of the crate.
fn readers() -> Vec<Reader> {
    [photometry::readers(), bsdf::readers(), rays::readers(), weather::readers(), polygons::readers(), gldf::readers(), gdtf::readers()]
        .concat()
}

/// The input at work and since when, for the watchdog.
type Work = Arc<Mutex<Option<(Instant, Vec<u8>)>>>;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let readers = readers();
    let reader = arguments.first().and_then(|name| readers.iter().find(|reader| reader.name == *name));
    let seconds = arguments.get(1).and_then(|seconds| seconds.parse::<f64>().ok()).filter(|seconds| (0.0..1e6).contains(seconds));
    let seed = arguments.get(2).map_or(Some(1), |seed| seed.parse::<u64>().ok());
    let (Some(reader), Some(seconds), Some(seed)) = (reader, seconds, seed) else {
        let names: Vec<&str> = readers.iter().map(|reader| reader.name).collect();
        eprintln!("usage: fuzz READER SECONDS [SEED], with READER one of {}", names.join(", "));
        return ExitCode::from(2);
    };
    // Panics are findings, told once and in one line.
    std::panic::set_hook(Box::new(|_| {}));
    match run(reader, Duration::from_secs_f64(seconds), seed) {
        None => ExitCode::SUCCESS,
        Some((problem, input)) => {
            report(reader.name, seed, &problem, &input);
            ExitCode::FAILURE
        }
    }
}

/// Tries inputs until the time is over or something is found.
fn run(reader: &Reader, duration: Duration, seed: u64) -> Option<(String, Vec<u8>)> {
    let seeds = (reader.seeds)();
    let mut random = Random::new(seed);
    let work = watchdog(reader.name, seed);
    let (start, mut count, mut good) = (Instant::now(), 0u64, 0u64);
    let inputs = std::iter::from_fn(|| Some(mutate::input(&seeds, &mut random)));
    for input in seeds.iter().cloned().chain(inputs) {
        if start.elapsed() > duration {
            break;
        }
        set(&work, Some((Instant::now(), input.clone())));
        match attempt(reader, &input) {
            Ok(read) => good += u64::from(read),
            Err(problem) => return Some((problem, input)),
        }
        set(&work, None);
        count += 1;
    }
    eprintln!(
        "{}: {count} inputs, {good} of them good, in {:.0} s from seed {seed}, no finding",
        reader.name,
        start.elapsed().as_secs_f64()
    );
    None
}

/// Reads once: whether the input was good, or what is wrong with the reader.
fn attempt(reader: &Reader, input: &[u8]) -> Result<bool, String> {
    let start = clock();
    let before = memory::restart();
    let result = catch_unwind(|| (reader.read)(input));
    let memory = memory::peak().saturating_sub(before);
    let elapsed = clock().saturating_sub(start);
    let most = MEMORY_FACTOR * input.len() + reader.memory;
    match result {
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
            Err(format!("panic: {}", text.unwrap_or("without a text")))
        }
        Ok(_) if elapsed > SLOW => Err(format!("{:.1} s for {} bytes", elapsed.as_secs_f64(), input.len())),
        Ok(_) if memory > most => Err(format!("{memory} bytes of memory for {} bytes", input.len())),
        Ok(good) => Ok(good),
    }
}

/// The thread's own time where the system tells it: on a busy machine anything takes long.
fn clock() -> Duration {
    static START: OnceLock<Instant> = OnceLock::new();
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let own = told.and_then(|text| text.split(' ').next()?.parse().ok()).map(Duration::from_nanos);
    own.unwrap_or_else(|| START.get_or_init(Instant::now).elapsed())
}

/// A thread that ends the run if an input never does.
fn watchdog(name: &'static str, seed: u64) -> Work {
    let work = Work::default();
    let watched = work.clone();
    std::thread::spawn(move || {
        loop {
            std::thread::sleep(SLOW);
            let stuck = watched.lock().unwrap_or_else(PoisonError::into_inner).take_if(|(since, _)| since.elapsed() > STUCK);
            if let Some((_, input)) = stuck {
                report(name, seed, "does not end", &input);
                std::process::exit(1);
            }
        }
    });
    work
}

fn set(work: &Work, at: Option<(Instant, Vec<u8>)>) {
    *work.lock().unwrap_or_else(PoisonError::into_inner) = at;
}

fn report(name: &str, seed: u64, problem: &str, input: &[u8]) {
    let path = format!("fuzz-{name}-{seed}.bin");
    let written = std::fs::write(&path, input);
    eprintln!("{name}: {problem}; {}", written.map_or_else(|error| error.to_string(), |()| format!("the input is in {path}")));
}
