//! What was found, for readers.

use gonio::dim::{Dimming, LightGroup};
use gonio_dimming::{Reached, Verdict};
use gonio_formats::short_number;

/// The groups' table, the targets, and the power before and after.
pub(super) fn lines(found: &Dimming) -> Vec<String> {
    let Dimming { groups, solution, .. } = found;
    let width = groups.iter().map(|group| group.group.name.chars().count()).chain([5]).max().unwrap_or_default();
    let mut lines = vec![format!("{:<width$}   level, %   power, W   at full, W", "group")];
    for (LightGroup { group, .. }, level) in groups.iter().zip(&solution.levels) {
        let [now, full] = [group.watts * level, group.watts].map(short_number);
        lines.push(format!("{:<width$}   {:>8.1}   {now:>8}   {full:>10}", group.name, 100.0 * level));
    }
    lines.extend(solution.targets.iter().map(target_line));
    let [now, full] = [solution.watts, found.watts_full()].map(short_number);
    lines.push(format!("power: {now} W, {full} W before"));
    lines
}

fn target_line(target: &Reached) -> String {
    let Reached { text, reached, error, margin, verdict } = target;
    if reached.is_nan() {
        return format!("{text}: the light is not white, {}", verdict.words());
    }
    // Shares have more places than lux.
    let places = if reached.abs() < 10.0 { 3 } else { 1 };
    let by = if *verdict == Verdict::NotMet { format!(" by {:.places$}", -margin) } else { String::new() };
    format!("{text}: {reached:.places$} ± {error:.places$}, {}{by}", verdict.words())
}
