//! `gonio bench`.

use super::{
    arguments::BenchOptions,
    file::{check_targets, put},
    messages::print,
};
use gonio::{Error, Result};
use gonio_bench::{Options, Stage, heading, paper, paper_pictures, plot, run};
use std::sync::atomic::AtomicBool;

/// Measures, and prints the table or everything as JSON.
pub(super) fn bench(options: &BenchOptions, interrupted: &AtomicBool) -> Result<i32> {
    let BenchOptions { stage, seconds, threads, scene, paper: as_paper, pictures, json, plot: chart } = options;
    check_targets(chart)?;
    if let Some(folder) = pictures {
        let paths = paper_pictures(folder, *threads, interrupted)?;
        paths.iter().for_each(|path| print(&path.display().to_string()));
        return Ok(0);
    }
    let stages = if *as_paper { Stage::PAPER.to_vec() } else { stage.clone() };
    let wanted = Options { stages, seconds: *seconds, threads: *threads, scene: scene.clone() };
    if !json {
        print(&heading());
    }
    let report = run(&wanted, interrupted, |row| {
        if !json {
            print(&row.to_string());
        }
    })?;
    if *json {
        print(&serde_json::to_string_pretty(&report).map_err(|error| Error::Internal(error.to_string()))?);
    } else if *as_paper {
        print(&format!("\n{}", paper(&report)));
    } else {
        report.renders.iter().for_each(|render| print(&format!("\n{render}")));
    }
    if let Some(path) = chart {
        put(path, plot(&report).as_bytes())?;
    }
    Ok(0)
}
