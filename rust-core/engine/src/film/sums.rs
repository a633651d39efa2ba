//! Sums over a run of blocks, kept so that runs can be joined to the bits that one run would have had.
//!
//! Adding floats depends on the order. The order is: within a group of blocks from the first to the last, then group after group. A run from the
//! first sample on keeps two sums, that of the whole groups and that of the blocks of the last, open one. A run from the middle keeps every group by
//! itself, and the blocks by which its first group is completed.

use crate::camera::sampler::BATCH;
use std::borrow::Cow;

/// Sums over a run of blocks, channel after channel, `BATCH` values each.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sums {
    /// Blocks that complete a group whose start belongs to another run.
    pub(super) leading: Vec<Vec<f32>>,
    /// Whole groups: one sum of all for a run from the first sample on, else one for each.
    pub(super) groups: Vec<Vec<f64>>,
    /// The blocks of the last group that is not whole; empty if there are none.
    pub(super) open: Vec<f64>,
}

/// What sums cannot tell by themselves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules<'a> {
    /// Channels of numbers of things.
    pub(super) index_channels: &'a [usize],
    /// Whether the run starts with the first sample.
    pub(super) from_start: bool,
}

impl Rules<'_> {
    /// Adds values to a sum that is empty before the first.
    fn add<T: Copy + Into<f64>>(self, sums: &mut Vec<f64>, values: &[T]) {
        if sums.is_empty() {
            sums.extend(values.iter().map(|value| (*value).into()));
            return;
        }
        for (channel, (sums, values)) in sums.chunks_exact_mut(BATCH).zip(values.chunks_exact(BATCH)).enumerate() {
            let pairs = sums.iter_mut().zip(values.iter().map(|value| (*value).into()));
            if self.index_channels.contains(&channel) {
                // Indices are not averaged: the first sample that met something names it.
                pairs.filter(|(sum, _)| **sum == 0.0).for_each(|(sum, value)| *sum = value);
            } else {
                pairs.for_each(|(sum, value)| *sum += value);
            }
        }
    }
}

/// Where a block lies among the groups.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    /// In a group whose start belongs to another run.
    Leading,
    /// In a group whose end is yet to come.
    Open,
    /// At the end of a group.
    Last,
}

impl Sums {
    /// Adds a block.
    pub(super) fn add_block(&mut self, block: Cow<'_, [f32]>, place: Place, rules: Rules<'_>) {
        if matches!(place, Place::Leading) {
            self.leading.push(block.into_owned());
            return;
        }
        rules.add(&mut self.open, &block);
        if matches!(place, Place::Last) {
            let group = std::mem::take(&mut self.open);
            self.add_group(group, rules);
        }
    }

    /// Adds a whole group.
    pub(super) fn add_group(&mut self, group: Vec<f64>, rules: Rules<'_>) {
        match self.groups.first_mut() {
            Some(all) if rules.from_start => rules.add(all, &group),
            _ => self.groups.push(group),
        }
    }

    /// The sums of all channels; empty before the first block.
    pub(super) fn total(&self, rules: Rules<'_>) -> Cow<'_, [f64]> {
        match (self.leading.as_slice(), self.groups.as_slice()) {
            ([], []) => Cow::Borrowed(&self.open),
            ([], [one]) if self.open.is_empty() => Cow::Borrowed(one),
            (leading, groups) => {
                let mut total = Vec::new();
                leading.iter().for_each(|block| rules.add(&mut total, block));
                groups.iter().chain(Some(&self.open)).for_each(|group| rules.add(&mut total, group));
                Cow::Owned(total)
            }
        }
    }
}
