//! Visibility bits of rays by their kind (Cycles' ray visibility). An instance is seen where its mask shares a bit.

use gonio_accel::RayMask;

/// Rays from the camera.
pub const CAMERA: RayMask = 1;
/// Shadow rays.
pub const SHADOW: RayMask = 2;
/// Diffusely scattered rays.
pub const DIFFUSE: RayMask = 4;
/// Rays of glossy reflection.
pub const GLOSSY: RayMask = 8;
/// Rays of transmission.
pub const TRANSMISSION: RayMask = 16;
/// Shadow rays that see shadow catchers alone.
pub const CATCHER_SHADOW: RayMask = 32;
/// Scattered rays that see shadow catchers alone.
pub const CATCHER_SCATTERED: RayMask = 64;
/// Shadow rays to lights that some instances alone block; of one kind of such lights.
pub const LINKED_SHADOW: RayMask = 128;
/// Rays that media scattered.
pub const VOLUME: RayMask = 256;
/// All scattered rays.
pub const INDIRECT: RayMask = DIFFUSE | GLOSSY | TRANSMISSION | VOLUME;
/// By kind of scattering.
pub(crate) const OF_KIND: [RayMask; 4] = [DIFFUSE, GLOSSY, TRANSMISSION, VOLUME];
/// What every ray and every instance shares a bit with.
pub const ALL: RayMask = RayMask::MAX;
