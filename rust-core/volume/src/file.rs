//! Files of grids.

use crate::stream::{Source, Stream};
use crate::{Grid, GridInfo, MetadataMap, Result, VolumeError, nano, vdb};
use std::path::Path;
use std::sync::Arc;

/// A file and the grids in it. Voxels are read one grid at a time, by [`VolumeFile::read`].
#[derive(Clone, Debug)]
pub struct VolumeFile {
    name: Arc<str>,
    source: Source,
    listing: Listing,
    infos: Vec<GridInfo>,
}

#[derive(Clone, Debug)]
enum Listing {
    OpenVdb(vdb::Listing),
    NanoVdb(nano::Listing),
}

/// Whether a file that begins so is an OpenVDB or a NanoVDB file; eight bytes tell.
pub fn is_volume_file(start: &[u8]) -> bool {
    start.first_chunk().is_some_and(|magic| *magic == vdb::MAGIC || nano::is_magic(*magic))
}

/// Lists the grids of an OpenVDB (`.vdb`, file versions 220 to 225) or a NanoVDB (`.nvdb`) file, without their voxels. The content tells which it is.
///
/// Takes time and memory for the masks of all trees, less than a tenth of the file. Files that were written as streams are gone through whole.
/// A grid that cannot be read is listed with the reason, and does not spoil the others.
///
/// # Errors
///
/// What is wrong, with the file's name and the byte: no such file, not a volume file, a version that is not read, truncated or damaged.
pub fn open(path: impl AsRef<Path>) -> Result<VolumeFile> {
    let path = path.as_ref();
    VolumeFile::list(Source::Path(path.into()), path.to_string_lossy().into())
}

/// Lists the grids of a file that is in memory, as [`open`] does; `name` stands in messages.
///
/// # Errors
///
/// As [`open`].
pub fn from_bytes(bytes: impl Into<Arc<[u8]>>, name: &str) -> Result<VolumeFile> {
    VolumeFile::list(Source::Memory(bytes.into()), name.into())
}

impl VolumeFile {
    fn list(source: Source, name: Arc<str>) -> Result<Self> {
        let mut stream = Stream::open(&source, &name)?;
        let magic: [u8; 8] = if stream.size() < 8 { [0; 8] } else { stream.array()? };
        stream.seek(0)?;
        let listing = if magic == vdb::MAGIC {
            Listing::OpenVdb(vdb::list(&mut stream)?)
        } else if nano::is_magic(magic) {
            Listing::NanoVdb(nano::list(&mut stream)?)
        } else {
            return Err(VolumeError::whole(&name, "neither an OpenVDB nor a NanoVDB file"));
        };
        let infos = match &listing {
            Listing::OpenVdb(listing) => listing.entries.iter().map(|entry| entry.info.clone()).collect(),
            Listing::NanoVdb(listing) => listing.entries.iter().map(|entry| entry.info.clone()).collect(),
        };
        Ok(Self { name, source, listing, infos })
    }

    /// The file's name as it was given.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The grids, in the file's order.
    pub fn grids(&self) -> &[GridInfo] {
        &self.infos
    }

    /// The format and its version, such as `OpenVDB 224 (library 12.0)`.
    pub fn format(&self) -> String {
        match &self.listing {
            Listing::OpenVdb(listing) => format!("OpenVDB {} (library {}.{})", listing.version, listing.library[0], listing.library[1]),
            Listing::NanoVdb(listing) => format!("NanoVDB {}", listing.version()),
        }
    }

    /// What the file says of itself.
    pub fn metadata(&self) -> &[(String, crate::Metadata)] {
        const NONE: &MetadataMap = &MetadataMap::new();
        match &self.listing {
            Listing::OpenVdb(listing) => &listing.metadata,
            Listing::NanoVdb(_) => NONE,
        }
    }

    /// What was left out of the list, in words.
    pub fn notes(&self) -> &[String] {
        match &self.listing {
            Listing::OpenVdb(listing) => &listing.notes,
            Listing::NanoVdb(listing) => &listing.notes,
        }
    }

    /// The place of the first grid of a name.
    pub fn find(&self, name: &str) -> Option<usize> {
        self.infos.iter().position(|info| info.name == name)
    }

    /// Reads the first grid of a name.
    ///
    /// # Errors
    ///
    /// If there is none, and as [`VolumeFile::read`].
    pub fn read_named(&self, name: &str) -> Result<Grid> {
        let Some(index) = self.find(name) else {
            let names: Vec<&str> = self.infos.iter().map(|info| info.name.as_str()).collect();
            return Err(VolumeError::whole(&self.name, format!("there is no grid '{name}'; it has {}", names.join(", "))));
        };
        self.read(index)
    }

    /// Reads the grid at a place of [`VolumeFile::grids`]. It takes [`GridInfo::memory`] bytes.
    ///
    /// # Errors
    ///
    /// If there is none, it cannot be read or the file is damaged.
    pub fn read(&self, index: usize) -> Result<Grid> {
        let Some(info) = self.infos.get(index) else {
            return Err(VolumeError::whole(&self.name, format!("there is no grid {index}; it has {}", self.infos.len())));
        };
        let refused = info.refused.clone().or_else(|| info.transform.is_none().then(|| "it has no transform".into()));
        let (None, Some(transform)) = (refused.clone(), info.transform) else {
            return Err(VolumeError::whole(&self.name, format!("grid '{}': {}", info.name, refused.unwrap_or_default())));
        };
        let mut stream = Stream::open(&self.source, &self.name)?;
        match &self.listing {
            Listing::OpenVdb(listing) => vdb::read(&mut stream, listing, &listing.entries[index], transform),
            Listing::NanoVdb(listing) => nano::read(&mut stream, listing, index, transform),
        }
    }
}
