//! The bandwidth by the error: cells of triangles are joined where their own values would be too uncertain.
//!
//! A part of a triangle is divided if the standard errors of all four quarters are within the share asked for, of their own value or of the whole
//! part's mean, whichever is more. So shadows keep their edges, though too little arrives in them to know how dark they are.

use super::{cells::CellChart, side::SideMap, table::Sums};

/// Joins the cells of a side whose sums are told by `sums`.
pub(super) fn join(chart: &CellChart, areas: &[f64], paths: f64, error: f64, sums: &dyn Fn(usize) -> Sums, out: &mut SideMap) {
    for (triangle, area) in areas.iter().enumerate() {
        if *area > 0.0 {
            let task =
                Joining { sums, error, per_cell: 1.0 / (paths * area / chart.cells(triangle).len() as f64), whole: chart.level(triangle) };
            let first = chart.cells(triangle).start;
            task.divide(first, task.whole, &task.all(first, task.whole), out);
        }
    }
}

/// A triangle under way.
struct Joining<'a> {
    sums: &'a dyn Fn(usize) -> Sums,
    error: f64,
    /// One over paths and square metres of a cell.
    per_cell: f64,
    whole: u8,
}

impl Joining<'_> {
    /// The sums of all cells of a part that can be divided `level` times more.
    fn all(&self, first: usize, level: u8) -> Sums {
        (first..first + cells(level)).fold(Sums::default(), |all, cell| all.plus(&(self.sums)(cell)))
    }

    fn divide(&self, first: usize, level: u8, all: &Sums, out: &mut SideMap) {
        if level > 0 {
            let quarter = cells(level - 1);
            let parts = [0, 1, 2, 3].map(|part| self.all(first + part * quarter, level - 1));
            if parts.iter().all(|part| self.is_certain(part, all)) {
                for (number, part) in parts.iter().enumerate() {
                    self.divide(first + number * quarter, level - 1, part, out);
                }
                return;
            }
        }
        let range = first..first + cells(level);
        out.level[range.clone()].fill(self.whole - level);
        out.set(range, all, self.per_cell / cells(level) as f64);
    }

    /// Whether a quarter's value is certain enough. Where nothing arrived one arrival might have, as bright as the others.
    fn is_certain(&self, part: &Sums, all: &Sums) -> bool {
        if self.error <= 0.0 || all.count == 0.0 {
            return self.error <= 0.0;
        }
        let least = all.squares / all.count;
        part.squares.max(least).sqrt() <= self.error * part.total().abs().max(0.25 * all.total().abs())
    }
}

fn cells(level: u8) -> usize {
    1 << (2 * level)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arrivals of one lumen each.
    fn joined(counts: &[f64], error: f64) -> SideMap {
        let chart = CellChart::new(&[1.0], 1.0 / counts.len() as f64);
        let sums = |cell: usize| Sums { count: counts[cell], squares: counts[cell], flux: [counts[cell], 0.0], colour: [0.0; 3] };
        let mut out = SideMap::new(counts.len(), false, true);
        join(&chart, &[1.0], 100.0, error, &sums, &mut out);
        out
    }

    #[test]
    fn cells_with_few_arrivals_are_one() {
        let even = joined(&[100.0; 16], 0.06);
        assert_eq!(even.level, [1; 16]);
        assert!(even.illuminance.iter().all(|lux| (lux - 16.0).abs() < 1e-5));
        assert_eq!(joined(&[100.0; 16], 0.11).level, [2; 16]);
        assert_eq!(joined(&[100.0; 16], 0.02).level, [0; 16]);
        assert_eq!(joined(&[1.0; 16], 0.0).level, [2; 16]);
    }

    #[test]
    fn shadows_keep_their_edges() {
        let mut counts = [1000.0; 16];
        counts[..4].fill(0.0);
        let edge = joined(&counts, 0.05);
        assert_eq!((edge.level[5], edge.illuminance[0], edge.direct[3]), (2, 0.0, 0.0));
        assert_eq!(edge.level[0], 1, "a dark quarter tells nothing more");
    }
}
