//! Words of a year of daylight, in reports and on plots.

use serde::Deserialize;

/// A year of daylight.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct YearWords {
    pub(crate) title: String,
    pub(crate) weather: String,
    pub(crate) nameless: String,
    pub(crate) doubt: String,
    pub(crate) columns: [String; 9],
    pub(crate) note: String,
    pub(crate) not_known: String,
    pub(crate) provision: String,
    pub(crate) provision_columns: [String; 7],
    pub(crate) hourly: String,
    pub(crate) by_factor: String,
    pub(crate) provision_note: String,
    pub(crate) levels: [String; 4],
    pub(crate) closed: String,
    pub(crate) closed_hours: String,
    pub(crate) electric: String,
    pub(crate) no_certificate: String,
    pub(crate) autonomy: String,
    pub(crate) useful: String,
    pub(crate) direct: String,
    pub(crate) factor: String,
    pub(crate) mean_of_points: String,
    pub(crate) median_of_points: String,
    pub(crate) exposed: String,
    pub(crate) error_of_points: String,
    pub(crate) carpet: String,
    pub(crate) carpet_mean: String,
    pub(crate) carpet_lines: String,
    pub(crate) months: [String; 12],
    pub(crate) bands: String,
    pub(crate) bands_points: String,
    pub(crate) bands_names: [String; 4],
    pub(crate) glare: String,
    pub(crate) glare_value: String,
    pub(crate) glare_above: String,
}
