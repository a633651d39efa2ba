//! The schedules: in which order the wavefront stages run. They alone know the whole workspace.
//!
//! [`tracer`] starts batches, [`steps`] has the steps that schedules share. [`path`] is the path tracer, [`whitted`] traces trees of rays,
//! [`guides`] traces the rays that guide denoisers, [`light`] paths that start at lights, [`sky`] light from given directions.

pub(crate) mod guides;
pub(crate) mod light;
pub(crate) mod path;
pub(crate) mod sky;
pub(crate) mod steps;
pub(crate) mod tracer;
pub(crate) mod whitted;
