//! OpenEXR's ZIPS: bytes told apart by their significance, differences, zlib (OpenEXR File Layout, "Data Compression").

use miniz_oxide::deflate::compress_to_vec_zlib;

/// Level of zlib: OpenEXR's own default.
const LEVEL: u8 = 4;

/// The bytes of a block as files hold them: compressed, or as they are where that is shorter.
pub(super) fn compress(bytes: Vec<u8>) -> Vec<u8> {
    let packed = compress_to_vec_zlib(&predicted(&apart(&bytes)), LEVEL);
    if packed.len() < bytes.len() { packed } else { bytes }
}

/// Even bytes first, then odd ones.
fn apart(bytes: &[u8]) -> Vec<u8> {
    let every_second = |first: usize| bytes.iter().skip(first).step_by(2).copied();
    every_second(0).chain(every_second(1)).collect()
}

/// Differences from byte to byte, 128 for none.
fn predicted(bytes: &[u8]) -> Vec<u8> {
    let mut before = bytes.first().map_or(0, |first| first.wrapping_sub(128));
    bytes
        .iter()
        .enumerate()
        .map(|(at, byte)| {
            let difference = if at == 0 { *byte } else { byte.wrapping_sub(before).wrapping_add(128) };
            before = *byte;
            difference
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_back() {
        let bytes: Vec<u8> = (0..999_u32).map(|i| (i * i / 70 % 256) as u8).collect();
        let packed = compress(bytes.clone());
        assert!(packed.len() < bytes.len());
        let mut out = miniz_oxide::inflate::decompress_to_vec_zlib(&packed).expect("zlib");
        for at in 1..out.len() {
            out[at] = out[at - 1].wrapping_add(out[at]).wrapping_sub(128);
        }
        let half = out.len().div_ceil(2);
        let back: Vec<u8> = (0..out.len()).map(|at| out[at / 2 + if at % 2 == 0 { 0 } else { half }]).collect();
        assert_eq!(back, bytes);
        assert_eq!(compress(vec![7]), [7]);
        assert_eq!(compress(Vec::new()), []);
    }
}
