//! Groups of windows and their blinds.

use crate::{Coefficients, Schedule};

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
