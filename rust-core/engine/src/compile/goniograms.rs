//! Goniograms as tables, each once however many lights have it.

use crate::{
    error::Diagnostic,
    light::{AngularType, FarField, Goniogram, LightKind, LightRecord},
    scene::{self, Light, PhotometricType},
};
use std::sync::Arc;

/// The goniograms of a scene's lights, and what they were laid out from.
#[derive(Clone, Debug, Default)]
pub(super) struct CompiledGoniograms {
    sources: Vec<Arc<scene::Goniogram>>,
    /// None for what cannot be used.
    places: Vec<Option<u32>>,
    /// Flux in lm of each table, where it was asked for.
    fluxes: Vec<Option<f64>>,
    pub(super) tables: Vec<Arc<Goniogram>>,
}

impl CompiledGoniograms {
    /// The number of a light's goniogram, laid out if it is new; reports those that cannot be used.
    pub(super) fn number(&mut self, light: &Light, diagnostics: &mut Vec<Diagnostic>) -> Option<u32> {
        let source = light.goniogram.as_ref()?;
        if let Some(known) = self.sources.iter().position(|known| Arc::ptr_eq(known, source) || known == source) {
            return self.places[known];
        }
        let table = table(source);
        if table.is_none() {
            let problem = "the goniogram needs strictly increasing angles and a finite factor, zero or more, for each pair of them";
            diagnostics.push(Diagnostic::warning(&light.origin, format!("{problem}; the light counts as uniform")));
        }
        let place = table.map(|table| {
            self.tables.push(Arc::new(table));
            self.fluxes.push(None);
            self.tables.len() as u32 - 1
        });
        self.sources.push(source.clone());
        self.places.push(place);
        place
    }

    /// The flux in lm that a table's factors sum up to as intensities in cd.
    pub(super) fn flux(&mut self, number: u32) -> f64 {
        let Some(known) = self.fluxes.get_mut(number as usize) else { return 0.0 };
        *known.get_or_insert_with(|| {
            let point = LightRecord { goniogram: Some(number), ..LightRecord::new(LightKind::Point) };
            FarField::new(&[point], &self.tables).flux()
        })
    }

    /// Whether the same goniograms were laid out, in the same order.
    pub(super) fn is_of_same(&self, other: &Self) -> bool {
        self.sources.len() == other.sources.len() && self.sources.iter().zip(&other.sources).all(|(a, b)| Arc::ptr_eq(a, b))
    }
}

fn table(source: &scene::Goniogram) -> Option<Goniogram> {
    let angular_type = match source.photometric_type {
        PhotometricType::C => AngularType::C,
        PhotometricType::B => AngularType::B,
        PhotometricType::A => AngularType::A,
    };
    Goniogram::new(angular_type, &source.horizontal_deg, &source.vertical_deg, &source.factors)
}
