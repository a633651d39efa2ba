//! Shading nodes: what each computes, as functions on registers of lanes.

pub mod hash;
pub mod voronoi;
