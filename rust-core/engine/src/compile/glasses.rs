//! Glasses that materials name: their indices as kernels want them, with and without wavelengths.

use super::{indices::Indices, materials::Parameters};
use crate::{
    bsdf::parameter,
    error::Diagnostic,
    scene::{Closure, GlassIndex, Input, Material, Model, Scene},
};
use gonio_formats::FormatError;
use gonio_spectrum::triples;

/// The glasses of a scene.
#[derive(Clone, Debug)]
pub(super) struct Glasses(Indices<GlassIndex, CompiledGlass>);

#[derive(Clone, Debug)]
struct CompiledGlass {
    index: gonio_spectrum::GlassIndex,
    /// By rotation of wavelengths: the index over the stated one.
    values: Vec<[f32; 3]>,
}

impl CompiledGlass {
    fn new(source: &GlassIndex) -> Result<Self, FormatError> {
        let GlassIndex { name, wavelengths_nm, n } = source.clone();
        let index = gonio_spectrum::GlassIndex::new(&name, wavelengths_nm, n)?;
        let stated = index.stated();
        Ok(Self { values: triples().filter(|nm| index.at(nm) / stated), index })
    }
}

impl Glasses {
    /// Those of a scene; what is no index is told, and the material keeps its own.
    pub(super) fn of(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let instead = "glass cannot be used, its own index stands in for it";
        Self(Indices::of(scene, |closure| closure.glass.as_ref(), CompiledGlass::new, instead, diagnostics))
    }

    /// The row of a closure's glass.
    pub(super) fn row_of(&self, closure: &Closure) -> Option<u32> {
        self.0.row_of(closure)
    }

    /// Gives a closure the stated index of the glass of a row.
    pub(super) fn set(&self, row: u32, closure: &Closure, parameters: &mut Parameters) {
        parameters.fix(parameter::IOR, &[self.0.row(row).index.stated() as f32]);
        parameters.fix(parameter::TRANSMISSION_DISPERSION, &[0.0]);
        if closure.input("transmission_weight").is_none() {
            parameters.fix(parameter::TRANSMISSION_WEIGHT, &[1.0]);
        }
    }

    /// By glass and rotation of wavelengths: quads of the index over the stated one.
    pub(super) fn by_rotation(&self) -> Vec<f32> {
        self.0.all().flat_map(|glass| &glass.values).flat_map(|[a, b, c]| [*a, *b, *c, 0.0]).collect()
    }

    /// The same by glass and wavelength in nm, all components alike.
    pub(super) fn at(&self, wavelengths_nm: &[f64]) -> Vec<f32> {
        let of = |glass: &CompiledGlass, nm: f64| [(glass.index.at(nm) / glass.index.stated()) as f32; 4];
        self.0.all().flat_map(|glass| wavelengths_nm.iter().flat_map(move |nm| of(glass, *nm))).collect()
    }
}

/// Says where a material names a glass and lets no light pass, and where it has an Abbe number beside it.
pub(super) fn tell(material: &Material, diagnostics: &mut Vec<Diagnostic>) {
    let Some(glass) = material.closures.iter().find_map(|closure| closure.glass.as_ref()) else { return };
    let mut tell = |told: String| diagnostics.push(Diagnostic::warning(&material.origin, told));
    if !material.closures.iter().any(lets_light_pass) {
        tell(format!("it names the glass '{}', but lets no light pass: its transmission is 0, or its model has none", glass.name));
    }
    let abbe = |closure: &Closure| match closure.input("transmission_dispersion") {
        Some(Input::Constant([dispersion, ..])) => dispersion > 0.0,
        varying => varying.is_some(),
    };
    if material.closures.iter().any(abbe) {
        tell(format!("it names the glass '{}' and an Abbe number: the glass alone tells how it disperses", glass.name));
    }
}

/// Whether light can pass any of a closure that has an index.
fn lets_light_pass(closure: &Closure) -> bool {
    let is = |name: &str, value: f32| matches!(closure.input(name), Some(Input::Constant([found, ..])) if (found - value).abs() < 1e-6);
    match closure.model {
        Model::Glass | Model::Refraction => true,
        Model::OpenPbr | Model::Principled | Model::PreviewSurface | Model::StandardSurface | Model::Gltf => {
            let is_metal = is("metalness", 1.0) || (closure.metal.is_some() && closure.input("metalness").is_none());
            !is_metal && !is("transmission_weight", 0.0)
        }
        _ => false,
    }
}
