//! What `gonio measure` prints: meters, sensor grids of models, and grids.

use super::{
    area::{Area, Figure, with_notes},
    colour::{beside, is_of_colour, of_points},
    eyes,
    object::{Found, error, number, objects, text},
};
use crate::{estimate::Estimate, note::Note, plan::Plan, unit::Unit};
use gonio_formats::FormatError;
use serde_json::{Map, Value};

/// The error of a point over its value from which on it is told what noise does to least and greatest points.
const NOISY: f64 = 0.05;

pub(super) fn read(whole: &Map<String, Value>, file: usize) -> Found<Vec<Area>> {
    let meters = objects(whole, "meters")?.into_iter().map(|of| meter(of, file));
    let grids = objects(whole, "grids")?.into_iter().map(|of| grid(of, file));
    // Files of before have none.
    let together = if whole.contains_key("sensor_grids") { objects(whole, "sensor_grids")? } else { Vec::new() };
    let areas: Found<Vec<Area>> = meters.chain(together.into_iter().map(|of| grid(of, file))).chain(grids).collect();
    Ok(with_notes(areas?, whole))
}

/// A figure's name as requirements write it: `daylight_factor`.
fn underlined(name: &str) -> String {
    name.replace('-', "_")
}

fn meter(of: &Map<String, Value>, file: usize) -> Found<Area> {
    let mut area = Area::new(text(of, "name", "a meter")?, file);
    let quantity = underlined(text(of, "quantity", "a meter")?);
    let value = reading(of)?;
    let mut figure = Figure::new(&quantity, value, unit(of, &quantity));
    figure.of = Some(quantity.clone());
    figure.aliases = vec!["mean".to_owned(), "value".to_owned()];
    let coverage = of.get("ugr_coverage");
    figure.notes = without_error(value).into_iter().chain(left_out(coverage)).chain(covered(coverage.into_iter())).collect();
    area.figures.push(figure);
    area.figures.extend(beside(&quantity, of)?);
    if let Some(as_in_tables) = of.get("ugr_as_in_tables").and_then(Value::as_object) {
        area.figures.push(Figure::new("ugr_as_in_tables", reading(as_in_tables)?, Unit::plain()));
    }
    Ok(area)
}

fn grid(of: &Map<String, Value>, file: usize) -> Found<Area> {
    let name = text(of, "name", "a grid")?;
    let quantity = underlined(text(of, "quantity", &format!("the grid '{name}'"))?);
    let mut area = Area::new(name, file);
    let part = |key: &str| {
        let wrong = || FormatError::whole(format!("the grid '{name}' has no '{key}' with 'value' and 'standard_error'"));
        of.get(key).and_then(Value::as_object).ok_or_else(wrong).and_then(reading)
    };
    let (mean, least, greatest) = (part("average")?, part("min")?, part("max")?);
    area.plans = plan(of, &quantity).into_iter().collect();
    let own = unit(of, &quantity);
    let ratio = |of: Option<Estimate>, to: Option<Estimate>| of.zip(to).and_then(|(of, to)| of.over(to));
    let add = |key: &str, aliases: &[&str], value: Option<Estimate>, unit: &Unit, notes: Vec<Note>| {
        let aliases = aliases.iter().map(|alias| (*alias).to_owned()).collect();
        let plan = (!area.plans.is_empty()).then_some(0);
        let notes = notes.into_iter().chain(without_error(value)).collect();
        let of = Some(quantity.clone());
        Figure { aliases, of, notes, plan, ..Figure::new(key, value, unit.clone()) }
    };
    let glare = quantity == "ugr";
    let amount = !glare && !is_of_colour(&quantity);
    let low = || least.filter(|_| !is_of_colour(&quantity)).map(Estimate::relative).filter(|share| *share > NOISY).map(Note::LeastIsLow);
    let high =
        || greatest.filter(|_| !is_of_colour(&quantity)).map(Estimate::relative).filter(|share| *share > NOISY).map(Note::GreatestIsHigh);
    let missing = || of.get("values").and_then(Value::as_array).map(|values| values.iter().filter(|value| value.is_null()).count());
    let missing = missing().filter(|count| *count > 0).map(Note::Missing);
    let behind = covered(of.get("ugr_coverage").and_then(Value::as_array).into_iter().flatten());
    let (of_mean, of_greatest) =
        if glare { (vec![], vec!["max", "greatest", "ugr"]) } else { (vec![quantity.as_str()], vec!["max", "greatest"]) };
    let of_mean: Vec<&str> = of_mean.into_iter().chain(["average", "em"]).collect();
    let mut figures = vec![
        add("mean", &of_mean, mean, &own, missing.clone().into_iter().collect()),
        add("minimum", &["min", "least"], least, &own, low().into_iter().chain(missing.clone()).collect()),
        add(
            "maximum",
            &of_greatest,
            greatest,
            &own,
            high().into_iter().chain(worst_left_out(of)).chain(behind).chain(missing.clone()).collect(),
        ),
    ];
    if amount {
        figures.push(add(
            "uniformity",
            &["u0", "uo", "uniformity_u0"],
            ratio(least, mean),
            &Unit::share(),
            low().into_iter().chain(missing.clone()).collect(),
        ));
        let both = low().into_iter().chain(high()).chain(missing).collect();
        figures.push(add("diversity", &["ud", "diversity_ud"], ratio(least, greatest), &Unit::share(), both));
    }
    figures.extend(eyes::figures(of, &quantity, &own)?);
    figures.extend(of_points(&quantity, of)?);
    area.figures = figures;
    Ok(area)
}

fn unit(of: &Map<String, Value>, quantity: &str) -> Unit {
    match of.get("unit").and_then(Value::as_str).unwrap_or_default() {
        "" => Unit::plain(),
        sign if quantity == "ugr" || is_of_colour(quantity) => Unit::of(sign),
        sign => Unit::light(sign),
    }
}

fn reading(of: &Map<String, Value>) -> Found<Option<Estimate>> {
    let error = error(of, "standard_error")?;
    Ok(number(of, "value").map(|value| Estimate::new(value, error)))
}

/// What is told of a figure whose error the file does not state.
fn without_error(value: Option<Estimate>) -> Option<Note> {
    value.filter(|value| value.error.is_none()).map(|_| Note::NoError)
}

/// What a rating of glare leaves out.
fn left_out(coverage: Option<&Value>) -> Option<Note> {
    let coverage = coverage?.as_object()?;
    let count = coverage.get("left_out")?.as_u64().filter(|count| *count > 0)?;
    Some(Note::LeftOut { count, share: number(coverage, "share_left_out")? })
}

/// At how many points luminaires are seen through glass or covers alone.
fn covered<'a>(coverage: impl Iterator<Item = &'a Value>) -> Option<Note> {
    let is_covered = |coverage: &&Value| coverage.get("behind_covers").and_then(Value::as_u64).is_some_and(|count| count > 0);
    Some(coverage.filter(is_covered).count()).filter(|count| *count > 0).map(Note::Covered)
}

/// That of the point which leaves out most.
fn worst_left_out(of: &Map<String, Value>) -> Option<Note> {
    let notes = of.get("ugr_coverage")?.as_array()?.iter().filter_map(|coverage| left_out(Some(coverage)));
    let share = |note: &Note| if let Note::LeftOut { share, .. } = note { *share } else { 0.0 };
    notes.max_by(|a, b| share(a).total_cmp(&share(b)))
}

fn plan(of: &Map<String, Value>, quantity: &str) -> Option<Plan> {
    let count = |key: &str| of.get(key)?.as_u64()?.try_into().ok();
    let spacing: Vec<f64> = of.get("spacing_m")?.as_array()?.iter().filter_map(Value::as_f64).collect();
    let values = of.get("values")?.as_array()?.iter().map(Value::as_f64).collect();
    let unit = of.get("unit").and_then(Value::as_str).unwrap_or_default();
    Plan::new([count("columns")?, count("rows")?], spacing.try_into().ok()?, values, quantity, unit)
}
