//! The wavefront stages. Each takes a batch one step further: it takes the columns that it reads and writes.
//!
//! In the order in which `schedule/path` calls them:
//!
//! - [`start::generate`] starts camera paths, [`start::sensors`] those of meters, [`start::places`] those of textures that light is baked into.
//! - [`find::intersect`] traces them, [`find::found_light`] adds the light of lights they hit; paths fork at shadow catchers ([`shade::catcher`]).
//! - [`shade::closure`] selects one closure of a mix, [`find::sort`] sorts hits by material.
//! - [`find::surface`] computes the surface points of a chunk.
//! - [`shade::shading`] adds emission and AOVs ([`shade::first_surface`]). The schedule's [`shade::integrator`] runs next event estimation ([`light::nee`], [`light::light_queue`],
//!   [`light::terminator`]) and BSDF sampling ([`shade::scatter`], [`shade::guided`] where the guiding field is followed), or sends paths on through portals
//!   ([`shade::portal`]).
//! - [`walk::subsurface`] takes the random walks under surfaces, [`walk::exit`] lights where they leave.
//! - [`light::measure`] lights points whose illuminance is wanted.
//! - [`light::merge`] takes up photons behind mirrors and smooth glass.
//! - [`light::shadow`] traces shadow rays and adds what arrives.
//!
//! `schedule/light` starts light paths by [`start::emit`], and shades by [`shade::forward`]. [`start::start_media`] says what absorbs where paths start,
//! and [`start::index`] what refracts there.
//! [`find::segments`] are the ways that light paths go.

pub(crate) mod find;
pub(crate) mod light;
pub(crate) mod medium;
pub(crate) mod shade;
pub(crate) mod start;
pub(crate) mod walk;
