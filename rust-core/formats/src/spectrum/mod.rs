//! Power of lamps over wavelength: what a list of it has to be, and files of text that hold one.

mod check;
mod text;

pub use text::read_text;

/// The most points: a spectrometer of a thousandth of a nanometre has fewer.
pub const MOST: usize = 1 << 20;

/// Letters of a file that messages show.
const SHOWN: usize = 40;

/// The power of a lamp over wavelength: at least five points that increase, none below zero.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralPower {
    /// What it is called; empty where nothing says.
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Power per nanometre at each of them, over the largest.
    pub power: Vec<f64>,
    /// What a reader should know of the data: noise below zero, wide steps.
    pub notes: Vec<String>,
}

/// A point of a file, with the line that it stands in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralPoint {
    /// Wavelength, nm.
    pub nm: f64,
    /// Power per nanometre, in any unit.
    pub power: f64,
    /// The line, from one.
    pub line: Option<u64>,
}

/// A part of a file for messages.
pub fn quoted(text: &str) -> String {
    let short: String = text.trim().chars().take(SHOWN).map(|c| if c.is_control() { char::REPLACEMENT_CHARACTER } else { c }).collect();
    if text.trim().chars().count() > SHOWN { format!("'{short}…'") } else { format!("'{short}'") }
}
