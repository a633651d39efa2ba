//! Plots as SVG: texts are texts, colours fit light and dark surroundings, and nothing beside the file is needed.

mod axis;
mod bands;
mod carpet;
mod drawing;
mod map;
mod scale;
#[cfg(test)]
mod tests;

pub use bands::{Band, Bands};
pub use carpet::Carpet;
pub use map::{Map, cell_text};
pub use scale::Scale;

/// What stands above a plot.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// What is shown, of what.
    pub title: String,
    /// Lines below it, such as means with their errors.
    pub lines: Vec<String>,
}
