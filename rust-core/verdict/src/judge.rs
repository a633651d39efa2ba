//! From a requirement to its verdict.

use crate::{
    bound::{DOUBT, Verdict, more_samples},
    error::{Result, VerdictError},
    estimate::Estimate,
    measured::{Area, Figure, Measured},
    names::{listed, nearest, shown, spelt},
    note::Note,
    requirement::Requirement,
    sheet::{Reached, Row},
};
use gonio_formats::FormatError;
use std::path::Path;

/// A requirement under way, for messages with its line.
struct Wanted<'a> {
    requirement: &'a Requirement,
    path: &'a Path,
    quantity: String,
    of: Option<String>,
}

/// The line of a requirement.
pub(crate) fn judged(requirement: &Requirement, path: &Path, measured: &Measured) -> Result<Row> {
    let wanted = Wanted { requirement, path, quantity: spelt(&requirement.quantity), of: requirement.of.as_deref().map(spelt) };
    let file = requirement.file.as_deref().map(|file| measured.file(file).map_err(|problem| wanted.problem(problem))).transpose()?;
    let areas: Vec<(usize, &Area, u8)> =
        measured.meant(&requirement.area).into_iter().filter(|(_, area, _)| file.is_none_or(|file| area.file == file)).collect();
    if areas.is_empty() {
        return Ok(wanted.without(wanted.no_area(measured, file)));
    }
    let found = wanted.figures(&areas);
    match found[..] {
        [] => Ok(wanted.without(wanted.no_quantity(&areas))),
        [(number, area, figure)] => wanted.row(number, area, figure, measured),
        _ => Err(wanted.problem(wanted.several(&found, measured))),
    }
}

impl Wanted<'_> {
    fn problem(&self, problem: String) -> VerdictError {
        VerdictError::new(self.path, FormatError::line(self.requirement.line, problem))
    }

    /// Where the requirement stands.
    fn place(&self) -> String {
        format!("{}:{}", self.path.display(), self.requirement.line)
    }

    /// The line of what was not measured.
    fn without(&self, note: Note) -> Row {
        let requirement = self.requirement.clone();
        let unit = requirement.unit.clone().unwrap_or_default();
        Row { requirement, unit, reached: None, verdict: Verdict::NotMeasured, notes: vec![note], plan: None }
    }

    /// The figures that are meant, of the areas that fit best among those that have them.
    fn figures<'a>(&self, areas: &[(usize, &'a Area, u8)]) -> Vec<(usize, &'a Area, &'a Figure)> {
        let is_meant = |figure: &&Figure| figure.is(&self.quantity, self.of.as_deref());
        let of_area = |(number, area, fit): &(usize, &'a Area, u8)| {
            let (number, area, fit) = (*number, *area, *fit);
            area.figures.iter().filter(is_meant).map(move |figure| (fit, (number, area, figure))).collect::<Vec<_>>()
        };
        let found: Vec<_> = areas.iter().flat_map(of_area).collect();
        let best = found.iter().map(|(fit, _)| *fit).min();
        found.into_iter().filter(|(fit, _)| Some(*fit) == best).map(|(_, found)| found).collect()
    }

    fn no_area(&self, measured: &Measured, file: Option<usize>) -> Note {
        let written = &self.requirement.area;
        let names = || measured.areas.iter().filter(|area| file.is_none_or(|file| area.file == file)).map(|area| area.name.as_str());
        let nearest = nearest(written, names()).map(shown);
        Note::NoArea { place: self.place(), written: shown(written), nearest, known: listed(names()) }
    }

    fn no_quantity(&self, areas: &[(usize, &Area, u8)]) -> Note {
        let figures = || areas.iter().flat_map(|(_, area, _)| &area.figures);
        let keys: Vec<String> = figures().map(full_name).collect();
        let names = figures().flat_map(|figure| std::iter::once(&figure.key).chain(&figure.aliases)).map(String::as_str);
        let written = match &self.requirement.of {
            Some(of) => format!("{}, {of}", self.requirement.quantity),
            None => self.requirement.quantity.clone(),
        };
        let nearest = nearest(&self.quantity, names).filter(|name| *name != self.quantity).map(shown);
        Note::NoQuantity { place: self.place(), written: shown(&written), nearest, known: listed(keys.iter().map(String::as_str)) }
    }

    /// What is told where several figures are meant.
    fn several(&self, found: &[(usize, &Area, &Figure)], measured: &Measured) -> String {
        let told = |(_, area, figure): &(usize, &Area, &Figure)| {
            let file = measured.sources.get(area.file).map_or(String::new(), |source| source.path.display().to_string());
            format!("{} of {} ({file})", full_name(figure), area.name)
        };
        let told: Vec<String> = found.iter().map(told).collect();
        let quantity = shown(&self.requirement.quantity);
        format!(
            "quantity '{quantity}' may be any of {}; write more of the area's path, or of = \"…\" or file = \"…\" beside it",
            listed(told.iter().map(String::as_str))
        )
    }

    fn row(&self, number: usize, area: &Area, figure: &Figure, measured: &Measured) -> Result<Row> {
        let requirement = self.requirement;
        let (factor, unit) = self.in_unit(figure)?;
        let mut notes = figure.notes.clone();
        let Some(value) = figure.value.map(|value| value.times(factor)) else {
            notes.insert(0, Note::NoNumber);
            return Ok(Row { unit, notes, plan: None, ..self.without(Note::NoNumber) });
        };
        let maintained = self.maintained(figure, value, &unit, &mut notes)?;
        let error = maintained.error.unwrap_or(0.0);
        let margin = requirement.bound.margin(maintained.value, requirement.limit);
        let verdict = Verdict::new(margin, error, requirement.limit);
        let interval = [-DOUBT, DOUBT].map(|errors| maintained.value + errors * error);
        let times = (verdict == Verdict::WithinError).then(|| more_samples(maintained, margin));
        notes.extend(times.map(|times| Note::MoreSamples { times, interval, error, unit: unit.clone() }));
        let reached = Reached {
            area: area.name.clone(),
            file: measured.sources.get(area.file).map(|source| source.path.clone()).unwrap_or_default(),
            value: maintained.value,
            standard_error: maintained.error,
            interval,
            margin,
            more_samples: times,
        };
        let plan = figure.plan.map(|plan| (number, plan));
        Ok(Row { requirement: requirement.clone(), unit, reached: Some(reached), verdict, notes, plan })
    }

    /// The factor from the figure's unit to that of the limit, and the limit's.
    fn in_unit(&self, figure: &Figure) -> Result<(f64, String)> {
        let Requirement { unit, limit, bound, .. } = self.requirement;
        let name = full_name(figure);
        let Some(written) = unit else {
            if figure.unit.share && *limit > 1.0 {
                let problem = format!("{} is {limit}, and {name} is a share from 0 to 1; write unit = \"%\" beside per cent", bound.key());
                return Err(self.problem(problem));
            }
            return Ok((1.0, figure.unit.sign.clone()));
        };
        let factor = figure.unit.factor_to(written);
        let factor = factor.ok_or_else(|| self.problem(format!("unit is '{written}', but that of {name} is {}", figure.unit.told())))?;
        if figure.unit.share && *limit > 100.0 {
            return Err(self.problem(format!("{} is {limit} %, and no {name} is above 100 %", bound.key())));
        }
        Ok((factor, written.clone()))
    }

    /// The figure times its maintenance factor, which is told.
    fn maintained(&self, figure: &Figure, value: Estimate, unit: &str, notes: &mut Vec<Note>) -> Result<Estimate> {
        let Some(factor) = self.requirement.maintenance_factor else { return Ok(value) };
        if !figure.unit.light {
            let problem = match notes.contains(&Note::Calculated) {
                true => "maintenance_factor is no matter of a road's figures: its rows have their own",
                false => "maintenance_factor is for lx, cd/m² and daylight factors alone: the other figures are not proportional to light",
            };
            return Err(self.problem(problem.to_owned()));
        }
        notes.insert(0, Note::Maintained { factor, measured: value, unit: unit.to_owned() });
        Ok(value.times(factor))
    }
}

/// A figure's name with what it is of.
fn full_name(figure: &Figure) -> String {
    match &figure.of {
        Some(of) if *of != figure.key => format!("{} of {of}", figure.key),
        _ => figure.key.clone(),
    }
}
