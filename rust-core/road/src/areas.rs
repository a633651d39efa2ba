//! Illuminances of areas: the carriageway, its edges, paths beside it.

use crate::{
    field::{across, across_strip},
    illuminance::{Measurand, illuminance},
    line::Line,
    required::{self, Wanted},
    results::{Edge, Field, Footing, Illuminances},
    road::{Footpath, Road},
};

/// What areas are calculated with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lit<'a> {
    pub(crate) road: &'a Road,
    pub(crate) lines: &'a [Line<'a>],
    pub(crate) field: &'a Field,
}

/// Average, least and greatest.
struct Spread {
    average: f64,
    least: f64,
    greatest: f64,
}

impl Lit<'_> {
    /// Values of a measurand, row by row from the right.
    pub(crate) fn values(&self, ys: &[f64], measurand: Measurand) -> Vec<Vec<f64>> {
        let xs = self.field.xs();
        let row = |y: &f64| xs.iter().map(|x| illuminance(self.lines, &self.road.reach, [*x, *y], measurand)).collect();
        ys.iter().map(row).collect()
    }

    fn spread(&self, ys: &[f64], measurand: Measurand) -> Spread {
        let values: Vec<f64> = self.values(ys, measurand).into_iter().flatten().collect();
        let average = values.iter().sum::<f64>() / values.len().max(1) as f64;
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        Spread { average, least, greatest: values.iter().copied().fold(0.0, f64::max) }
    }

    /// The illuminances of an area between two places across the road.
    pub(crate) fn illuminances(&self, range: [f64; 2]) -> Illuminances {
        let ys = across(range);
        let [flat, half_sphere] = [Measurand::Horizontal, Measurand::Hemispherical].map(|measurand| self.spread(&ys, measurand));
        let least = |measurand: fn(f64) -> Measurand| [1.0, -1.0].map(|facing| self.spread(&ys, measurand(facing)).least);
        let [cylinder, plane] = [least(Measurand::Semicylindrical), least(Measurand::Vertical)];
        Illuminances {
            e_av: flat.average,
            e_min: flat.least,
            e_max: flat.greatest,
            u0: ratio(flat.least, flat.average),
            e_hs_av: half_sphere.average,
            e_hs_min: half_sphere.least,
            u0_hs: ratio(half_sphere.least, half_sphere.average),
            e_sc_min: cylinder[0].min(cylinder[1]),
            e_sc_min_facing: cylinder,
            e_v_min: plane[0].min(plane[1]),
            e_v_min_facing: plane,
        }
    }

    /// Strips beside and within both edges, the right one first.
    pub(crate) fn edges(&self) -> [Edge; 2] {
        let (width, strip) = (self.road.carriageway_width, self.road.edge_strip);
        let average = |range| self.spread(&across_strip(range), Measurand::Horizontal).average;
        let edge = |side: &'static str, outside, inside| {
            let [outside, inside] = [average(outside), average(inside)];
            Edge { side, outside, inside, ratio: ratio(outside, inside) }
        };
        [edge("right", [-strip, 0.0], [0.0, strip]), edge("left", [width, width + strip], [width - strip, width])]
    }

    /// The results of a path.
    pub(crate) fn footpath(&self, path: &Footpath) -> Footing {
        let range = path.range(self.road.carriageway_width);
        let illuminances = self.illuminances(range);
        let verdicts = required::verdicts(&path.required, &|key| illuminances.wanted(key));
        Footing { name: path.name.clone(), range, illuminances, required: verdicts }
    }
}

impl Footpath {
    /// Where it is across the road.
    pub(crate) fn range(&self, carriageway: f64) -> [f64; 2] {
        if self.left {
            [carriageway + self.distance, carriageway + self.distance + self.width]
        } else {
            [-self.distance - self.width, -self.distance]
        }
    }
}

/// A share of something that is there.
pub(crate) fn ratio(part: f64, whole: f64) -> Option<f64> {
    (whole > 0.0).then(|| part / whole)
}
