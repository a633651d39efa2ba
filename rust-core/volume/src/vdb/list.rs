//! The grids of a file, without their voxels.

use super::packing::{Compression, Unpacker};
use super::tree::{self, CONFIGURATION, Visitor};
use super::{HALF_SUFFIX, MAGIC, SEPARATOR};
use crate::grid::{Extent, bytes};
use crate::stream::Stream;
use crate::value::ValueType;
use crate::{Brick, GridClass, GridInfo, MetadataMap, Result, Tile, metadata, transform};

/// All of a file but its voxels.
#[derive(Clone, Debug)]
pub(crate) struct Listing {
    pub(crate) version: u32,
    pub(crate) library: [u32; 2],
    pub(crate) metadata: MetadataMap,
    pub(crate) entries: Vec<Entry>,
    /// What was left out, in words.
    pub(crate) notes: Vec<String>,
}

/// A grid and where its tree begins and ends.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    /// The name, with a number if others have the same.
    unique: String,
    pub(crate) info: GridInfo,
    pub(crate) tree: Option<TreePlace>,
}

/// A tree in the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TreePlace {
    pub(crate) value: ValueType,
    pub(crate) compression: Compression,
    pub(crate) start: u64,
    pub(crate) end: u64,
}

struct Header {
    version: u32,
    library: [u32; 2],
    /// Grids tell where they end.
    offsets: bool,
    /// What holds for all grids of files before version 222.
    compression: Compression,
}

/// Reads everything but voxels.
pub(crate) fn list(stream: &mut Stream) -> Result<Listing> {
    let header = header(stream)?;
    let metadata = metadata::read(stream)?;
    let count = stream.i32()?;
    let Ok(count) = u64::try_from(count) else {
        return Err(stream.error(format!("a file of {count} grids")));
    };
    stream.expect(count * 36, "the grids")?;
    let mut listing = Listing { version: header.version, library: header.library, metadata, entries: Vec::new(), notes: Vec::new() };
    for index in 0..count {
        let entry = descriptor(stream, &header, &listing.entries)?;
        let lost = !header.offsets && entry.tree.is_none() && entry.info.instance_of.is_none();
        listing.entries.push(entry);
        if lost && index + 1 < count {
            let after = listing.entries.last().map_or("", |entry| &entry.info.name);
            let left = count - index - 1;
            listing
                .notes
                .push(format!("{left} grids after '{after}' cannot be found: the file was written as a stream, without their places"));
            break;
        }
    }
    Ok(listing)
}

fn header(stream: &mut Stream) -> Result<Header> {
    if stream.array()? != MAGIC {
        return Err(stream.error_at(0, "not an OpenVDB file"));
    }
    let version = stream.u32()?;
    if !(220..=225).contains(&version) {
        let hint = if version < 220 { "save it again with a newer OpenVDB" } else { "save it with an older OpenVDB, such as 12" };
        return Err(stream.error_at(8, format!("OpenVDB's file version {version}; versions 220 to 225 are read: {hint}")));
    }
    let library = [stream.u32()?, stream.u32()?];
    let offsets = stream.u8()? != 0;
    let zip = version < 222 && stream.u8()? != 0;
    // The file's identifier.
    stream.skip(36)?;
    Ok(Header { version, library, offsets, compression: Compression { zip, ..Compression::NONE } })
}

/// One grid; the stream stands at its end afterwards if that is known.
fn descriptor(stream: &mut Stream, header: &Header, before: &[Entry]) -> Result<Entry> {
    let unique = stream.text()?;
    let kind = stream.text()?;
    let parent = stream.text()?;
    let start = stream.position();
    let [_, _, end] = [stream.i64()?, stream.i64()?, stream.i64()?];
    let name = unique.split(SEPARATOR).next().unwrap_or_default().to_owned();
    let (short, halved) = kind.strip_suffix(HALF_SUFFIX).map_or((kind.as_str(), false), |short| (short, true));
    let value_name = short.strip_prefix("Tree_").and_then(|rest| rest.strip_suffix(CONFIGURATION)).unwrap_or(short);
    let value_type = if halved { format!("{value_name} (half)") } else { value_name.to_owned() };
    let mut entry = Entry { unique, info: GridInfo::new(name, value_type), tree: None };
    if !header.offsets {
        grid(stream, header, &mut entry, ValueType::named(value_name, halved), &parent, before)?;
        return Ok(entry);
    }
    let end = u64::try_from(end)
        .ok()
        .filter(|end| *end >= stream.position())
        .ok_or_else(|| stream.error_at(start, format!("the grid '{}' ends at byte {end}, before it begins", entry.info.name)))?;
    if end > stream.size() {
        let problem = format!("the grid '{}' ends at byte {end}, but the file has {}: it is truncated", entry.info.name, stream.size());
        return Err(stream.error_at(start, problem));
    }
    stream.limit(end);
    // What is wrong with one grid does not spoil the others.
    if let Err(error) = grid(stream, header, &mut entry, ValueType::named(value_name, halved), &parent, before) {
        entry.info.refused = Some(error.in_file());
        entry.tree = None;
    }
    stream.seek(end)?;
    Ok(entry)
}

/// What stands before a grid's tree, and the tree's masks.
fn grid(stream: &mut Stream, header: &Header, entry: &mut Entry, value: Option<ValueType>, parent: &str, before: &[Entry]) -> Result<()> {
    let mut compression = header.compression;
    if header.version >= 222 {
        let flags = stream.u32()?;
        compression = Compression::from_flags(flags).ok_or_else(|| stream.error(format!("an unknown way of compression, {flags:#x}")))?;
    }
    let info = &mut entry.info;
    info.compression = compression.name();
    info.metadata = metadata::read(stream)?;
    info.class = metadata::text(&info.metadata, "class").map_or(GridClass::Unknown, GridClass::named);
    let transform = transform::read(stream, header.version)?;
    info.transform = transform.as_ref().ok().copied();
    info.refused = transform.err();
    if !parent.is_empty() {
        share(entry, parent, before);
        return Ok(());
    }
    let Some(value) = value else {
        info.refused = Some(refusal(&info.value_type));
        return Ok(());
    };
    match value.storage() {
        Some(storage) => info.storage = storage,
        None => info.refused = Some(refusal(&info.value_type)),
    }
    let start = stream.position();
    let tree_end = masks(stream, header, info, value, compression)?;
    entry.tree = Some(TreePlace { value, compression, start, end: tree_end });
    Ok(())
}

fn refusal(value_type: &str) -> String {
    if value_type.starts_with("pt") {
        return "a grid of points, not of values".into();
    }
    format!("grids of {value_type:.40} are not read; float, double, half, vec3s, vec3d, vec3i, bool, mask and whole numbers are")
}

/// Reads a tree's masks; gives where the tree ends, if voxels must be gone past, or where the grid does.
fn masks(stream: &mut Stream, header: &Header, info: &mut GridInfo, value: ValueType, compression: Compression) -> Result<u64> {
    let mut unpacker = Unpacker::new(value, header.version, compression);
    let mut counter = Counter::default();
    tree::topology(stream, &mut unpacker, &mut counter)?;
    info.active_voxels = counter.extent.active;
    info.bounds = counter.extent.bounds();
    (info.bricks, info.tiles) = (counter.bricks, counter.tiles);
    info.memory = bytes(counter.bricks, counter.tiles, info.storage);
    // Each leaf has its mask a second time.
    stream.expect(counter.bricks * 64, "the voxels")?;
    if header.offsets {
        return Ok(stream.position() + stream.remaining());
    }
    for _ in 0..counter.bricks {
        tree::skip_leaf(stream, &mut unpacker)?;
    }
    Ok(stream.position())
}

/// Takes the tree of another grid.
fn share(entry: &mut Entry, parent: &str, before: &[Entry]) {
    let name = parent.replace(SEPARATOR, " ");
    entry.info.instance_of = Some(name.clone());
    let Some(other) = before.iter().find(|other| other.unique == parent) else {
        entry.info.refused = Some(format!("it shares the voxels of '{name}', which is not in the file before it"));
        return;
    };
    entry.tree = other.tree;
    let (info, shared) = (&mut entry.info, &other.info);
    info.value_type.clone_from(&shared.value_type);
    info.storage = shared.storage;
    (info.active_voxels, info.bounds) = (shared.active_voxels, shared.bounds);
    (info.bricks, info.tiles, info.memory) = (shared.bricks, shared.tiles, shared.memory);
    if entry.tree.is_none() || info.storage_refused(shared) {
        info.refused = Some(format!("it shares the voxels of '{name}', which cannot be read"));
    }
}

impl GridInfo {
    /// Whether the voxels of a grid, and not only its transform, cannot be read.
    fn storage_refused(&self, shared: &Self) -> bool {
        shared.refused.is_some() && shared.transform.is_some()
    }
}

#[derive(Default)]
struct Counter {
    extent: Extent,
    bricks: u64,
    tiles: u64,
}

impl Visitor for Counter {
    fn root_child(&mut self, _: [i32; 3]) {}

    fn leaf(&mut self, leaf: Brick) {
        self.bricks += 1;
        self.extent.add_brick(&leaf);
    }

    fn tile(&mut self, tile: Tile) {
        self.tiles += 1;
        self.extent.add_tile(&tile);
    }
}
