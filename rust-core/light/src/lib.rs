//! Lights: what they send, where to look for them, and how likely each direction is drawn.
//!
//! The compile step writes [`LightRecord`]s; [`LightTable`] lays them out. At a vertex [`LightTable::sample`] chooses a light and a direction;
//! [`LightTable::eval_hit`] and [`LightTable::escaped`] weigh rays that found a light by the BSDF. Formulas are UsdLux's, in cd/m².

mod aim_far;
mod aim_near;
mod beam;
mod blackbody;
mod build;
mod choice;
mod cylinder;
mod disk;
mod distant;
mod dome;
mod draws;
mod emitted;
mod emitter;
mod escaped;
mod facing_disk;
mod far_field;
mod goniogram;
mod met;
mod portal;
mod projected_area;
mod record;
mod rectangle;
mod row;
mod sample;
mod shaping;
mod size;
mod solid_angle;
mod sphere;
mod table;
mod texture;
mod tree;
mod triangle;
mod vector;

#[cfg(test)]
mod tests;

pub use blackbody::blackbody_rgb;
pub use draws::Draw;
pub use far_field::FarField;
pub use goniogram::{AngularType, Goniogram};
pub use projected_area::{Outline, ProjectedArea};
pub use record::{LightKind, LightRecord, LightTexture, OpeningPart, Shaping, Spot};
pub use sample::{LightSample, power_heuristic};
pub use size::size_factor;
pub use table::LightTable;
pub use tree::{Arrival, KnownLights};
