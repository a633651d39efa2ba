//! What a user asks of a road: the user's own numbers, none of a norm.

use crate::results::{Classed, Illuminances, Results, Verdict};

/// A value that a result has to reach, or must not exceed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Requirement {
    /// The result's key, one of [`KEYS`].
    pub key: &'static str,
    /// The value, in the result's unit.
    pub value: f64,
}

/// A class of road lighting as the user describes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// What it is called.
    pub name: String,
    /// What it requires of the carriageway.
    pub required: Vec<Requirement>,
}

/// Keys of results that may be required.
pub const KEYS: [&str; 17] = [
    "l_av", "uo", "ul", "uo_wet", "ti", "eir", "e_av", "e_min", "u0", "e_hs_av", "e_hs_min", "u0_hs", "e_sc_min", "e_v_min", "e_max",
    "pdi", "aeci",
];
/// Keys that paths have.
pub(crate) const PATH_KEYS: [&str; 9] = ["e_av", "e_min", "u0", "e_hs_av", "e_hs_min", "u0_hs", "e_sc_min", "e_v_min", "e_max"];
/// Keys whose value must not be exceeded.
const AT_MOST: [&str; 4] = ["ti", "e_max", "pdi", "aeci"];

/// Results by their keys.
pub(crate) trait Wanted {
    /// The result of a key, if there is one.
    fn wanted(&self, key: &str) -> Option<f64>;
}

impl Wanted for Illuminances {
    fn wanted(&self, key: &str) -> Option<f64> {
        match key {
            "e_av" => Some(self.e_av),
            "e_min" => Some(self.e_min),
            "e_max" => Some(self.e_max),
            "u0" => self.u0,
            "e_hs_av" => Some(self.e_hs_av),
            "e_hs_min" => Some(self.e_hs_min),
            "u0_hs" => self.u0_hs,
            "e_sc_min" => Some(self.e_sc_min),
            "e_v_min" => Some(self.e_v_min),
            _ => None,
        }
    }
}

impl Wanted for Results {
    fn wanted(&self, key: &str) -> Option<f64> {
        match key {
            "l_av" => Some(self.l_av),
            "uo" => self.uo,
            "ul" => self.ul,
            "uo_wet" => self.uo_wet,
            "ti" => self.ti,
            "eir" => self.eir,
            "pdi" => self.energy.and_then(|energy| energy.pdi),
            "aeci" => self.energy.map(|energy| energy.aeci),
            _ => self.illuminances.wanted(key),
        }
    }
}

/// Which classes are met.
pub(crate) fn classes(classes: &[Class], wanted: &dyn Fn(&str) -> Option<f64>) -> Vec<Classed> {
    let classed = |class: &Class| {
        let required = verdicts(&class.required, wanted);
        Classed { name: class.name.clone(), met: required.iter().all(|verdict| verdict.met), required }
    };
    classes.iter().map(classed).collect()
}

/// Which requirements are met.
pub(crate) fn verdicts(required: &[Requirement], wanted: &dyn Fn(&str) -> Option<f64>) -> Vec<Verdict> {
    let verdict = |Requirement { key, value }: &Requirement| {
        let (found, at_most) = (wanted(key), AT_MOST.contains(key));
        let met = found.is_some_and(|found| if at_most { found <= *value } else { found >= *value });
        Verdict { key, required: *value, at_most, found, met }
    };
    required.iter().map(verdict).collect()
}
