//! Light at a vertex: next event estimation with its shadow rays, and what light paths brought.

pub(crate) mod light_queue;
pub(crate) mod linked_shadow;
pub(crate) mod measure;
pub(crate) mod merge;
pub(crate) mod nee;
pub(crate) mod openings;
pub(crate) mod seen_through;
pub(crate) mod shadow;
pub(crate) mod terminator;
pub(crate) mod textured_emission;
