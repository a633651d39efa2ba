//! Measured scattering of materials: what files hold, how it is evaluated, and how it is sampled.
//!
//! Directions are unit vectors of the shading frame, z along the front's normal, both pointing away from the surface; light comes from `wi`
//! and leaves to `wo`. Values in tables are BSDF in 1/sr *without* a cosine, [`Measured::eval`] gives BSDF × |cos θ| of `wi`.
//!
//! Everything here is scalar and in f64: the reference that lane kernels are tested against. The arrays are flat, so that those kernels can
//! gather from them as they are.

mod axis;
pub(crate) mod bytes;
mod colour;
mod coordinates;
mod diagram;
mod direction;
mod figures;
mod fit;
mod format;
pub mod gbsdf;
mod hemispheres;
mod measured;
pub mod merl;
mod patches;
mod pbrdf;
mod quadrature;
mod report;
mod resample;
mod rgl;
mod sampling;
mod table;
mod tensor_file;
#[cfg(test)]
mod tests;
mod text;
mod tree;
pub mod utia;
mod warp;
pub mod xml;
pub mod zemax;

pub use axis::{Axis, Mode};
pub use colour::{Channels, cie_1931};
pub use coordinates::Coordinates;
pub use diagram::{lobe_diagram, lobe_map};
pub use direction::Direction;
pub use figures::{Figures, FromDirection, Share};
pub use fit::{Fit, FittedAlbedo};
pub use format::Format;
pub use hemispheres::Hemispheres;
pub use measured::{Measured, read};
pub use patches::{Band, Basis, Matrix, PatchCounts, Patches, Shares};
pub use report::{Albedo, Reciprocity};
pub use resample::Grid;
pub use rgl::{Rgl, RglGrid};
pub use sampling::{HalfVectorTable, Lobe, Resolution, Sample, Sampler};
pub use table::{Layout, Table};
pub use tree::{Component, TensorTree, Tree, disk_to_square, square_to_disk};
pub use warp::{Interpolant, Warp};
