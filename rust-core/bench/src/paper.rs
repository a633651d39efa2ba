//! The tables of the paper that gonio descends from, beside what was measured here, as Markdown.
//!
//! Coherent ray tracing for physically accurate rendering on SSE, four lanes, one thread; its figures are those of its Tables 1 to 4.

use super::report::{Breakdown, Report, Row};
use super::stage::Stage;
use super::stages::paper::{FRAME, FRAME_THREADS};
use std::fmt::Write;

/// What the paper gained by four lanes, by stage and row.
const GAINED: [(Stage, &str, f64); 14] = [
    (Stage::PaperBrdf, "100000 calls", 3.43),
    (Stage::PaperBrdf, "200000 calls", 3.17),
    (Stage::PaperBrdf, "400000 calls", 3.17),
    (Stage::PaperLight, "omnidirectional", 7.24),
    (Stage::PaperLight, "spot", 3.87),
    (Stage::PaperLight, "parallel", 4.31),
    (Stage::PaperLight, "directed", 6.24),
    (Stage::PaperLight, "linear", 5.83),
    (Stage::PaperLight, "circular", 5.79),
    (Stage::PaperLight, "rectangular", 5.96),
    (Stage::PaperLight, "with a goniogram", 4.38),
    (Stage::PaperPicture, "car", 3.6),
    (Stage::PaperPicture, "glass", 2.6),
    (Stage::PaperPicture, "room", 3.5),
];

/// Triangles, lights and depth of the paper's scenes.
const SCENES: [(&str, u64, u64, u32); 3] = [("car", 141_512, 3, 3), ("glass", 44_928, 2, 2), ("room", 11_788, 9, 2)];

/// The ratio that the paper has for a row.
fn gained(row: &Row) -> Option<f64> {
    GAINED.iter().find(|(stage, name, _)| stage.name() == row.stage && *name == row.name).map(|(_, _, ratio)| *ratio)
}

/// Frames a second at which one can move about.
const INTERACTIVE: f64 = 10.0;

/// The processors' word for a level.
fn name_of(level: &str) -> &str {
    match level {
        "scalar" => "one lane",
        "sse4.2" => "SSE4.2",
        "avx2" => "AVX2",
        "avx512" => "AVX-512",
        "neon" => "NEON",
        other => other,
    }
}

/// All four tables, and that of frames.
pub fn paper(report: &Report) -> String {
    [
        ratios(report, Stage::PaperBrdf, "Table 1: a BRDF of 17 × 7 × 17 × 13 values, looked up"),
        ratios(report, Stage::PaperLight, "Table 2: illumination by kind of light, a million samples"),
        ratios(report, Stage::PaperPicture, "Table 3: pictures of 1024 × 768 pixels"),
        scenes(&report.renders),
        frames(report),
    ]
    .concat()
}

/// A table of ratios; bold ones reach the paper's.
fn ratios(report: &Report, stage: Stage, title: &str) -> String {
    let rows: Vec<&Row> = report.rows.iter().filter(|row| row.stage == stage.name()).collect();
    let Some(first) = rows.first() else { return String::new() };
    let levels = first.levels.iter();
    let mut text = format!("## {title}\n\n| | one lane, ms | paper, 4 lanes |");
    levels.clone().for_each(|figure| _ = write!(text, " {}, {} lanes |", name_of(figure.level), figure.lanes));
    text.push_str(&format!("\n| --- | --- | --- |{}\n", " --- |".repeat(levels.count())));
    for row in rows {
        let units = match stage {
            Stage::PaperBrdf => leading_number(&row.name),
            Stage::PaperLight => 1e6,
            _ => 1.0,
        };
        let aim = gained(row);
        let aim_text = aim.map_or_else(|| "–".to_owned(), |aim| format!("{aim:.2}"));
        _ = write!(text, "| {} | {:.2} | {aim_text} |", row.name, row.baseline_ns * units * 1e-6);
        for figure in &row.levels {
            let ratio = figure.ratio.median;
            let mark = if aim.is_some_and(|aim| ratio >= aim) { "**" } else { "" };
            _ = write!(text, " {mark}{ratio:.2}{mark} |");
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// The number that a name begins with.
fn leading_number(name: &str) -> f64 {
    name.split(' ').next().and_then(|word| word.parse().ok()).unwrap_or(1.0)
}

/// The scenes beside the paper's, the rays that antialiasing took, and where the time went.
fn scenes(renders: &[Breakdown]) -> String {
    if renders.is_empty() {
        return String::new();
    }
    let mut text =
        "## Table 4: the scenes\n\n| | triangles, paper | here | lights, paper | here | depth | camera rays a pixel | tracing, one lane |"
            .to_owned();
    let levels = renders[0].levels.iter().skip(1);
    levels.clone().for_each(|level| _ = write!(text, " tracing, {} |", name_of(level.level)));
    text.push_str(&format!("\n|{}\n", " --- |".repeat(8 + levels.count())));
    for render in renders {
        let known = SCENES.iter().find(|scene| scene.0 == render.scene);
        let (triangles, lights, depth) = known.map_or((0, 0, 0), |(_, triangles, lights, depth)| (*triangles, *lights, *depth));
        let rays = render.levels.last().map_or(0.0, |level| level.camera_rays);
        _ = write!(text, "| {} | {triangles} | {} | {lights} | {} | {depth} | {rays:.2} |", render.scene, render.triangles, render.lights);
        for level in &render.levels {
            let traced: f64 =
                level.time.iter().filter(|share| ["intersect", "shadow"].contains(&share.stage)).map(|share| share.share).sum();
            _ = write!(text, " {:.0} % |", traced * 100.0);
        }
        text.push('\n');
    }
    text.push('\n');
    text
}

/// Frames a second by the clock; bold ones are interactive.
fn frames(report: &Report) -> String {
    let rows: Vec<&Row> = report.rows.iter().filter(|row| row.stage == Stage::PaperFrame.name()).collect();
    let Some(first) = rows.first() else { return String::new() };
    let [width, height] = FRAME;
    let mut text = format!("## Frames a second: {width} × {height} pixels, {FRAME_THREADS} threads\n\n| | one lane |");
    first.levels.iter().for_each(|figure| _ = write!(text, " {}, {} lanes |", name_of(figure.level), figure.lanes));
    text.push_str(&format!("\n| --- | --- |{}\n", " --- |".repeat(first.levels.len())));
    for row in rows {
        _ = write!(text, "| {} |", row.name);
        for ns in std::iter::once(row.baseline_clock_ns).chain(row.levels.iter().map(|figure| figure.clock_ns)) {
            let rate = 1e9 / ns;
            let mark = if rate >= INTERACTIVE { "**" } else { "" };
            _ = write!(text, " {mark}{rate:.1}{mark} |");
        }
        text.push('\n');
    }
    text
}
