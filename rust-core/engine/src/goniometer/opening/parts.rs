//! Parts that shine apart from each other.

use super::{
    departure::Departure,
    extent::{Extent, largest_of},
    hull::Hull,
};

/// Cells along the largest side, finest first; the first that has [`MEMBERS`] places in a cell is taken.
const CELLS: [usize; 6] = [48, 32, 24, 16, 12, 8];
const MEMBERS: usize = 6;
/// Share of the light below which a part is stray.
const LEAST: f64 = 5e-3;
/// Share of a part's places that may lie in another's hull: a lamp in its reflector is no part of its own.
const WITHIN: f64 = 0.1;

/// The departures of each part, in the order of their first cells.
pub(super) fn find(sample: &[Departure], whole: &Extent) -> Vec<Vec<Departure>> {
    let mut cells = Cells::new(whole, CELLS[CELLS.len() - 1]);
    for along in CELLS {
        let finer = Cells::new(whole, along);
        if sample.len() >= MEMBERS * finer.occupied(sample) {
            cells = finer;
            break;
        }
    }
    let labels = cells.components(sample);
    let count = labels.iter().copied().max().unwrap_or(0) as usize;
    let mut parts = vec![Vec::new(); count];
    for departure in sample {
        if let Some(number) = cells.find(departure.place).map(|cell| labels[cell] as usize)
            && number > 0
        {
            parts[number - 1].push(*departure);
        }
    }
    parts.retain(|part| part.len() as f64 >= LEAST * sample.len() as f64);
    together(parts)
}

/// Parts that lie in each other's hulls become one.
fn together(mut parts: Vec<Vec<Departure>>) -> Vec<Vec<Departure>> {
    let mut hulls: Vec<Hull> = parts.iter().map(|part| Hull::new(part)).collect();
    let within = |part: &[Departure], hull: &Hull| {
        part.iter().filter(|departure| hull.holds(departure.place)).count() as f64 > WITHIN * part.len() as f64
    };
    let mut first = 0;
    while first < parts.len() {
        let other = (first + 1..parts.len()).find(|j| within(&parts[*j], &hulls[first]) || within(&parts[first], &hulls[*j]));
        let Some(other) = other else {
            first += 1;
            continue;
        };
        let more = parts.remove(other);
        hulls.remove(other);
        parts[first].extend(more);
        hulls[first] = Hull::new(&parts[first]);
        // A larger hull may hold what came before.
        first = 0;
    }
    parts
}

/// Cubes about all places.
struct Cells {
    start: [f64; 3],
    side: f64,
    counts: [usize; 3],
}

impl Cells {
    fn new(whole: &Extent, along: usize) -> Self {
        let side = largest_of(whole) / along as f64;
        // Strays lie beyond: a cell at each end.
        let counts = [0, 1, 2].map(|k| ((whole[1][k] - whole[0][k]) / side).ceil() as usize + 3);
        Self { start: whole[0].map(|x| x - 1.5 * side), side, counts }
    }

    fn find(&self, place: [f64; 3]) -> Option<usize> {
        let at = [0, 1, 2].map(|k| (place[k] - self.start[k]) / self.side);
        let inside = (0..3).all(|k| at[k] >= 0.0 && at[k] < self.counts[k] as f64);
        let [x, y, z] = at.map(|x| x as usize);
        inside.then(|| (z * self.counts[1] + y) * self.counts[0] + x)
    }

    fn filled(&self, sample: &[Departure]) -> Vec<bool> {
        let mut filled = vec![false; self.counts.iter().product()];
        sample.iter().filter_map(|departure| self.find(departure.place)).for_each(|cell| filled[cell] = true);
        filled
    }

    fn occupied(&self, sample: &[Departure]) -> usize {
        self.filled(sample).iter().filter(|filled| **filled).count()
    }

    /// The number of each cell's component, from 1; 0 of empty ones. Cells that share a corner belong together.
    fn components(&self, sample: &[Departure]) -> Vec<u32> {
        let filled = self.filled(sample);
        let mut labels = vec![0; filled.len()];
        let (mut count, mut open) = (0, Vec::new());
        for start in 0..filled.len() {
            if !filled[start] || labels[start] > 0 {
                continue;
            }
            count += 1;
            labels[start] = count;
            open.push(start);
            while let Some(cell) = open.pop() {
                for next in self.neighbours(cell) {
                    if filled[next] && labels[next] == 0 {
                        labels[next] = count;
                        open.push(next);
                    }
                }
            }
        }
        labels
    }

    fn neighbours(&self, cell: usize) -> impl Iterator<Item = usize> + '_ {
        let [nx, ny, nz] = self.counts;
        let [x, y, z] = [cell % nx, cell / nx % ny, cell / (nx * ny)];
        let near = |at: usize, count: usize| at.saturating_sub(1)..(at + 2).min(count);
        near(z, nz).flat_map(move |z| near(y, ny).flat_map(move |y| near(x, nx).map(move |x| (z * ny + y) * nx + x)))
    }
}
