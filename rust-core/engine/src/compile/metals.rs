//! Metals that materials name: their indices as kernels want them, with and without wavelengths.

use super::materials::Parameters;
use crate::{
    bsdf::{Metal, Switches, parameter},
    error::Diagnostic,
    scene::{Closure, Input, Material, MetalIndex, Model, Scene},
};
use gonio_spectrum::triples;
use std::sync::Arc;

/// The metals of a scene, each once however many materials are of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Metals(Vec<CompiledMetal>);

#[derive(Clone, Debug)]
struct CompiledMetal {
    source: Arc<MetalIndex>,
    index: gonio_spectrum::MetalIndex,
    /// By rotation of wavelengths: n and k.
    values: Vec<[[f32; 3]; 2]>,
    /// n and k of red, green and blue.
    colour: [[f32; 3]; 2],
}

impl CompiledMetal {
    fn new(source: &Arc<MetalIndex>, index: gonio_spectrum::MetalIndex) -> Self {
        let part = |part: usize| triples().filter(|nm| index.at(nm)[part]);
        let values = part(0).into_iter().zip(part(1)).map(|(n, k)| [n, k]).collect();
        Self { source: source.clone(), colour: index.colour_index(), values, index }
    }
}

impl Metals {
    /// Those of a scene; what is no index is told, and the material keeps its colours.
    pub(super) fn of(scene: &Scene, diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut all = Self::default();
        for material in &scene.materials {
            for metal in material.closures.iter().filter_map(|closure| closure.metal.as_ref()) {
                if all.find(metal).is_some() {
                    continue;
                }
                match gonio_spectrum::MetalIndex::new(&metal.name, metal.wavelengths_nm.clone(), metal.n.clone(), metal.k.clone()) {
                    Ok(index) => all.0.push(CompiledMetal::new(metal, index)),
                    Err(error) => {
                        let told = format!("its metal cannot be used, its colours stand in for it: {}", error.problem);
                        diagnostics.push(Diagnostic::warning(&material.origin, told));
                    }
                }
            }
        }
        all
    }

    fn find(&self, metal: &Arc<MetalIndex>) -> Option<usize> {
        self.0.iter().position(|known| Arc::ptr_eq(&known.source, metal) || known.source == *metal)
    }

    /// The row of a closure's metal.
    pub(super) fn row_of(&self, closure: &Closure) -> Option<u32> {
        closure.metal.as_ref().and_then(|metal| self.find(metal)).map(|row| row as u32)
    }

    /// Makes a closure's metal that of a row, with the index of colours where light has no wavelengths.
    pub(super) fn set(&self, row: u32, closure: &Closure, switches: &mut Switches, parameters: &mut Parameters) {
        switches.metal = Metal::Conductor;
        for (offset, values) in [parameter::METAL_N, parameter::METAL_K].into_iter().zip(self.0[row as usize].colour) {
            parameters.fix(offset, &values);
        }
        if closure.input("metalness").is_none() {
            parameters.fix(parameter::METALNESS, &[1.0]);
        }
    }

    /// By metal and rotation of wavelengths: quads of n and of k.
    pub(super) fn by_rotation(&self) -> Vec<f32> {
        self.0.iter().flat_map(|metal| &metal.values).copied().flat_map(quads).collect()
    }

    /// By metal and wavelength in nm: quads of n and of k, all components the same.
    pub(super) fn at(&self, wavelengths_nm: &[f64]) -> Vec<f32> {
        let of = |metal: &CompiledMetal, nm: f64| quads(metal.index.at(nm).map(|part| [part as f32; 3]));
        self.0.iter().flat_map(|metal| wavelengths_nm.iter().flat_map(move |nm| of(metal, *nm))).collect()
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
