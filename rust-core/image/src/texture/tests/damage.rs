//! Damaged files give errors, never panics or great allocations.

use super::formats::{Exr, ramp};
use super::made::{Random, bytes, coded, hdr, jpeg, png, tiff_of};
use crate::texture::{TextureErrorKind, decode};
use image::ImageFormat;

fn samples() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("png", png(&bytes(24, 20, 4, 1))),
        ("jpeg", jpeg(&bytes(24, 20, 3, 2))),
        ("hdr", hdr(24, 20, &[[0.25, 1.5, 3.0]; 480])),
        ("tiff", tiff_of(&bytes(24, 20, 3, 3))),
        ("webp", coded(ImageFormat::WebP)),
        ("avif", include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/usd/images/half_clear.avif")).to_vec()),
        ("gif", coded(ImageFormat::Gif)),
        ("bmp", coded(ImageFormat::Bmp)),
        ("tga", coded(ImageFormat::Tga)),
        ("exr", Exr::new(24, 20, vec![("R", ramp(480, 0.0)), ("G", ramp(480, 1.0)), ("B", ramp(480, 2.0))]).write()),
    ]
}

#[test]
fn truncated_files_are_refused() {
    for (format, file) in samples() {
        assert!(decode(&file).is_ok(), "{format}");
        for cut in (0..file.len() - 16).step_by(file.len() / 60 + 1) {
            let error = decode(&file[..cut]).expect_err(format);
            assert!(!error.what.is_empty() && !error.what.contains('\n'), "{format} cut at {cut}: {error}");
        }
    }
}

/// The largest address space this process has had, in KiB; zero where the system does not say.
fn peak_address_space() -> usize {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmPeak:"));
    line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0)
}

#[test]
fn mutations_neither_panic_nor_allocate() {
    let before = peak_address_space();
    let mut random = Random(0x1eaf);
    for (_, file) in samples() {
        for _ in 0..1500 {
            let mut damaged = file.clone();
            for _ in 0..1 + random.below(4) {
                // Headers matter most.
                let end = if random.below(2) == 0 { damaged.len().min(400) } else { damaged.len() };
                let at = random.below(end);
                damaged[at] = [random.next() as u8, 0, 0xff, damaged[at] ^ (1 << random.below(8))][random.below(4)];
            }
            if random.below(8) == 0 {
                damaged.truncate(random.below(damaged.len()));
            }
            let _ = decode(&damaged);
        }
    }
    let grown = peak_address_space().saturating_sub(before);
    assert!(grown < 2 << 20, "the address space grew by {grown} KiB");
}

#[test]
fn claims_beyond_the_file_are_refused() {
    // A PNG header that claims 60 000 × 60 000 texels (its checksum is right), then nothing.
    let mut file = png(&bytes(1, 1, 3, 1));
    file[16..20].copy_from_slice(&60_000_u32.to_be_bytes());
    file[20..24].copy_from_slice(&60_000_u32.to_be_bytes());
    let checksum = crc32(&file[12..29]).to_be_bytes();
    file[29..33].copy_from_slice(&checksum);
    assert_eq!(decode(&file).unwrap_err().kind, TextureErrorKind::TooLarge);
    let error = decode(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 9000 +X 9000\n").unwrap_err();
    assert!(error.what.contains("cannot hold"), "{error}");
    let error = decode(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 90000 +X 9000\n").unwrap_err();
    assert_eq!(error.kind, TextureErrorKind::TooLarge, "{error}");
    let error = decode(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 0 +X 0\n").unwrap_err();
    assert_eq!(error.kind, TextureErrorKind::Malformed, "{error}");
}

pub(super) fn crc32(bytes: &[u8]) -> u32 {
    !bytes
        .iter()
        .fold(!0_u32, |crc, byte| (0..8).fold(crc ^ u32::from(*byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg())))
}

#[test]
fn other_formats_are_named() {
    for (file, name) in [
        (&b"8BPS\0\x01"[..], "Photoshop"),
        (b"\0\0\0\x1cftypavif", "AVIF boxes"),
        (b"version https://git-lfs", "Git LFS"),
        (b"garbage", "no known"),
        (b"", "empty"),
    ] {
        let error = decode(file).unwrap_err();
        assert!(error.what.contains(name), "{error}");
    }
}
