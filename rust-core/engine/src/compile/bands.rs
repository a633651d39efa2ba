//! A compiled scene at one narrow band of wavelengths after another, where light is one number: its power relative to that of daylight D65.
//!
//! Paths of all bands are the same as far as materials let them, so that what they bring differs by the spectra of lamps and surfaces alone.

use super::{colour_spectra::column_of_band, compiled::CompiledScene, wavelengths::column};
use crate::{
    colour::luminance_of_pixel,
    error::{Error, Result},
    scene::{Light, OTHER_LIGHTS, Scene},
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
    /// By lamp, its spectrum in each band relative to D65's.
    lamps: Vec<Vec<f32>>,
    /// Of sun and sky, by set of spectra what red, green and blue are in each band, relative to D65's.
    skies: Vec<Vec<[f32; 3]>>,
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
        let skies = scene.spectra.of_colours.by_band(bands);
        Self { scene: Arc::new(scene), bands, lamps, skies }
    }

    /// The scene as it is in a band, until the next call.
    ///
    /// # Errors
    /// A render of the band before still goes on.
    pub(crate) fn at(&mut self, band: usize) -> Result<&Arc<CompiledScene>> {
        let busy = || Error::Internal("the scene of one band of wavelengths is in use while the next is asked for".to_owned());
        let scene = Arc::get_mut(&mut self.scene).ok_or_else(busy)?;
        let count = if scene.tables.materials.surfaces.iter().any(|surface| surface.surface.lobes.disperses) { BENT } else { 1 };
        let mut table = scene.spectra.table_of_band((self.bands, band), &self.lamps, (&scene.metals, &scene.glasses), count);
        table.colour_spectra = column(&column_of_band(&self.skies, band, count));
        scene.tables.set_wavelengths(Some(Arc::new(table)));
        Ok(&self.scene)
    }
    /// The bands.
    pub(crate) fn bands(&self) -> &'static Bands {
        self.bands
    }

    /// What all lamps of a light group send, surfaces that shine by a spectrum among them, by band over daylight D65, both of luminance 1. None where they
    /// differ, a picture tells a lamp's colours, or what shines without a spectrum is among them.
    pub(crate) fn lamp_of_group(&self, scene: &Scene, group: &str) -> Option<Vec<f32>> {
        let is_rest = group == OTHER_LIGHTS;
        let is_of = |name: &String| name == group || is_rest && name.is_empty();
        if is_rest && scene.shines_without_spectra() {
            return None;
        }
        let of_group = scene.instances.iter().filter(|set| is_of(&set.light_group));
        let surfaces = of_group.flat_map(|set| set.materials.iter().filter(|id| scene.shines(**id))).map(|id| self.surface(id.index()));
        let lights = scene.lights.iter().enumerate().filter(|(_, light)| is_of(&light.group) && !light.portal);
        let shining = lights.filter(|(_, light)| luminance_of_pixel(light.emission.radiance) != 0.0);
        let mut lamps = shining.map(|(number, light)| self.lamp(number, light)).chain(surfaces);
        let first = lamps.next()??;
        lamps.all(|other| other.is_some_and(|other| alike(&first, &other))).then_some(first)
    }

    /// What the surfaces of a material send that has a spectrum, by band over daylight D65.
    fn surface(&self, material: usize) -> Option<Vec<f32>> {
        self.lamps.get(self.scene.spectra.of_material(material)?).cloned()
    }

    /// What a light sends, by band over daylight D65.
    fn lamp(&self, number: usize, light: &Light) -> Option<Vec<f32>> {
        if let Some(own) = self.scene.spectra.of_light(number) {
            return self.lamps.get(own).cloned();
        }
        let luminance = luminance_of_pixel(light.emission.radiance);
        let colour = light.emission.radiance.map(|part| part / luminance);
        let of_sky = self.scene.spectra.of_colours_of(number).and_then(|set| self.skies.get(set));
        let in_band = |band: usize| match of_sky {
            Some(parts) => parts[band].iter().zip(colour).map(|(part, value)| part * value).sum::<f32>().max(0.0),
            None => self.bands.of_colour(band, colour),
        };
        light.texture.is_none().then(|| (0..self.bands.count()).map(in_band).collect())
    }
}

/// Whether two spectra differ by rounding alone.
fn alike(one: &[f32], other: &[f32]) -> bool {
    let largest = one.iter().copied().fold(0.0, f32::max);
    one.iter().zip(other).all(|(a, b)| (a - b).abs() <= 1e-4 * largest)
}
