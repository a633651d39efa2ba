//! Metals that materials name: their indices as kernels want them, with and without wavelengths.

use super::{indices::Indices, materials::Parameters};
use crate::{
    bsdf::{Metal, Switches, parameter},
    error::Diagnostic,
    scene::{Closure, Input, Material, MetalIndex, Model, Scene},
};
use gonio_formats::FormatError;
use gonio_spectrum::triples;

/// The metals of a scene.
#[derive(Clone, Debug)]
pub(super) struct Metals(Indices<MetalIndex, CompiledMetal>);

#[derive(Clone, Debug)]
struct CompiledMetal {
    index: gonio_spectrum::MetalIndex,
    /// By rotation of wavelengths: n and k.
    values: Vec<[[f32; 3]; 2]>,
    /// n and k of red, green and blue.
    colour: [[f32; 3]; 2],
}

impl CompiledMetal {
    fn new(source: &MetalIndex) -> Result<Self, FormatError> {
        let MetalIndex { name, wavelengths_nm, n, k } = source.clone();
        let index = gonio_spectrum::MetalIndex::new(&name, wavelengths_nm, n, k)?;
        let part = |part: usize| triples().filter(|nm| index.at(nm)[part]);
        let values = part(0).into_iter().zip(part(1)).map(|(n, k)| [n, k]).collect();
        Ok(Self { colour: index.colour_index(), values, index })
    }
}

impl Metals {
    /// Those of a scene; what is no index is told, and the material keeps its colours.
    pub(super) fn of(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let instead = "metal cannot be used, its colours stand in for it";
        Self(Indices::of(scene, |closure| closure.metal.as_ref(), CompiledMetal::new, instead, diagnostics))
    }

    /// The row of a closure's metal.
    pub(super) fn row_of(&self, closure: &Closure) -> Option<u32> {
        self.0.row_of(closure)
    }

    /// Makes a closure's metal that of a row, with the index of colours where light has no wavelengths.
    pub(super) fn set(&self, row: u32, closure: &Closure, switches: &mut Switches, parameters: &mut Parameters) {
        switches.metal = Metal::Conductor;
        for (offset, values) in [parameter::METAL_N, parameter::METAL_K].into_iter().zip(self.0.row(row).colour) {
            parameters.fix(offset, &values);
        }
        if closure.input("metalness").is_none() {
            parameters.fix(parameter::METALNESS, &[1.0]);
        }
    }

    /// By metal and rotation of wavelengths: quads of n and of k.
    pub(super) fn by_rotation(&self) -> Vec<f32> {
        self.0.all().flat_map(|metal| &metal.values).copied().flat_map(quads).collect()
    }

    /// By metal and wavelength in nm: quads of n and of k, all components the same.
    pub(super) fn at(&self, wavelengths_nm: &[f64]) -> Vec<f32> {
        let of = |metal: &CompiledMetal, nm: f64| quads(metal.index.at(nm).map(|part| [part as f32; 3]));
        self.0.all().flat_map(|metal| wavelengths_nm.iter().flat_map(move |nm| of(metal, *nm))).collect()
    }
}

fn quads([[a, b, c], [d, e, f]]: [[f32; 3]; 2]) -> [f32; 8] {
    [a, b, c, 0.0, d, e, f, 0.0]
}

/// Says where a material names a metal and none of it is metallic.
pub(super) fn tell_unused(material: &Material, diagnostics: &mut Vec<Diagnostic>) {
    let named = material.closures.iter().find_map(|closure| closure.metal.as_ref());
    if let (Some(metal), false) = (named, material.closures.iter().any(is_metallic)) {
        let told =
            format!("it names the metal '{}', but no part of it is metallic: its metalness is 0, or its model has no metal", metal.name);
        diagnostics.push(Diagnostic::warning(&material.origin, told));
    }
}

/// Whether any of a closure can be metal.
fn is_metallic(closure: &Closure) -> bool {
    match closure.model {
        Model::Metallic | Model::Conductor => true,
        Model::OpenPbr | Model::Principled | Model::PreviewSurface | Model::StandardSurface | Model::Gltf => {
            !matches!(closure.input("metalness"), Some(Input::Constant([metalness, ..])) if metalness <= 0.0)
        }
        _ => false,
    }
}
