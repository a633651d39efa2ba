//! Points that say nothing of rows but lie in some, such as the sensors of a model.

use crate::vector::{Vector, cross, dot, minus};

/// Share of a spacing by which points may lie off their places.
const OFF: f64 = 0.01;
/// Coordinates that differ by less are one, m.
const SAME: f64 = 1e-3;
/// How alike normals are: their cosine.
const ALIKE: f64 = 0.999;
/// Cells for each point, at most: what is sparser is no grid.
const MOST_CELLS: usize = 8;

/// Columns and rows of points on a lattice, and the cell of each, seen from where their normals point: what lies most along +X is to the right. `None`
/// of others, and of points in one row.
pub(super) fn lattice(positions: &[Vector], normals: &[Vector]) -> Option<([usize; 2], Vec<usize>)> {
    let (first, normal) = (*positions.first()?, *normals.first()?);
    if normals.iter().any(|other| dot(*other, normal) < ALIKE) || positions.iter().any(|at| dot(minus(*at, first), normal).abs() > SAME) {
        return None;
    }
    let right = right(positions, normal)?;
    let [columns, rows] = [right, cross(normal, right)].map(|axis| {
        let along: Vec<f64> = positions.iter().map(|at| dot(minus(*at, first), axis)).collect();
        numbered(&along)
    });
    let ((columns, along), (rows, across)) = (columns?, rows?);
    if rows < 2 || columns < 2 || columns * rows > MOST_CELLS * positions.len() {
        return None;
    }
    let cells: Vec<usize> = along.iter().zip(&across).map(|(column, row)| row * columns + column).collect();
    let mut sorted = cells.clone();
    sorted.sort_unstable();
    sorted.windows(2).all(|pair| pair[0] < pair[1]).then_some(([columns, rows], cells))
}

/// The way to the point that is nearest to the first, or one across it: of the four that which lies most along +X.
fn right(positions: &[Vector], normal: Vector) -> Option<Vector> {
    let ways = positions.iter().map(|at| minus(*at, positions[0])).filter(|way| dot(*way, *way) > SAME * SAME);
    let near = ways.min_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))?;
    let length = dot(near, near).sqrt();
    let near = near.map(|part| part / length);
    let across = cross(normal, near);
    let four = [near, across, near.map(|part| -part), across.map(|part| -part)];
    four.into_iter().reduce(|most, way| if way[0] > most[0] + SAME { way } else { most })
}

/// How many even steps coordinates take, and the number of each; `None` where they are not even.
fn numbered(along: &[f64]) -> Option<(usize, Vec<usize>)> {
    let mut sorted = along.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let gaps = sorted.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > SAME);
    let Some(step) = gaps.min_by(f64::total_cmp) else { return Some((1, vec![0; along.len()])) };
    let places: Vec<f64> = along.iter().map(|at| (at - sorted[0]) / step).collect();
    let is_even = places.iter().all(|place| (place - place.round()).abs() < OFF * place.max(1.0));
    is_even.then(|| {
        let numbers: Vec<usize> = places.iter().map(|place| place.round() as usize).collect();
        (numbers.iter().max().map_or(0, |most| most + 1), numbers)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const UP: Vector = [0.0, 0.0, 1.0];

    /// Three columns to the right and two rows to the top, turned about the vertical, in an order of their own.
    fn places(turn: f64, order: [usize; 6]) -> Vec<Vector> {
        let (sin, cos) = turn.to_radians().sin_cos();
        let at = |cell: usize| [0.5 * (cell % 3) as f64, 0.4 * (cell / 3) as f64];
        order.map(at).map(|[x, y]| [2.0 + cos * x - sin * y, 1.0 + sin * x + cos * y, 0.8]).into()
    }

    #[test]
    fn points_find_their_cells_in_any_order() {
        for turn in [0.0, 20.0, -40.0] {
            for order in [[0, 1, 2, 3, 4, 5], [3, 0, 4, 1, 5, 2], [5, 2, 0, 1, 3, 4]] {
                let found = lattice(&places(turn, order), &[UP; 6]);
                assert_eq!(found, Some(([3, 2], order.to_vec())), "{turn}");
            }
        }
        // Two of them lack.
        let some = &places(10.0, [0, 4, 5, 1, 2, 3])[..4];
        assert_eq!(lattice(some, &[UP; 4]), Some(([3, 2], vec![0, 4, 5, 1])));
        // South is down and north up where Y is up: rows go towards -Z.
        let level: Vec<Vector> = places(0.0, [0, 1, 2, 3, 4, 5]).iter().map(|[x, y, z]| [*x, *z, -*y]).collect();
        assert_eq!(lattice(&level, &[[0.0, 1.0, 0.0]; 6]), Some(([3, 2], vec![0, 1, 2, 3, 4, 5])));
    }

    #[test]
    fn what_is_no_lattice_is_none() {
        let mut places = places(0.0, [0, 1, 2, 3, 4, 5]);
        assert_eq!(lattice(&places[..3], &[UP; 3]), None);
        places[4][0] += 0.07;
        assert_eq!(lattice(&places, &[UP; 6]), None);
        places[4] = places[0];
        assert_eq!(lattice(&places, &[UP; 6]), None);
        assert_eq!(lattice(&[], &[]), None);
        assert_eq!(lattice(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[UP, UP, [1.0, 0.0, 0.0]]), None);
    }
}
