//! Guth's position index as CIE 117 tabulates it (table 4.1).

/// A source's place that CIE 117 has no position index for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoIndex {
    /// Not ahead of the eye.
    Behind,
    /// Below the line of sight.
    Below,
    /// H/R above 1.9, or less where the table ends at 16.
    High,
    /// |T/R| above 3.
    Aside,
}

/// Where the table has none.
const NONE: f64 = f64::NAN;

/// Steps of both ratios, and slack for rounding at the table's end.
const STEP: f64 = 0.1;
const SLACK: f64 = 1e-9;

/// By T/R from 0 to 3 (rows) and H/R from 0 to 1.9. The print's 7.50 at T/R = 2.7, H/R = 0.6 stands between 7.00 and 7.08, and its 1.97 at T/R = 0.3,
/// H/R = 0.3 between 1.80 and 1.96: 7.05 and 1.87 are meant.
#[rustfmt::skip]
static TABLE: [[f64; 20]; 31] = [
    [1.0, 1.26, 1.53, 1.9, 2.35, 2.86, 3.5, 4.2, 5.0, 6.0, 7.0, 8.1, 9.25, 10.35, 11.7, 13.15, 14.7, 16.2, NONE, NONE],
    [1.05, 1.22, 1.46, 1.8, 2.2, 2.75, 3.4, 4.1, 4.8, 5.8, 6.8, 8.0, 9.1, 10.3, 11.6, 13.0, 14.6, 16.1, NONE, NONE],
    [1.12, 1.3, 1.5, 1.8, 2.2, 2.66, 3.18, 3.88, 4.6, 5.5, 6.5, 7.6, 8.75, 9.85, 11.2, 12.7, 14.0, 15.7, NONE, NONE],
    [1.22, 1.38, 1.6, 1.87, 2.25, 2.7, 3.25, 3.9, 4.6, 5.45, 6.45, 7.4, 8.4, 9.5, 10.85, 12.1, 13.7, 15.0, NONE, NONE],
    [1.32, 1.47, 1.7, 1.96, 2.35, 2.8, 3.3, 3.9, 4.6, 5.4, 6.4, 7.3, 8.3, 9.4, 10.6, 11.9, 13.2, 14.6, 16.0, NONE],
    [1.43, 1.6, 1.82, 2.1, 2.48, 2.91, 3.4, 3.98, 4.7, 5.5, 6.4, 7.3, 8.3, 9.4, 10.5, 11.75, 13.0, 14.4, 15.7, NONE],
    [1.55, 1.72, 1.98, 2.3, 2.65, 3.1, 3.6, 4.1, 4.8, 5.5, 6.4, 7.35, 8.4, 9.4, 10.5, 11.7, 13.0, 14.1, 15.4, NONE],
    [1.7, 1.88, 2.12, 2.48, 2.87, 3.3, 3.78, 4.3, 4.88, 5.6, 6.5, 7.4, 8.5, 9.5, 10.5, 11.7, 12.85, 14.0, 15.2, NONE],
    [1.82, 2.0, 2.32, 2.7, 3.08, 3.5, 3.92, 4.5, 5.1, 5.75, 6.6, 7.5, 8.6, 9.5, 10.6, 11.75, 12.8, 14.0, 15.1, NONE],
    [1.96, 2.2, 2.54, 2.9, 3.3, 3.7, 4.2, 4.75, 5.3, 6.0, 6.75, 7.7, 8.7, 9.65, 10.75, 11.8, 12.9, 14.0, 15.0, 16.0],
    [2.11, 2.4, 2.75, 3.1, 3.5, 3.91, 4.4, 5.0, 5.6, 6.2, 7.0, 7.9, 8.8, 9.75, 10.8, 11.9, 12.95, 14.0, 15.0, 16.0],
    [2.3, 2.55, 2.92, 3.3, 3.72, 4.2, 4.7, 5.25, 5.8, 6.55, 7.2, 8.15, 9.0, 9.9, 10.95, 12.0, 13.0, 14.0, 15.0, 16.0],
    [2.4, 2.75, 3.12, 3.5, 3.9, 4.35, 4.85, 5.5, 6.05, 6.7, 7.5, 8.3, 9.2, 10.0, 11.02, 12.1, 13.1, 14.0, 15.0, 16.0],
    [2.55, 2.9, 3.3, 3.7, 4.2, 4.65, 5.2, 5.7, 6.3, 7.0, 7.7, 8.55, 9.35, 10.2, 11.2, 12.25, 13.2, 14.0, 15.0, 16.0],
    [2.7, 3.1, 3.5, 3.9, 4.35, 4.85, 5.35, 5.85, 6.5, 7.25, 8.0, 8.7, 9.5, 10.4, 11.4, 12.4, 13.25, 14.05, 15.0, 16.0],
    [2.85, 3.15, 3.65, 4.1, 4.55, 5.0, 5.5, 6.2, 6.8, 7.5, 8.2, 8.85, 9.7, 10.55, 11.5, 12.5, 13.3, 14.05, 15.02, 16.0],
    [2.95, 3.4, 3.8, 4.25, 4.75, 5.2, 5.75, 6.3, 7.0, 7.65, 8.4, 9.0, 9.8, 10.8, 11.75, 12.6, 13.4, 14.2, 15.1, 16.0],
    [3.1, 3.55, 4.0, 4.5, 4.9, 5.4, 5.95, 6.5, 7.2, 7.8, 8.5, 9.2, 10.0, 10.85, 11.85, 12.75, 13.45, 14.2, 15.1, 16.0],
    [3.25, 3.7, 4.2, 4.65, 5.1, 5.6, 6.1, 6.75, 7.4, 8.0, 8.65, 9.35, 10.1, 11.0, 11.9, 12.8, 13.5, 14.2, 15.1, 16.0],
    [3.43, 3.86, 4.3, 4.75, 5.2, 5.7, 6.3, 6.9, 7.5, 8.17, 8.8, 9.5, 10.2, 11.0, 12.0, 12.82, 13.55, 14.2, 15.1, 16.0],
    [3.5, 4.0, 4.5, 4.9, 5.35, 5.8, 6.4, 7.1, 7.7, 8.3, 8.9, 9.6, 10.4, 11.1, 12.0, 12.85, 13.6, 14.3, 15.1, 16.0],
    [3.6, 4.17, 4.65, 5.05, 5.5, 6.0, 6.6, 7.2, 7.82, 8.45, 9.0, 9.75, 10.5, 11.2, 12.1, 12.9, 13.7, 14.35, 15.1, 16.0],
    [3.75, 4.25, 4.72, 5.2, 5.6, 6.1, 6.7, 7.35, 8.0, 8.55, 9.15, 9.85, 10.6, 11.3, 12.1, 12.9, 13.7, 14.4, 15.15, 16.0],
    [3.85, 4.35, 4.8, 5.25, 5.7, 6.22, 6.8, 7.4, 8.1, 8.65, 9.3, 9.9, 10.7, 11.4, 12.2, 12.95, 13.7, 14.4, 15.2, 16.0],
    [3.95, 4.4, 4.9, 5.35, 5.8, 6.3, 6.9, 7.5, 8.2, 8.8, 9.4, 10.0, 10.8, 11.5, 12.25, 13.0, 13.75, 14.45, 15.2, 16.0],
    [4.0, 4.5, 4.96, 5.4, 5.85, 6.4, 6.95, 7.55, 8.25, 8.85, 9.5, 10.05, 10.85, 11.55, 12.3, 13.0, 13.8, 14.5, 15.25, 16.0],
    [4.07, 4.55, 5.05, 5.47, 5.95, 6.46, 7.0, 7.65, 8.35, 8.95, 9.55, 10.1, 10.9, 11.6, 12.32, 13.0, 13.8, 14.5, 15.25, 16.0],
    [4.1, 4.6, 5.1, 5.53, 6.0, 6.5, 7.05, 7.7, 8.4, 9.0, 9.6, 10.16, 10.92, 11.63, 12.35, 13.0, 13.8, 14.5, 15.25, 16.0],
    [4.15, 4.62, 5.15, 5.56, 6.05, 6.55, 7.08, 7.73, 8.45, 9.05, 9.65, 10.2, 10.95, 11.65, 12.35, 13.0, 13.8, 14.5, 15.25, 16.0],
    [4.2, 4.65, 5.17, 5.6, 6.07, 6.57, 7.12, 7.75, 8.5, 9.1, 9.7, 10.23, 10.95, 11.65, 12.35, 13.0, 13.8, 14.5, 15.25, 16.0],
    [4.22, 4.67, 5.2, 5.65, 6.12, 6.6, 7.15, 7.8, 8.55, 9.12, 9.7, 10.23, 10.95, 11.65, 12.35, 13.0, 13.8, 14.5, 15.25, 16.0],
];

/// The position index of a source by its direction in the eye's frame (right, up, ahead; any length but zero), bilinear in the table: T, H and R are the
/// three in the standard's words.
///
/// # Errors
/// Why there is none. What is left out of the table is left out of the rating.
pub fn position_index([right, up, ahead]: [f64; 3]) -> Result<f64, NoIndex> {
    if ahead <= 0.0 {
        return Err(NoIndex::Behind);
    }
    // Nought but rounding: level with the eye.
    let (high, aside) = (up / ahead, right.abs() / ahead);
    if high < -SLACK {
        return Err(NoIndex::Below);
    }
    let (i, s) = cell(aside, TABLE.len()).ok_or(NoIndex::Aside)?;
    let (j, t) = cell(high.max(0.0), TABLE[0].len()).ok_or(NoIndex::High)?;
    let corners = [(0, 0, (1.0 - s) * (1.0 - t)), (1, 0, s * (1.0 - t)), (0, 1, (1.0 - s) * t), (1, 1, s * t)];
    let index: f64 = corners.iter().filter(|corner| corner.2 > 0.0).map(|(down, on, weight)| weight * TABLE[i + down][j + on]).sum();
    if index.is_nan() { Err(NoIndex::High) } else { Ok(index) }
}

/// The table's cell that holds a ratio, and how far into it the ratio lies; none beyond the table.
fn cell(ratio: f64, count: usize) -> Option<(usize, f64)> {
    let place = ratio / STEP;
    let last = (count - 1) as f64;
    if place > last + SLACK {
        return None;
    }
    let index = (place as usize).min(count - 2);
    let share = place - index as f64;
    // A tabulated value is itself, whatever stands beside it.
    Some((index, if share < SLACK { 0.0 } else { share.min(1.0) }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabulated_places_have_their_values() {
        assert_eq!(position_index([0.0, 0.0, 2.0]), Ok(1.0));
        assert_eq!(position_index([-3.0, 0.0, 1.0]), Ok(4.22));
        for (aside, high, expected) in [(0.0, 1.7, 16.2), (1.0, 1.0, 7.0), (3.0, 1.9, 16.0), (0.5, 0.3, 2.1)] {
            let found = position_index([aside, high, 1.0]).expect("an index");
            assert!((found - expected).abs() < 1e-9, "{found} instead of {expected}");
        }
        // Half way between 1.00, 1.26, 1.05 and 1.22.
        assert!((position_index([0.05, 0.05, 1.0]).expect("an index") - 1.1325).abs() < 1e-12);
    }

    #[test]
    fn guths_formula_is_near_the_table() {
        for (aside, high) in [(0.0, 0.35), (0.75, 0.55), (1.5, 1.25), (0.2, 1.0), (2.5, 1.0)] {
            let (tau, sigma) = (f64::atan2(aside, high).to_degrees(), f64::hypot(aside, high).atan().to_degrees());
            let first = 35.2 - 0.31889 * tau - 1.22 * (-2.0 * tau / 9.0).exp();
            let second = 21.0 + 0.26667 * tau - 0.002963 * tau * tau;
            let formula = (first * 1e-3 * sigma + second * 1e-5 * sigma * sigma).exp();
            let found = position_index([aside, high, 1.0]).expect("an index");
            // The formula is a fit, worst far aside.
            assert!((found / formula - 1.0).abs() < 0.1, "{aside} {high}: {found} and {formula}");
        }
    }

    #[test]
    fn beyond_the_table_there_is_none() {
        for (place, reason) in [
            ([0.0, 1.0, -1.0], NoIndex::Behind),
            ([0.0, -0.1, 1.0], NoIndex::Below),
            ([0.0, 1.91, 1.0], NoIndex::High),
            ([0.0, 1.75, 1.0], NoIndex::High),
            ([3.01, 0.5, 1.0], NoIndex::Aside),
            ([5.0, 4.0, 1.0], NoIndex::Aside),
        ] {
            assert_eq!(position_index(place), Err(reason));
        }
    }
}
