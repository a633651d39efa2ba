//! What is asked of an area, and how it is written.

use crate::error::DimmingError;
use gonio_spectrum::{HIGHEST_CCT, LOWEST_CCT};

/// A limit of an area's figures, in the unit of what is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The mean is so much at least.
    MeanAtLeast(f64),
    /// The mean is so much at most.
    MeanAtMost(f64),
    /// The mean is so much, give or take the second number.
    Mean(f64, f64),
    /// Every point gets so much at least.
    LeastAtLeast(f64),
    /// No point gets more.
    GreatestAtMost(f64),
    /// The least point is this share of the mean at least.
    UniformityAtLeast(f64),
    /// The light of all points together has this correlated colour temperature at least, K.
    CctAtLeast(f64),
    /// At most.
    CctAtMost(f64),
    /// This one, give or take the second number.
    Cct(f64, f64),
}

impl Limit {
    /// Whether it limits the light's colour.
    pub fn is_of_colour(self) -> bool {
        matches!(self, Self::CctAtLeast(_) | Self::CctAtMost(_) | Self::Cct(..))
    }
}

/// What is asked of an area.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// As it was written.
    pub text: String,
    /// The name of the area, or the last part of its path.
    pub area: String,
    /// What is asked.
    pub limit: Limit,
}

/// What is expected of a target's text.
const EXPECTED: &str =
    "expected NAME.mean>=LX, NAME.mean<=LX, NAME.mean=LX+-TOLERANCE, NAME.min>=LX, NAME.max<=LX, NAME.uo>=SHARE or NAME.cct=K+-TOLERANCE";

impl Target {
    /// Reads `NAME.mean>=500`, `NAME.mean<=800`, `NAME.mean=500+-25`, `NAME.min>=200`, `NAME.max<=1000`, `NAME.uo>=0.6` or `NAME.cct=4000+-100`; of a
    /// name without a figure the mean is meant, which is a meter's reading. `±` does for `+-`.
    ///
    /// # Errors
    /// Other texts, numbers that are none or below 0, and limits that no linear program knows, such as a greatest value that is at least so much.
    pub fn parse(text: &str) -> Result<Self, DimmingError> {
        let wrong = |problem: &str| DimmingError::Target { text: text.to_owned(), problem: problem.to_owned() };
        let split =
            ["<=", ">=", "="].into_iter().find_map(|sign| text.split_once(sign).map(|(left, right)| (left.trim(), sign, right.trim())));
        let (left, sign, right) = split.ok_or_else(|| wrong(EXPECTED))?;
        let (area, figure) = match left.rsplit_once('.') {
            Some((area, figure)) if matches!(figure, "mean" | "min" | "max" | "uo" | "cct") => (area, figure),
            _ => (left, "mean"),
        };
        let (right, tolerance) =
            right.split_once("+-").or_else(|| right.split_once('±')).map_or((right, None), |(value, by)| (value, Some(by)));
        let number = |text: &str| {
            let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite() && *value >= 0.0);
            value.ok_or_else(|| wrong(&format!("'{}' in it is no number of zero or more; {EXPECTED}", text.trim())))
        };
        let value = number(right)?;
        let limit = match (figure, sign, tolerance) {
            _ if area.is_empty() => return Err(wrong(EXPECTED)),
            ("cct", ..) if !(LOWEST_CCT..=HIGHEST_CCT).contains(&value) => {
                return Err(wrong(&format!("expected a temperature from {LOWEST_CCT} to {HIGHEST_CCT} K")));
            }
            ("cct", "=", Some(by)) => Limit::Cct(value, number(by)?),
            ("cct", "=", None) => return Err(wrong("a tolerance is missing, as in NAME.cct=4000+-100")),
            ("cct", ">=", None) => Limit::CctAtLeast(value),
            ("cct", "<=", None) => Limit::CctAtMost(value),
            ("mean", "=", Some(by)) => Limit::Mean(value, number(by)?),
            ("mean", "=", None) => return Err(wrong("a tolerance is missing, as in NAME.mean=500+-25")),
            ("mean", ">=", None) => Limit::MeanAtLeast(value),
            ("mean", "<=", None) => Limit::MeanAtMost(value),
            ("min", ">=", None) => Limit::LeastAtLeast(value),
            ("max", "<=", None) => Limit::GreatestAtMost(value),
            ("uo", ">=", None) if value <= 1.0 => Limit::UniformityAtLeast(value),
            ("uo", ">=", None) => return Err(wrong("no least value is above the mean; expected a share from 0 to 1")),
            _ => return Err(wrong(EXPECTED)),
        };
        Ok(Self { text: text.to_owned(), area: area.to_owned(), limit })
    }

    /// What the target names among several; exactly one must be meant.
    ///
    /// # Errors
    /// None of them has the name, or more than one.
    pub fn find<'a, T>(&self, all: &'a [T], name: impl Fn(&T) -> &str) -> Result<&'a T, DimmingError> {
        let found: Vec<&T> = all.iter().filter(|one| self.names(name(one))).collect();
        match found[..] {
            [one] => Ok(one),
            [] => {
                let names: Vec<&str> = all.iter().map(&name).collect();
                let problem = format!("nothing measured is called '{}', expected one of {}", self.area, names.join("; "));
                Err(DimmingError::Target { text: self.text.clone(), problem })
            }
            _ => {
                let problem = format!("'{}' names several that are measured; write the whole path", self.area);
                Err(DimmingError::Target { text: self.text.clone(), problem })
            }
        }
    }

    /// Whether an area's name is meant: the whole of it, or the last part of a path.
    pub fn names(&self, name: &str) -> bool {
        name == self.area || name.rsplit_once('/').is_some_and(|(_, last)| last == self.area)
    }
}
