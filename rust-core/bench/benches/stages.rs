//! Every stage at every SIMD level, as `gonio bench` measures it: `cargo bench -p gonio-bench [-- STAGE…]`.

#![allow(clippy::print_stdout, reason = "the ratios are what the benchmark is for")]

use gonio::{Error, Result};
use gonio_bench::{Options, Stage, heading, run};
use std::sync::atomic::AtomicBool;

fn main() -> Result<()> {
    // Cargo passes switches of its own, which begin with a dash.
    let names: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let unknown = |name: &String| Error::Setting { name: name.clone(), problem: Stage::expected() };
    let stages = names.iter().map(|name| Stage::by_name(name).ok_or_else(|| unknown(name))).collect::<Result<_>>()?;
    println!("{}", heading());
    let report = run(&Options { stages, ..Options::default() }, &AtomicBool::new(false), |row| println!("{row}"))?;
    report.renders.iter().for_each(|render| print!("\n{render}"));
    Ok(())
}
