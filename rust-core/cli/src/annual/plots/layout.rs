//! Where a grid's points lie on the plan.

use super::lattice::lattice;
use gonio::annual::AnnualGrid;
use serde_json::{Value, json};
use std::collections::HashMap;

/// Share by which distances of neighbours may differ from each other.
const EVEN: f64 = 0.01;

/// Columns and rows of a grid, seen from above, and the cell of each point, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cells {
    pub(crate) size: [usize; 2],
    of_points: Vec<usize>,
}

/// The cells of a grid whose points lie evenly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Layout {
    pub(crate) cells: Cells,
    /// Width and depth of a cell, m.
    pub(crate) spacing: [f64; 2],
}

impl Cells {
    /// Of a traced grid: those of its layout, else the rows that were traced.
    pub(crate) fn of(grid: &AnnualGrid, layout: Option<&Layout>) -> Self {
        let rows = || Self { size: grid.size, of_points: filled(&grid.is_there) };
        layout.map_or_else(rows, |layout| layout.cells.clone())
    }

    /// A value for each cell, of those for each point.
    pub(crate) fn spread(&self, values: &[Option<f64>]) -> Vec<Option<f64>> {
        let mut found = vec![None; self.size[0] * self.size[1]];
        self.of_points.iter().zip(values).for_each(|(cell, value)| found[*cell] = *value);
        found
    }

    /// Tells a grid as JSON where its points lie.
    pub(crate) fn tell(&self, grid: &mut Value) {
        (grid["columns"], grid["rows"]) = (json!(self.size[0]), json!(self.size[1]));
        if self.of_points.len() < self.size[0] * self.size[1] || self.of_points.iter().enumerate().any(|(place, cell)| place != *cell) {
            grid["cells"] = json!(self.of_points);
        }
    }
}

impl Layout {
    /// Of points that lie evenly; `None` of others, such as meters here and there.
    pub(crate) fn new(size: [usize; 2], cells: Vec<usize>, positions: &[[f64; 3]]) -> Option<Self> {
        let fits = cells.len() == positions.len() && cells.iter().all(|cell| *cell < size[0].saturating_mul(size[1]));
        if !fits || cells.is_empty() {
            return None;
        }
        let along = even(&cells, positions, |cell| ((cell + 1) % size[0] != 0).then_some(cell + 1))?;
        let across = even(&cells, positions, |cell| Some(cell + size[0]))?;
        let spacing = match (along, across) {
            (0.0, 0.0) => return None,
            (0.0, across) => [across; 2],
            (along, 0.0) => [along; 2],
            (along, across) => [along, across],
        };
        Some(Self { cells: Cells { size, of_points: cells }, spacing })
    }

    /// Of a traced grid; of meters that lie in rows.
    pub(crate) fn of(grid: &AnnualGrid) -> Option<Self> {
        Self::new(grid.size, filled(&grid.is_there), &grid.positions).or_else(|| {
            let (size, cells) = lattice(&grid.positions, &grid.normals)?;
            Self::new(size, cells, &grid.positions)
        })
    }

    /// Of a grid as JSON.
    pub(crate) fn read(grid: &Value) -> Option<Self> {
        let count = |key: &str| grid[key].as_u64().and_then(|count| usize::try_from(count).ok());
        let points = grid["points"].as_array()?;
        let place = |point: &Value| serde_json::from_value(point["position_m"].clone()).ok();
        let positions: Vec<[f64; 3]> = points.iter().map(place).collect::<Option<_>>()?;
        let cells = serde_json::from_value(grid["cells"].clone()).unwrap_or_else(|_| (0..points.len()).collect());
        Self::new([count("columns")?, count("rows")?], cells, &positions)
    }
}

/// The cells that hold points.
fn filled(is_there: &[bool]) -> Vec<usize> {
    is_there.iter().enumerate().filter_map(|(cell, is_there)| is_there.then_some(cell)).collect()
}

/// The distance of the points of cells that are neighbours; 0 where there are none, `None` where distances differ.
fn even(cells: &[usize], positions: &[[f64; 3]], next: impl Fn(usize) -> Option<usize>) -> Option<f64> {
    let place_of: HashMap<usize, &[f64; 3]> = cells.iter().copied().zip(positions).collect();
    let mut found: Option<f64> = None;
    for (cell, place) in cells.iter().zip(positions) {
        let Some(other) = next(*cell).and_then(|next| place_of.get(&next)) else { continue };
        let apart = place.iter().zip(*other).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        match found {
            Some(known) if (apart - known).abs() > EVEN * known => return None,
            _ => found = found.or(Some(apart)),
        }
    }
    Some(found.unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(size: [usize; 2], spacing: [f64; 2]) -> Vec<[f64; 3]> {
        (0..size[0] * size[1]).map(|cell| [(cell % size[0]) as f64 * spacing[0], (cell / size[0]) as f64 * spacing[1], 0.8]).collect()
    }

    #[test]
    fn cells_are_as_wide_as_points_are_apart() {
        for (size, spacing, found) in [([3, 2], [0.5, 0.4], [0.5, 0.4]), ([1, 4], [9.0, 0.4], [0.4, 0.4]), ([4, 1], [0.3, 9.0], [0.3, 0.3])]
        {
            let positions = places(size, spacing);
            let layout = Layout::new(size, (0..positions.len()).collect(), &positions).expect("even points");
            assert!(layout.spacing.iter().zip(found).all(|(a, b)| (a - b).abs() < 1e-9), "{layout:?}");
        }
    }

    #[test]
    fn cells_without_points_are_blank() {
        let positions = places([3, 2], [1.0, 1.0]);
        let some: Vec<[f64; 3]> = [0, 1, 5].map(|cell: usize| positions[cell]).into();
        let layout = Layout::new([3, 2], filled(&[true, true, false, false, false, true]), &some).expect("even points");
        assert_eq!(layout.cells.spread(&[Some(1.0), Some(2.0), Some(3.0)]), [Some(1.0), Some(2.0), None, None, None, Some(3.0)]);
    }

    #[test]
    fn scattered_points_have_no_plan() {
        assert_eq!(Layout::new([3, 1], vec![0, 1, 2], &[[0.0; 3], [1.0, 0.0, 0.0], [5.0, 0.0, 0.0]]), None);
        assert_eq!(Layout::new([1, 1], vec![0], &[[0.0; 3]]), None);
        assert_eq!(Layout::new([2, 1], vec![0], &[[0.0; 3], [1.0; 3]]), None);
    }
}
