//! Textures within a memory limit: pyramids cut into tiles, kept in files of a cache folder and read when a lookup needs them.
//!
//! [`load_paged`] makes the files that are missing and opens all. [`TextureMemory`] holds the tiles in use and gives up those not used of
//! late; in files they are compressed without loss. Each worker looks tiles up through a [`TileReader`], which takes a lock only where it does
//! not have the tile itself.

mod codec;
mod file;
mod folder;
mod layout;
mod make;
mod memory;
mod need;
mod neighbour;
mod pack;
mod pages;
mod reader;

pub use folder::CacheFolder;
pub use make::load_paged;
pub use memory::{TextureMemory, TextureStatistics};
pub use reader::TileReader;

pub(crate) use file::TextureFacts;
pub(crate) use pages::PagedTexels;
