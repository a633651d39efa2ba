//! Surfaces: a block of parameters with OpenPBR's names, switches for the models that differ, and the lobes they resolve into.
//!
//! Contract: directions are unit, in the shading frame (z the normal on the viewer's side, x the tangent) and point away from the surface.
//! `eval` gives BSDF × |cos θi|, `pdf` is per solid angle, `sample` returns a struct whose `value / pdf` is the throughput factor.
//!
//! A [`Surface`] is compiled once for a material; [`Surface::resolve`] turns the parameter values of a batch of hits into [`Lobes`], in which
//! all attenuation by layers at the view is contained; evaluation and sampling loop over the lobes' slots, which are the same in all lanes.

mod adjoint;
mod base;
mod closure;
mod coat;
mod diffuse;
mod dispersion;
mod energy;
mod film;
mod fresnel;
mod fuzz;
mod glass;
mod hair;
mod lobes;
mod measured;
mod microfacet;
pub mod normals;
pub mod parameter;
pub mod phase;
mod portal;
mod reflect;
mod resolve;
pub mod subsurface;
mod surface;
mod switches;
#[cfg(test)]
mod tests;
mod toon;
mod transmission;
mod turn;

pub use adjoint::LightHits;
pub use hair::NUMBERS as WAY_NUMBERS;
pub use lobes::{BsdfSample, Lobes, MAXIMUM, SpecularRay, Way};
pub use measured::MeasuredBsdf;
pub use portal::Portal;
pub use resolve::Hits;
pub use surface::{LobeSet, ParameterValues, Surface};
pub use switches::{
    Anisotropy, Attenuation, Bump, Closure, CoatPath, Diffuse, Distribution, EmissionOrder, Fresnel, Fuzz, FuzzAttenuation, FuzzOrder,
    Metal, SubsurfaceMethod, Switches, Tint,
};
