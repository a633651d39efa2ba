//! Measured BSDFs laid out for lanes, each once however many closures show it.

use crate::{
    bsdf::MeasuredBsdf,
    error::Diagnostic,
    scene::{self, Closure, Model, Scene},
};
use gonio_formats::bsdf::Measured;
use std::sync::Arc;

/// Shares of light up to this are those of a surface, and an estimate's noise.
const MOST_ALBEDO: f32 = 1.02;

/// Spectra that differ by up to this are those that were measured.
const MOST_SPECTRAL_ERROR: f64 = 5e-3;

/// The measurements of a scene by their numbers; none for what is not shown or cannot be used.
#[derive(Clone, Debug, Default)]
pub(super) struct CompiledMeasured {
    /// Whether they are laid out for light with wavelengths.
    spectral: bool,
    entries: Vec<Option<(Arc<Measured>, Arc<MeasuredBsdf>)>>,
}

impl CompiledMeasured {
    /// What a closure shows.
    pub(super) fn of(&self, closure: &Closure) -> Option<&Arc<MeasuredBsdf>> {
        let (_, laid_out) = self.entries.get(shown_by(closure)?)?.as_ref()?;
        Some(laid_out)
    }

    /// What was laid out of the same measurement, for light with wavelengths or without.
    fn known(&self, data: &Arc<Measured>, spectral: bool) -> Option<&Arc<MeasuredBsdf>> {
        let same = |known: &Arc<Measured>| self.spectral == spectral && (Arc::ptr_eq(known, data) || known == data);
        self.entries.iter().flatten().find(|(known, _)| same(known)).map(|(_, laid_out)| laid_out)
    }
}

/// Lays out the measurements that closures show, but for those that `kept` has; reports those that cannot be used or give more light than
/// they get.
pub(super) fn compile(scene: &Scene, kept: &CompiledMeasured, diagnostics: &mut Vec<Diagnostic>) -> CompiledMeasured {
    let mut shown = vec![false; scene.measured.len()];
    for number in scene.materials.iter().flat_map(|material| &material.closures).filter_map(shown_by) {
        if let Some(place) = shown.get_mut(number) {
            *place = true;
        }
    }
    let mut compiled = CompiledMeasured { spectral: scene.settings.spectral, entries: Vec::with_capacity(shown.len()) };
    for (measured, shown) in scene.measured.iter().zip(shown) {
        let laid_out = if shown { laid_out(measured, scene.settings.spectral, [kept, &compiled], diagnostics) } else { None };
        compiled.entries.push(laid_out.map(|laid_out| (measured.data.clone(), laid_out)));
    }
    compiled
}

/// The number of the measurement that a closure shows.
fn shown_by(closure: &Closure) -> Option<usize> {
    let shows = matches!(closure.model, Model::Measured | Model::OpenPbr);
    closure.measured.filter(|_| shows).map(|id| id.index())
}

fn laid_out(
    measured: &scene::MeasuredBsdf,
    spectral: bool,
    known: [&CompiledMeasured; 2],
    diagnostics: &mut Vec<Diagnostic>,
) -> Option<Arc<MeasuredBsdf>> {
    let before = known.iter().find_map(|known| known.known(&measured.data, spectral)).cloned();
    let lay_out = if spectral { MeasuredBsdf::with_wavelengths } else { MeasuredBsdf::new };
    let laid_out = match before.map_or_else(|| lay_out(&measured.data).map(Arc::new), Ok) {
        Ok(laid_out) => laid_out,
        Err(problem) => {
            diagnostics
                .push(Diagnostic::warning(&measured.origin, format!("the measurement cannot be shown: {problem}; grey takes its place")));
            return None;
        }
    };
    let unseen = measured.data.unseen().into_iter().map(|problem| Diagnostic::warning(&measured.origin, problem));
    diagnostics.extend(unseen);
    let error = laid_out.spectral_error();
    if error > MOST_SPECTRAL_ERROR {
        let message =
            format!("the measurement's spectra are kept to {:.1} % of their own (rms): they have more detail or noise", 100.0 * error);
        diagnostics.push(Diagnostic::warning(&measured.origin, message));
    }
    let (albedo, angle) = laid_out.peak_albedo();
    if albedo > MOST_ALBEDO {
        let message = format!(
            "the measurement gives back {albedo:.2} times the light it gets, seen {angle:.0}° from the normal; it is shown as it is"
        );
        diagnostics.push(Diagnostic::warning(&measured.origin, message));
    }
    Some(laid_out)
}
