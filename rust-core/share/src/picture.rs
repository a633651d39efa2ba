//! What a page is made of.

use gonio_page::Language;

/// What keeps a page from being made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Problem {
    /// There is nothing to dim.
    #[error("there are no light groups")]
    NoGroups,
    /// More groups than a page can hold.
    #[error("there are {0} light groups, a page holds at most {most}", most = Picture::MOST_GROUPS)]
    Groups(usize),
    /// Two groups that could not be told apart.
    #[error("two light groups are named '{0}'")]
    Twice(String),
    /// Values that are missing, or too many.
    #[error("the light group '{name}' has {found} values, {wanted} were expected")]
    Length {
        /// The group.
        name: String,
        /// Values that it has.
        found: usize,
        /// Three a pixel.
        wanted: usize,
    },
    /// Light that is no number.
    #[error("the light group '{name}' has {count} values that are not finite, the first in column {column} and row {row}")]
    NotFinite {
        /// The group.
        name: String,
        /// Values that are infinite or not a number.
        count: usize,
        /// From 0 at the left.
        column: usize,
        /// From 0 at the top.
        row: usize,
    },
    /// The picture for readers without scripts could not be made.
    #[error("{0}")]
    Still(String),
    /// Nothing small enough can be made.
    #[error("the page would not come below {0} bytes even with few pixels")]
    TooLarge(usize),
}

/// A group of lamps.
#[derive(Clone, Debug)]
pub struct Group {
    /// What people call it.
    pub name: String,
    /// What it brings to the picture: linear Rec.709, luminance in cd/m² times the picture's exposure, three values a pixel, rows from the top.
    pub light: Vec<f32>,
    /// Power at full light, W.
    pub watts: Option<f64>,
}

/// What one group is set to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// The group's place.
    pub group: usize,
    /// Factor on its light.
    pub level: f64,
    /// What tints it, K.
    pub kelvin: Option<f64>,
}

/// Settings under a name; groups that are not named have level 1.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What people call it.
    pub name: String,
    /// The groups that differ.
    pub settings: Vec<Setting>,
}

/// Colours of luminance 1 by colour temperature, at even places.
#[derive(Clone, Debug)]
pub struct Tints {
    /// The first place, K.
    pub first: u32,
    /// From one to the next, K.
    pub step: u32,
    /// Linear Rec.709.
    pub colours: Vec<[f32; 3]>,
}

/// A picture whose light is known by group.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What stands at the top.
    pub title: String,
    /// Columns and rows.
    pub size: [usize; 2],
    /// The groups, in the order that people see.
    pub groups: Vec<Group>,
    /// What luminance in cd/m² was multiplied by.
    pub exposure: f32,
    /// Log-average luminance of the whole picture, times `exposure`: what the eye has adapted to at first.
    pub average: f32,
    /// Luminance shown as white, where the log-average is 0.18.
    pub white: f32,
    /// Stops by which the picture is brightened at first.
    pub stops: f32,
    /// What groups can be tinted with.
    pub tints: Tints,
    /// Settings to choose from.
    pub scenes: Vec<Scene>,
    /// Hours a year that the light burns at first.
    pub hours: f64,
    /// The page's language.
    pub language: Language,
    /// Bytes that the page must not exceed.
    pub limit: usize,
}

impl Picture {
    /// Groups that a page holds at most: what every WebGL 2 has room for in its uniforms.
    pub const MOST_GROUPS: usize = 64;

    /// The first thing that is wrong.
    pub(super) fn check(&self) -> Result<(), Problem> {
        match self.groups.len() {
            0 => return Err(Problem::NoGroups),
            count if count > Self::MOST_GROUPS => return Err(Problem::Groups(count)),
            _ => {}
        }
        let wanted = 3 * self.size[0] * self.size[1];
        for (number, Group { name, light, .. }) in self.groups.iter().enumerate() {
            if self.groups[..number].iter().any(|other| other.name == *name) {
                return Err(Problem::Twice(name.clone()));
            }
            if light.len() != wanted || wanted == 0 {
                return Err(Problem::Length { name: name.clone(), found: light.len(), wanted });
            }
            if let Some(first) = light.iter().position(|value| !value.is_finite()) {
                let count = light.iter().filter(|value| !value.is_finite()).count();
                let (column, row) = (first / 3 % self.size[0], first / 3 / self.size[0]);
                return Err(Problem::NotFinite { name: name.clone(), count, column, row });
            }
        }
        Ok(())
    }
}
