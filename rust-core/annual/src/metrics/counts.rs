//! What is counted of a year at each point, chunk by chunk.

use super::en17037::{Half, LEVELS};
use crate::{
    chunk::Chunk,
    electric::{ElectricLight, Loads},
    schedule::Schedule,
};

/// Direct sun that counts, lx.
const BRIGHT: f32 = 1000.0;

/// Steps of a point.
#[derive(Clone, Debug, Default)]
pub(crate) struct Count {
    /// Of the used steps, lx.
    pub(super) sum: f64,
    /// Steps with 300 lx.
    pub(super) enough: u32,
    /// The same with partial credit below.
    pub(super) credit: f64,
    /// 100 to 300 lx.
    pub(super) supplementary: u32,
    /// 300 to 3000 lx.
    pub(super) autonomous: u32,
    /// Above 3000 lx.
    pub(super) exceeded: u32,
    /// Direct sun of 1000 lx.
    pub(super) direct: u32,
    /// Steps of the bright half of the year with at least the illuminances of EN 17037.
    pub(super) bright_half: [u32; LEVELS.len()],
}

/// Counts of all points.
#[derive(Clone, Debug)]
pub(crate) struct Counts {
    pub(super) points: Vec<Count>,
    /// Of electric light beside it, where that is asked for.
    pub(super) loads: Option<Loads>,
}

impl Counts {
    pub(crate) fn new(points: usize, electric: Option<ElectricLight>) -> Self {
        Self { points: vec![Count::default(); points], loads: electric.map(Loads::new) }
    }

    /// Counts a chunk.
    pub(crate) fn add(&mut self, chunk: &Chunk<'_>, schedule: &Schedule, half: &Half) {
        self.loads.iter_mut().for_each(|loads| loads.add(chunk, schedule));
        let steps = chunk.steps.len();
        let used: Vec<bool> = chunk.steps.iter().map(|step| schedule.is_used(*step)).collect();
        let is_bright: Vec<bool> = chunk.steps.iter().map(|step| half.has(*step)).collect();
        for (point, count) in self.points.iter_mut().enumerate() {
            let row = &chunk.total[point * steps..][..steps];
            row.iter().zip(&used).filter(|(_, used)| **used).for_each(|(value, _)| count.total(*value));
            for (value, _) in row.iter().zip(&is_bright).filter(|(_, is_bright)| **is_bright) {
                count.bright_half.iter_mut().zip(LEVELS).for_each(|(count, level)| *count += u32::from(f64::from(*value) >= level));
            }
            if let Some(direct) = chunk.direct {
                let row = &direct[point * steps..][..steps];
                count.direct += row.iter().zip(&used).filter(|(value, used)| **used && **value >= BRIGHT).count() as u32;
            }
        }
    }
}

impl Count {
    fn total(&mut self, value: f32) {
        self.sum += f64::from(value);
        self.credit += f64::from(value / 300.0).min(1.0);
        self.enough += u32::from(value >= 300.0);
        self.supplementary += u32::from((100.0..300.0).contains(&value));
        self.autonomous += u32::from((300.0..=3000.0).contains(&value));
        self.exceeded += u32::from(value > 3000.0);
    }
}
