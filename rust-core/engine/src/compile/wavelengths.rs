//! What the wavelengths of paths mean: the table that kernels read, and the spectra of lamps.

use super::{colour_spectra::SetsOfSpectra, glasses::Glasses, metals::Metals, shining::emission_of_colour};
use crate::{
    colour::luminance_of_pixel,
    error::Diagnostic,
    light::LightTable,
    scene::{LampSpectrum, Light, Material, Observer, Origin, Scene},
};
use gonio_simd::{Column, WavelengthTable};
use gonio_spectrum::{Bands, Spectrum, Triples, triples, upsampling};
use std::sync::{Arc, OnceLock};

/// Spectra of a scene's lamps, each once.
#[derive(Clone, Debug, Default)]
pub(super) struct LampSpectra {
    spectra: Vec<Lamp>,
    /// Of sun and sky by their colours, where light has wavelengths.
    pub(super) of_colours: SetsOfSpectra,
    /// By light of the scene, the number of its spectrum counted from 1, or of its colours; 0 is none.
    of_light: Vec<u32>,
    /// The same by material, of what its surface sends.
    of_material: Vec<u32>,
}

/// A spectrum as kernels and colours want it, found once however many lights have it.
#[derive(Clone, Debug)]
struct Lamp {
    source: Arc<LampSpectrum>,
    spectrum: Spectrum,
    /// By rotation: over D65's, of unit luminance.
    values: Vec<[f32; 3]>,
    /// Linear Rec.709 of that.
    colour: [f32; 3],
}

impl Lamp {
    fn new(source: &Arc<LampSpectrum>, spectrum: &Spectrum) -> Self {
        let values = triples().tabulate(spectrum);
        Self { source: source.clone(), spectrum: spectrum.clone(), colour: colour(&values), values }
    }
}

impl LampSpectra {
    /// Those of a scene; what is no spectrum is told and left out.
    pub(super) fn of(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut all = Self::default();
        for light in &scene.lights {
            // Pictures in red, green and blue have spectra that were asked for alone.
            let spectrum = if scene.settings.spectral { light.lamp_spectrum() } else { light.spectrum.as_ref() };
            let number = match spectrum {
                Some(spectrum) => all.number(&light.origin, spectrum, diagnostics),
                None if scene.settings.spectral => all.of_colours.number(light, diagnostics),
                None => 0,
            };
            all.of_light.push(number);
            if scene.settings.spectral && light.colour_hides_spectrum() {
                let told = "the light's colour stands for the spectrum that its file has: with white it has that";
                diagnostics.push(Diagnostic::info(&light.origin, told));
            }
        }
        for material in &scene.materials {
            let number = material.spectrum.as_ref().map_or(0, |spectrum| all.number(&material.origin, spectrum, diagnostics));
            all.of_material.push(number);
        }
        all
    }

    fn number(&mut self, origin: &Origin, lamp: &Arc<LampSpectrum>, diagnostics: &mut Vec<Diagnostic>) -> u32 {
        if let Some(known) = self.spectra.iter().position(|known| Arc::ptr_eq(&known.source, lamp) || known.source == *lamp) {
            return known as u32 + 1;
        }
        match Spectrum::new(&lamp.name, &lamp.wavelengths_nm, &lamp.power) {
            Ok(spectrum) => {
                let told = |note: &String| Diagnostic::warning(origin, format!("of its spectrum: {note}"));
                diagnostics.extend(spectrum.notes.iter().map(told));
                self.spectra.push(Lamp::new(lamp, &spectrum));
                self.spectra.len() as u32
            }
            Err(error) => {
                diagnostics.push(Diagnostic::warning(origin, format!("its spectrum cannot be used, its colour stands in for it: {error}")));
                0
            }
        }
    }

    /// A light as it shines by its spectrum: its luminance in the spectrum's colour.
    pub(super) fn coloured(&self, number: usize, light: &Light) -> Option<Light> {
        let lamp = self.spectra.get(self.of_light(number)?)?;
        let luminance = luminance_of_pixel(light.emission.radiance);
        let mut light = light.clone();
        light.emission.radiance = lamp.colour.map(|part| part * luminance);
        Some(light)
    }

    /// A material as it shines by its spectrum.
    pub(super) fn coloured_material(&self, number: usize, material: &Material) -> Option<Material> {
        let lamp = self.spectra.get(self.of_material(number)?)?;
        Some(emission_of_colour(material, lamp.colour))
    }

    /// The number of the spectrum of a material, counted from 1; 0 is none.
    pub(super) fn number_of_material(&self, number: usize) -> u32 {
        self.of_material.get(number).copied().unwrap_or(0)
    }

    /// Lets the lights of a table shine by spectra: those of the scene's lights that the first belong to, and of the triangles behind them by their materials.
    pub(super) fn set(&self, table: &mut Arc<LightTable>, of_light: &[u32], of_triangle: impl Fn(usize) -> u32) {
        if self.spectra.is_empty() && self.of_colours.is_empty() {
            return;
        }
        let of_lamp = |light: u32| self.of_light.get(light as usize).copied().unwrap_or(0);
        let number = |light: usize| of_light.get(light).map_or_else(|| of_triangle(light), |light| of_lamp(*light));
        let numbers = (0..table.len()).map(number).collect();
        Arc::make_mut(table).set_spectra(numbers);
    }

    /// The table of wavelengths, where light is to have any.
    pub(super) fn table(&self, scene: &Scene, (metals, glasses): (&Metals, &Glasses)) -> Option<Arc<WavelengthTable>> {
        if !scene.settings.spectral {
            return None;
        }
        let plain = without_lamps();
        let (metals, glasses) = (metals.by_rotation(), glasses.by_rotation());
        let is_plain = self.spectra.is_empty() && self.of_colours.is_empty() && metals.is_empty() && glasses.is_empty();
        if is_plain && scene.settings.observer.is_luminous() {
            return Some(plain.clone());
        }
        let lamps: Vec<f32> = self.spectra.iter().flat_map(|lamp| &lamp.values).copied().flat_map(quad).collect();
        let mut table = WavelengthTable {
            lamps: rows(lamps, Triples::COUNT),
            lamp_colours: self.colours(),
            metals: column(&metals),
            glasses: column(&glasses),
            ..(**plain).clone()
        };
        table.colour_spectra = column(&self.of_colours.by_rotation());
        if scene.settings.observer == Observer::Melanopic {
            let grey = |value: f32| quad([value; 3]);
            table.film = column(&triples().melanopic().into_iter().flatten().flat_map(grey).collect::<Vec<f32>>());
        }
        Some(Arc::new(table))
    }

    /// The table of a band, by so many wavelengths even over it, one of which is its middle where they are odd in number. All three components of a path
    /// stand at one of them, and each brings a third of what is seen: the light of the band as a grey, relative to D65's. `lamps` is [`Self::by_band`].
    pub(super) fn table_of_band(
        &self,
        (bands, band): (&Bands, usize),
        lamps: &[Vec<f32>],
        (metals, glasses): (&Metals, &Glasses),
        count: usize,
    ) -> WavelengthTable {
        let part = |number: usize| (number as f64 + 0.5) / count as f64 - 0.5;
        let wavelengths: Vec<f64> = (0..count).map(|number| bands.centre(band) + part(number) * bands.width_nm()).collect();
        let places: Vec<f32> = wavelengths.iter().flat_map(|nm| quad([((nm - 380.0) / 400.0) as f32; 3])).collect();
        let lamps: Vec<f32> = lamps.iter().flat_map(|lamp| quad([lamp[band]; 3]).repeat(count)).collect();
        WavelengthTable {
            rotations: count as u32,
            places: column(&places),
            film: column(&quad([1.0 / 3.0; 3]).repeat(3 * count)),
            lamps: rows(lamps, count),
            lamp_colours: self.colours(),
            metals: column(&metals.at(&wavelengths)),
            glasses: column(&glasses.at(&wavelengths)),
            ..(**without_lamps()).clone()
        }
    }

    /// The spectrum of a light of the scene, by its place among them all.
    pub(super) fn of_light(&self, number: usize) -> Option<usize> {
        let place = (*self.of_light.get(number)? as usize).checked_sub(1)?;
        (place < self.spectra.len()).then_some(place)
    }

    /// The spectra of a light's colours, by their place among them all.
    pub(super) fn of_colours_of(&self, number: usize) -> Option<usize> {
        SetsOfSpectra::place(*self.of_light.get(number)?)
    }

    /// The spectrum of a material of the scene, by its place among them all.
    pub(super) fn of_material(&self, number: usize) -> Option<usize> {
        (self.number_of_material(number) as usize).checked_sub(1)
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.spectra.len()
    }

    /// By lamp, its spectrum in each band relative to D65's.
    pub(super) fn by_band(&self, bands: &Bands) -> Vec<Vec<f32>> {
        self.spectra.iter().map(|lamp| bands.tabulate(&lamp.spectrum)).collect()
    }

    fn colours(&self) -> Column {
        rows(self.spectra.iter().flat_map(|lamp| quad(lamp.colour)).collect(), 1)
    }
}

/// Linear Rec.709 of light with these values by rotation.
fn colour(values: &[[f32; 3]]) -> [f32; 3] {
    let mut sum = [0.0; 3];
    for (film, lamp) in triples().film().iter().zip(values) {
        for (film, value) in film.iter().zip(lamp) {
            sum.iter_mut().zip(film).for_each(|(sum, film)| *sum += f64::from(film * value));
        }
    }
    sum.map(|sum| (sum / Triples::COUNT as f64) as f32)
}

/// The table without lamps, made at first use.
fn without_lamps() -> &'static Arc<WavelengthTable> {
    static PLAIN: OnceLock<Arc<WavelengthTable>> = OnceLock::new();
    PLAIN.get_or_init(|| Arc::new(plain()))
}

fn plain() -> WavelengthTable {
    let (triples, upsampling) = (triples(), upsampling());
    let places: Vec<f32> = triples.centres().into_iter().flat_map(|triple| quad(triple.map(|nm| (nm - 380.0) / 400.0))).collect();
    let film = triples.film().into_iter().flatten().flat_map(quad).collect::<Vec<f32>>();
    WavelengthTable {
        rotations: Triples::COUNT as u32,
        places: column(&places),
        film: column(&film),
        polynomials: column(&upsampling.table),
        resolution: upsampling.resolution as u32,
        lamps: Column::new(0),
        lamp_colours: Column::new(0),
        colour_spectra: Column::new(0),
        metals: Column::new(0),
        glasses: Column::new(0),
    }
}

/// Rows of lamps, of so many quads each: one at least, for lanes without a lamp read the first where others have one or a sky.
fn rows(values: Vec<f32>, quads: usize) -> Column {
    column(if values.is_empty() { vec![0.0; 4 * quads] } else { values }.as_slice())
}

fn quad([a, b, c]: [f32; 3]) -> [f32; 4] {
    [a, b, c, 0.0]
}

pub(super) fn column(values: &[f32]) -> Column {
    let mut column = Column::new(values.len());
    column[..values.len()].copy_from_slice(values);
    column
}
