//! Light transport in stages over batches of paths: generate, intersect, shade by material, sample lights, trace shadows, accumulate.

mod accumulate;
pub mod geometry;
pub mod graph;
pub mod kernels;
mod schedule;
mod stage;
mod state;
mod statistics;
mod tables;

pub use accumulate::catcher_sums::CatcherSums;
pub use accumulate::light_sums::{LightSums, code};
pub use accumulate::shader_sums::ShaderSums;
pub use accumulate::tile_sums::TileSums;
pub use schedule::path::{Start, Tracer};
pub use stage::generate::{TileArea, generate};
pub use stage::sensors::{Sensor, SensorTable};
pub use stage::sort::order_by_material;
pub use state::paths::Paths;
pub use state::workspace::Workspace;
pub use state::workspaces::Workspaces;
pub use statistics::{LANE_BOUNCES, LANE_STAGES, LaneCount, STAGES, Statistics};
pub use tables::light_groups::{GroupPasses, LightGroups, UNSEEN};
pub use tables::material::{MaterialTable, Mix, Shading, SurfaceMaterial};
pub use tables::shader_passes::{ShaderOutput, ShaderOutputs, ShaderPasses};
pub use tables::transport::{FirstPasses, Mist, PathFilter, Transport};
pub use tables::{Tables, ray_mask};
