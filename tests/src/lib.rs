//! Helpers that the tests share: small scenes, rendering, image comparison.

pub mod picture;
pub mod scenes;
