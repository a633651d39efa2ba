//! The benchmark runs every stage at every level, and all levels do the same work. Nothing is timed.

use gonio_bench::{Options, Report, Spread, Stage, paper, plot, run};
use gonio_simd::Execution;
use std::sync::{LazyLock, atomic::AtomicBool};

/// Everything run once.
static REPORT: LazyLock<Report> = LazyLock::new(|| {
    let options = Options { seconds: 0.0, ..Options::default() };
    run(&options, &AtomicBool::new(false), |_| ()).expect("the benchmark runs")
});

#[test]
fn every_stage_runs_at_every_level() {
    let mut wider: Vec<&str> = Execution::all().iter().filter(|level| level.lanes() > 1).map(Execution::name).collect();
    wider.reverse();
    for stage in Stage::ALL {
        assert!(REPORT.rows.iter().any(|row| row.stage == stage.name()), "{}", stage.name());
    }
    for row in &REPORT.rows {
        let levels: Vec<&str> = row.levels.iter().map(|figure| figure.level).collect();
        assert_eq!(levels, wider, "{} {}", row.stage, row.name);
    }
}

#[test]
fn all_levels_do_the_same_work() {
    for row in &REPORT.rows {
        assert!(row.baseline_outcome.is_finite() && row.baseline_outcome > 0.0, "{} {}: {}", row.stage, row.name, row.baseline_outcome);
        for figure in &row.levels {
            let difference = (figure.outcome / row.baseline_outcome - 1.0).abs();
            assert!(difference <= row.tolerance, "{} {} at {}: off by {difference:.1e}", row.stage, row.name, figure.level);
        }
    }
}

#[test]
fn the_generated_scenes_have_the_sizes_that_their_names_promise() {
    let sizes: Vec<_> = REPORT.renders.iter().map(|r| (r.scene.as_str(), r.triangles.div_ceil(1000), r.lights)).collect();
    let rooms = ["room", "room all in GGX", "room all in a table"].map(|name| (name, 13, 9));
    let media = [("haze", 1, 2), ("smoke", 1, 1), ("cloud", 1, 2)];
    assert_eq!(sizes, [&media[..], &[("car", 142, 4), ("glass", 45, 2)], &rooms[..]].concat());
}

#[test]
fn registers_are_full_at_first_and_never_more_than_full() {
    for level in REPORT.renders.iter().flat_map(|render| &render.levels) {
        let shares = level.lanes.iter().flat_map(|bounce| &bounce.alive).chain(&level.time);
        assert!(shares.clone().all(|share| (-0.01..=1.01).contains(&share.share)), "{level}");
        assert!(level.lanes[0].alive.iter().any(|share| share.stage == "shade" && share.share > 0.9), "{level}");
    }
}

#[test]
fn machines_and_browsers_can_read_the_figures() {
    let json = serde_json::to_string(&*REPORT).expect("figures are plain data");
    let back: serde_json::Value = serde_json::from_str(&json).expect("well-formed JSON");
    assert_eq!(back["rows"].as_array().map(Vec::len), Some(REPORT.rows.len()));
    let svg = plot(&REPORT);
    let chart = roxmltree::Document::parse(&svg).expect("well-formed XML");
    let bars = chart.descendants().filter(|node| node.has_tag_name("rect")).count();
    assert!(bars > REPORT.rows.iter().map(|row| row.levels.len()).sum());
}

#[test]
fn every_row_has_its_figure_in_the_paper() {
    let options = Options { stages: vec![Stage::PaperBrdf, Stage::PaperLight], seconds: 0.0, ..Options::default() };
    let report = run(&options, &AtomicBool::new(false), |_| ()).expect("it is measured");
    assert_eq!(report.rows.len(), 11);
    let page = paper(&report);
    for row in &report.rows {
        let line = page.lines().find(|line| line.contains(&format!("| {} |", row.name)));
        assert!(line.is_some_and(|line| !line.contains('–')), "{}: {page}", row.name);
        let apart = row.levels.iter().map(|figure| (figure.outcome / row.baseline_outcome - 1.0).abs());
        assert!(apart.fold(0.0, f64::max) <= row.tolerance, "{}: levels differ", row.name);
    }
    assert!(page.contains("| with a goniogram |") && !page.contains("Table 4"), "{page}");
}

#[test]
fn a_spread_is_the_median_and_the_quartiles() {
    let spread = Spread::of(vec![5.0, 1.0, 3.0, 2.0, 4.0]);
    assert_eq!(spread, Spread { median: 3.0, low: 2.0, high: 4.0 });
    assert_eq!(Spread::of(vec![1.0, 2.0]).median, 1.5);
    assert!(Spread::of(Vec::new()).median.is_nan());
}
