//! Calculates a road without the command line: `cargo run -p gonio-road --example road -- road.toml [sheet.svg]` prints the results as JSON.

#![allow(clippy::print_stdout, reason = "its results go to standard output")]

use gonio_road::{Road, sheet::sheet};
use std::{error::Error, path::Path, process::ExitCode};

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let path = Path::new(arguments.first().ok_or("the name of a road's file is missing")?);
    let read = Road::read(path)?;
    let (road, results) = match read.optimise(&|| false) {
        Some((road, results, best)) => {
            eprintln!("{}", serde_json::to_string(&best)?);
            (road, results)
        }
        None => {
            let results = read.evaluate();
            (read, results)
        }
    };
    println!("{}", serde_json::to_string(&results)?);
    if let Some(to) = arguments.get(1) {
        std::fs::write(to, sheet(&road, &results, &path.to_string_lossy()))?;
    }
    Ok(())
}
