//! Illumination maps: light paths leave their flux on the surfaces themselves, front and back apart, direct and indirect light apart.
//!
//! A surface is divided by the texels of its texture coordinates ([`TexelChart`]), or triangle by triangle ([`CellChart`]); the second kind joins
//! cells again until their values are as certain as was asked for. Sums are whole numbers, so maps are the same bits for any number of threads.
//! The paper that the engine began with keeps the light of its forward ray tracing so.

mod cells;
mod dilate;
mod divided;
mod exr;
mod figures;
mod gather;
mod join;
mod options;
mod side;
mod smooth;
mod surface;
mod table;
mod texels;
mod usda;
mod view;
mod within_errors;

pub use cells::{CellChart, corners};
pub use divided::divided_meshes;
pub use exr::write_map_exr;
pub use figures::most_batches;
pub use gather::{Chart, IlluminationMaps, SurfaceMap, illumination_maps};
pub use options::{MOST_PATHS, MapOptions, TexelSize};
pub use side::{PartColour, SideMap, Summary};
pub use surface::MappedSurface;
pub use texels::TexelChart;
pub use usda::{FaceTable, map_layer};
pub use view::{Looks, Quantity, view};
