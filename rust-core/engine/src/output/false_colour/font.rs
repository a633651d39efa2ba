//! Numbers and units in a grid of 5 × 7 dots.

/// Dots across a sign and down it, without the gap to the next.
pub(super) const SIZE: [usize; 2] = [5, 7];

/// Rows of a sign from the top, the leftmost dot in the highest of five bits; unknown signs are empty.
fn rows(sign: char) -> [u8; 7] {
    match sign {
        '0' => [0b01110, 0b10001, 0b10011, 0b10101, 0b11001, 0b10001, 0b01110],
        '1' => [0b00100, 0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        '2' => [0b01110, 0b10001, 0b00001, 0b00010, 0b00100, 0b01000, 0b11111],
        '3' => [0b11111, 0b00010, 0b00100, 0b00010, 0b00001, 0b10001, 0b01110],
        '4' => [0b00010, 0b00110, 0b01010, 0b10010, 0b11111, 0b00010, 0b00010],
        '5' => [0b11111, 0b10000, 0b11110, 0b00001, 0b00001, 0b10001, 0b01110],
        '6' => [0b00110, 0b01000, 0b10000, 0b11110, 0b10001, 0b10001, 0b01110],
        '7' => [0b11111, 0b00001, 0b00010, 0b00100, 0b01000, 0b01000, 0b01000],
        '8' => [0b01110, 0b10001, 0b10001, 0b01110, 0b10001, 0b10001, 0b01110],
        '9' => [0b01110, 0b10001, 0b10001, 0b01111, 0b00001, 0b00010, 0b01100],
        '.' => [0, 0, 0, 0, 0, 0b01100, 0b01100],
        '-' => [0, 0, 0, 0b11111, 0, 0, 0],
        '/' => [0b00001, 0b00001, 0b00010, 0b00100, 0b01000, 0b10000, 0b10000],
        '%' => [0b11000, 0b11001, 0b00010, 0b00100, 0b01000, 0b10011, 0b00011],
        '²' => [0b01100, 0b10010, 0b00100, 0b01000, 0b11110, 0, 0],
        'l' => [0b01100, 0b00100, 0b00100, 0b00100, 0b00100, 0b00100, 0b01110],
        'x' => [0, 0, 0b10001, 0b01010, 0b00100, 0b01010, 0b10001],
        'c' => [0, 0, 0b01110, 0b10000, 0b10000, 0b10001, 0b01110],
        'd' => [0b00001, 0b00001, 0b01101, 0b10011, 0b10001, 0b10001, 0b01111],
        'm' => [0, 0, 0b11010, 0b10101, 0b10101, 0b10001, 0b10001],
        'e' => [0, 0, 0b01110, 0b10001, 0b11111, 0b10000, 0b01110],
        _ => [0; 7],
    }
}

/// Dots across a text.
pub(super) fn width(text: &str) -> usize {
    (text.chars().count() * (SIZE[0] + 1)).saturating_sub(1)
}

/// Calls `dot` with column and row of every dot of a text.
pub(super) fn draw(text: &str, mut dot: impl FnMut(usize, usize)) {
    for (place, sign) in text.chars().enumerate() {
        for (y, bits) in rows(sign).into_iter().enumerate() {
            (0..SIZE[0]).filter(|x| bits >> (SIZE[0] - 1 - x) & 1 == 1).for_each(|x| dot(place * (SIZE[0] + 1) + x, y));
        }
    }
}
