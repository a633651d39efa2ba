//! The verdict sheet of a lighting planner: what somebody requires beside what `gonio measure`, `gonio annual` and `gonio road` found.
//!
//! Requirements are a TOML file ([`Requirements`]), figures the JSON that those commands print ([`Measured`]). Every line gets a verdict by the
//! standard error of its figure ([`Sheet::new`]), and the lines become a table, JSON, or a page that needs nothing beside itself ([`page`]).
//!
//! The numbers that a norm asks for are the user's: there is no norm's table in here, and a sheet is no certificate.

#![forbid(unsafe_code)]

mod bound;
mod error;
mod estimate;
mod html;
mod input;
mod json;
mod judge;
mod measured;
mod names;
mod note;
mod plan;
mod requirement;
mod sheet;
#[cfg(test)]
mod tests;
mod text;
mod unit;
mod words;

pub use bound::{Bound, Verdict};
pub use error::VerdictError;
pub use html::page;
pub use json::json;
pub use measured::Measured;
pub use requirement::{Requirement, Requirements};
pub use sheet::{Reached, Row, Sheet};
pub use text::lines;
