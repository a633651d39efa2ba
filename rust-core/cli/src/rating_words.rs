//! What ratings of glare are made of, in words.

use crate::words::Words;
use gonio::measure::{GridReading, MeterReading, SmallSources, Summary, glare::Coverage};
use gonio_page::fill;

/// What a rating leaves out; none where all is rated and nothing is too large.
pub(crate) fn coverage(coverage: &Coverage, words: &Words) -> Option<String> {
    let say = &words.rating;
    let part = |count: usize, template: &str| (count > 0).then(|| fill(template, &[("count", &count.to_string())]));
    let reasons = [part(coverage.high, &say.high), part(coverage.aside, &say.aside), part(coverage.below, &say.below)];
    let reasons: Vec<String> = reasons.into_iter().flatten().collect();
    let out = (!reasons.is_empty()).then(|| {
        let (count, sources) = (coverage.left_out().to_string(), coverage.sources.to_string());
        let percent = format!("{:.0}", 100.0 * coverage.share_left_out());
        fill(&say.left_out, &[("count", &count), ("sources", &sources), ("reasons", &reasons.join(", ")), ("percent", &percent)])
    });
    joined([out, part(coverage.large, &say.large), part(coverage.covered, &say.covered)])
}

/// What a meter's reading is made of; none where there is nothing to be said.
pub(crate) fn of_meter(found: &MeterReading, words: &Words) -> Option<String> {
    let colour = found.colour.as_ref().map(|colour| words.numbers.form(&colour.note()));
    let small = found.small.filter(|small| small.count > 0).map(|SmallSources { count, tabular }| {
        let tabular = tabular.map_or(words.rating.no_tabular.clone(), |reading| words.numbers.fixed(reading.value, 1));
        fill(&words.rating.small, &[("count", &count.to_string()), ("tabular", &tabular)])
    });
    joined([colour, small, found.coverage.as_ref().and_then(|found| coverage(found, words))])
}

/// What a grid's ratings are made of; none where there is nothing to be said.
pub(crate) fn of_grid(grid: &GridReading, words: &Words) -> Option<String> {
    joined([small_of_grid(grid, words), left_out_of_grid(grid, words), covered_of_grid(grid, words)])
}

fn small_of_grid(grid: &GridReading, words: &Words) -> Option<String> {
    let points = grid.small.iter().filter(|small| small.count > 0).count();
    let tabular = match grid.tabular_summary() {
        Some(Summary { average, min, max, .. }) => {
            let [average, least, greatest] = [average, min, max].map(|reading| words.numbers.fixed(reading.value, 1));
            fill(&words.rating.grid_tabular, &[("average", &average), ("least", &least), ("greatest", &greatest)])
        }
        None => words.rating.no_tabular.clone(),
    };
    let values = [("points", points.to_string()), ("all", grid.small.len().to_string()), ("tabular", tabular)];
    (points > 0).then(|| fill(&words.rating.grid_small, &values.each_ref().map(|(name, value)| (*name, value.as_str()))))
}

fn left_out_of_grid(grid: &GridReading, words: &Words) -> Option<String> {
    let out: Vec<&Coverage> = grid.coverage.iter().filter(|coverage| coverage.left_out() > 0).collect();
    let share = out.iter().map(|coverage| coverage.share_left_out()).fold(0.0, f64::max);
    let most = out.iter().map(|coverage| coverage.left_out()).max()?;
    let values = [
        ("points", out.len().to_string()),
        ("all", grid.coverage.len().to_string()),
        ("most", most.to_string()),
        ("percent", format!("{:.0}", 100.0 * share)),
    ];
    Some(fill(&words.rating.grid_left_out, &values.each_ref().map(|(name, value)| (*name, value.as_str()))))
}

fn covered_of_grid(grid: &GridReading, words: &Words) -> Option<String> {
    let points = grid.coverage.iter().filter(|coverage| coverage.covered > 0).count();
    let all = grid.coverage.len().to_string();
    (points > 0).then(|| fill(&words.rating.grid_covered, &[("points", &points.to_string()), ("all", &all)]))
}

fn joined<const N: usize>(notes: [Option<String>; N]) -> Option<String> {
    let notes: Vec<String> = notes.into_iter().flatten().collect();
    (!notes.is_empty()).then(|| notes.join("; "))
}
