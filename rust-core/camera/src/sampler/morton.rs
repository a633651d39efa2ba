//! Morton numbers of a tile's pixels.

use super::BATCH;
use gonio_simd::{Lanes, U};

/// The even bits of a Morton number, packed: its column.
#[inline(always)]
pub fn morton_even<L: Lanes>(code: U<L>) -> U<L> {
    let x = code & 0x5555_5555;
    let x = (x | (x >> 1)) & 0x3333_3333;
    let x = (x | (x >> 2)) & 0x0f0f_0f0f;
    (x | (x >> 4)) & 0x00ff_00ff
}

/// The Morton number of a tile's pixel.
#[inline]
pub fn tile_code([x, y]: [usize; 2]) -> usize {
    let spread = |mut x: usize| {
        x = (x | (x << 4)) & 0x0f0f;
        x = (x | (x << 2)) & 0x3333;
        (x | (x << 1)) & 0x5555
    };
    spread(x) | spread(y) << 1
}

/// The column and row of a tile's pixel of this Morton number.
#[inline]
pub fn tile_place(code: usize) -> [usize; 2] {
    PLACES[code].map(usize::from)
}

/// Columns and rows by Morton number: whole tiles are gone through more than once a picture.
static PLACES: [[u8; 2]; BATCH] = places();

const fn places() -> [[u8; 2]; BATCH] {
    let mut places = [[0; 2]; BATCH];
    let mut code = 0;
    while code < BATCH {
        places[code] = [packed(code), packed(code >> 1)];
        code += 1;
    }
    places
}

/// The even bits, packed.
const fn packed(code: usize) -> u8 {
    let x = code & 0x5555;
    let x = (x | (x >> 1)) & 0x3333;
    let x = (x | (x >> 2)) & 0x0f0f;
    (x | (x >> 4)) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn morton_numbers_and_places_belong_together() {
        for code in 0..BATCH {
            assert_eq!(tile_code(tile_place(code)), code);
        }
    }
}
