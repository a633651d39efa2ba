//! Rays that lights send.

mod aimed;
mod cases;
mod chi_square;
mod flux;
mod harness;
mod levels;
mod planes;
mod selection;
