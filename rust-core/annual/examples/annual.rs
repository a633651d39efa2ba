//! Calculates a year without the command line: `annual -- WEATHER COEFFICIENTS [SUN-COEFFICIENTS]` prints the grid as JSON.

#![allow(clippy::print_stdout, reason = "its results go to standard output")]

use gonio_annual::{Coefficients, Group, Schedule, Settings, Year, evaluate, sky::SkyOptions};
use std::{error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [weather, open, direct @ ..] = &arguments[..] else { return Err("a weather file and coefficients are needed".into()) };
    let year = Year::read(Path::new(weather), &fs::read(weather)?)?;
    let read = |path: &String| -> Result<_, Box<dyn Error>> { Ok(Coefficients::read(Path::new(path), &fs::read(path)?)?) };
    let group =
        Group { open: read(open)?, direct: direct.first().map(read).transpose()?, sun: None, scattered: None, blinds: None, closed: None };
    let settings = Settings { sky: SkyOptions::default(), memory: 1 << 28, threads: 2, electric: None };
    let schedule = Schedule::daily(&year, 8.0, 18.0)?;
    let grid = evaluate(&year, &schedule, &[group], &settings, &mut |_| true)?;
    println!("{}", serde_json::to_string(&grid)?);
    Ok(())
}
