//! One HTML page on which the light of a finished picture is played with: dimmed, tinted, measured and compared, without a server.
//!
//! The light of each group is kept as logarithms of its colours in whole steps ([`codes`]), predicted from neighbours, deflated and written in base 64.
//! WebGL 2 sums the groups, each times its factor and colour, as `gonio relight` does. Where the page would become too large, steps are coarser and
//! then pixels fewer; [`Page`] says what was done.

#![forbid(unsafe_code)]

pub mod codes;
mod fit;
mod pack;
mod page;
mod picture;
mod words;

pub use fit::reduced;
pub use page::{Page, page};
pub use picture::{Group, Picture, Problem, Scene, Setting, Tints};
