//! How kernels run: one lane, or the machine's registers at some level.

use fearless_simd::Level;

/// The way kernels are executed, chosen once and kept in the render context.
#[derive(Clone, Copy, Debug)]
pub enum Execution {
    /// One value at a time; the baseline of every ratio.
    Scalar,
    /// The machine's registers at a level of `fearless_simd`.
    Vector(Level),
}

/// A level's name that this machine or this program does not know.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownLevel {
    /// The name asked for.
    pub name: String,
    /// Names that would work here, best first.
    pub available: Vec<&'static str>,
}

impl core::fmt::Display for UnknownLevel {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(f, "SIMD level '{}' is not available on this machine; choose one of {}", self.name, self.available.join(", "))
    }
}

impl core::error::Error for UnknownLevel {}

impl Execution {
    /// The best level of this machine, or the lower one that the environment variable `GONIO_SIMD` names; an unknown name counts as unset.
    pub fn detect() -> Self {
        std::env::var("GONIO_SIMD").ok().and_then(|name| Self::named(&name).ok()).unwrap_or_else(Self::best)
    }

    /// The best level of this machine.
    pub fn best() -> Self {
        Self::Vector(Level::new())
    }

    /// The level called `name` (`scalar`, `sse4.2`, `avx2`, `avx512`, `neon`), if this machine has it.
    pub fn named(name: &str) -> Result<Self, UnknownLevel> {
        let all = Self::all();
        all.iter()
            .copied()
            .find(|execution| execution.name().eq_ignore_ascii_case(name))
            .ok_or_else(|| UnknownLevel { name: name.to_owned(), available: all.iter().map(Self::name).collect() })
    }

    /// Every level that this machine has, best first, the scalar one last.
    pub fn all() -> Vec<Self> {
        let best = Level::new();
        let mut all = Vec::new();
        #[cfg(all(target_arch = "x86_64", not(only_level)))]
        {
            all.extend(best.as_avx512().map(|t| Self::Vector(Level::Avx512(t))));
            all.extend(best.as_avx2().map(|t| Self::Vector(Level::Avx2(t))));
            all.extend(best.as_sse4_2().map(|t| Self::Vector(Level::Sse4_2(t))));
        }
        if all.is_empty() {
            all.push(Self::Vector(best));
        }
        all.push(Self::Scalar);
        all
    }

    /// The level's name as `GONIO_SIMD` takes it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Scalar => "scalar",
            #[cfg(target_arch = "x86_64")]
            Self::Vector(Level::Avx512(_)) => "avx512",
            #[cfg(target_arch = "x86_64")]
            Self::Vector(Level::Avx2(_)) => "avx2",
            #[cfg(target_arch = "x86_64")]
            Self::Vector(Level::Sse4_2(_)) => "sse4.2",
            #[cfg(target_arch = "aarch64")]
            Self::Vector(Level::Neon(_)) => "neon",
            Self::Vector(_) => "baseline",
        }
    }

    /// Lanes in a register.
    pub fn lanes(&self) -> usize {
        #[inline(always)]
        fn count<L: crate::Lanes>(_: L) -> usize {
            L::COUNT
        }
        crate::dispatch!(*self, l => count(l))
    }
}

/// Calls a kernel for an [`Execution`]: `dispatch!(execution, l => kernel(l, arguments))`.
///
/// The expression is compiled once for each level, so it should be a single call; `return` and `?` inside it do not leave the caller.
#[macro_export]
macro_rules! dispatch {
    ($execution:expr, $lanes:ident => $call:expr) => {
        match $execution {
            $crate::Execution::Scalar => {
                let $lanes = $crate::One;
                $call
            }
            $crate::Execution::Vector(level) => $crate::dispatch_level!(level, simd => {
                let $lanes = $crate::Wide(simd);
                $call
            }),
        }
    };
}

/// Calls code for a level of `fearless_simd`: `dispatch_level!(level, simd => call(simd, arguments))`; with the feature `own-level` it is
/// compiled for one level alone.
#[cfg(not(only_level))]
#[macro_export]
macro_rules! dispatch_level {
    ($level:expr, $simd:ident => $call:expr) => {
        $crate::fearless_simd::dispatch!($level, $simd => $call)
    };
}

/// As above, for the only level that is built.
#[cfg(only_level)]
#[macro_export]
macro_rules! dispatch_level {
    ($level:expr, $simd:ident => $call:expr) => {{
        let $simd = $crate::only_level($level);
        $crate::fearless_simd::Simd::vectorize(
            $simd,
            #[inline(always)]
            || $call,
        )
    }};
}

macro_rules! only_level {
    ($name:literal, $token:ident, $as_token:ident) => {
        /// The token of the only level that is built.
        #[cfg(only_level = $name)]
        #[inline]
        pub fn only_level(level: Level) -> fearless_simd::$token {
            level.$as_token().expect("this build has one SIMD level, which another machine does not have; build it anew here")
        }
    };
}
only_level!("avx512", Avx512, as_avx512);
only_level!("avx2", Avx2, as_avx2);
only_level!("sse4.2", Sse4_2, as_sse4_2);
