//! What happens to paths at surfaces: emission, AOVs, and the ways on.

pub(crate) mod catcher;
pub(crate) mod closure;
pub(crate) mod first_surface;
pub(crate) mod forward;
pub(crate) mod guided;
pub(crate) mod integrator;
pub(crate) mod media;
pub(crate) mod portal;
pub(crate) mod scatter;
pub(crate) mod shading;
pub(crate) mod straight;
