//! Words of reports.

use serde::Deserialize;

/// What stands at the top of a page.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HeadWords {
    pub(crate) project: String,
    pub(crate) place: String,
    pub(crate) coordinates: String,
    pub(crate) sun_and_sky: String,
    pub(crate) time_and_sky: String,
    pub(crate) date: String,
    pub(crate) model: String,
    pub(crate) program: String,
    pub(crate) calculated: String,
}

/// What a page's tables have beside them.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PageWords {
    pub(crate) copy: String,
    pub(crate) copied: String,
    pub(crate) sort: String,
}

/// The luminaire schedule.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LuminairesWords {
    pub(crate) title: String,
    pub(crate) none: String,
    pub(crate) columns: [String; 10],
    pub(crate) in_all: String,
    pub(crate) unknown: String,
    pub(crate) note: String,
    pub(crate) afar: String,
    pub(crate) shining: String,
}

/// Installed power.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PowerWords {
    pub(crate) room: String,
    pub(crate) grid: String,
    pub(crate) no_room: String,
    pub(crate) density: String,
    pub(crate) of_light: String,
    pub(crate) without: String,
}

/// Pictures of cameras.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PicturesWords {
    pub(crate) title: String,
    pub(crate) seen: String,
    pub(crate) denoised: String,
    pub(crate) luminance: String,
}

/// Grids and meters.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GridsWords {
    pub(crate) title: String,
    pub(crate) columns: [String; 9],
    pub(crate) note: String,
    pub(crate) eyes: String,
    pub(crate) eyes_at: String,
    pub(crate) eyes_columns: [String; 5],
    pub(crate) eyes_note: String,
    pub(crate) directions: String,
    pub(crate) meters: String,
    pub(crate) meters_columns: [String; 4],
}

/// The colour of light.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ColourWords {
    pub(crate) title: String,
    pub(crate) missing: String,
    pub(crate) columns: [String; 9],
    pub(crate) note: String,
    pub(crate) drawing: String,
    pub(crate) middle: String,
    pub(crate) at: String,
}

/// What was not done.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NotesWords {
    pub(crate) title: String,
}
