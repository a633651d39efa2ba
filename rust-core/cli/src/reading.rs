//! Readings as the command line tells them, and places as it is told them.

use super::daylight;
use gonio::{Error, Result, measure::Reading, scene::Measurand};
use serde_json::{Value, json};

/// Three numbers, such as a place or a direction.
pub(super) fn triple(name: &str, text: &str) -> Result<[f64; 3]> {
    let numbers = text.split(',').map(|part| daylight::number(name, part)).collect::<Result<Vec<f64>>>()?;
    let wrong = |_| Error::setting(name, format!("'{text}' was found, expected three numbers separated by commas"));
    numbers.try_into().map_err(wrong)
}

/// Places of a value and of its error: those that matter of figures of colour, else these.
pub(super) fn places(measurand: Measurand, others: [usize; 2]) -> [usize; 2] {
    match measurand {
        Measurand::Cct => [1; 2],
        Measurand::Duv => [5; 2],
        Measurand::Ra | Measurand::Rf | Measurand::Rg => [2; 2],
        _ => others,
    }
}

/// A value of so many places with its standard error; in words where there is none.
pub(super) fn figure(Reading { value, standard_error }: &Reading, [places, of_error]: [usize; 2], unit: &str) -> String {
    if value.is_nan() { "not measured".into() } else { format!("{value:.places$}{unit} ± {standard_error:.of_error$}") }
}

/// The unit's sign with a blank before it; nothing where there is none.
pub(super) fn spaced(measurand: Measurand) -> String {
    let unit = measurand.unit();
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

/// A value with its error, for machines.
pub(super) fn reading_json(reading: &Reading) -> Value {
    json!({ "value": reading.value, "standard_error": reading.standard_error })
}
