//! The illuminances of a whole year.

use crate::chunk::Chunk;

/// Illuminances of a year in lx, row after row: points × steps. It is dark where nothing was taken.
#[derive(Clone, Debug)]
pub struct Series {
    /// Rows.
    pub points: usize,
    /// Columns, the year's steps.
    pub steps: usize,
    /// Sky and sun, with blinds as they are operated.
    pub total: Vec<f32>,
    /// The sun alone, through open blinds; `None` where no chunk knew it.
    pub direct: Option<Vec<f32>>,
}

impl Series {
    /// A dark year.
    pub fn new(points: usize, steps: usize) -> Self {
        Self { points, steps, total: vec![0.0; points * steps], direct: None }
    }

    /// Takes a chunk of all blocks over.
    pub fn take(&mut self, chunk: &Chunk<'_>) {
        if chunk.without.is_some() {
            return;
        }
        put_steps(&mut self.total, self.steps, chunk.steps, chunk.total);
        if let Some(direct) = chunk.direct {
            let all = self.direct.get_or_insert_with(|| vec![0.0; self.points * self.steps]);
            put_steps(all, self.steps, chunk.steps, direct);
        }
    }

    /// Means of all points, by step.
    pub fn means(&self) -> Vec<f32> {
        let mut sums = vec![0.0_f64; self.steps];
        for row in self.total.chunks_exact(self.steps) {
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += f64::from(*value));
        }
        sums.into_iter().map(|sum| (sum / self.points as f64) as f32).collect()
    }
}

/// Copies a chunk's columns to their places.
fn put_steps(all: &mut [f32], steps: usize, places: &[usize], chunk: &[f32]) {
    for (row, values) in all.chunks_exact_mut(steps).zip(chunk.chunks_exact(places.len())) {
        places.iter().zip(values).for_each(|(place, value)| row[*place] = *value);
    }
}
