//! Adding light and AOVs to the sums of a block of samples.

pub(crate) mod add;
pub(crate) mod arrivals;
pub(crate) mod catcher_sums;
pub(crate) mod guides;
pub(crate) mod light_groups;
pub(crate) mod light_sums;
pub(crate) mod shader_passes;
pub(crate) mod shader_sums;
pub(crate) mod surface_aovs;
pub(crate) mod tile_sums;
