//! Nodes whose bytes are written here by hand, after OpenVDB's `io/Compression.h`.

use super::packing::{Compression, Unpacker};
use crate::stream::{Source, Stream};
use crate::value::ValueType;

/// Every second of 64 places is active.
const MASK: [u64; 1] = [0x5555_5555_5555_5555];
/// The first half of the places.
const CHOSEN: u64 = 0xffff_ffff;
const BACKGROUND: f32 = 3.0;

fn bytes(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn active() -> Vec<f32> {
    (0..32).map(|n| 100.0 + n as f32).collect()
}

fn read(node: &[u8], compression: Compression, value: &str, halved: bool) -> Result<Vec<f32>, String> {
    let mut stream = Stream::open(&Source::Memory(node.into()), &"node".into()).unwrap();
    let mut unpacker = Unpacker::new(ValueType::named(value, halved).unwrap(), 224, compression);
    unpacker.background = [BACKGROUND; 4];
    let mut values = Vec::new();
    unpacker.values(&mut stream, 64, &MASK, &mut values).map_err(|error| error.to_string())?;
    assert_eq!(stream.remaining(), 0, "all bytes are read");
    // Going past a node takes as many bytes as reading it.
    let mut stream = Stream::open(&Source::Memory(node.into()), &"node".into()).unwrap();
    unpacker.skip(&mut stream, 64, &MASK).unwrap();
    assert_eq!(stream.remaining(), 0, "all bytes are gone past");
    Ok(values)
}

/// What inactive places hold in each of the seven ways: in the first half and in the second.
#[test]
fn inactive_values_come_back_in_all_seven_ways() {
    let masked = Compression { active_mask: true, ..Compression::NONE };
    let cases: [(u8, &[f32], bool, [f32; 2]); 6] = [
        (0, &[], false, [BACKGROUND; 2]),
        (1, &[], false, [-BACKGROUND; 2]),
        (2, &[7.0], false, [7.0; 2]),
        (3, &[], true, [BACKGROUND, -BACKGROUND]),
        (4, &[7.0], true, [BACKGROUND, 7.0]),
        (5, &[7.0, 8.0], true, [8.0, 7.0]),
    ];
    for (way, told, selects, inactive) in cases {
        let mut node = vec![way];
        node.extend(bytes(told));
        node.extend(if selects { CHOSEN.to_le_bytes().to_vec() } else { Vec::new() });
        node.extend(bytes(&active()));
        let expected: Vec<f32> = (0..64).map(|n| if n % 2 == 0 { active()[n / 2] } else { inactive[n / 32] }).collect();
        assert_eq!(read(&node, masked, "float", false), Ok(expected), "way {way}");
    }
    let all: Vec<f32> = (0..64).map(|n| n as f32).collect();
    let mut node = vec![6];
    node.extend(bytes(&all));
    assert_eq!(read(&node, masked, "float", false), Ok(all));
    assert!(read(&[7], masked, "float", false).unwrap_err().contains("way 7"));
}

/// Halves: told values are in full, stored ones of two bytes; where none is stored, not even a length is.
#[test]
fn halves_and_packed_arrays() {
    let masked = Compression { active_mask: true, zip: true, blosc: false };
    let stored: Vec<u8> = active().iter().flat_map(|x| half::f16::from_f32(*x).to_le_bytes()).collect();
    let mut node = vec![2];
    node.extend(bytes(&[7.0]));
    let packed = miniz_oxide::deflate::compress_to_vec_zlib(&stored, 6);
    node.extend((packed.len() as i64).to_le_bytes());
    node.extend(packed);
    let expected: Vec<f32> = (0..64).map(|n| if n % 2 == 0 { active()[n / 2] } else { 7.0 }).collect();
    assert_eq!(read(&node, masked, "float", true), Ok(expected.clone()));
    let mut plain = vec![2];
    plain.extend(bytes(&[7.0]));
    plain.extend((-(stored.len() as i64)).to_le_bytes());
    plain.extend(&stored);
    assert_eq!(read(&plain, masked, "float", true), Ok(expected));
    plain[5..13].copy_from_slice(&(-3i64).to_le_bytes());
    assert!(read(&plain, masked, "float", true).unwrap_err().contains("an array of 3 bytes, expected 64"));
}

/// The negative of yes is no.
#[test]
fn whole_numbers_and_yes_and_no() {
    let mut node = vec![1];
    node.extend((0..32).flat_map(|n: i32| n.to_le_bytes()));
    let values = read(&node, Compression { active_mask: true, ..Compression::NONE }, "int32", false).unwrap();
    assert_eq!(values[..4], [0.0, -BACKGROUND, 1.0, -BACKGROUND]);
    let mut unpacker = Unpacker::new(ValueType::named("bool", false).unwrap(), 224, Compression { active_mask: true, ..Compression::NONE });
    unpacker.background = [1.0; 4];
    let mut node = vec![1];
    node.extend([1u8; 32]);
    let mut stream = Stream::open(&Source::Memory(node.into()), &"node".into()).unwrap();
    let mut values = Vec::new();
    unpacker.values(&mut stream, 64, &MASK, &mut values).unwrap();
    assert_eq!(values[..4], [1.0, 0.0, 1.0, 0.0]);
}
