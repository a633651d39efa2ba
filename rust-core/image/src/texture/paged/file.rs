//! The file of a texture's tiles: a header, the tiles, compressed, and behind them where each ends and what checks it.
//!
//! Numbers are in the machine's own order of bytes, for caches are not carried about. A file that another order or version wrote is as good
//! as none.

use super::codec;
use super::layout::TileLayout;
use crate::colour::Transfer;
use crate::texture::texel::TexelFormat;
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Of what is written here; another number makes all files anew.
pub(crate) const VERSION: u32 = 2;
const MAGIC: [u8; 8] = *b"gonioTEX";
const ORDER: u32 = 0x0102_0304;
const HEADER: usize = 64;
const FORMATS: [TexelFormat; 4] = [TexelFormat::Byte, TexelFormat::Grey, TexelFormat::Half, TexelFormat::Float];
const TRANSFERS: [Transfer; 6] =
    [Transfer::Linear, Transfer::Srgb, Transfer::Gamma18, Transfer::Gamma22, Transfer::Gamma24, Transfer::AdobeRgb];
/// Tiles that are compressed side by side before they are written.
const AT_ONCE: u32 = 256;
/// Files that stay open; further ones are opened at every read, for systems allow a process no more than a thousand or so.
const MOST_OPEN: usize = 256;
static OPEN: AtomicUsize = AtomicUsize::new(0);

/// What a texture is beside its texels.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TextureFacts {
    pub(crate) format: TexelFormat,
    pub(crate) transfer: Transfer,
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) note: Option<String>,
}

impl TextureFacts {
    pub(crate) fn layout(&self) -> TileLayout {
        TileLayout::new(self.format, self.width, self.height)
    }

    fn header(&self, key: u64) -> [u8; HEADER] {
        let place = |found: Option<usize>| found.unwrap_or_default() as u32;
        let format = place(FORMATS.iter().position(|format| *format == self.format));
        let transfer = place(TRANSFERS.iter().position(|transfer| *transfer == self.transfer));
        let note = self.note.as_ref().map_or(0, |note| note.len() as u32);
        let mut header = [0; HEADER];
        header[..8].copy_from_slice(&MAGIC);
        header[8..16].copy_from_slice(&key.to_ne_bytes());
        for (place, number) in [VERSION, ORDER, format, transfer, self.width, self.height, note].into_iter().enumerate() {
            header[16 + 4 * place..20 + 4 * place].copy_from_slice(&number.to_ne_bytes());
        }
        header
    }

    /// The facts of a header but for the note, whose length comes along.
    fn of_header(header: &[u8; HEADER], key: u64) -> Option<(Self, usize)> {
        let number = |place: usize| {
            let at = 16 + 4 * place;
            u32::from_ne_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]])
        };
        let is_ours = header[..8] == MAGIC && header[8..16] == key.to_ne_bytes() && number(0) == VERSION && number(1) == ORDER;
        let (width, height) = (number(4), number(5));
        let sides = 1..=1 << 20;
        if !is_ours || !sides.contains(&width) || !sides.contains(&height) {
            return None;
        }
        let (format, transfer) = (*FORMATS.get(number(2) as usize)?, *TRANSFERS.get(number(3) as usize)?);
        Some((Self { format, transfer, width, height, note: None }, number(6) as usize))
    }
}

/// A file of tiles that was found sound but for its tiles, which are checked one by one.
#[derive(Debug)]
pub(crate) struct TileFile {
    path: PathBuf,
    /// Nothing where too many files are open.
    open: Option<File>,
    /// Where the tiles begin, and where the last one ends.
    places: Vec<u64>,
    /// Checksums of the tiles' bytes in the file.
    sums: Vec<u32>,
}

impl Drop for TileFile {
    fn drop(&mut self) {
        if self.open.is_some() {
            OPEN.fetch_sub(1, Ordering::Relaxed);
        }
    }
}

/// Writes the tiles of a pyramid to a file that has no name yet to be read by.
pub(crate) fn write(path: &Path, facts: &TextureFacts, key: u64, pyramid: &[f32]) -> io::Result<()> {
    let layout = facts.layout();
    let mut file = BufWriter::with_capacity(1 << 20, File::create(path)?);
    let header = facts.header(key);
    file.write_all(&header)?;
    let (mut lengths, mut sums) = (Vec::with_capacity(layout.tiles() as usize), Vec::with_capacity(layout.tiles() as usize));
    for first in (0..layout.tiles()).step_by(AT_ONCE as usize) {
        let tiles = first..layout.tiles().min(first + AT_ONCE);
        let encoded: Vec<Vec<u8>> = tiles.into_par_iter().map(|tile| encoded(&layout, pyramid, tile)).collect();
        for bytes in encoded {
            lengths.push(bytes.len() as u32);
            sums.push(crc32fast::hash(&bytes));
            file.write_all(&bytes)?;
        }
    }
    let note = facts.note.as_deref().unwrap_or_default().as_bytes();
    let (lengths, sums): (&[u8], &[u8]) = (bytemuck::cast_slice(&lengths), bytemuck::cast_slice(&sums));
    for part in [lengths, sums, note] {
        file.write_all(part)?;
    }
    file.write_all(&sum_of([&header, lengths, sums, note]).to_ne_bytes())?;
    file.flush()
}

fn encoded(layout: &TileLayout, pyramid: &[f32], tile: u32) -> Vec<u8> {
    let mut words = Vec::new();
    layout.cut(pyramid, tile, &mut words);
    codec::encode(&words, layout.format(), layout.span(tile).width)
}

fn sum_of(parts: [&[u8]; 4]) -> u32 {
    let mut hasher = crc32fast::Hasher::new();
    parts.iter().for_each(|part| hasher.update(part));
    hasher.finalize()
}

impl TileFile {
    /// Opens a file that was written for `key`; `None` where it is damaged, cut short or of another kind.
    pub(crate) fn open(path: &Path, key: u64) -> io::Result<Option<(Self, TextureFacts)>> {
        let mut file = File::open(path)?;
        let mut header = [0; HEADER];
        if file.read_exact(&mut header).is_err() {
            return Ok(None);
        }
        let Some((mut facts, note)) = TextureFacts::of_header(&header, key) else { return Ok(None) };
        let tiles = facts.layout().tiles() as usize;
        let tail = 8 * tiles as u64 + note as u64 + 4;
        let Some(data) = file.metadata()?.len().checked_sub(HEADER as u64 + tail) else { return Ok(None) };
        file.seek(SeekFrom::Start(HEADER as u64 + data))?;
        let (mut lengths, mut sums, mut text, mut sum) = (vec![0_u32; tiles], vec![0_u32; tiles], vec![0; note], [0; 4]);
        file.read_exact(bytemuck::cast_slice_mut(&mut lengths))?;
        file.read_exact(bytemuck::cast_slice_mut(&mut sums))?;
        file.read_exact(&mut text)?;
        file.read_exact(&mut sum)?;
        let found = sum_of([&header, bytemuck::cast_slice(&lengths), bytemuck::cast_slice(&sums), &text]);
        let places = places(&lengths);
        if found != u32::from_ne_bytes(sum) || places.last() != Some(&(HEADER as u64 + data)) {
            return Ok(None);
        }
        facts.note = (note > 0).then(|| String::from_utf8_lossy(&text).into_owned());
        let may_stay_open = OPEN.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |open| (open < MOST_OPEN).then_some(open + 1)).is_ok();
        Ok(Some((Self { path: path.to_owned(), open: may_stay_open.then_some(file), places, sums }, facts)))
    }

    /// Reads a tile, and how many bytes it takes in the file; an error where it cannot be read or is not what was written.
    pub(crate) fn read(&self, layout: &TileLayout, tile: u32) -> io::Result<(Vec<f32>, usize)> {
        let (at, end) = (self.places[tile as usize], self.places[tile as usize + 1]);
        let length = (end - at) as usize;
        let mut bytes = vec![0; length + codec::PADDING];
        match &self.open {
            Some(file) => read_at(file, &mut bytes[..length], at)?,
            None => read_at(&File::open(&self.path)?, &mut bytes[..length], at)?,
        }
        let invalid = |what| io::Error::new(io::ErrorKind::InvalidData, what);
        if crc32fast::hash(&bytes[..length]) != self.sums[tile as usize] {
            return Err(invalid("a tile's checksum is wrong"));
        }
        let span = layout.span(tile);
        let mut words = vec![0.0_f32; span.width * span.height * layout.words()];
        codec::decode(&bytes, layout.format(), span.width, &mut words).ok_or_else(|| invalid("a tile is not as it was written"))?;
        Ok((words, length))
    }
}

/// Where tiles of these lengths begin, and where the last one ends.
fn places(lengths: &[u32]) -> Vec<u64> {
    let mut at = HEADER as u64;
    let ends = lengths.iter().map(|length| {
        at += u64::from(*length);
        at
    });
    std::iter::once(HEADER as u64).chain(ends).collect()
}

#[cfg(unix)]
fn read_at(file: &File, bytes: &mut [u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, bytes, at)
}

#[cfg(windows)]
fn read_at(file: &File, mut bytes: &mut [u8], mut at: u64) -> io::Result<()> {
    while !bytes.is_empty() {
        match std::os::windows::fs::FileExt::seek_read(file, bytes, at)? {
            0 => return Err(io::ErrorKind::UnexpectedEof.into()),
            count => (bytes, at) = (&mut bytes[count..], at + count as u64),
        }
    }
    Ok(())
}
