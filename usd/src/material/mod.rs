//! Materials of a stage: which is bound to a prim, and its shading network as a surface of the scene.
//!
//! A material's surface is looked for in the render contexts `gonio`, `mtlx` and the universal one, in this order, then in all others that it has.
//! Its network is read into a neutral document (`from_usd`; documents of MaterialX by `mtlx`), which `network` and the nodes' and surfaces' files
//! translate without `pxr`; what they ask of the stage goes through `host`. Nodes of the graph are made in `emit` alone.

mod arnold_math;
mod arnold_nodes;
mod asked;
mod binding;
mod convert;
mod dangling;
mod definition;
mod displaced;
mod document;
mod emit;
mod from_usd;
mod host;
mod inputs;
mod library;
mod made_of;
mod materialx;
mod mtlx;
mod network;
mod neutral;
mod outputs;
mod shaded;
mod stage_host;
mod surface;
#[cfg(test)]
mod tests;
mod textures;
mod usd_nodes;
mod value;
mod varying;
mod volume;
mod xml;

pub use asked::Shaded;
pub(crate) use binding::volume_shading;
pub use binding::{bound, bound_all};
pub use convert::fallback;
pub use document::{Substitution, substitute_documents};
pub use library::Library;
pub(crate) use textures::{image_source, texture};
pub(crate) use value::{stated_colour_space, to_linear_rec709};
pub(crate) use volume::VolumeShading;
