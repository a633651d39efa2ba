//! Visibility bits of rays by their kind (Cycles' ray visibility). An instance is seen where its mask shares a bit.

/// Rays from the camera.
pub const CAMERA: u8 = 1;
/// Shadow rays.
pub const SHADOW: u8 = 2;
/// Diffusely scattered rays.
pub const DIFFUSE: u8 = 4;
/// Rays of glossy reflection.
pub const GLOSSY: u8 = 8;
/// Rays of transmission.
pub const TRANSMISSION: u8 = 16;
/// Shadow rays that see shadow catchers alone.
pub const CATCHER_SHADOW: u8 = 32;
/// Scattered rays that see shadow catchers alone.
pub const CATCHER_SCATTERED: u8 = 64;
/// Shadow rays to lights that some instances alone block; of one kind of such lights.
pub const LINKED_SHADOW: u8 = 128;
/// All scattered rays.
pub const INDIRECT: u8 = DIFFUSE | GLOSSY | TRANSMISSION;
