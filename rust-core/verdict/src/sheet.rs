//! The sheet: a line for each requirement.

use crate::{
    bound::Verdict,
    error::VerdictError,
    judge::judged,
    measured::{Area, Measured, Source},
    note::Note,
    plan::Plan,
    requirement::{Requirement, Requirements},
};
use std::path::PathBuf;

/// What a requirement's figure comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Reached {
    /// The whole name of the area.
    pub area: String,
    /// The file that it stands in.
    pub file: PathBuf,
    /// The figure, maintained where the requirement says so.
    pub value: f64,
    /// Its standard error, where it has one.
    pub standard_error: Option<f64>,
    /// Two standard errors to each side.
    pub interval: [f64; 2],
    /// By how much the limit is kept, negative where it is missed.
    pub margin: f64,
    /// How many times as many samples would settle what is within the error, about; infinite on the limit.
    pub more_samples: Option<f64>,
}

/// A line of the sheet.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// What is required.
    pub requirement: Requirement,
    /// The unit of limit and figure; empty where they have none.
    pub unit: String,
    /// What there is, unless it was not measured.
    pub reached: Option<Reached>,
    /// What becomes of it.
    pub verdict: Verdict,
    pub(crate) notes: Vec<Note>,
    /// The numbers of its area and of that area's plan.
    pub(crate) plan: Option<(usize, usize)>,
}

/// Requirements beside what was measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// The lines, in the requirements' order.
    pub rows: Vec<Row>,
    pub(crate) requirements: Requirements,
    /// All files that were read, the requirements first.
    pub(crate) sources: Vec<Source>,
    pub(crate) areas: Vec<Area>,
}

impl Sheet {
    /// Judges requirements, whose file had these bytes.
    ///
    /// # Errors
    /// A requirement that several figures answer to, whose unit is another, or that asks for what there cannot be, with its line.
    pub fn new(requirements: Requirements, bytes: &[u8], measured: Measured) -> Result<Self, VerdictError> {
        let rows = requirements.list.iter().map(|wanted| judged(wanted, &requirements.path, &measured)).collect::<Result<_, _>>()?;
        let own = Source::new(&requirements.path, bytes);
        let Measured { sources, areas } = measured;
        Ok(Self { rows, requirements, sources: std::iter::once(own).chain(sources).collect(), areas })
    }

    /// How many lines have a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.rows.iter().filter(|row| row.verdict == verdict).count()
    }

    /// The verdict on all lines: not met where one is not met or not measured, else within the error where one is.
    pub fn verdict(&self) -> Verdict {
        let has = |verdict| self.count(verdict) > 0;
        if has(Verdict::NotMet) || has(Verdict::NotMeasured) {
            Verdict::NotMet
        } else if has(Verdict::WithinError) {
            Verdict::WithinError
        } else {
            Verdict::Met
        }
    }

    /// The sheet's title: the requirements', else their file's name without its ending.
    pub fn title(&self) -> String {
        let stem = || self.requirements.path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.requirements.title.clone().unwrap_or_else(stem)
    }

    /// The plans that lines have, each once, with the lines' numbers.
    pub(crate) fn plans(&self) -> Vec<(&Area, &Plan, Vec<usize>)> {
        let mut found: Vec<((usize, usize), Vec<usize>)> = Vec::new();
        for (number, row) in self.rows.iter().enumerate() {
            let Some(place) = row.plan else { continue };
            match found.iter_mut().find(|(known, _)| *known == place) {
                Some((_, numbers)) => numbers.push(number),
                None => found.push((place, vec![number])),
            }
        }
        let shown = |((area, plan), numbers): ((usize, usize), Vec<usize>)| {
            let area = self.areas.get(area)?;
            Some((area, area.plans.get(plan)?, numbers))
        };
        found.into_iter().filter_map(shown).collect()
    }
}
