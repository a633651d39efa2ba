//! Tables and sums of light transport by themselves; what stages do with them is tested by the crates above.

mod bright_places;
mod deep_sums;
mod material_order;
mod matte_names;
mod media;
