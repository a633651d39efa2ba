//! What `gonio spectrum` takes.

use clap::Args;
use std::path::PathBuf;

/// Command lines to start from, and what names there are.
pub(super) const SPECTRUM_EXAMPLES: &str = "\
Examples:
  gonio spectrum lamp.csv                        all figures, with units
  gonio spectrum lamp.spdx -o lamp.svg           the spectrum and TM-30's colour vector graphic
  gonio spectrum LED-B3 FL11 A 2700K lamp.csv    a table
  gonio spectrum lamp.csv --json                 for machines

Names:
  A, E, D50, D55, D65, D75, FL1 to FL12, FL3.1 to FL3.15, HP1 to HP5, LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1, LED-V2 (CIE 015:2018);
  2700K is a blackbody, D5700K daylight. A file of the same name comes first.

Files:
  Lines of 'nm, power' in any unit of power, up from the shortest wavelength. Words before and after, and lines that begin with #, %, ! or //,
  are left out. A column beyond the second is left out and told. docs/spectral.md says what the figures mean.";

/// Command lines to start from.
pub(super) const SENSOR_EXAMPLES: &str = "Examples:
  gonio render office.usda --by-wavelength office.exr --band 10
  gonio sensor office.exr camera.csv -o photo.exr
  gonio sensor office.exr camera.csv -o raw.exr --white none
  gonio sensor office.exr cie-2015 -o seen.exr   the colours as the observer of 2015 sees them";

#[derive(Args, Debug)]
pub(crate) struct SensorOptions {
    /// A picture by wavelength (gonio render --by-wavelength).
    pub(crate) image: PathBuf,
    /// The sensor's curves: lines of nm and the response of each channel, in any unit; a line of names may stand first, three columns without one are R, G and B. Or an observer of the CIE: cie-1931, cie-1964, cie-2015 (2°, by the cones), cie-2015-10; the picture has X, Y, Z and their colour.
    pub(crate) response: PathBuf,
    /// The picture to write, a channel for each curve.
    #[arg(long, short = 'o', value_name = "FILE.exr")]
    pub(crate) output: PathBuf,
    /// The light that is white to the sensor: a file or a name as gonio spectrum has them. Of it each cd/m² is 1 in all channels. With 'none' channels are the sums of radiance, response and nm.
    #[arg(long, value_name = "LAMP", default_value = "D65")]
    pub(crate) white: Option<String>,
    /// Write nothing but errors.
    #[arg(long, short = 'q')]
    pub(crate) quiet: bool,
}

#[derive(Args, Debug)]
pub(crate) struct SpectrumOptions {
    /// The lamps: files of nanometres and power, IES TM-27 .spdx files, TM-33, GLDF and GDTF files with all of their spectra, or names such as FL11, D65, 2700K.
    #[arg(required = true, value_name = "FILE|NAME")]
    pub(crate) sources: Vec<PathBuf>,
    /// For machines: x, y, cct, duv, ra, r (R1 to R15), rf, rg, hue_bins, melanopic_der, alpha_opic, ler, notes. An object for one lamp, a list for
    /// several; what is undefined is null.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the spectrum beside TM-30's colour vector graphic, of one lamp.
    #[arg(short, long, value_name = "FILE.svg|FILE.png")]
    pub(crate) output: Option<PathBuf>,
}
