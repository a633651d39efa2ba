//! Lanes: kernels written once, run one, four, eight or sixteen values at a time.
//!
//! A kernel is a function generic over [`Lanes`] and takes the lanes token `l` first. [`dispatch!`] calls it for the [`Execution`] at hand:
//! SSE4.2, AVX2, AVX-512 or NEON through `fearless_simd` ([`Wide`]), or one value at a time ([`One`]), the honest scalar level that benchmarks
//! compare with.
//!
//! ```
//! use gonio_simd::{Column, Execution, F, Lanes, Vec3, dispatch};
//!
//! /// Lambert's cosine by lane: a step, on registers.
//! #[inline(always)]
//! fn lambert<L: Lanes>(n: Vec3<L>, wi: Vec3<L>) -> F<L> {
//!     let cosine = n.dot(wi);
//!     cosine.keep_if(cosine.gt(0.0)) * core::f32::consts::FRAC_1_PI
//! }
//!
//! /// The same for a batch: a stage, on columns.
//! #[inline(always)]
//! fn lambert_batch<L: Lanes>(l: L, wi: [&[f32]; 3], out: &mut [f32]) {
//!     let up = Vec3::splat(l, [0.0, 0.0, 1.0]);
//!     for at in (0..out.len()).step_by(L::COUNT) {
//!         lambert(up, Vec3::load(l, wi, at)).store(out, at);
//!     }
//! }
//!
//! let (x, y, mut z, mut out) = (Column::new(100), Column::new(100), Column::new(100), Column::new(100));
//! z.fill(1.0);
//! dispatch!(Execution::detect(), l => lambert_batch(l, [&x, &y, &z], &mut out));
//! assert!(out.iter().all(|v| (v * core::f32::consts::PI - 1.0).abs() < 1e-6));
//! ```
//!
//! # How to write a kernel
//!
//! - **Inline everything.** Each function with lanes in its signature carries `#[inline(always)]`, methods and closures passed on included: a
//!   forgotten one costs a factor of ten without a warning. So does a function's name passed on: write a closure that calls it.
//!   `tests/inlining.rs` reads the whole workspace for it. Where a kernel grows too large, its body may be wrapped in `l.vectorize(|| …)`, which
//!   brings the level's instructions along.
//! - **One [`dispatch!`] for a stage and batch**, a single call to a generic function. The level is chosen once and handed down.
//! - **Batches are [`Column`]s**: aligned to 64 bytes and padded to [`PADDING`], so there are no remainder loops. What the padding computes must be
//!   harmless, not right.
//! - **No branches on lanes.** Compute both sides and [`select`](M::select); masks stay masks ([`M`] has `&`, `|`, `!`); ask [`any`](M::any) only
//!   where a whole register may skip expensive work. Count with [`U::count_if`]; collect survivors with [`F::append`] and [`M::count`].
//! - **`for` loops over arrays of vectors**, never `from_fn` or `map`: they end in `memcpy`.
//! - **Gathers are the slowest thing here.** Axes of up to 32 knots take comparisons, `count_if` and [`lookup32`](Lanes::lookup32); where a gather must be,
//!   lay neighbours side by side and read them with [`gather_pairs`](Lanes::gather_pairs); sums of what is read are cheapest with
//!   [`sum_octets`](Lanes::sum_octets). Indices are clamped to the table, so no index is unsafe.
//! - **Exactness by name.** [`mul_add`](F::mul_add) is fused where the level has it; `min`, `max` and [`to_i32`](F::to_i32) leave NaN and overflow to
//!   the hardware. Code that must survive NaN compares and selects. Levels therefore agree statistically and not bit for bit; one level gives the same
//!   bits each time.
//! - **Elementary functions** are methods of [`F`]: `sin_cos`, `sin_cos_turns`, `tan`, `exp`, `exp2`, `ln`, `log2`, `pow`, `asin`, `acos`, `atan2`, each with
//!   its error bound. `sin_cos_turns` spares the range reduction, and `exp2` and `log2` are the cheap ones.

mod column;
mod execution;
mod float;
mod frame;
mod gather;
mod integer;
mod lanes;
mod mask;
pub mod motion;
#[cfg(target_arch = "aarch64")]
mod neon;
mod octets;
mod one;
mod prefetch;
mod rgb;
mod sort;
mod spectrum;
mod transcendental;
mod vector;
mod wide;

pub use column::{Column, PADDING, padded};
#[cfg(only_level)]
pub use execution::only_level;
pub use execution::{Execution, UnknownLevel};
pub use fearless_simd;
pub use float::{F, ToF};
pub use frame::Frame;
pub use integer::{ToU, U};
pub use lanes::Lanes;
pub use mask::{M, Select};
pub use one::One;
pub use prefetch::{prefetch, prefetch_at};
pub use rgb::Rgb;
pub use sort::{Sort8, sorts_fast};
pub use spectrum::{FIRST_COLOUR_SPECTRA, Spectrum, SpectrumColumns, SpectrumItems, WavelengthColumn, WavelengthTable, Wavelengths};
pub use vector::{Vec2, Vec3};
pub use wide::Wide;
