//! Tests of the lights.

mod accuracy;
mod agreement;
mod basics;
mod beam;
mod dome;
mod emit;
mod goniogram;
mod harness;
mod light_cache;
mod light_sampler;
mod portal;
mod shape;
