//! LightTools' ray data (`.ray`): binary (`LTRF`) and text (`lt_rdf_version`), version 2.
//!
//! Rays are x, y, z, the direction and a flux, and a wavelength in nm behind them where the head says so; far-field data have no position
//! and start at the head's origin. Fluxes are in proportion: the head states the whole flux. The layout follows the public ray set tools of
//! J. Muschaweck (Unlicense) and files beside them. Tristimulus values and polarisation are refused: what is known does not say where they
//! stand.

mod binary;
mod text;

pub use binary::read;
pub use text::read as read_text;

use super::collect::{Collector, Ray, StatedFlux};
use super::{FluxUnit, LengthUnit, RayColour, RayFile, RayFormat};
use crate::error::Result;

/// What a head says of its rays.
struct Head {
    format: RayFormat,
    lumens: bool,
    far_field: bool,
    wavelengths: bool,
    unit: LengthUnit,
    origin: [f32; 3],
    flux: f64,
}

impl Head {
    /// Numbers in a ray.
    fn width(&self) -> usize {
        let position = if self.far_field { 0 } else { 3 };
        position + 4 + usize::from(self.wavelengths)
    }

    fn collector(&self, capacity: usize) -> Collector {
        let mut collector = Collector::new(self.format, self.unit, capacity);
        if !self.far_field && self.origin != [0.0; 3] {
            collector.warn("the head has an origin of its own: rays are not moved by it".into());
        }
        collector
    }

    /// A ray of [`Head::width`] numbers.
    fn push(&self, collector: &mut Collector, values: &[f32]) {
        let mut ray: Ray = [0.0; 7];
        ray[..3].copy_from_slice(&self.origin);
        let at = if self.far_field { 3 } else { 0 };
        ray[at..].copy_from_slice(&values[..7 - at]);
        collector.push(&ray, &values[7 - at..]);
    }

    fn finish(&self, mut collector: Collector) -> Result<RayFile> {
        let extra = collector.take_extra();
        let colour = if self.wavelengths { RayColour::Wavelengths(extra) } else { RayColour::Unknown };
        let rays = if self.lumens { FluxUnit::Lumens } else { FluxUnit::Watts };
        let [lumens, watts] = [self.lumens, !self.lumens].map(|own| own.then_some(self.flux));
        collector.finish(colour, StatedFlux { rays, lumens, watts, exact: false })
    }
}
