//! What is to be dimmed, and where the light is measured.

use crate::{
    colour::{Colour, Light},
    error::DimmingError,
    estimate::Estimate,
    target::Target,
};

/// Lights that are dimmed together.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// Its name.
    pub name: String,
    /// What counts as its power at level 1, W; other weights do as well.
    pub watts: f64,
    /// The least and the greatest level, within 0 and 1; equal ones fix it.
    pub range: [f64; 2],
}

/// A point that is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What it gets of light that is not dimmed.
    pub fixed: Estimate,
    /// What it gets of each group at level 1.
    pub of_groups: Vec<Estimate>,
}

impl Point {
    /// What it gets at these levels, errors of different groups being independent.
    pub fn at(&self, levels: &[f64]) -> Estimate {
        self.of_groups.iter().zip(levels).fold(self.fixed, |sum, (group, level)| sum.plus(group.times(*level)))
    }
}

/// A meter, of one point, or a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// Its name.
    pub name: String,
    /// Its points; one at least.
    pub points: Vec<Point>,
    /// The colours of their light, where targets want them; else empty.
    pub colours: Vec<Colour>,
}

impl Area {
    /// A point that gets the mean of all.
    pub(crate) fn mean(&self) -> Point {
        let groups = self.points.first().map_or(0, |point| point.of_groups.len());
        let of_group = |k: usize| Estimate::mean(self.points.iter().filter_map(move |point| point.of_groups.get(k).copied()));
        Point { fixed: Estimate::mean(self.points.iter().map(|point| point.fixed)), of_groups: (0..groups).map(of_group).collect() }
    }
}

/// What is sought among the levels that meet the targets.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Goal {
    /// The least power.
    #[default]
    LeastPower,
    /// That no group strays further than it must from its wished level, then the least power; groups without one are free.
    Near(Vec<Option<f64>>),
    /// That levels differ as little as they may, then the least power; groups whose level is fixed do not count.
    Equal,
}

/// A dimming that is sought.
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// What is dimmed.
    pub groups: Vec<Group>,
    /// Where light is measured.
    pub areas: Vec<Area>,
    /// What is asked of the areas.
    pub targets: Vec<Target>,
    /// What is sought beyond.
    pub goal: Goal,
    /// Standard errors to keep from each limit; groups' errors are added up for that, which is on the safe side.
    pub errors_kept: f64,
}

impl Problem {
    /// The area that a target names.
    pub(crate) fn area(&self, target: &Target) -> Result<&Area, DimmingError> {
        target.find(&self.areas, |area| &area.name)
    }

    /// Says what is wrong with the numbers.
    pub(crate) fn check(&self) -> Result<(), DimmingError> {
        let wrong = |problem: String| Err(DimmingError::Problem(problem));
        if self.groups.is_empty() || self.targets.is_empty() {
            return wrong("a dimming wants a light group and a target at least".to_owned());
        }
        for Group { name, watts, range: [least, most] } in &self.groups {
            if !(watts.is_finite() && *watts >= 0.0) {
                return wrong(format!("group '{name}' has {watts} W, expected a number of zero or more"));
            }
            if !(0.0 <= *least && least <= most && *most <= 1.0) {
                return wrong(format!("group '{name}' may have levels from {least} to {most}, expected a range within 0 and 1"));
            }
        }
        for area in &self.areas {
            let fits = |point: &Point| {
                point.of_groups.len() == self.groups.len() && point.of_groups.iter().chain([&point.fixed]).all(Estimate::is_finite)
            };
            let is_coloured = |colour: &Colour| {
                colour.of_groups.len() == self.groups.len() && colour.of_groups.iter().chain([&colour.fixed]).all(Light::is_finite)
            };
            if !area.colours.iter().all(is_coloured) {
                return wrong(format!("{} has no colour for every group", area.name));
            }
            if area.points.is_empty() || !area.points.iter().all(fits) {
                return wrong(format!("{} has no figure for every group, or none at all", area.name));
            }
        }
        let wished = if let Goal::Near(levels) = &self.goal { levels.as_slice() } else { &[] };
        if wished.iter().flatten().any(|level| !(0.0..=1.0).contains(level)) {
            return wrong("a wished level is out of range, expected 0 to 1".to_owned());
        }
        if !(self.errors_kept.is_finite() && self.errors_kept >= 0.0) {
            return wrong(format!("{} standard errors cannot be kept, expected a number of zero or more", self.errors_kept));
        }
        self.targets.iter().try_for_each(|target| match self.area(target)? {
            area if target.limit.is_of_colour() && area.colours.is_empty() => {
                wrong(format!("the colour of {} was not measured", area.name))
            }
            _ => Ok(()),
        })
    }
}
