//! The order of stages: path tracing, trees of rays, and the rays that guide denoisers.

pub(crate) mod guides;
pub(crate) mod path;
pub(crate) mod whitted;
