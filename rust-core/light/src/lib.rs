//! Lights, as next event estimation (NEE) and light paths need them: what they emit, how a direction to one is sampled, how rays leave it, and with which
//! densities.
//!
//! The compile step writes [`LightRecord`]s; [`LightTable`] lays them out. At a vertex [`LightTable::sample_li`] selects a light by importance, among
//! many by the light tree (light BVH) and the learned light cache. Then it samples a direction: solid angle sampling where the shape allows it.
//! [`LightTable::eval_hit`] and [`LightTable::eval_escaped`] give the light that a BSDF's ray found, and its density or weight for MIS (multiple
//! importance sampling). [`EmissionSampler::sample`] draws a ray that a light sends, for light paths. Formulas are UsdLux's, in cd/m².

mod along;
mod beam;
mod blackbody;
mod build;
mod context;
mod cylinder;
mod disk;
mod distant;
mod dome;
mod emission;
mod emit;
mod emitter;
mod eval_escaped;
mod eval_hit;
mod facing_disk;
mod falloff;
mod far_field;
mod fixed_samples;
mod gate;
mod goniogram;
mod light_bounds;
mod light_kind;
mod light_sampler;
mod linked_sampler;
mod links;
mod medium;
mod mis;
mod portal;
mod projected_area;
mod record;
mod rectangle;
mod row;
mod sample;
mod sample_finite;
mod sample_infinite;
mod shaded;
mod shaping;
mod size;
mod solid_angle;
mod spectra;
mod sphere;
mod table;
mod texture;
mod tree;
mod triangle;
mod vector;
mod way;

#[cfg(test)]
mod tests;

pub use along::LightAlong;
pub use blackbody::blackbody_rgb;
pub use context::LightSampleContext;
pub use emit::{AIMED, EmissionSampler, EmittedRay};
pub use eval_escaped::EscapedRay;
pub use far_field::FarField;
pub use fixed_samples::FixedLightSample;
pub use gate::{Filter, Slide};
pub use goniogram::{AngularType, Goniogram};
pub use light_kind::LightKind;
pub use links::LightLinks;
pub use mis::{SampleWeight, hit_weight, power_heuristic};
pub use projected_area::{Outline, ProjectedArea};
pub use record::{Falloff, LightRecord, LightTexture, OpeningPart, Shaping, Spot};
pub use sample::LightSample;
pub use shaded::TrianglePoint;
pub use size::size_factor;
pub use table::LightTable;
pub use tree::{Arrival, LightCache};
pub use way::{LightWay, Sight};
