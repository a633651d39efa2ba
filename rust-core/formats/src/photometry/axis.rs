//! Tables of intensities as a file has them, and how their angles come into order.

use super::grid::SAME;
use super::text::number;
use crate::error::{FormatError, Result};

/// A list of angles with the line that each stands in.
#[derive(Clone, Debug, Default)]
pub(crate) struct Axis {
    /// What the angles are called in messages.
    pub(crate) name: &'static str,
    /// Degrees.
    pub(crate) angles: Vec<f64>,
    /// Line numbers, one an angle.
    pub(crate) lines: Vec<u64>,
}

/// Angles and intensities that nobody has vouched for.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) horizontal: Axis,
    pub(crate) vertical: Axis,
    /// `intensities[h * vertical.angles.len() + v]`; the reader has made sure of their number.
    pub(crate) intensities: Vec<f64>,
}

impl Axis {
    pub(crate) fn line(&self, index: usize) -> u64 {
        self.lines.get(index).copied().unwrap_or(1)
    }

    pub(crate) fn first(&self) -> f64 {
        self.angles.first().copied().unwrap_or(0.0)
    }

    pub(crate) fn last(&self) -> f64 {
        self.angles.last().copied().unwrap_or(0.0)
    }

    /// Puts the first and the last angle where they are meant to be: files round.
    pub(crate) fn snap(&mut self, to: &[f64]) {
        let near = |angle: f64| to.iter().find(|exact| (angle - **exact).abs() < 0.01).copied().unwrap_or(angle);
        let end = self.angles.len().saturating_sub(1);
        for (index, neighbour) in [(0, 1), (end, end.saturating_sub(1))] {
            let inner = self.angles.get(neighbour).copied();
            if let Some(angle) = self.angles.get_mut(index) {
                // An angle of its own must not fall on the end.
                if inner.is_none_or(|inner| neighbour == index || (inner - near(*angle)) * (inner - *angle) > 0.0) {
                    *angle = near(*angle);
                }
            }
        }
    }

    /// All angles are within a range.
    pub(crate) fn within(&self, [low, high]: [f64; 2]) -> Result<()> {
        match self.angles.iter().position(|angle| !(low..=high).contains(angle)) {
            None => Ok(()),
            Some(index) => {
                let angle = number(self.angles[index]);
                let problem = format!("{} {angle} was found, expected {low} to {high} degrees", self.name);
                Err(FormatError::line(self.line(index), problem))
            }
        }
    }

    fn pick(&mut self, indices: &[usize]) {
        self.angles = indices.iter().map(|index| self.angles[*index]).collect();
        self.lines = indices.iter().map(|index| self.line(*index)).collect();
    }

    /// Indices in increasing order of the angles: a list that falls throughout is turned round, an angle that comes again with the same
    /// intensities is left out.
    fn order(&self, same: impl Fn(usize, usize) -> bool, warnings: &mut Vec<FormatError>) -> Result<Vec<usize>> {
        let falling = self.first() > self.last() && self.angles.is_sorted_by(|a, b| a >= b);
        let mut kept: Vec<usize> = Vec::with_capacity(self.angles.len());
        let count = self.angles.len();
        for index in (0..count).map(|index| if falling { count - 1 - index } else { index }) {
            let Some(before) = kept.last().copied() else {
                kept.push(index);
                continue;
            };
            let (angle, previous) = (self.angles[index], self.angles[before]);
            if angle > previous + SAME {
                kept.push(index);
            } else if angle < previous - SAME {
                let problem = format!("{} {} follows {}, expected increasing angles", self.name, number(angle), number(previous));
                return Err(FormatError::line(self.line(index), problem));
            } else if !same(index, before) {
                let problem = format!("{} {} comes again with other intensities", self.name, number(angle));
                return Err(FormatError::line(self.line(index), problem));
            }
        }
        if falling {
            warnings.push(FormatError::line(
                self.line(0),
                format!("{}s fall from {} to {}: turned round", self.name, number(self.first()), number(self.last())),
            ));
        }
        if kept.len() < count {
            let problem = format!("{} of {} {}s come again with the same intensities: left out", count - kept.len(), count, self.name);
            warnings.push(FormatError::line(self.line(0), problem));
        }
        Ok(kept)
    }
}

impl Table {
    /// Brings both axes into increasing order.
    pub(crate) fn order(&mut self, warnings: &mut Vec<FormatError>) -> Result<()> {
        let count = self.vertical.angles.len();
        let tolerance = 1e-6 * self.intensities.iter().copied().fold(0.0, f64::max);
        let close = |a: f64, b: f64| (a - b).abs() <= tolerance;
        let values = &self.intensities;
        let row = |h: usize| values.get(h * count..(h + 1) * count).unwrap_or(&[]);
        let columns = |a: usize, b: usize| values.chunks(count.max(1)).all(|row| close(row[a], row[b]));
        let rows = |a: usize, b: usize| row(a).iter().zip(row(b)).all(|(a, b)| close(*a, *b));
        let horizontal = self.horizontal.order(rows, warnings)?;
        let vertical = self.vertical.order(columns, warnings)?;
        self.pick(&horizontal, &vertical);
        Ok(())
    }

    /// Keeps planes and columns, in the order named.
    fn pick(&mut self, horizontal: &[usize], vertical: &[usize]) {
        let count = self.vertical.angles.len();
        let at = |h: &usize, v: &usize| self.intensities[h * count + v];
        self.intensities = horizontal.iter().flat_map(|h| vertical.iter().map(move |v| at(h, v))).collect();
        self.horizontal.pick(horizontal);
        self.vertical.pick(vertical);
    }

    /// Whether the first and the last plane differ by more than 1 % of the greatest intensity.
    pub(crate) fn has_seam(&self) -> bool {
        let count = self.vertical.angles.len();
        let limit = 0.01 * self.intensities.iter().copied().fold(0.0, f64::max);
        let last = self.intensities.len().saturating_sub(count);
        self.intensities.iter().zip(&self.intensities[last..]).any(|(first, last)| (first - last).abs() > limit)
    }

    /// Gives the planes new angles and sorts them by these.
    pub(crate) fn map_planes(&mut self, angle: impl Fn(f64) -> f64) {
        self.horizontal.angles.iter_mut().for_each(|c| *c = angle(*c));
        let angles = &self.horizontal.angles;
        let mut order: Vec<usize> = (0..angles.len()).collect();
        order.sort_by(|a, b| angles[*a].total_cmp(&angles[*b]));
        let columns: Vec<usize> = (0..self.vertical.angles.len()).collect();
        self.pick(&order, &columns);
    }

    /// Drops the last plane.
    pub(crate) fn drop_last_plane(&mut self) {
        self.horizontal.angles.pop();
        self.horizontal.lines.pop();
        self.intensities.truncate(self.horizontal.angles.len() * self.vertical.angles.len());
    }
}
