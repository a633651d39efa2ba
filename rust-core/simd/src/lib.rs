//! Lanes: kernels written once, run one, four, eight or sixteen values at a time.
//!
//! A kernel is a function generic over [`Lanes`] and takes the lanes token `l` first. [`dispatch!`] calls it for the [`Execution`] at hand:
//! SSE4.2, AVX2, AVX-512 or NEON through `fearless_simd` ([`Wide`]), or one value at a time ([`One`]), the honest scalar level that benchmarks
//! compare with.
//!
//! Rules: every function with lanes in its signature is `#[inline(always)]`; one `dispatch!` per stage and batch; batches are padded to
//! [`PADDING`]; `for` loops over arrays of vectors, never `from_fn`; masks stay masks.
//!
//! ```
//! use gonio_simd::{dispatch, Execution, F, Lanes};
//!
//! #[inline(always)]
//! fn halve<L: Lanes>(l: L, values: &mut [f32]) {
//!     for i in (0..values.len()).step_by(L::COUNT) {
//!         (l.load(values, i) * 0.5).store(values, i);
//!     }
//! }
//! let mut values = vec![2.0; 32];
//! dispatch!(Execution::detect(), l => halve(l, &mut values));
//! assert!(values.iter().all(|v| *v == 1.0));
//! ```

mod column;
mod execution;
mod float;
mod frame;
mod gather;
mod integer;
mod lanes;
mod mask;
mod one;
mod rgb;
mod transcendental;
mod vector;
mod wide;

pub use column::{Column, PADDING, padded};
pub use execution::{Execution, UnknownLevel};
pub use fearless_simd;
pub use float::{F, ToF};
pub use frame::Frame;
pub use integer::{ToU, U};
pub use lanes::Lanes;
pub use mask::{M, Select};
pub use one::One;
pub use rgb::Rgb;
pub use vector::{Vec2, Vec3};
pub use wide::Wide;
