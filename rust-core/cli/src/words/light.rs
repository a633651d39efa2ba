//! Words of lights, of their files and of glare.

use serde::Deserialize;
use std::collections::BTreeMap;

/// Lights.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LightsWords {
    pub(crate) rectangle: String,
    pub(crate) ellipse: String,
    pub(crate) disk: String,
    pub(crate) sphere: String,
    pub(crate) facing_disk: String,
    pub(crate) cylinder: String,
    pub(crate) point: String,
    pub(crate) luminaire: String,
    pub(crate) opening: String,
    pub(crate) distant: String,
    pub(crate) dome: String,
    pub(crate) textured: String,
    pub(crate) lamps: String,
    pub(crate) lux_at: String,
    pub(crate) measured: String,
    pub(crate) facing: String,
}

/// What a luminaire's file says.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FileWords {
    pub(crate) title: String,
    pub(crate) texts: [String; 5],
    pub(crate) photometry: String,
    pub(crate) flux: String,
    pub(crate) ratio: String,
    pub(crate) power: String,
    pub(crate) peak: String,
    pub(crate) beam: String,
    pub(crate) field: String,
    pub(crate) spreads: String,
    pub(crate) zenith: String,
    pub(crate) aside: String,
    pub(crate) codes: String,
    pub(crate) rating: String,
    pub(crate) opening: String,
    pub(crate) extent: String,
    pub(crate) extent_of_sides: String,
    pub(crate) lamp_set: String,
    pub(crate) in_use: String,
    pub(crate) lamps: String,
    pub(crate) no_flux: String,
    pub(crate) absolute: String,
    pub(crate) relative: String,
    pub(crate) tilt: String,
    pub(crate) spectrum: String,
    pub(crate) warning: String,
    /// By what the command line calls them in English.
    pub(crate) names: BTreeMap<String, String>,
}

/// UGR tables.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct UgrWords {
    pub(crate) caption: String,
    pub(crate) room: String,
    pub(crate) crosswise: String,
    pub(crate) endwise: String,
    pub(crate) note: String,
}

/// Glare in a picture.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GlareWords {
    pub(crate) ugr: String,
    pub(crate) black: String,
    pub(crate) no_source: String,
    pub(crate) part: String,
    pub(crate) dgp: String,
    pub(crate) at_eye: String,
    pub(crate) no_dgp: String,
    pub(crate) no_light: String,
    pub(crate) background: String,
    pub(crate) sources: String,
    pub(crate) source: String,
    pub(crate) left_out: String,
    pub(crate) of_ugr: String,
}

/// What a rating of glare is made of.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RatingWords {
    pub(crate) high: String,
    pub(crate) aside: String,
    pub(crate) below: String,
    pub(crate) left_out: String,
    pub(crate) large: String,
    pub(crate) covered: String,
    pub(crate) small: String,
    pub(crate) no_tabular: String,
    pub(crate) grid_small: String,
    pub(crate) grid_tabular: String,
    pub(crate) grid_covered: String,
    pub(crate) grid_left_out: String,
}

impl FileWords {
    /// A shape or a symmetry.
    pub(crate) fn name<'a>(&'a self, english: &'a str) -> &'a str {
        self.names.get(english).map_or(english, String::as_str)
    }
}
