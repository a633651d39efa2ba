//! The area that places cover, seen along a direction.

use super::extent::ends;

/// Cells along a side, finest first; the first that has [`MEMBERS`] places in a cell is taken.
const CELLS: [usize; 7] = [64, 48, 32, 24, 16, 8, 4];
const MEMBERS: usize = 16;
/// Share of what its neighbours have that makes a cell a lit one: a border runs through the middle of its cells.
const HALF: f64 = 0.5;
/// Share of the mean below which a cell is dark.
const DARK: f64 = 0.05;
/// Share of the whole by which a full rectangle or ellipse may be missed: counts of places are no better.
const NEAR: f64 = 0.03;
/// Share of a cell by which a border may be missed.
const BORDER: f64 = 0.2;

/// What is covered.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Shadow {
    /// Square metres.
    pub(super) area: f64,
    /// Whether it is an ellipse along the axes.
    pub(super) elliptic: bool,
}

impl Shadow {
    /// Of points along a unit direction. Its first axis is horizontal.
    pub(super) fn new(points: &[[f64; 3]], [x, y, z]: [f64; 3]) -> Self {
        let level = x.hypot(y);
        let across = if level > 1e-9 { [-y / level, x / level, 0.0] } else { [1.0, 0.0, 0.0] };
        let up = [y * across[2] - z * across[1], z * across[0] - x * across[2], x * across[1] - y * across[0]];
        let flat: Vec<[f64; 2]> =
            points.iter().map(|point| [across, up].map(|axis| (0..3).map(|k| axis[k] * point[k]).sum::<f64>())).collect();
        Self::of(&flat)
    }

    fn of(points: &[[f64; 2]]) -> Self {
        let bounds = [0, 1].map(|k| ends(&mut points.iter().map(|point| point[k]).collect::<Vec<_>>()));
        let [Some(wide), Some(high)] = bounds else { return Self::default() };
        let sizes = [wide[1] - wide[0], high[1] - high[0]];
        if !sizes.iter().all(|size| *size > 0.0) {
            return Self::default();
        }
        let mut grid = Grid::new(points, [wide, high], CELLS[CELLS.len() - 1]);
        for along in CELLS {
            let finer = Grid::new(points, [wide, high], along);
            if points.len() >= MEMBERS * finer.occupied() {
                grid = finer;
                break;
            }
        }
        let lit = grid.lit();
        let share = lit.iter().filter(|lit| **lit).count() as f64 / lit.len() as f64;
        let ellipse = std::f64::consts::FRAC_PI_4;
        let last = grid.along - 1;
        let corners = [0, last, last * grid.along, last * (grid.along + 1)].iter().all(|corner| !lit[*corner]);
        // An ellipse's circumference over its area is four over its diameter.
        let missed = (2.0 * NEAR).max(4.0 * BORDER / grid.along as f64);
        let elliptic = corners && (share / ellipse - 1.0).abs() < missed;
        let share = if elliptic {
            ellipse
        } else if share > 1.0 - NEAR {
            1.0
        } else {
            share
        };
        Self { area: share * sizes[0] * sizes[1], elliptic }
    }
}

/// Counts of points on a square number of cells.
struct Grid {
    along: usize,
    counts: Vec<u32>,
}

impl Grid {
    fn new(points: &[[f64; 2]], bounds: [[f64; 2]; 2], along: usize) -> Self {
        let mut counts = vec![0; along * along];
        for point in points {
            let [i, j] = [0, 1].map(|k| (point[k] - bounds[k][0]) / (bounds[k][1] - bounds[k][0]) * along as f64);
            // What lies on the very end belongs to the last cell; strays lie beyond.
            if i >= 0.0 && j >= 0.0 && i <= along as f64 && j <= along as f64 {
                counts[(j as usize).min(along - 1) * along + (i as usize).min(along - 1)] += 1;
            }
        }
        Self { along, counts }
    }

    fn occupied(&self) -> usize {
        self.counts.iter().filter(|count| **count > 0).count()
    }

    fn around(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        let [i, j] = [cell % self.along, cell / self.along];
        let near = |at: usize| at.saturating_sub(1)..(at + 2).min(self.along);
        near(j).flat_map(move |j| near(i).map(move |i| j * self.along + i))
    }

    /// Which cells are more than half covered, as far as counts tell; a single hole is chance.
    fn lit(&self) -> Vec<bool> {
        let total: u32 = self.counts.iter().sum();
        let mean = f64::from(total) / self.occupied().max(1) as f64;
        let is_lit = |cell: usize| {
            let count = f64::from(self.counts[cell]);
            let mut near: Vec<u32> = self.around(cell).map(|other| self.counts[other]).filter(|count| *count > 0).collect();
            near.sort_unstable();
            let usual = near.get(near.len() / 2).copied().unwrap_or(0);
            count > 0.0 && count >= HALF * f64::from(usual) && count >= DARK * mean
        };
        let lit: Vec<bool> = (0..self.counts.len()).map(is_lit).collect();
        let filled = |cell: usize| lit[cell] || self.around(cell).filter(|other| lit[*other]).count() >= 6;
        (0..lit.len()).map(filled).collect()
    }
}
