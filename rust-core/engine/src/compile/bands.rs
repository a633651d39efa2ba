//! A compiled scene at one narrow band of wavelengths after another, where light is one number: its power relative to that of daylight D65.
//!
//! Paths of all bands are the same as far as materials let them, so that what they bring differs by the spectra of lamps and surfaces alone.

use super::compiled::CompiledScene;
use crate::{
    error::{Error, Result},
    transport::MediumTable,
};
use gonio_spectrum::Bands;
use std::sync::Arc;

/// Wavelengths of a band where glass bends each its own way; of one alone a prism would show a slit once a band.
const BENT: usize = 31;

/// A scene that was compiled for light with wavelengths.
#[derive(Debug)]
pub(crate) struct BandedScene {
    scene: Arc<CompiledScene>,
    bands: &'static Bands,
    /// Its media, by colour.
    media: MediumTable,
    /// By lamp, its spectrum in each band relative to D65's.
    lamps: Vec<Vec<f32>>,
}

impl BandedScene {
    /// With the lamps' own spectra.
    pub(crate) fn new(scene: CompiledScene, bands: &'static Bands) -> Self {
        let lamps = scene.spectra.by_band(bands);
        Self::with_lamps(scene, bands, lamps)
    }

    /// With lamps that are as bright in every band: found is by how much their light changes on its way.
    pub(crate) fn with_even_lamps(scene: CompiledScene, bands: &'static Bands) -> Self {
        let lamps = vec![vec![1.0; bands.count()]; scene.spectra.count()];
        Self::with_lamps(scene, bands, lamps)
    }

    fn with_lamps(scene: CompiledScene, bands: &'static Bands, lamps: Vec<Vec<f32>>) -> Self {
        let media = scene.tables.materials.media.clone();
        Self { scene: Arc::new(scene), bands, media, lamps }
    }

    /// The scene as it is in a band, until the next call.
    ///
    /// # Errors
    /// A render of the band before still goes on.
    pub(crate) fn at(&mut self, band: usize) -> Result<&Arc<CompiledScene>> {
        let busy = || Error::Internal("the scene of one band of wavelengths is in use while the next is asked for".to_owned());
        let scene = Arc::get_mut(&mut self.scene).ok_or_else(busy)?;
        let count = if scene.tables.materials.surfaces.iter().any(|surface| surface.surface.lobes.disperses) { BENT } else { 1 };
        let table = scene.spectra.table_of_band((self.bands, band), &self.lamps, &scene.metals, count);
        scene.tables.wavelengths = Some(Arc::new(table));
        scene.tables.materials.media = self.media.seen(|colour| [self.bands.of_colour(band, colour); 3]);
        Ok(&self.scene)
    }
}
