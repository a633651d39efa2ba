//! Eyes at the points of a grid: where they look, and what they get.

use super::{
    reaching::Reaching,
    reading::Reading,
    vector::{Vector, across, add, cross, scaled, unit},
};
use crate::{
    error::{Error, Result},
    scene::{Eyes, Grid, Measurand},
};
use std::f64::consts::TAU;

/// Level directions, even around and clockwise seen from above, the first one ahead; `up` and `ahead` are unit vectors across each other.
pub fn around(up: [f64; 3], ahead: [f64; 3], count: u32) -> Vec<[f64; 3]> {
    let right = cross(ahead, up);
    let direction = |number: u32| {
        let (sin, cos) = (TAU * f64::from(number) / f64::from(count)).sin_cos();
        // Quarter turns are exact.
        let exact = |part: f64| if part.abs() < 1e-15 { 0.0 } else { part };
        add(scaled(ahead, exact(cos)), scaled(right, exact(sin))).map(exact)
    };
    (0..count).map(direction).collect()
}

/// Where a grid's eyes look, unit vectors; none of grids without eyes.
///
/// # Errors
/// Eyes that look nowhere, and of quantities that they do not have.
pub(super) fn facings(grid: &Grid, normal: Vector) -> Result<Vec<Vector>> {
    let Some(eyes) = &grid.eyes else { return Ok(Vec::new()) };
    if !grid.measurand.is_of_eyes() {
        let known: Vec<&str> = Measurand::NAMES.iter().filter(|(known, _)| known.is_of_eyes()).map(|(_, name)| *name).collect();
        let problem = format!("eyes have {}; a grid of {} has none", known.join(", "), grid.measurand.name());
        return Err(Error::scene(&grid.origin, problem));
    }
    let nowhere = || Error::scene(&grid.origin, "eyes look nowhere; a direction is zero or no number, or there is none");
    let facings: Vec<Vector> = match eyes {
        Eyes::Around(count) => around(normal, across(normal, grid.facing), *count),
        Eyes::Towards(facings) => facings.iter().map(|facing| unit(*facing).ok_or_else(nowhere)).collect::<Result<_>>()?,
    };
    if facings.is_empty() { Err(nowhere()) } else { Ok(facings) }
}

/// What eyes at a grid's points get.
#[derive(Clone, Debug, PartialEq)]
pub struct EyeReadings {
    /// Where the eyes of each point look, unit vectors in world space.
    pub facings: Vec<[f64; 3]>,
    /// By point that was measured, the readings of its eyes in the directions' order.
    pub views: Vec<Vec<Reading>>,
}

impl EyeReadings {
    /// Of readings point by point.
    pub(super) fn new(facings: Vec<Vector>, readings: impl Iterator<Item = Reading>) -> Self {
        let readings: Vec<Reading> = readings.collect();
        let views = readings.chunks(facings.len().max(1)).map(<[Reading]>::to_vec).collect();
        Self { facings, views }
    }

    /// Each point's mean over the directions that have a figure.
    pub(super) fn means(&self) -> Vec<Reading> {
        self.views.iter().map(|views| mean(views.iter().copied())).collect()
    }

    /// Each point's least direction.
    pub fn leasts(&self) -> Vec<Reading> {
        let least = |views: &Vec<Reading>| {
            let known = views.iter().copied().filter(Reading::is_known);
            known.min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(Reading::UNKNOWN)
        };
        self.views.iter().map(least).collect()
    }

    /// What all points get in each direction, in the mean.
    pub fn by_facing(&self) -> Vec<Reading> {
        let of = |facing: usize| mean(self.views.iter().filter_map(move |views| views.get(facing).copied()));
        (0..self.facings.len()).map(of).collect()
    }

    /// The least of all eyes.
    pub fn least(&self) -> Reading {
        self.leasts().into_iter().filter(Reading::is_known).min_by(|a, b| a.value.total_cmp(&b.value)).unwrap_or(Reading::UNKNOWN)
    }

    /// How many points reach a value in each direction.
    pub fn reaching_all_ways(&self, target: f64) -> Reaching {
        Reaching::new(self.leasts().into_iter(), target)
    }

    /// How many eyes do, point by point and direction by direction.
    pub fn reaching_views(&self, target: f64) -> Reaching {
        Reaching::new(self.views.iter().flatten().copied(), target)
    }
}

/// The mean of readings that are independent of each other, those without a figure left out; none where none has one.
fn mean(readings: impl Iterator<Item = Reading> + Clone) -> Reading {
    let known = readings.filter(Reading::is_known);
    let share = 1.0 / known.clone().count() as f64;
    let value = known.clone().map(|reading| reading.value).sum::<f64>() * share;
    let standard_error = known.map(|reading| reading.standard_error.powi(2)).sum::<f64>().sqrt() * share;
    Reading { value, standard_error }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reading(value: f64) -> Reading {
        Reading { value, standard_error: 3.0 }
    }

    #[test]
    fn directions_go_clockwise_from_ahead() {
        let found = around([0.0, 0.0, 1.0], [0.0, 1.0, 0.0], 4);
        let expected = [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]];
        for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }

    #[test]
    fn points_have_means_and_leasts_over_directions() {
        let facings = vec![[0.0, 1.0, 0.0], [0.0, -1.0, 0.0]];
        let values = [100.0, 300.0, 260.0, f64::NAN, f64::NAN, f64::NAN].map(reading);
        let eyes = EyeReadings::new(facings, values.into_iter());
        let [first, second, third] = eyes.means()[..] else { panic!("three points") };
        assert_eq!((first.value, second.value), (200.0, 260.0));
        assert!((first.standard_error - 3.0 / 2f64.sqrt()).abs() < 1e-12 && second.standard_error == 3.0 && !third.is_known());
        assert_eq!(eyes.leasts()[..2], [reading(100.0), reading(260.0)]);
        assert_eq!(eyes.least(), reading(100.0));
        assert_eq!(eyes.by_facing()[0].value, 180.0);
        let (all, views) = (eyes.reaching_all_ways(250.0), eyes.reaching_views(250.0));
        assert_eq!((all.count, all.reached, views.count, views.reached), (2, 1, 3, 2));
    }
}
