//! Random numbers: an Owen-scrambled Sobol sequence laid over each tile so that neighbouring pixels' errors differ (blue noise).
//!
//! A number depends on (pixel, sample, dimension, seed) alone. All samples of a 64×64 tile form one two-dimensional Sobol sequence: the
//! pixels are numbered along a Morton curve and each takes a block of 2^k consecutive points, which is itself a scrambled (0, k, 2)-net;
//! blocks of neighbouring pixels together are nets again, so their errors cancel under the eye's low-pass (Ahmed and Wonka, Screen-Space
//! Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels, 2020). Pairs of dimensions are decorrelated by
//! a nested uniform shuffle of the numbering and scrambled by hashing (Burley, Practical Hash-based Owen Scrambling, JCGT 9(4), 2020).

mod batch;
mod morton;
mod runs;
mod sobol;

pub use batch::{BATCH, CAPACITY, TILE, pixel};
pub use morton::{morton_even, tile_code, tile_place};
pub use runs::{RUN, RUNS, Runs, codes, unpack};
pub use sobol::{Sampler, hash, to_unit};

/// The dimensions a path uses, by name: a pair each, `BOUNCE` times the depth apart.
pub mod dimension {
    /// Position in the pixel, and as a third number when the shutter lets the sample in.
    pub const PIXEL: u32 = 0;
    /// Position on the lens.
    pub const LENS: u32 = 1;
    /// First dimension of the first surface.
    pub const FIRST_BOUNCE: u32 = 2;
    /// Dimensions a bounce.
    pub const BOUNCE: u32 = 16;
    /// Point on a light, within a bounce.
    pub const LIGHT: u32 = 0;
    /// Choice of the light, and Russian roulette, within a bounce.
    pub const LIGHT_CHOICE: u32 = 1;
    /// Direction of the BSDF sample, within a bounce.
    pub const BSDF: u32 = 2;
    /// Choice of the lobe, and opacity, within a bounce.
    pub const LOBE: u32 = 3;
    /// The way inside of a fibre, three pairs, within a bounce.
    pub const FIBRE: u32 = 4;
    /// Choice of the closure, within a bounce.
    pub const CLOSURE: u32 = 7;
    /// Added to the first three for the paths that measure illuminance.
    pub const MEASURE: u32 = 8;
    /// Added to the first three for walks that come out of surfaces.
    pub const EXIT: u32 = 11;
    /// Where in the pixel that sees it the light of a light path comes in, within a bounce.
    pub const SPLAT: u32 = 14;

    /// First dimension of what happens in media, beyond those of walks under surfaces; `MEDIUM` times the depth apart.
    pub const MEDIA: u32 = 1 << 20;
    /// Dimensions of the way before a surface.
    pub const MEDIUM: u32 = 8;
    /// Component of light and length of a free flight, within such a way.
    pub const FLIGHT: u32 = 0;
    /// Direction after a scattering.
    pub const PHASE: u32 = 1;
    /// Which of several media scatters, and Russian roulette.
    pub const PHASE_CHOICE: u32 = 2;
    /// Choice of the light, and the component of light by which the place to be lit is drawn.
    pub const MEDIUM_LIGHT_CHOICE: u32 = 3;
    /// Point of the light that the place is drawn towards.
    pub const MEDIUM_POINT: u32 = 4;
    /// Way of drawing that place, and the place.
    pub const MEDIUM_PLACE: u32 = 5;
    /// Point of the light that lights it.
    pub const MEDIUM_LIGHT: u32 = 6;
    /// Seed and first flight of tracking through media that vary.
    pub const TRACK: u32 = 7;
}
