//! What rays traverse: the BLAS of a mesh, the TLAS of a scene, their nodes and instances.

pub(crate) mod blas;
pub(crate) mod deforming;
pub(crate) mod instance;
mod leaf_kinds;
mod loose_lights;
pub(crate) mod moving;
pub(crate) mod moving_smooth;
pub(crate) mod node;
mod refit;
pub(crate) mod smooth_tree;
pub(crate) mod tlas;
mod tlas_input;
