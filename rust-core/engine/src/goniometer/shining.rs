//! What shines in a luminaire: its lights, and tables of rays.

use super::Options;
use crate::{
    compile::{Bounds, CompiledScene},
    error::{Diagnostic, Error, Result},
    light::EmissionSampler,
    light_paths::Channels,
    transport::{Emission, RayTable},
};

/// What shines in the luminaire.
pub(super) struct Sources {
    lights: Option<EmissionSampler>,
    tables: Vec<RayTable>,
}

impl Sources {
    pub(super) fn new(compiled: &CompiledScene, bounds: &Bounds, options: &Options, diagnostics: &mut Vec<Diagnostic>) -> Result<Self> {
        let origin = compiled.tables.origin;
        let (centre, radius) = if bounds.is_empty() { ([0.0; 3], 1.0) } else { bounds.sphere(origin) };
        let lights = EmissionSampler::new(&compiled.tables.lights, None, (centre, radius as f32), &[]);
        let tables = options.rays.iter().map(|rays| rays.table(origin, diagnostics)).collect::<Result<Vec<_>>>()?;
        if lights.is_empty() && tables.is_empty() {
            let problem = "the luminaire has no light that shines: no light prim, no emissive surface, no ray file";
            return Err(Error::setting("luminaire", problem));
        }
        Ok(Self { lights: Some(lights).filter(|lights| !lights.is_empty()), tables })
    }

    pub(super) fn emissions(&self) -> impl Iterator<Item = Emission<'_>> {
        self.lights.iter().map(Emission::Lights).chain(self.tables.iter().map(Emission::Rays))
    }
}

/// What paths of an emission carry.
pub(super) fn power(emission: Emission<'_>) -> Channels {
    match emission {
        Emission::Lights(sampler) => sampler.total_power(),
        Emission::Rays(table) => [0, 1, 2].map(|k| table.flux[k].iter().map(|x| f64::from(*x)).sum::<f64>() / table.len() as f64),
    }
}
