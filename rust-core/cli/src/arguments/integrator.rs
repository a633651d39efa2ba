//! The integrators by the names that options have for them.

use clap::ValueEnum;
use gonio::scene::Integrator;

/// How light is followed.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum IntegratorArgument {
    /// Path tracing.
    Path,
    /// The same, stopped after direct light.
    Direct,
    /// Direct light without noise, mirrors and clear glass; --max-bounces is their depth.
    Whitted,
    /// Light tracing: paths from the lamps alone. In mirrors and through clear glass lamps are seen, and nothing else.
    Light,
}

impl From<IntegratorArgument> for Integrator {
    fn from(argument: IntegratorArgument) -> Self {
        match argument {
            IntegratorArgument::Path => Self::Path,
            IntegratorArgument::Direct => Self::Direct,
            IntegratorArgument::Whitted => Self::Whitted,
            IntegratorArgument::Light => Self::Light,
        }
    }
}
