//! NumPy's arrays (NEP 1): a magic, a header of Python's words, the numbers.

use super::Coefficients;
use gonio_formats::FormatError;

/// What files begin with.
pub(super) const MAGIC: &[u8] = b"\x93NUMPY";
/// Where numbers begin is a multiple of this.
const ALIGNMENT: usize = 64;
/// How to save what is read here.
const HINT: &str = "numpy.save(file, numpy.ascontiguousarray(array, numpy.float32)) writes what is read";

/// Reads points × columns, or blocks × points × columns.
pub(super) fn read(bytes: &[u8]) -> Result<Coefficients, FormatError> {
    let wrong = |what: &str| FormatError::whole(format!("{what}; {HINT}"));
    let (width, start): (usize, usize) = if bytes.get(6) == Some(&1) { (2, 10) } else { (4, 12) };
    let length = bytes.get(8..8 + width).ok_or_else(|| wrong("the array's header is cut off"))?;
    let length = length.iter().rev().fold(0_usize, |sum, byte| sum * 256 + usize::from(*byte));
    let head = bytes.get(start..start.saturating_add(length)).ok_or_else(|| wrong("the array's header is cut off"))?;
    let head = String::from_utf8_lossy(head);
    if !head.contains("'fortran_order': False") {
        return Err(wrong("the array is not in C's order"));
    }
    let shape = head.split_once("'shape': (").and_then(|(_, rest)| rest.split_once(')')).map(|(shape, _)| shape);
    let shape: Option<Vec<usize>> =
        shape.and_then(|shape| shape.split(',').map(str::trim).filter(|word| !word.is_empty()).map(|word| word.parse().ok()).collect());
    let (blocks, points, columns) = match shape.as_deref() {
        Some([points, columns]) => (1, *points, *columns),
        Some([blocks, points, columns]) => (*blocks, *points, *columns),
        _ => return Err(wrong("the array's shape is not points × columns or blocks × points × columns")),
    };
    let kind = head.split_once("'descr': '").map_or("", |(_, rest)| rest.get(..3).unwrap_or_default());
    let values = numbers(&bytes[start + length..], kind).ok_or_else(|| wrong("the array's numbers are not float32 or float64"))?;
    let size = points.checked_mul(columns).filter(|size| *size > 0);
    let size = size.ok_or_else(|| wrong("the array is empty"))?;
    if size.checked_mul(blocks) != Some(values.len()) {
        return Err(wrong(&format!("{} numbers were found, expected {blocks} × {points} × {columns}", values.len())));
    }
    Coefficients::new(points, columns, values.chunks_exact(size).map(<[f32]>::to_vec).collect())
}

fn numbers(bytes: &[u8], kind: &str) -> Option<Vec<f32>> {
    let four = |bytes: &[u8]| bytes.try_into().unwrap_or_default();
    let eight = |bytes: &[u8]| bytes.try_into().unwrap_or_default();
    match kind {
        "<f4" => Some(bytes.chunks_exact(4).map(|bytes| f32::from_le_bytes(four(bytes))).collect()),
        ">f4" => Some(bytes.chunks_exact(4).map(|bytes| f32::from_be_bytes(four(bytes))).collect()),
        "<f8" => Some(bytes.chunks_exact(8).map(|bytes| f64::from_le_bytes(eight(bytes)) as f32).collect()),
        ">f8" => Some(bytes.chunks_exact(8).map(|bytes| f64::from_be_bytes(eight(bytes)) as f32).collect()),
        _ => None,
    }
}

/// The bytes of an array of rows in 32-bit floats.
pub fn to_npy(rows: usize, columns: usize, values: &[f32]) -> Vec<u8> {
    let head = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let before = MAGIC.len() + 4;
    let padded = (before + head.len() + 1).next_multiple_of(ALIGNMENT) - before;
    let mut bytes = Vec::with_capacity(before + padded + 4 * values.len());
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&[1, 0]);
    bytes.extend_from_slice(&(padded as u16).to_le_bytes());
    bytes.extend_from_slice(format!("{head:<width$}\n", width = padded - 1).as_bytes());
    values.iter().for_each(|value| bytes.extend_from_slice(&value.to_le_bytes()));
    bytes
}
