//! Tests of graphs.

mod arithmetic;
mod curve;
mod harness;
mod pruning;
mod shading;
mod steps;
mod texture_memory;
mod vector;
