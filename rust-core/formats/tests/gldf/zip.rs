//! ZIP archives for tests, with sizes that may lie.

use miniz_oxide::deflate::compress_to_vec;

/// A file for an archive: name, bytes, and the size that the archive states.
pub(crate) struct Packed<'a>(pub(crate) &'a str, pub(crate) &'a [u8], pub(crate) u32);

/// An archive of deflated files (APPNOTE 6.3, sections 4.3.7, 4.3.12 and 4.3.16).
pub(crate) fn archive(files: &[(&str, &[u8])]) -> Vec<u8> {
    packed(&files.iter().map(|(name, bytes)| Packed(name, bytes, bytes.len() as u32)).collect::<Vec<_>>())
}

/// The same with stated sizes.
pub(crate) fn packed(files: &[Packed<'_>]) -> Vec<u8> {
    let (mut bytes, mut directory) = (Vec::new(), Vec::new());
    for Packed(name, content, size) in files {
        let deflated = compress_to_vec(content, 6);
        let offset = bytes.len() as u32;
        let mut common = Vec::new();
        // Version 2.0, names in UTF-8, deflated, no time.
        [20_u16, 0x800, 8, 0, 0].iter().for_each(|word| common.extend(word.to_le_bytes()));
        [crc32fast::hash(content), deflated.len() as u32, *size].iter().for_each(|word| common.extend(word.to_le_bytes()));
        [name.len() as u16, 0].iter().for_each(|word| common.extend(word.to_le_bytes()));
        bytes.extend(b"PK\x03\x04");
        bytes.extend(&common);
        bytes.extend(name.as_bytes());
        bytes.extend(deflated);
        directory.extend(b"PK\x01\x02\x14\0");
        directory.extend(common);
        directory.extend([0; 10]);
        directory.extend(offset.to_le_bytes());
        directory.extend(name.as_bytes());
    }
    let (start, length, count) = (bytes.len() as u32, directory.len() as u32, files.len() as u16);
    bytes.extend(directory);
    bytes.extend(b"PK\x05\x06\0\0\0\0");
    [count, count].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    [length, start].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    bytes.extend([0; 2]);
    bytes
}
