//! Archives that are written: deflated files without a time, so that the same files make the same bytes.

use crate::error::{FormatError, Result};
use miniz_oxide::deflate::compress_to_vec;
use rawzip::{CompressionMethod, DataDescriptorOutput, ZipArchiveWriter};
use std::io::Write;

/// Of zlib's levels the usual one.
const LEVEL: u8 = 6;

/// The bytes of an archive of files by their names with folders, in that order.
///
/// # Errors
/// A name that no archive can hold.
pub(crate) fn packed(files: &[(&str, &[u8])]) -> Result<Vec<u8>> {
    write(files).map_err(|error| FormatError::whole(format!("no ZIP archive can be made: {error}")))
}

fn write(files: &[(&str, &[u8])]) -> std::result::Result<Vec<u8>, rawzip::Error> {
    let mut archive = ZipArchiveWriter::new(Vec::new());
    for (name, content) in files {
        let (mut entry, _) = archive.new_file(*name).compression_method(CompressionMethod::DEFLATE).start()?;
        entry.write_all(&compress_to_vec(content, LEVEL))?;
        entry.finish(DataDescriptorOutput::new(crc32fast::hash(content), content.len() as u64))?;
    }
    archive.finish()
}
