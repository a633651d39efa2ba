//! Sun and sky by place and time.

use super::number::finite;
use clap::Args;
use std::path::PathBuf;

/// Sun and sky beside the stage's own lights.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Daylight")]
pub(crate) struct DaylightArguments {
    /// Add sun and sky as seen from a place at a time: degrees north, degrees east, ISO 8601 with the offset from UTC, as in 48.14,11.58,2024-06-21T15:00+02:00.
    #[arg(long, value_name = "LAT,LON,TIME", allow_hyphen_values = true)]
    pub(crate) sun: Option<String>,
    /// How luminance is spread over the sky: perez (all weathers), hosek-wilkie (clear), clear and overcast (CIE), or cie1 to cie15 of ISO 15469.
    #[arg(long, value_name = "MODEL", default_value = "perez", requires = "sun")]
    pub(crate) sky: String,
    /// Haze from 1 to 10: 2 in the mountains, 3 in the country, 5 in a city (Linke's turbidity).
    #[arg(long, value_name = "NUMBER", default_value_t = 3.0, requires = "sun", value_parser = finite::<f64>)]
    pub(crate) turbidity: f64,
    /// Measured irradiances in W/m², direct normal and diffuse horizontal, instead of a cloudless sky.
    #[arg(long, value_name = "DIRECT,DIFFUSE", requires = "sun", conflicts_with = "weather")]
    pub(crate) irradiance: Option<String>,
    /// Take the irradiances of the time's hour from an EPW or WEA file.
    #[arg(long, value_name = "FILE", requires = "sun")]
    pub(crate) weather: Option<PathBuf>,
    /// Where true north lies: degrees clockwise, seen from above, of +Y where Z is up and of -Z where Y is up.
    #[arg(long, value_name = "DEGREES", default_value_t = 0.0, allow_hyphen_values = true, requires = "sun", value_parser = finite::<f64>)]
    pub(crate) north: f64,
    /// Albedo of the ground, 0 to 1; it is shown below the horizon, which is black without it.
    #[arg(long, value_name = "ALBEDO", default_value_t = 0.0, requires = "sun", value_parser = finite::<f64>)]
    pub(crate) ground: f64,
    /// Metres above the sea.
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true, requires = "sun", value_parser = finite::<f64>)]
    pub(crate) elevation: f64,
    /// White sun and sky with the same luminances.
    #[arg(long = "white-daylight", requires = "sun")]
    pub(crate) white_daylight: bool,
}
