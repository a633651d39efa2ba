//! Targets as linear inequalities in the levels.

use crate::{
    error::DimmingError,
    estimate::Estimate,
    problem::{Area, Point, Problem},
    target::{Limit, Target},
};

/// An inequality: `constant + Σ levels · factors + slack ≥ 0`, in units of its target's limit.
#[derive(Debug)]
pub(crate) struct Row {
    /// The number of the target, whose slack it is.
    pub(crate) target: usize,
    pub(crate) factors: Vec<f64>,
    pub(crate) constant: f64,
}

/// The inequalities of all targets.
pub(crate) fn rows(problem: &Problem) -> Result<Vec<Row>, DimmingError> {
    let mut all = Vec::new();
    for (number, target) in problem.targets.iter().enumerate() {
        let (scale, expressions) = expressions(problem, target)?;
        let kept = problem.errors_kept;
        let row = |point: Point| Row {
            target: number,
            factors: point.of_groups.iter().map(|group| (group.value - kept * group.error) / scale).collect(),
            constant: (point.fixed.value - kept * point.fixed.error) / scale,
        };
        all.extend(expressions.into_iter().map(row));
    }
    Ok(all)
}

/// What must not be negative for a target, and the unit in which it is missed.
fn expressions(problem: &Problem, target: &Target) -> Result<(f64, Vec<Point>), DimmingError> {
    let area = problem.area(target)?;
    let mean = area.mean();
    let unit = |limit: f64| if limit > 0.0 { limit } else { 1.0 };
    let points = || area.points.iter();
    Ok(match target.limit {
        Limit::MeanAtLeast(least) => (unit(least), vec![above(&mean, least)]),
        Limit::MeanAtMost(most) => (unit(most), vec![below(&mean, most)]),
        Limit::Mean(value, by) => (unit(value), vec![above(&mean, value - by), below(&mean, value + by)]),
        Limit::LeastAtLeast(least) => (unit(least), points().map(|point| above(point, least)).collect()),
        Limit::GreatestAtMost(most) => (unit(most), points().map(|point| below(point, most)).collect()),
        Limit::UniformityAtLeast(share) => {
            let full: Vec<f64> = problem.groups.iter().map(|group| group.range[1]).collect();
            let scale = unit(share * mean.at(&full).value);
            (scale, points().map(|point| combined(point, 1.0, &mean, -share)).collect())
        }
        Limit::CctAtLeast(least) => (divisor(problem, area), vec![area.cooler_than(least)]),
        Limit::CctAtMost(most) => (divisor(problem, area), vec![warmer(&area.cooler_than(most))]),
        Limit::Cct(value, by) => (divisor(problem, area), vec![area.cooler_than(value - by), warmer(&area.cooler_than(value + by))]),
    })
}

/// By which the side of an isotherm is about a relative temperature.
fn divisor(problem: &Problem, area: &Area) -> f64 {
    let full: Vec<f64> = problem.groups.iter().map(|group| group.range[1]).collect();
    Some(area.divisor(&full)).filter(|divisor| *divisor > 0.0).unwrap_or(1.0)
}

fn warmer(cooler: &Point) -> Point {
    Point { fixed: cooler.fixed.times(-1.0), of_groups: cooler.of_groups.iter().map(|group| group.times(-1.0)).collect() }
}

fn above(point: &Point, least: f64) -> Point {
    Point { fixed: Estimate::new(point.fixed.value - least, point.fixed.error), of_groups: point.of_groups.clone() }
}

fn below(point: &Point, most: f64) -> Point {
    let of_groups = point.of_groups.iter().map(|group| group.times(-1.0)).collect();
    Point { fixed: Estimate::new(most - point.fixed.value, point.fixed.error), of_groups }
}

fn combined(one: &Point, first: f64, other: &Point, second: f64) -> Point {
    let sum = |a: &Estimate, b: &Estimate| a.times(first).plus(b.times(second));
    let of_groups = one.of_groups.iter().zip(&other.of_groups).map(|(a, b)| sum(a, b)).collect();
    Point { fixed: sum(&one.fixed, &other.fixed), of_groups }
}
