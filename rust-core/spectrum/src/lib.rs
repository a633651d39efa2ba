//! Spectra of lamps and what they say: chromaticity, correlated colour temperature, colour rendering by CIE 13.3 and TM-30, luminous efficacy of
//! radiation, the alpha-opic quantities of CIE S 026.
//!
//! ```
//! let lamp = gonio_spectrum::named("FL11").expect("a name of the CIE's").expect("within its range");
//! let figures = gonio_spectrum::figures(&lamp);
//! assert_eq!(figures.white.expect("a white lamp").cct.round(), 3999.0);
//! ```
//!
//! For spectral rendering: [`triples()`] of wavelengths whose light is white together, [`upsampling()`] of colours to spectra of reflectance.
//!
//! Wavelengths are in nanometres, power is per nanometre in any unit. A spectrum is summed at its own points, by the trapezoidal rule, as the CIE's
//! tables in steps of 5 nm are; steps beyond 5 nm are divided linearly first. `data/README.md` names the tables and their licence.

#![forbid(unsafe_code)]

mod alpha_opic;
mod appearance;
mod bands;
mod cct;
mod check;
mod colour_spectra;
mod drawing;
mod figures;
mod glass;
mod illuminant;
mod index;
mod integral;
mod metal;
mod mixture;
mod named;
mod observer;
mod read;
mod rendering;
mod rendering_of_many;
mod rendition;
mod samples;
mod source;
mod sun;
mod table;
mod triples;
mod upsampling;
mod white;

pub use alpha_opic::{AlphaOpic, OPSINS, melanopic_daylight};
pub use bands::{Bands, bands_of};
pub use cct::{HIGHEST_CCT, LARGEST_DUV, LOWEST_CCT, cct_of_colour, cct_of_xyz, isotherm};
pub use colour_spectra::{ColourSpectra, colours_over_d65};
pub use drawing::spectrum_drawing;
pub use figures::{Figures, White, figures};
pub use glass::{GlassIndex, glass, glass_sets};
pub use metal::{MetalIndex, metal, metal_sets};
pub use mixture::Mixture;
pub use named::{NAMES, named};
pub use observer::CieObserver;
pub use read::{glass::read_glass, metal::read_metal, read, response::Response};
pub use rendering::{Rendering, TOLERANCE};
pub use rendering_of_many::RenderingOfMany;
pub use rendition::{HueBin, Rendition};
pub use source::Spectrum;
pub use sun::{ozone_thickness, solar_irradiance};
pub use triples::{Triples, triples};
pub use upsampling::{REC709_TO_REC2020, Upsampling, upsampling};
pub use white::{d65_power, rec709_of_white};

#[cfg(test)]
mod tests;
