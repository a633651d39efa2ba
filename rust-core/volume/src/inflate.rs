//! zlib streams of known size.

use miniz_oxide::inflate::decompress_slice_iter_to_slice;

/// Unpacks a stream that holds just as many bytes as `to` has room for.
pub(crate) fn inflate(packed: &[u8], to: &mut [u8]) -> Result<(), String> {
    let expected = to.len();
    match decompress_slice_iter_to_slice(to, std::iter::once(packed), true, false) {
        Ok(size) if size == expected => Ok(()),
        Ok(size) => Err(format!("a zlib stream of {size} bytes, expected {expected}")),
        Err(status) => Err(format!("a damaged zlib stream ({status:?})")),
    }
}
