//! The largest spacing that meets what is required.

use crate::{
    results::Results,
    road::{Ranges, Road},
};
use std::sync::Arc;

/// What was found.
#[derive(Clone, Debug, serde::Serialize)]
pub struct Best {
    /// Spacing of all rows in metres; none where nothing met what was required.
    pub spacing: Option<f64>,
    /// Height of all rows in metres, where heights were varied.
    pub height: Option<f64>,
    /// Tilt of all rows in degrees, where tilts were varied.
    pub tilt: Option<f64>,
    /// How many roads were calculated.
    pub tried: u32,
}

/// How often steps are halved after the coarse search.
const HALVINGS: u32 = 3;
/// The most roads that one search calculates.
const MOST: u32 = 200_000;

/// A way of building the road.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Design {
    spacing: f64,
    height: Option<f64>,
    tilt: Option<f64>,
}

/// A search under way.
struct Search<'a> {
    road: &'a Road,
    ranges: Ranges,
    best: Option<Design>,
    tried: u32,
    stopped: &'a dyn Fn() -> bool,
}

impl Road {
    /// Looks for the largest spacing within the ranges with which everything that was required is met, first in coarse steps, then about the
    /// best in finer ones; of equal spacings the lower height and tilt. Gives the road built so, its results and what was found; none without
    /// ranges or requirements, or where `stopped` says so before the end.
    pub fn optimise(&self, stopped: &dyn Fn() -> bool) -> Option<(Self, Results, Best)> {
        let ranges = self.ranges?;
        let mut search = Search { road: self, ranges, best: None, tried: 0, stopped };
        if !self.requires_anything() {
            return None;
        }
        search.coarse();
        for halving in 1..=HALVINGS {
            search.finer(0.5_f64.powi(halving as i32));
        }
        if stopped() {
            return None;
        }
        let built = search.best.map_or_else(|| self.clone(), |design| search.built(design));
        let best = Best {
            spacing: search.best.map(|design| design.spacing),
            height: search.best.and_then(|design| design.height),
            tilt: search.best.and_then(|design| design.tilt),
            tried: search.tried,
        };
        let mut results = built.evaluate();
        if self.rows.iter().any(|row| row.offset != 0.0) {
            results
                .notes
                .push("rows keep their offsets in metres at all spacings; rows on the side 'staggered' stay half a spacing apart".into());
        }
        Some((built, results, best))
    }
}

impl Search<'_> {
    fn coarse(&mut self) {
        let Ranges { height, tilt, height_step, tilt_step, spacing, spacing_step } = self.ranges;
        for height in steps(height, height_step) {
            for tilt in steps(tilt, tilt_step) {
                self.longest(height, tilt, spacing, spacing_step);
            }
        }
    }

    /// Heights and tilts beside the best, and spacings beyond it, in steps that are a share of the coarse ones.
    fn finer(&mut self, share: f64) {
        let Some(best) = self.best else { return };
        let Ranges { height_step, tilt_step, spacing_step, spacing, .. } = self.ranges;
        let about = |at: Option<f64>, range: Option<[f64; 2]>, step: f64| -> Vec<Option<f64>> {
            let Some((at, [from, to])) = at.zip(range) else { return vec![None] };
            [at - step, at, at + step].into_iter().filter(|at| (from..=to).contains(at)).map(Some).collect()
        };
        let beyond = [best.spacing, (best.spacing + spacing_step).min(spacing[1])];
        for height in about(best.height, self.ranges.height, height_step * share) {
            for tilt in about(best.tilt, self.ranges.tilt, tilt_step * share) {
                self.longest(height, tilt, beyond, spacing_step * share);
            }
        }
    }

    /// Tries spacings from the greatest down to the best so far.
    fn longest(&mut self, height: Option<f64>, tilt: Option<f64>, range: [f64; 2], step: f64) {
        for spacing in steps(Some(range), step).into_iter().rev().flatten() {
            if self.best.is_some_and(|best| spacing <= best.spacing) || self.tried >= MOST || (self.stopped)() {
                return;
            }
            let design = Design { spacing, height, tilt };
            self.tried += 1;
            if self.built(design).evaluate().met == Some(true) {
                self.best = Some(design);
                return;
            }
        }
    }

    fn built(&self, design: Design) -> Road {
        let mut road = self.road.clone();
        for row in &mut road.rows {
            row.spacing = design.spacing;
            row.height = design.height.unwrap_or(row.height);
            if let Some(tilt) = design.tilt {
                if row.goniogram.tilt.is_some() {
                    row.goniogram = Arc::new(row.goniogram.tilted_on(row.tilt, tilt));
                }
                row.tilt = tilt;
            }
        }
        road
    }
}

/// Steps of a range with both its ends; what is not varied has one step.
fn steps(range: Option<[f64; 2]>, step: f64) -> Vec<Option<f64>> {
    let Some([from, to]) = range else { return vec![None] };
    let count = ((to - from) / step + 1e-9).floor() as u32;
    let mut steps: Vec<f64> = (0..=count).map(|index| from + f64::from(index) * step).collect();
    if steps.last().is_some_and(|last| to - last > 1e-9 * to.abs().max(1.0)) {
        steps.push(to);
    }
    steps.into_iter().map(Some).collect()
}
