//! What rays meet, and the surface points there.

pub(crate) mod closures;
pub(crate) mod corners;
pub(crate) mod covered;
pub(crate) mod found_light;
pub(crate) mod intersect;
pub(crate) mod segments;
pub(crate) mod sort;
pub(crate) mod surface;
