//! Luminaires' files that a stage names.

use gonio::scene::{Goniogram, Light};
use gonio_formats::photometry;
use std::sync::Arc;

/// A luminaire's file that lights of a stage name, with what it says beside the intensities.
#[derive(Clone, Debug)]
pub struct LuminaireFile {
    /// The path as the stage has it.
    pub path: String,
    /// What the file holds.
    pub photometry: photometry::Goniogram,
    pub(crate) goniogram: Arc<Goniogram>,
}

impl LuminaireFile {
    /// What a file of a path holds, and what lights have of it.
    pub fn new(path: String, photometry: photometry::Goniogram, goniogram: Arc<Goniogram>) -> Self {
        Self { path, photometry, goniogram }
    }
    /// Whether a light of the scene that was read with it has its goniogram from this file.
    pub fn is_of(&self, light: &Light) -> bool {
        light.goniogram.as_ref().is_some_and(|goniogram| Arc::ptr_eq(goniogram, &self.goniogram))
    }
}
