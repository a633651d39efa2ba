//! Codes of a picture as text: differences from what neighbours let expect, deflated, in base 64.

use super::codes::Steps;
use base64::{Engine, engine::general_purpose::STANDARD};
use miniz_oxide::deflate::compress_to_vec_zlib;

/// Of zlib: higher ones take several times as long for a hundredth.
const LEVEL: u8 = 6;
/// What stands in the place of no difference between channels.
const EVEN: u16 = 1 << 15;

/// A group's light as a page holds it, before base 64: green, red less green, blue less green; of each the low bytes, then the high ones.
pub(super) fn packed(values: &[f32], width: usize, steps: Steps) -> Vec<u8> {
    let codes: Vec<[u16; 3]> = values.as_chunks::<3>().0.iter().map(|colour| colour.map(|light| steps.code(light))).collect();
    let difference = |a: u16, b: u16| a.wrapping_sub(b).wrapping_add(EVEN);
    let of = |channel: usize, code: &[u16; 3]| if channel == 1 { code[1] } else { difference(code[channel], code[1]) };
    let mut bytes = Vec::with_capacity(6 * codes.len());
    for channel in [1, 0, 2] {
        let plane: Vec<u16> = codes.iter().map(|code| of(channel, code)).collect();
        let residues = residues(&plane, width);
        bytes.extend(residues.iter().map(|residue| *residue as u8));
        bytes.extend(residues.iter().map(|residue| (residue >> 8) as u8));
    }
    compress_to_vec_zlib(&bytes, LEVEL)
}

/// In base 64 (RFC 4648, section 4).
pub(super) fn text(bytes: &[u8]) -> String {
    STANDARD.encode(bytes)
}

/// What the median edge detector of JPEG-LS (ITU-T T.87, A.4.1) does not foresee, folded to small numbers: 0, -1, 1, -2, ...
fn residues(plane: &[u16], width: usize) -> Vec<u16> {
    let expected = |at: usize| -> u16 {
        let (x, y) = (at % width, at / width);
        match (x, y) {
            (0, 0) => 0,
            (_, 0) => plane[at - 1],
            (0, _) => plane[at - width],
            _ => expected(plane[at - 1], plane[at - width], plane[at - width - 1]),
        }
    };
    let folded = |difference: i16| ((difference << 1) ^ (difference >> 15)) as u16;
    plane.iter().enumerate().map(|(at, value)| folded(value.wrapping_sub(expected(at)) as i16)).collect()
}

/// From the values at the left, above, and above at the left.
fn expected(left: u16, above: u16, corner: u16) -> u16 {
    let (least, most) = (left.min(above), left.max(above));
    if corner >= most {
        least
    } else if corner <= least {
        most
    } else {
        left.wrapping_add(above).wrapping_sub(corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use miniz_oxide::inflate::decompress_to_vec_zlib;

    /// The reader's side, as `web/decode.js` has it.
    fn unpacked(bytes: &[u8], width: usize, height: usize) -> Vec<[u16; 3]> {
        let bytes = decompress_to_vec_zlib(bytes).expect("a zlib stream");
        let count = width * height;
        let mut planes = [const { Vec::new() }; 3];
        for (number, plane) in planes.iter_mut().enumerate() {
            for at in 0..count {
                let folded = u16::from(bytes[2 * number * count + at]) | u16::from(bytes[(2 * number + 1) * count + at]) << 8;
                let residue = (folded >> 1) ^ 0u16.wrapping_sub(folded & 1);
                let from = match (at % width, at / width) {
                    (0, 0) => 0,
                    (_, 0) => plane[at - 1],
                    (0, _) => plane[at - width],
                    _ => expected(plane[at - 1], plane[at - width], plane[at - width - 1]),
                };
                plane.push(residue.wrapping_add(from));
            }
        }
        let plus = |a: u16, b: u16| a.wrapping_add(b).wrapping_sub(EVEN);
        (0..count).map(|at| [plus(planes[1][at], planes[0][at]), planes[0][at], plus(planes[2][at], planes[0][at])]).collect()
    }

    #[test]
    fn codes_come_back() {
        let mut state = 7u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as f32 / 16_777_216.0
        };
        for [width, height] in [[1, 1], [5, 1], [1, 6], [17, 9]] {
            let values: Vec<f32> =
                (0..3 * width * height).map(|_| if next() < 0.2 { 0.0 } else { 10f32.powf(8.0 * next() - 4.0) }).collect();
            let steps = Steps::of(&values, 96);
            let expected: Vec<[u16; 3]> = values.as_chunks::<3>().0.iter().map(|colour| colour.map(|x| steps.code(x))).collect();
            assert_eq!(unpacked(&packed(&values, width, steps), width, height), expected);
        }
    }

    #[test]
    fn even_light_takes_little_room() {
        let values = vec![12.5; 3 * 256 * 256];
        assert!(packed(&values, 256, Steps::of(&values, 96)).len() < 1000);
    }
}
