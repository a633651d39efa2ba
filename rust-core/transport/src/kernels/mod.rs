//! The large kernels that several stages call, as functions of their own that are never inlined: BSDF sampling, light sampling, surface points, shading programs.
//!
//! Inlined at every call they would make stages of a hundred thousand instructions, which compile for minutes and run no faster: a call costs
//! nanoseconds where a register's worth of shading costs microseconds. Each enables its level's instructions again.
//!
//! Arguments are handed on as they came: a pattern among them copies its registers, in two calls of `memcpy`, before the level's instructions are on.
//! Points that many branches read are passed by reference. By value they would be stored once more before the branches.
//!
//! A file is a unit of code generation: these are the longest of the crate.

mod bsdf;
mod fixed_light;
mod light;
mod light_hit;
mod surface;

pub use bsdf::sample;
pub(crate) use bsdf::{emitted, eval, eval_diffuse, flux, flux_diffuse, flux_factor, sample_or_follow, specular_rays, transmittance};
pub(crate) use fixed_light::sample_fixed;
pub use light::sample_li;
pub(crate) use light::{light_pmf, sample_along, sample_li_of};
pub(crate) use light_hit::{LightHit, eval_escaped, eval_light};
pub(crate) use surface::{evaluate, evaluate_on, lift, run_program, surface_points};
