//! The wavefront stages. Each takes a batch one step further: it takes the columns that it reads and writes.
//!
//! In the order in which `schedule/path` calls them:
//!
//! - [`generate`] starts camera paths, [`sensors`] those of meters, [`places`] those of textures that light is baked into.
//! - [`intersect`] traces them and adds the light of lights they hit; paths fork at shadow catchers ([`catcher`]).
//! - [`closure`] selects one closure of a mix, [`sort`] sorts hits by material.
//! - [`surface`] computes the surface points of a chunk.
//! - [`shade`] adds emission and AOVs ([`first_surface`]). The schedule's [`integrator`] runs next event estimation ([`nee`], [`light_queue`],
//!   [`terminator`]) and BSDF sampling ([`scatter`], [`guided`] where the guiding field is followed), or sends paths on through portals
//!   ([`portal`]).
//! - [`subsurface`] takes the random walks under surfaces, [`exit`] lights where they leave.
//! - [`measure`] lights points whose illuminance is wanted.
//! - [`merge`] takes up photons behind mirrors and smooth glass.
//! - [`shadow`] traces shadow rays and adds what arrives; [`volume`] says what light loses in what fills meshes.
//!
//! `schedule/light` starts light paths by [`emit`], and shades by [`forward`]. [`start_media`] says what absorbs where paths start.
//! [`segments`] are the ways that light paths go.

pub(crate) mod catcher;
pub(crate) mod closure;
pub(crate) mod corners;
pub(crate) mod covered;
pub(crate) mod emit;
pub(crate) mod exit;
pub(crate) mod first_surface;
pub(crate) mod forward;
pub(crate) mod generate;
pub(crate) mod glow;
pub(crate) mod guided;
pub(crate) mod integrator;
pub(crate) mod intersect;
pub(crate) mod light_queue;
pub(crate) mod linked_shadow;
pub(crate) mod measure;
pub(crate) mod merge;
pub(crate) mod nee;
pub(crate) mod places;
pub(crate) mod portal;
pub(crate) mod scatter;
pub(crate) mod segments;
pub(crate) mod sensors;
pub(crate) mod shade;
pub(crate) mod shadow;
pub(crate) mod sort;
pub(crate) mod start_media;
pub(crate) mod straight;
pub(crate) mod subsurface;
pub(crate) mod surface;
pub(crate) mod terminator;
pub(crate) mod volume;
