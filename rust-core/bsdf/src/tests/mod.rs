//! Tests of the surface models. Settings are shared: a new row in [`rows`] gets every statistical test.

mod adjoint;
mod chi_square;
mod cycles;
mod dispersion;
mod elliptic;
mod film;
mod furnace;
mod hair;
mod harness;
mod measured;
mod measurements;
mod normals;
mod phase;
mod phases;
mod ranges;
mod rows;
mod smooth;
mod subsurface;
