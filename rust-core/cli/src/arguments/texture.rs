//! How much memory textures may take.

use clap::Args;
use gonio::scene::{Settings, parse_bytes};
use std::path::PathBuf;

/// The limit of texture memory, and where tiles are kept.
#[derive(Args, Clone, Debug)]
pub(crate) struct TextureArguments {
    /// Memory for textures of materials, such as 512M or 4G; beyond it tiles are read from the texture cache as needed. 0 is no limit.
    #[arg(long = "texture-memory", value_name = "SIZE", default_value = "0", value_parser = parse_bytes)]
    pub(crate) texture_memory: u64,
    /// Folder of the texture cache, which --texture-memory fills; gonio/textures in the user's folder for caches (XDG_CACHE_HOME) without it.
    #[arg(long = "texture-cache", value_name = "DIR")]
    pub(crate) texture_cache: Option<PathBuf>,
}

impl TextureArguments {
    /// Puts them into a scene's settings.
    pub(crate) fn apply(&self, settings: &mut Settings) {
        (settings.texture_memory, settings.texture_cache) = (self.texture_memory, self.texture_cache.clone());
    }
}
