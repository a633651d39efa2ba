//! The integrators: in which order the wavefront stages run.
//!
//! [`path`] is the path tracer, [`whitted`] traces trees of rays, [`guides`] traces the rays that guide denoisers.

pub(crate) mod guides;
pub(crate) mod path;
pub(crate) mod whitted;
