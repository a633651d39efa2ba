//! Shading programs run over batches of hits: what nodes ask of surface points, rays and images. The nodes themselves are in `gonio-nodes`.

mod columns;
mod evaluate;
mod hit_step;
mod light_path;
mod nearby;
mod nearby_rays;
mod normals;
mod program;
mod shading;

pub use columns::{GraphScratch, OutputColumns, SurfaceColumns};
pub use evaluate::evaluate;
pub use gonio_nodes::{CHUNK, Source};
pub use hit_step::HitStep;
pub use nearby::Occlusion;
pub use nearby_rays::Around;
pub use program::{Direction, Output, Program, Wanted, WantedOutput};
