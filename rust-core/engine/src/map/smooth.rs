//! Values between the parts of divided triangles: each part has its own value at its middle, and at its corners the mean of those that meet there.

use super::{
    cells::{CellChart, MOST_LEVELS},
    usda::SAME_SURFACE,
};

/// Steps along the side of a triangle that is divided most.
const STEPS: u32 = 1 << MOST_LEVELS;

/// A side of a surface, smooth across parts and across triangles that lie in the same surface.
pub(super) struct Smooth<'a> {
    chart: &'a CellChart,
    levels: &'a [u8],
    /// The value in the middle of the part that begins with a cell, and those at its three corners.
    values: Vec<[f32; 4]>,
}

/// What is known of a triangle: the mesh's points at its corners, and its unit normal.
pub(super) struct Facet {
    pub(super) points: [u32; 3],
    pub(super) normal: [f32; 3],
}

/// A corner of a part: where it is, the triangle, the part's first cell, and which of its corners.
type Corner = ([u32; 4], u32, u32, usize);

impl<'a> Smooth<'a> {
    /// Of parts that were joined to these levels, with a cell's value; facets without an area have none.
    pub(super) fn new(chart: &'a CellChart, levels: &'a [u8], facets: &[Option<Facet>], value: impl Fn(usize) -> f32) -> Self {
        let mut values = vec![[f32::NAN; 4]; chart.len()];
        let mut corners: Vec<Corner> = Vec::new();
        for (triangle, facet) in facets.iter().enumerate() {
            let Some(facet) = facet else { continue };
            for (cell, places) in chart.parts(triangle, levels) {
                values[cell] = [value(cell); 4];
                let corner = |(number, place)| (shared(facet, triangle as u32, place), triangle as u32, cell as u32, number);
                corners.extend(places.into_iter().enumerate().map(corner));
            }
        }
        corners.sort_unstable();
        for meeting in corners.chunk_by(|a, b| a.0 == b.0) {
            for (_, triangle, cell, number) in meeting {
                let same = |other: &&Corner| cosine(facets, *triangle, other.1) >= SAME_SURFACE as f32;
                let (mut sum, mut count) = (0.0, 0.0);
                for (_, _, other, _) in meeting.iter().filter(same) {
                    sum += values[*other as usize][0];
                    count += 1.0;
                }
                values[*cell as usize][1 + number] = sum / count;
            }
        }
        Self { chart, levels, values }
    }

    /// The value at barycentric coordinates of corners 1 and 2.
    pub(super) fn at(&self, triangle: u32, place: [f32; 2]) -> f32 {
        let (cell, [u, v]) = self.chart.part(triangle, place, self.levels);
        let [middle, corners @ ..] = self.values[cell];
        let weights = [1.0 - u - v, u, v];
        let least = weights.into_iter().fold(1.0f32 / 3.0, f32::min).max(0.0);
        middle * 3.0 * least + corners.into_iter().zip(weights).map(|(value, weight)| value * (weight - least)).sum::<f32>()
    }
}

/// A name of a place that all triangles which have it know: a point, a place between two, or one within a triangle.
fn shared(facet: &Facet, triangle: u32, [u, v]: [f64; 2]) -> [u32; 4] {
    let [u, v] = [u, v].map(|x| (x * f64::from(STEPS)) as u32);
    let mut on = facet.points.into_iter().zip([STEPS - u - v, u, v]).filter(|(_, weight)| *weight > 0);
    match (on.next(), on.next(), on.next()) {
        (Some((point, _)), None, _) => [point, point, 0, 0],
        (Some(a), Some(b), None) => {
            let (low, high) = if a.0 < b.0 { (a, b) } else { (b, a) };
            [low.0, high.0, high.1, 0]
        }
        _ => [triangle, u32::MAX, u, v],
    }
}

fn cosine(facets: &[Option<Facet>], a: u32, b: u32) -> f32 {
    if a == b {
        return 1.0;
    }
    let normal = |triangle: u32| facets[triangle as usize].as_ref().map_or([0.0; 3], |facet| facet.normal);
    (0..3).map(|k| normal(a)[k] * normal(b)[k]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facet(points: [u32; 3], normal: [f32; 3]) -> Option<Facet> {
        Some(Facet { points, normal })
    }

    #[test]
    fn middles_keep_their_values_and_neighbours_meet() {
        let (up, side) = ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
        let chart = CellChart::new(&[4.0, 4.0, 1.0], 1.0);
        // The third triangle is one part, and another surface.
        let levels = [1, 1, 1, 1, 1, 1, 1, 1, 0];
        let facets = [facet([0, 1, 2], up), facet([2, 1, 3], up), facet([1, 0, 4], side)];
        let smooth = Smooth::new(&chart, &levels, &facets, |cell| cell as f32);
        for (cell, place) in [(0, [1.0 / 6.0, 1.0 / 6.0]), (3, [1.0 / 3.0, 1.0 / 3.0])] {
            assert!((smooth.at(0, place) - cell as f32).abs() < 1e-4);
        }
        // Along the edge from point 1 to point 2, from both of its sides.
        for t in [0.0, 0.2, 0.5, 0.9] {
            let (a, b) = (smooth.at(0, [1.0 - t, t]), smooth.at(1, [1.0 - t, 0.0]));
            assert!((a - b).abs() < 1e-4, "{t}: {a} {b}");
        }
        assert_eq!([[0.0, 0.0], [1.0, 0.0]].map(|place| smooth.at(2, place)), [8.0; 2]);
    }
}
