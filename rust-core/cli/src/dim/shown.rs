//! What was found, for readers and for machines.

use super::groups::LightGroup;
use gonio_dimming::{Area, Point, Problem, Reached, Solution, Verdict};
use gonio_formats::short_number;
use serde_json::{Value, json};

/// The groups' table, the targets, and the power before and after.
pub(super) fn lines(groups: &[LightGroup], solution: &Solution) -> Vec<String> {
    let width = groups.iter().map(|group| group.group.name.chars().count()).chain([5]).max().unwrap_or_default();
    let mut lines = vec![format!("{:<width$}   level, %   power, W   at full, W", "group")];
    for (LightGroup { group, .. }, level) in groups.iter().zip(&solution.levels) {
        let [now, full] = [group.watts * level, group.watts].map(short_number);
        lines.push(format!("{:<width$}   {:>8.1}   {now:>8}   {full:>10}", group.name, 100.0 * level));
    }
    lines.extend(solution.targets.iter().map(target_line));
    let [now, full] = [solution.watts, full(groups)].map(short_number);
    lines.push(format!("power: {now} W, {full} W before"));
    lines
}

fn target_line(target: &Reached) -> String {
    let Reached { text, reached, error, margin, verdict } = target;
    // Shares have more places than lux.
    let places = if reached.abs() < 10.0 { 3 } else { 1 };
    let by = if *verdict == Verdict::NotMet { format!(" by {:.places$}", -margin) } else { String::new() };
    format!("{text}: {reached:.places$} ± {error:.places$}, {}{by}", verdict.words())
}

fn full(groups: &[LightGroup]) -> f64 {
    groups.iter().map(|group| group.group.watts).sum()
}

/// Groups, targets, power, and what each point gets of each group at level 1.
pub(super) fn as_json(problem: &Problem, groups: &[LightGroup], solution: &Solution) -> Value {
    let group = |(light, level): (&LightGroup, &f64)| {
        let LightGroup { group, source, prims, .. } = light;
        json!({
            "name": group.name,
            "level": level,
            "watts": group.watts * level,
            "watts_full": group.watts,
            "watts_from": source.name(),
            "range": group.range,
            "lights": prims,
        })
    };
    let point = |point: &Point| json!({ "fixed": point.fixed, "groups": point.of_groups });
    let area = |area: &Area| json!({ "name": area.name, "points": area.points.iter().map(point).collect::<Vec<_>>() });
    json!({
        "groups": groups.iter().zip(&solution.levels).map(group).collect::<Vec<_>>(),
        "targets": solution.targets,
        "watts": solution.watts,
        "watts_full": full(groups),
        "areas": problem.areas.iter().map(area).collect::<Vec<_>>(),
    })
}
