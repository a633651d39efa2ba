//! A measured material, whatever file it came from.

use super::colour::Channels;
use super::direction::Direction;
use super::format::Format;
use super::gbsdf;
use super::hemispheres::Hemispheres;
use super::patches::Patches;
use super::rgl::Rgl;
use super::table::Table;
use super::tensor_file::TensorFile;
use super::tree::TensorTree;
use super::{merl, pbrdf, utia, xml, zemax};
use crate::error::{FormatError, Result};

/// What a file can hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// Tables over angles, at most one for each pair of hemispheres, all with the same channels; sides without a table scatter nothing.
    Tables(Vec<Table>),
    /// An adaptive measurement with its own warp.
    Rgl(Box<Rgl>),
    /// Matrices over patches of directions.
    Patches(Patches),
    /// Tensor trees.
    Tree(TensorTree),
}

/// Reads any of the formats, told apart by what the bytes are; `name`, the file's name, only stands in the message when they are none.
///
/// # Errors
/// When the bytes are none of the formats, or not a sound file of theirs.
pub fn read(bytes: &[u8], name: &str) -> Result<Measured> {
    let table = |table: Table| Measured::Tables(vec![table]);
    match Format::of(bytes, name) {
        Some(Format::Rgl) => Rgl::from_tensor_file(&TensorFile::read(bytes)?).map(|rgl| Measured::Rgl(Box::new(rgl))),
        Some(Format::Pbrdf) => pbrdf::from_tensor_file(&TensorFile::read(bytes)?).map(table),
        Some(Format::Gbsdf) => gbsdf::read(bytes).map(Measured::Tables),
        Some(Format::Merl) => merl::read(bytes).map(table),
        Some(Format::Utia) => utia::read(bytes).map(table),
        Some(Format::Xml) => xml::read(bytes),
        Some(Format::Zemax) => zemax::read(&String::from_utf8_lossy(bytes)).map(table),
        None => Err(FormatError::whole(
            "not a measured material that we know: MERL .binary, RGL .bsdf, pBRDF .pbsdf, UTIA .bin, BSDF XML, Zemax .bsdf or .gbsdf",
        )),
    }
}

impl Measured {
    /// The bytes of a file of its kind, from which [`read`] gives the same again: `.gbsdf`, RGL `.bsdf` or BSDF XML.
    pub fn to_bytes(&self) -> Vec<u8> {
        match self {
            Self::Tables(tables) => gbsdf::write(tables, "", gbsdf::Encoding::Binary),
            Self::Rgl(rgl) => rgl.write(),
            Self::Patches(patches) => xml::write_patches(patches, "").into_bytes(),
            Self::Tree(tree) => xml::write_tree(tree, "").into_bytes(),
        }
    }

    /// What the channels of [`Measured::eval`] are.
    pub fn channels(&self) -> &Channels {
        match self {
            Self::Tables(tables) => tables.first().map_or(&Channels::Luminance, |table| &table.layout().channels),
            Self::Rgl(rgl) => &rgl.channels,
            Self::Patches(patches) => patches.channels(),
            Self::Tree(tree) => tree.channels(),
        }
    }

    /// Whether there is light from the one side to the other.
    pub fn has(&self, hemispheres: Hemispheres) -> bool {
        match self {
            Self::Tables(tables) => tables.iter().any(|table| table.layout().hemispheres == hemispheres),
            Self::Rgl(_) => hemispheres == Hemispheres::ReflectionFront,
            Self::Patches(patches) => patches.main(hemispheres).is_some(),
            Self::Tree(tree) => tree.has(hemispheres),
        }
    }

    /// BSDF × |cos θ| of `wi` for each channel, 1/sr; zero where nothing was measured. `out` has as many elements as there are channels.
    pub fn eval(&self, wi: Direction, wo: Direction, out: &mut [f64]) {
        out.fill(0.0);
        let Some(pair) = Hemispheres::of(wi, wo) else { return };
        match self {
            Self::Rgl(rgl) => return rgl.eval(wi, wo, out),
            Self::Tables(tables) => {
                let fits = |table: &&Table| table.layout().hemispheres == pair && table.layout().channels.count() == out.len();
                if let Some(table) = tables.iter().find(fits) {
                    table.value(wi, wo, out);
                }
            }
            Self::Patches(patches) => patches.value(pair, wi, wo, out),
            Self::Tree(tree) => tree.value(pair, wi, wo, out),
        }
        out.iter_mut().for_each(|value| *value *= wi[2].abs());
    }

    /// Whether a turn of both directions about the normal changes nothing, as the kind of data says; matrices over patches may always be
    /// anisotropic.
    pub fn is_isotropic(&self) -> bool {
        match self {
            Self::Tables(tables) => tables.iter().all(|table| table.layout().is_isotropic()),
            Self::Rgl(rgl) => rgl.is_isotropic(),
            Self::Patches(_) => false,
            Self::Tree(tree) => tree.components().iter().all(|component| component.tree.rank == 3),
        }
    }

    /// [`Measured::eval`] in linear Rec.709 (see [`Channels`] for how).
    pub fn eval_rgb(&self, wi: Direction, wo: Direction) -> [f64; 3] {
        self.rgb(&self.channels().rgb_weights(), wi, wo)
    }

    /// Linear Rec.709 by weights that the caller keeps, because those of spectra take long to find.
    pub(crate) fn rgb(&self, weights: &[[f64; 3]], wi: Direction, wo: Direction) -> [f64; 3] {
        let mut values = vec![0.0; weights.len()];
        self.eval(wi, wo, &mut values);
        [0, 1, 2].map(|c| values.iter().zip(weights).map(|(v, w)| v * w[c]).sum())
    }

    /// [`Measured::eval`] as luminance.
    pub fn eval_luminance(&self, wi: Direction, wo: Direction) -> f64 {
        self.luminance(&self.channels().luminance_weights(), wi, wo)
    }

    /// Luminance by weights that the caller keeps, because those of spectra take long to find.
    pub(crate) fn luminance(&self, weights: &[f64], wi: Direction, wo: Direction) -> f64 {
        // Most materials have three channels; a spectrum's buffer is the price of a spectrum.
        let mut few = [0.0; 8];
        let mut many = Vec::new();
        let values = if weights.len() <= few.len() {
            &mut few[..weights.len()]
        } else {
            many.resize(weights.len(), 0.0);
            &mut many[..]
        };
        self.eval(wi, wo, values);
        values.iter().zip(weights).map(|(v, w)| v * w).sum()
    }
}
