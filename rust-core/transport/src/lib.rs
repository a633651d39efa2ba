//! Light transport: a wavefront path tracer over batches of paths.
//!
//! In go the [`Tables`] of a compiled scene, a view's [`Transport`] and a [`Start`] (camera or sensors). Out come [`TileSums`]: radiance and
//! AOVs by slot.
//!
//! Read `schedule/path` first: it calls the wavefront stages in order, for a [`Tracer`]. `stage` has a file for each, `state` the columns that wait
//! between them, `media` what lies between surfaces. `accumulate` adds to the sums. `tables` is what no stage changes. `words` are the bits that all of them
//! read. The design is that of pbrt's `WavefrontPathIntegrator` (Physically Based Rendering, 4th edition, chapter 15), on SIMD lanes in place of a GPU's
//! threads.

mod accumulate;
pub mod geometry;
pub mod graph;
pub mod kernels;
pub mod media;
mod schedule;
mod stage;
mod state;
mod statistics;
mod tables;
mod words;

pub use accumulate::catcher_sums::CatcherSums;
pub use accumulate::deep_sums::{DeepPart, DeepSums};
pub use accumulate::deposit::Deposits;
pub use accumulate::effort::Effort;
pub use accumulate::guiding_notes::GuidingNotes;
pub use accumulate::light_sums::LightSums;
pub use accumulate::matte_sums::{MatteSums, Met};
pub use accumulate::shader_sums::ShaderSums;
pub use accumulate::sky_arrivals::SkyArrivals;
pub use accumulate::tile_sums::TileSums;
pub use schedule::light::{BatchFlux, LIGHT_BATCH, LightTracer, Receiver};
pub use schedule::tracer::{Start, Tracer};
pub use stage::find::corners::{Corner, CornerRoom, CornerTables};
pub use stage::find::segments::{Segment, Segments};
pub use stage::find::sort::order_by_material;
pub use stage::light::seen_through::{SeenThroughRoom, seen_through};
pub use stage::light::textured_emission::{EmissionPoint, emitted};
pub use stage::shade::forward::{Arriving, Picture, Splat, Wanted};
pub use stage::start::emit::Emission;
pub use stage::start::generate::{TileArea, generate};
pub use stage::start::index::squared_indices_at;
pub use stage::start::places::{Place, PlaceTable, Viewpoint};
pub use stage::start::sensors::{Sensor, SensorTable};
pub use stage::start::surroundings::surroundings_at;
pub use state::light_paths::{Arrivals, Escapes};
pub use state::paths::Paths;
pub use state::rays::Rays;
pub use state::textured_emission::EmissionRoom;
pub use state::workspace::Workspace;
pub use state::workspaces::Workspaces;
pub use statistics::{LANE_BOUNCES, LaneCount, LaneStage, Stage, Statistics};
pub use tables::Tables;
pub use tables::bodies::{Bodies, Body};
pub use tables::bright_places::{ArrivalCells, BrightPlaces};
pub use tables::expressions::{KIND_BITS, PathExpressions};
pub use tables::fields::{FieldLayout, FieldRow, FieldTable, GLOW, MovingFields, Numbers, POINTS};
pub use tables::guiding::{GuidingField, GuidingNote, Learning};
pub use tables::light_groups::{GroupPasses, LightGroups, UNSEEN};
pub use tables::links::Links;
pub use tables::material::{MaterialTable, Mix, Shading, SurfaceMaterial};
pub use tables::matte_names::{MatteNames, NameRun};
pub use tables::media::{Coefficients, Medium, MediumTable};
pub use tables::motion_vectors::{MotionCameras, NeighbourFrames, NeighbourMaps};
pub use tables::openings::Openings;
pub use tables::photons::{Bright, OFF_PLANE, Photon, Photons};
pub use tables::ray_table::RayTable;
pub use tables::shader_passes::{ShaderOutput, ShaderOutputs, ShaderPasses};
pub use tables::shutter::{Rolling, Shutter};
pub use tables::transport::{Distance, Estimator, FirstLight, Limits, Mist, Passes, PathFilter, Transport};
pub use words::{code, ray_mask};
