//! Where a pixel is sampled, in units of its side from the top left; points are told in the version for discontinuities along the columns.
//!
//! The paper's figures 7 and 8 name the points and their order from left to right. Their places here are a reconstruction: E, G, F, H with a corner
//! are a lattice of rank 1, and the twenty points of the zigzags lie one on each line of 1/20, one in each quarter of the height for every zone, as
//! far from one another as a search could bring them. All 24 points together stay where they are when the square is turned.

/// Zones between the columns of corners and inner points.
pub(super) const ZONES: usize = 5;
/// Points of a zone's zigzag.
pub(super) const STEPS: usize = 4;

/// The inner points E, F, G, H.
pub(super) const INNER: [[f32; 2]; 4] = [[0.2, 0.4], [0.6, 0.2], [0.4, 0.8], [0.8, 0.6]];

/// The points of the zigzags, zone by zone.
pub(super) const ZIGZAGS: [[[f32; 2]; STEPS]; ZONES] = [
    [[0.025, 0.325], [0.075, 0.825], [0.125, 0.575], [0.175, 0.075]],
    [[0.225, 0.725], [0.275, 0.225], [0.325, 0.975], [0.375, 0.475]],
    [[0.425, 0.125], [0.475, 0.625], [0.525, 0.375], [0.575, 0.875]],
    [[0.625, 0.525], [0.675, 0.025], [0.725, 0.775], [0.775, 0.275]],
    [[0.825, 0.925], [0.875, 0.425], [0.925, 0.175], [0.975, 0.675]],
];

/// Where a point lies in a pixel whose square was turned by a right angle to bring the discontinuity along its columns.
pub(super) fn turned([x, y]: [f32; 2]) -> [f32; 2] {
    [y, 1.0 - x]
}

/// Columns and rows from a pixel's corner A to A, B, C and D of the upright version, and of the turned one.
pub(super) const CORNERS: [[[u32; 2]; 4]; 2] = [[[0, 0], [1, 0], [0, 1], [1, 1]], [[0, 1], [0, 0], [1, 1], [1, 0]]];

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<[f32; 2]> {
        INNER.into_iter().chain(ZIGZAGS.into_iter().flatten()).collect()
    }

    #[test]
    fn turning_the_square_leaves_the_points_where_they_are() {
        for point in all() {
            let [x, y] = turned(point);
            assert!(all().iter().any(|other| (other[0] - x).abs() < 1e-6 && (other[1] - y).abs() < 1e-6), "{point:?}");
        }
    }

    #[test]
    fn corners_turn_with_the_points() {
        for (corner, turned_corner) in CORNERS[0].into_iter().zip(CORNERS[1]) {
            assert_eq!(turned(corner.map(|x| x as f32)), turned_corner.map(|x| x as f32));
        }
    }

    #[test]
    fn zigzags_have_a_point_on_every_line_and_in_every_quarter() {
        for (number, point) in ZIGZAGS.into_iter().flatten().enumerate() {
            assert!((point[0] - (number as f32 + 0.5) / 20.0).abs() < 1e-6);
        }
        for zone in ZIGZAGS {
            let mut quarters = zone.map(|[_, y]| (y * 4.0) as u32);
            quarters.sort_unstable();
            assert_eq!(quarters, [0, 1, 2, 3]);
        }
    }
}
