//! What hits are called in cryptomattes: 32-bit values of the names of objects and of what these are parts of.

use crate::geometry::InstanceRow;

/// Some placements of a set of instances that are called the same.
#[derive(Clone, Copy, Debug)]
pub struct NameRun {
    /// First placement in its set.
    pub first: u32,
    /// Value of the object's name.
    pub object: u32,
    /// Value of the name of what it is a part of.
    pub asset: u32,
}

/// The names of all placements.
#[derive(Clone, Debug, Default)]
pub struct MatteNames {
    runs: Vec<NameRun>,
    /// First run of each set, then their number.
    of_set: Vec<u32>,
}

impl MatteNames {
    /// Puts the runs of the sets one after the other; the first placements of each rise from 0.
    pub fn new(sets: impl Iterator<Item = Vec<NameRun>>) -> Self {
        let mut names = Self { runs: Vec::new(), of_set: vec![0] };
        for runs in sets {
            names.runs.extend(runs);
            names.of_set.push(names.runs.len() as u32);
        }
        names
    }

    /// The values of an instance's object and asset.
    #[inline]
    pub fn of(&self, row: &InstanceRow) -> [u32; 2] {
        let [first, end] = [0, 1].map(|next| self.of_set[row.set as usize + next] as usize);
        let runs = &self.runs[first..end];
        let run = runs.partition_point(|run| run.first <= row.number).checked_sub(1).map(|at| runs[at]);
        run.map_or([0; 2], |run| [run.object, run.asset])
    }
}
