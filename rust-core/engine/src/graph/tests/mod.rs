//! Tests of graphs.

mod arithmetic;
mod curve;
mod harness;
mod shading;
mod steps;
mod vector;
