//! Light transport in stages over batches of paths: generate, intersect, shade by material, sample lights, trace shadows, accumulate.

mod accumulate;
mod bounce;
mod catcher;
mod closure;
mod direct_light;
mod exit;
mod first_surface;
mod generate;
mod intersect;
pub(crate) mod kernels;
mod light_groups;
mod light_sums;
mod material;
mod measure;
mod path;
mod scatter;
mod sensors;
mod shade;
mod shader_passes;
mod shadow;
mod shadow_order;
mod state;
mod statistics;
mod subsurface;
mod surface;

pub use catcher::CatcherSums;
pub(crate) use generate::{TileArea, generate, tile_code};
pub use light_groups::{GroupPasses, LightGroups, UNSEEN};
pub use light_sums::{LightSums, code};
pub use material::{MaterialTable, Mix, Shading, SurfaceMaterial, Tables};
pub use path::{FirstPasses, Mist, Start, Tracer, Transport};
pub use sensors::{Sensor, SensorTable};
pub use shader_passes::{ShaderOutput, ShaderOutputs, ShaderPasses, ShaderSums};
pub(crate) use state::Paths;
pub use state::{BATCH, FirstHit, TILE, Workspace, ray_mask};
pub use statistics::{LANE_BOUNCES, LANE_STAGES, LaneCount, STAGES, Statistics};
