//! Tests of the lights.

mod accuracy;
mod agreement;
mod basics;
mod choice;
mod dome;
mod harness;
mod shape;
