//! The grids of a file, without their voxels.

use super::layout::{self, Layout};
use super::read::{Visitor, walk};
use crate::grid::{Extent, bytes};
use crate::stream::Stream;
use crate::{Brick, GridClass, GridInfo, Result, Tile, Transform, blosc};
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;

/// Bytes of a grid's first structure and of the tree's, which follows.
pub(super) const GRID_HEADER: usize = 672;
pub(super) const TREE_HEADER: usize = 64;

/// Blosc chunks hold at most so many bytes.
const CHUNK: u64 = 1 << 30;

/// No packer that is read makes more bytes of one.
const MOST_OF_ZIP: u64 = 1032;
const MOST_OF_LZ4: u64 = 255;

/// All of a file but its voxels.
#[derive(Clone, Debug)]
pub(crate) struct Listing {
    version: u32,
    pub(crate) entries: Vec<Entry>,
    /// What was left out, in words.
    pub(crate) notes: Vec<String>,
}

/// A grid and where its block is.
#[derive(Clone, Debug)]
pub(crate) struct Entry {
    pub(crate) info: GridInfo,
    pub(crate) layout: Option<Layout>,
    start: u64,
    packed: u64,
    size: u64,
    codec: Codec,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Codec {
    None,
    Zip,
    Blosc,
}

impl Listing {
    pub(crate) fn version(&self) -> String {
        format!("{}.{}.{}", self.version >> 21, self.version >> 10 & 0x7ff, self.version & 0x3ff)
    }
}

/// Reads everything, and keeps all but voxels.
pub(crate) fn list(stream: &mut Stream) -> Result<Listing> {
    let mut listing = Listing { version: 0, entries: Vec::new(), notes: Vec::new() };
    while stream.remaining() > 0 {
        let start = stream.position();
        let magic: [u8; 8] = stream.array()?;
        if !super::is_magic(magic) {
            return Err(stream.error_at(start, "neither a segment nor a grid of NanoVDB"));
        }
        let version = stream.u32()?;
        // Files and raw grids once began alike; where a file has its version, a raw grid has a checksum.
        let raw = magic[7] == b'1' || (magic[7] == b'0' && version >> 21 != 32);
        if raw {
            raw_grid(stream, start, &mut listing)?;
        } else {
            check_version(stream, version, start)?;
            listing.version = version;
            segment(stream, &mut listing)?;
        }
    }
    for entry in &mut listing.entries {
        // What is wrong with one grid does not spoil the others.
        if let Err(error) = describe(stream, entry) {
            entry.info.refused = Some(error.in_file());
        }
    }
    Ok(listing)
}

fn check_version(stream: &Stream, version: u32, start: u64) -> Result<()> {
    if version >> 21 == 32 {
        return Ok(());
    }
    let problem = format!(
        "NanoVDB's version {}.{}; versions 32.x are read: convert the grid anew with nanovdb_convert",
        version >> 21,
        version >> 10 & 0x7ff
    );
    Err(stream.error_at(start, problem))
}

fn segment(stream: &mut Stream, listing: &mut Listing) -> Result<()> {
    let count = u16::from_le_bytes(stream.array()?);
    stream.skip(2)?;
    stream.expect(u64::from(count) * 176, "the grids' records")?;
    let first = listing.entries.len();
    for _ in 0..count {
        let size = stream.u64()?;
        let packed = stream.u64()?;
        stream.skip(16)?;
        let kind = stream.u32()?;
        stream.skip(4 + 48 + 24 + 24)?;
        let name_size = stream.u32()?;
        stream.skip(16 + 12)?;
        let number = u16::from_le_bytes(stream.array()?);
        let codec = [Codec::None, Codec::Zip, Codec::Blosc].get(usize::from(number)).copied();
        let codec = codec.ok_or_else(|| stream.error(format!("an unknown way of packing, {number}")))?;
        stream.skip(6)?;
        let mut name = Vec::new();
        stream.fill(&mut name, name_size.into(), "a grid's name")?;
        listing.entries.push(entry(text(&name), kind, [0, packed, size], codec));
    }
    for entry in &mut listing.entries[first..] {
        entry.start = stream.position();
        stream.skip(entry.packed)?;
    }
    Ok(())
}

fn raw_grid(stream: &mut Stream, start: u64, listing: &mut Listing) -> Result<()> {
    stream.skip(4)?;
    let version = stream.u32()?;
    check_version(stream, version, start)?;
    listing.version = version;
    stream.skip(12)?;
    let size = stream.u64()?;
    let mut name = Vec::new();
    stream.fill(&mut name, 256, "a grid's name")?;
    stream.skip(264 + 48 + 24 + 4)?;
    let kind = stream.u32()?;
    stream.seek(start)?;
    stream.skip(size.max(GRID_HEADER as u64))?;
    listing.entries.push(entry(text(&name), kind, [start, size, size], Codec::None));
    Ok(())
}

fn entry(name: String, kind: u32, [start, packed, size]: [u64; 3], codec: Codec) -> Entry {
    let mut info = GridInfo::new(name, layout::name(kind));
    info.compression = ["none", "zip", "blosc"][codec as usize].into();
    Entry { info, layout: Layout::of_type(kind), start, packed, size, codec }
}

/// A text up to its end or a zero.
fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes.split(|byte| *byte == 0).next().unwrap_or_default()).into_owned()
}

/// Fills in what the block alone tells.
fn describe(stream: &mut Stream, entry: &mut Entry) -> Result<()> {
    let Some(layout) = entry.layout else {
        let kind = &entry.info.value_type;
        entry.info.refused = Some(format!("grids of {kind} are not read; convert it from OpenVDB as float, Fp4, Fp8, Fp16, FpN or Vec3f"));
        return Ok(());
    };
    let block = block(stream, entry)?;
    let info = &mut entry.info;
    info.storage = layout.storage();
    let class = u32::from_le_bytes(block[632..636].try_into().unwrap_or_default());
    let classes = [GridClass::Unknown, GridClass::LevelSet, GridClass::FogVolume, GridClass::Staggered];
    info.class = classes.get(class as usize).copied().unwrap_or(GridClass::Other);
    let transform = transform(&block);
    match transform.problem() {
        None => info.transform = Some(transform),
        problem => info.refused = problem,
    }
    let mut counter = Counter::default();
    walk(&block, layout, &mut counter).map_err(|problem| stream.error_at(entry.start, problem))?;
    info.active_voxels = counter.extent.active;
    info.bounds = counter.extent.bounds();
    (info.bricks, info.tiles) = (counter.bricks, counter.tiles);
    info.memory = bytes(counter.bricks, counter.tiles, info.storage);
    Ok(())
}

/// From a matrix for columns, and a translation.
fn transform(block: &[u8]) -> Transform {
    let real = |at: usize| f64::from_le_bytes(block[at..at + 8].try_into().unwrap_or_default());
    let mut rows = [[0.0, 0.0, 0.0, 0.0]; 4];
    for (row, values) in rows.iter_mut().enumerate() {
        for (column, value) in values.iter_mut().take(3).enumerate() {
            *value = if row == 3 { real(528 + 8 * column) } else { real(384 + 8 * (3 * column + row)) };
        }
    }
    rows[3][3] = 1.0;
    Transform(rows)
}

/// A grid's block, unpacked; at least as long as its two headers.
pub(super) fn block(stream: &mut Stream, entry: &Entry) -> Result<Vec<u8>> {
    stream.seek(entry.start)?;
    let wrong = |stream: &Stream, problem: String| stream.error_at(entry.start, format!("grid '{}': {problem}", entry.info.name));
    let most = match entry.codec {
        Codec::None => 1,
        Codec::Zip => MOST_OF_ZIP,
        Codec::Blosc => MOST_OF_LZ4,
    };
    if entry.size > entry.packed.saturating_mul(most) || entry.size < (GRID_HEADER + TREE_HEADER) as u64 {
        return Err(wrong(stream, format!("a block of {} bytes in {}", entry.size, entry.packed)));
    }
    let mut bytes = Vec::new();
    match entry.codec {
        Codec::None => stream.fill(&mut bytes, entry.size, "a grid")?,
        Codec::Zip => {
            let size = stream.u64()?;
            let mut packed = Vec::new();
            stream.fill(&mut packed, size, "a packed grid")?;
            bytes = decompress_to_vec_zlib_with_limit(&packed, entry.size as usize).map_err(|error| wrong(stream, error.to_string()))?;
        }
        Codec::Blosc => {
            while (bytes.len() as u64) < entry.size {
                let size = stream.u64()?;
                let mut packed = Vec::new();
                stream.fill(&mut packed, size, "a packed grid")?;
                let at = bytes.len();
                let chunk = (entry.size - at as u64).min(CHUNK);
                bytes.resize(at + chunk as usize, 0);
                blosc::unpack(&packed, &mut bytes[at..]).map_err(|problem| wrong(stream, problem))?;
            }
        }
    }
    if bytes.len() as u64 != entry.size {
        return Err(wrong(stream, format!("{} bytes, expected {}", bytes.len(), entry.size)));
    }
    Ok(bytes)
}

#[derive(Default)]
struct Counter {
    extent: Extent,
    bricks: u64,
    tiles: u64,
}

impl Visitor for Counter {
    fn leaf(&mut self, leaf: Brick, _: &[u8], _: u32) {
        self.bricks += 1;
        self.extent.add_brick(&leaf);
    }

    fn tile(&mut self, tile: Tile) {
        self.tiles += 1;
        self.extent.add_tile(&tile);
    }
}
