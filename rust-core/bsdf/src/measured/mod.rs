//! Measured scattering on lanes: tables over angles, RGL's adaptive measurements, matrices over patches, tensor trees.
//!
//! All lanes of a call share one measurement, so that searches compare with its knots alone. Directions are in the measurement's frame on the
//! viewer's side: z up, x its tangent, y as its front has it. The f64 reference is [`gonio_formats::bsdf`].

mod albedo;
mod angles;
mod basis;
mod half_vector;
mod lobe;
mod patches;
mod rgl;
mod spectra;
mod table;
mod tree;
mod warp;

pub(crate) use lobe::MeasuredLobe;

use albedo::Albedos;
use gonio_formats::bsdf::{Hemispheres, Measured, Resolution, Sampler, Table};
use gonio_simd::{F, Lanes, M, Rgb, Spectrum, Vec3};
use half_vector::HalfVectors;
use patches::PatchMatrices;
use rgl::Adaptive;
use table::BsdfTable;
use tree::ColourTree;

/// Reflection and transmission to a view at the front, and to one at the back.
const PAIRS: [[Hemispheres; 2]; 2] =
    [[Hemispheres::ReflectionFront, Hemispheres::TransmissionBack], [Hemispheres::ReflectionBack, Hemispheres::TransmissionFront]];

/// A measured BSDF laid out for lanes, in linear Rec.709, and by wavelength where that was asked for and it was measured so.
#[derive(Clone, Debug)]
pub struct MeasuredBsdf {
    scattering: Scattering,
    /// Whether there is light between the sides of [`PAIRS`].
    scatters: [[bool; 2]; 2],
    albedos: Albedos,
    is_isotropic: bool,
    /// Only the front's reflection was measured: it holds for both sides.
    is_one_sided: bool,
}

#[derive(Clone, Debug)]
enum Scattering {
    Tables(Box<[[Option<BsdfTable>; 2]; 2]>, Box<HalfVectors>),
    Trees(Box<[[Option<ColourTree>; 2]; 2]>, Box<HalfVectors>),
    Patches(Box<PatchMatrices>),
    Adaptive(Box<Adaptive>),
}

impl MeasuredBsdf {
    /// Lays a measurement out in colour.
    ///
    /// # Errors
    /// When its angles are too near each other for single precision, or a table has 2³¹ values or more.
    pub fn new(measured: &Measured) -> Result<Self, &'static str> {
        Self::laid_out(measured, false)
    }

    /// The same for light with wavelengths: adaptive measurements (RGL) keep their spectra.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn with_wavelengths(measured: &Measured) -> Result<Self, &'static str> {
        Self::laid_out(measured, true)
    }

    fn laid_out(measured: &Measured, wavelengths: bool) -> Result<Self, &'static str> {
        const PROBLEM: &str = "its angles are too near each other for single precision, or it has 2^31 values or more";
        let is_isotropic = is_isotropic(measured);
        let sampler = Sampler::new(measured, &if is_isotropic { Resolution::ISOTROPIC } else { Resolution::ANISOTROPIC });
        let scattering = scattering(measured, &sampler, wavelengths).ok_or(PROBLEM)?;
        let scatters = PAIRS.map(|pairs| pairs.map(|pair| measured.has(pair)));
        let albedos = Albedos::new(measured, &sampler).ok_or(PROBLEM)?;
        let is_one_sided = scatters == [[true, false], [false, false]] && measured.unseen().is_empty();
        Ok(Self { scattering, scatters, albedos, is_isotropic, is_one_sided })
    }

    /// Whether the tangent does not matter.
    pub fn is_isotropic(&self) -> bool {
        self.is_isotropic
    }

    /// The largest share of light that comes back and passes through together, of any channel, and the view's angle from the normal in
    /// degrees at which it does. More than 1 is no reflectance that a surface can have.
    pub fn peak_albedo(&self) -> (f32, f32) {
        self.albedos.peak()
    }

    /// By how much the spectra that it keeps differ from those that were measured, rms over their own; zero where it keeps none.
    pub fn spectral_error(&self) -> f64 {
        match &self.scattering {
            Scattering::Adaptive(adaptive) => adaptive.spectral_error(),
            _ => 0.0,
        }
    }

    /// Where a view is at the measurement's front; `entering` where it is at the surface's.
    #[inline(always)]
    pub(super) fn front<L: Lanes>(&self, l: L, entering: M<L>) -> M<L> {
        if self.is_one_sided { l.m(true) } else { entering }
    }

    /// What a table has for two directions at the front, 1/sr; zero of what is no table.
    #[inline(always)]
    pub fn reflected<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> Rgb<L> {
        let Scattering::Tables(tables, _) = &self.scattering else { return Rgb::zero(l) };
        let Some(table) = &tables[0][0] else { return Rgb::zero(l) };
        table.value(l, wi, wo)
    }

    /// BSDF × cosine and density between directions on the viewer's side, transmission mirrored there.
    #[inline(always)]
    fn eval_side<L: Lanes>(&self, l: L, side: usize, transmitted: bool, wi: Vec3<L>, wo: Vec3<L>) -> (Rgb<L>, F<L>) {
        match &self.scattering {
            Scattering::Tables(tables, half_vectors) => {
                let Some(table) = &tables[side][usize::from(transmitted)] else { return (Rgb::zero(l), l.f(0.0)) };
                let value = table.value(l, wi, wo);
                (value * wi.z, half_vectors.pdf(l, side, transmitted, wi, wo))
            }
            Scattering::Trees(trees, half_vectors) => {
                let Some(tree) = &trees[side][usize::from(transmitted)] else { return (Rgb::zero(l), l.f(0.0)) };
                let value = tree.value(l, wi, wo);
                (value * wi.z, half_vectors.pdf(l, side, transmitted, wi, wo))
            }
            Scattering::Patches(patches) => {
                let (value, density) = patches.eval(l, side, transmitted, wi, wo);
                (value * wi.z, density * wi.z)
            }
            Scattering::Adaptive(adaptive) => adaptive.eval(l, wi, wo),
        }
    }

    /// BSDF × cosine at wavelengths in nanometres, and density, where it is known by wavelength.
    #[inline(always)]
    pub(crate) fn eval_at<L: Lanes>(&self, l: L, nanometres: Spectrum<L>, wi: Vec3<L>, wo: Vec3<L>) -> Option<(Spectrum<L>, F<L>)> {
        match &self.scattering {
            Scattering::Adaptive(adaptive) => adaptive.eval_at(l, nanometres, wi, wo),
            _ => None,
        }
    }

    /// A direction on the viewer's side, whether it is meant for the other side, and whether there is any.
    #[inline(always)]
    fn sample_side<L: Lanes>(&self, l: L, side: usize, wo: Vec3<L>, u: [F<L>; 3]) -> (Vec3<L>, [M<L>; 2]) {
        match &self.scattering {
            Scattering::Tables(_, half_vectors) | Scattering::Trees(_, half_vectors) => half_vectors.sample(l, side, wo, u),
            Scattering::Patches(patches) => patches.sample(l, side, wo, u),
            Scattering::Adaptive(adaptive) => {
                let (wi, usable) = adaptive.sample(l, wo, [u[1], u[2]]);
                (wi, [l.m(false), usable])
            }
        }
    }
}

/// Whether only the difference of azimuths counts.
fn is_isotropic(measured: &Measured) -> bool {
    use gonio_formats::bsdf::Coordinates::{HalfDifference, Isotropic};
    match measured {
        Measured::Tables(tables) => tables.iter().all(|table| matches!(table.layout().coordinates, Isotropic | HalfDifference)),
        Measured::Rgl(rgl) => rgl.is_isotropic(),
        Measured::Patches(_) => false,
        Measured::Tree(tree) => tree.components().iter().all(|component| component.tree.rank == 3),
    }
}

fn scattering(measured: &Measured, sampler: &Sampler<'_>, wavelengths: bool) -> Option<Scattering> {
    let half_vectors = || HalfVectors::new(sampler.table()?).map(Box::new);
    Some(match measured {
        Measured::Tables(tables) => {
            let mut sides = [[None, None], [None, None]];
            for (place, pair) in sides.iter_mut().flatten().zip(PAIRS.iter().flatten()) {
                let found = tables.iter().find(|table: &&Table| table.layout().hemispheres == *pair);
                if let Some(found) = found {
                    *place = Some(BsdfTable::new(found)?);
                }
            }
            Scattering::Tables(Box::new(sides), half_vectors()?)
        }
        Measured::Tree(tree) => {
            let sides = PAIRS.map(|pairs| pairs.map(|pair| ColourTree::new(tree, pair)));
            Scattering::Trees(Box::new(sides), half_vectors()?)
        }
        Measured::Patches(patches) => Scattering::Patches(Box::new(PatchMatrices::new(patches)?)),
        Measured::Rgl(rgl) => Scattering::Adaptive(Box::new(Adaptive::new(rgl, wavelengths)?)),
    })
}
