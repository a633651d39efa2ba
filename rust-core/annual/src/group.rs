//! Groups of windows and their blinds.

use crate::{Coefficients, Schedule, error::Result, year::Year};

/// What blinds leave of a group's light when they are closed.
#[derive(Clone, Debug)]
pub enum Blinds {
    /// This share of the light through open ones; 0.02 is usual.
    Share(f32),
    /// Coefficients of their own, of all light: the sun is in the patches.
    Coefficients(Coefficients),
    /// The same with the sun at its place, as where [`Group::scattered`] is given.
    Traced {
        /// Of all light: points × patches.
        all: Coefficients,
        /// Of light that was scattered on its way: points × patches.
        scattered: Coefficients,
        /// Of direct light: points × suns.
        suns: Coefficients,
    },
}

/// Windows whose blinds are operated together.
#[derive(Clone, Debug)]
pub struct Group {
    /// Of all light, blinds open: points × patches.
    pub open: Coefficients,
    /// Of direct light alone: points × patches, or points × suns, a column for each step with the sun above the horizon.
    pub direct: Option<Coefficients>,
    /// Of the sun's light with all its bounces: points × suns. Where it is given, the sun leaves the patches.
    pub sun: Option<Coefficients>,
    /// Of light that was scattered on its way: points × patches. Where it is given, the sun itself stands at its place, by `direct` of suns, and what it
    /// lights otherwise is in the patches.
    pub scattered: Option<Coefficients>,
    /// The blinds; `None` where there are none.
    pub blinds: Option<Blinds>,
    /// When they are closed, as if that were when a room is used; `None` leaves it to direct sun.
    pub closed: Option<Schedule>,
}

impl Group {
    /// The same by the means of all independent estimates.
    pub(crate) fn mean(&self) -> Self {
        let mean = |of: &Coefficients| Coefficients { blocks: vec![of.mean(None)], ..of.clone() };
        let of = |of: &Option<Coefficients>| of.as_ref().map(mean);
        let blinds = |blinds: &Blinds| match blinds {
            Blinds::Share(share) => Blinds::Share(*share),
            Blinds::Coefficients(all) => Blinds::Coefficients(mean(all)),
            Blinds::Traced { all, scattered, suns } => Blinds::Traced { all: mean(all), scattered: mean(scattered), suns: mean(suns) },
        };
        Self {
            open: mean(&self.open),
            direct: of(&self.direct),
            sun: of(&self.sun),
            scattered: of(&self.scattered),
            blinds: self.blinds.as_ref().map(blinds),
            closed: self.closed.clone(),
        }
    }

    /// Closed in these steps, whatever direct sun does.
    pub(crate) fn closed_in(mut self, year: &Year, steps: &[bool]) -> Result<Self> {
        if self.blinds.is_some() && steps.contains(&true) {
            self.closed = Some(Schedule::new(year, steps.to_vec())?);
        } else {
            (self.blinds, self.closed) = (None, None);
        }
        Ok(self)
    }
}
