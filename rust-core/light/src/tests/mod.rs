//! Tests of the lights.

mod accuracy;
mod agreement;
mod basics;
mod beam;
mod choice;
mod dome;
mod goniogram;
mod harness;
mod known;
mod portal;
mod shape;
