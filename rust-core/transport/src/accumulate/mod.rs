//! Adding light and AOVs to the sums of a sample block.
//!
//! In go registers of contributions with their slots, out come [`tile_sums::TileSums`], which the film takes. Light enters by
//! [`deposit::Deposits::deposit`] alone. The other files hold what a kind of pass needs: first surfaces, shader AOVs, guides of denoisers, shadow
//! catchers.

pub(crate) mod add;
pub(crate) mod arrivals;
pub(crate) mod catcher_sums;
pub(crate) mod deep_sums;
pub(crate) mod deposit;
pub(crate) mod effort;
pub(crate) mod expression_sums;
pub(crate) mod guides;
pub(crate) mod guiding_notes;
pub(crate) mod light_sums;
pub(crate) mod matte_sums;
pub(crate) mod shader_passes;
pub(crate) mod shader_sums;
pub(crate) mod sky_arrivals;
pub(crate) mod surface_aovs;
pub(crate) mod tile_sums;
