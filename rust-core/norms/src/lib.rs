//! Calculations as norms of lighting have them: emergency lighting (EN 1838), fields of sports and their glare (EN 12193, CIE 112), and zones of rooms
//! (EN 12464-1).
//!
//! A plan is a TOML file ([`emergency::Plan`], [`sports::Plan`], [`zones::Plan`]). It says where light is measured ([`Spot`]); whoever calls measures there, and gives back
//! readings in their order, which come to figures. What a norm requires is the user's: see `gonio-verdict`.

#![forbid(unsafe_code)]

pub mod emergency;
mod lit;
mod outline;
mod plan;
mod spacing;
pub mod sports;
mod vector;
pub mod zones;

pub use lit::{Reading, Spot};
