//! The wavefront stages: each takes a batch one step further.

pub(crate) mod catcher;
pub(crate) mod closure;
pub(crate) mod exit;
pub(crate) mod first_surface;
pub(crate) mod generate;
pub(crate) mod intersect;
pub(crate) mod light_queue;
pub(crate) mod measure;
pub(crate) mod nee;
pub(crate) mod scatter;
pub(crate) mod sensors;
pub(crate) mod shade;
pub(crate) mod shadow;
pub(crate) mod sort;
pub(crate) mod subsurface;
pub(crate) mod surface;
