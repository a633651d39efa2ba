//! The noises: what they give, and that they give it on any lanes.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod lanes;
mod nodes;
mod values;
