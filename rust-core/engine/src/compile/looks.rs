//! What surfaces look like: images, measured BSDFs and materials.

use super::{
    compiled::Kept,
    displace::Laid,
    fields::KeptFields,
    glasses::Glasses,
    materials,
    measured::{self, CompiledMeasured},
    metals::Metals,
    primvars,
    textures::{self, CompiledTextures},
    wavelengths::LampSpectra,
};
use crate::{
    error::{Diagnostic, Result},
    scene::Scene,
    transport::MaterialTable,
};
use std::sync::atomic::AtomicBool;

/// All of a scene.
#[derive(Debug)]
pub(super) struct Looks {
    pub(super) textures: CompiledTextures,
    pub(super) measured: CompiledMeasured,
    pub(super) metals: Metals,
    pub(super) glasses: Glasses,
    pub(super) spectra: LampSpectra,
    /// Names of the primvars that programs read.
    pub(super) names: Vec<String>,
    pub(super) materials: MaterialTable,
    /// Fields, for the next compilation.
    pub(super) fields: KeptFields,
}

impl Looks {
    pub(super) fn compile(scene: &Scene, kept: &Kept, cancel: &AtomicBool, diagnostics: &mut Vec<Diagnostic>) -> Result<Self> {
        let textures = textures::compile(scene, &kept.images, cancel, diagnostics)?;
        let measured = measured::compile(scene, &kept.measured, diagnostics);
        let metals = Metals::of(scene, diagnostics);
        let glasses = Glasses::of(scene, diagnostics);
        let spectra = LampSpectra::of(scene, diagnostics);
        let names = primvars::used_names(scene, &measured);
        let named = (&measured, &metals, &glasses);
        let (materials, fields) = materials::compile(scene, &textures, (named, &spectra), &names, &kept.fields, diagnostics)?;
        Ok(Self { textures, measured, metals, glasses, spectra, names, materials, fields })
    }

    /// What displacement reads.
    pub(super) fn laid(&self) -> Laid<'_> {
        Laid { textures: &self.textures, materials: &self.materials, names: &self.names }
    }
}
