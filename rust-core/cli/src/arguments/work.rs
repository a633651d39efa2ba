//! What every command takes that traces paths.

use super::number::count;
use clap::Args;
use gonio::scene::Settings;

/// Random numbers and threads.
#[derive(Args, Clone, Debug)]
pub(crate) struct WorkArguments {
    /// Seed of the random numbers.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    pub(crate) seed: u32,
    /// Worker threads; 0 takes one a core.
    #[arg(long, short = 'j', value_name = "COUNT", default_value_t = 0, value_parser = count::<u32>(0..=u64::from(u32::MAX)))]
    pub(crate) threads: u32,
}

impl WorkArguments {
    /// Puts them into a scene's settings.
    pub(crate) fn apply(&self, settings: &mut Settings) {
        (settings.seed, settings.threads) = (self.seed, self.threads);
    }
}
