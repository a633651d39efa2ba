//! Where paths start: at the camera, at meters, on textures that light is baked into, at lights.

pub(crate) mod emit;
pub(crate) mod generate;
pub(crate) mod index;
pub(crate) mod places;
pub(crate) mod sensors;
pub(crate) mod start_media;
pub(crate) mod surroundings;
