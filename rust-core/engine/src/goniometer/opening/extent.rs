//! Boxes about places, without the outermost.

/// Share of the places at each end of a direction that does not count.
const STRAY: f64 = 1e-4;

/// Least and greatest coordinates along x, y and z, metres.
pub type Extent = [[f64; 3]; 2];

/// The box about points but for the outermost; none without points.
pub(super) fn extent_of(points: &[[f64; 3]]) -> Option<Extent> {
    let mut extent = [[0.0; 3]; 2];
    for k in 0..3 {
        let mut along: Vec<f64> = points.iter().map(|point| point[k]).collect();
        let [least, greatest] = ends(&mut along)?;
        (extent[0][k], extent[1][k]) = (least, greatest);
    }
    Some(extent)
}

/// Least and greatest number but for the outermost.
pub(super) fn ends(numbers: &mut [f64]) -> Option<[f64; 2]> {
    let last = numbers.len().checked_sub(1)?;
    let stray = (STRAY * numbers.len() as f64) as usize;
    let least = *numbers.select_nth_unstable_by(stray, f64::total_cmp).1;
    let greatest = *numbers.select_nth_unstable_by(last - stray, f64::total_cmp).1;
    Some([least, greatest])
}

pub(super) fn size_of(extent: &Extent) -> [f64; 3] {
    [0, 1, 2].map(|k| extent[1][k] - extent[0][k])
}

pub(super) fn middle(extent: &Extent) -> [f64; 3] {
    [0, 1, 2].map(|k| 0.5 * (extent[0][k] + extent[1][k]))
}

pub(super) fn largest_of(extent: &Extent) -> f64 {
    size_of(extent).into_iter().fold(0.0, f64::max)
}

pub(super) fn joined(a: Extent, b: Extent) -> Extent {
    [[0, 1, 2].map(|k| a[0][k].min(b[0][k])), [0, 1, 2].map(|k| a[1][k].max(b[1][k]))]
}
