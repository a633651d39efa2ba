//! Numbers and units in strokes of one width, as technical lettering has them (ISO 3098), at any size.

/// A part of a sign: x from its left edge, y from the top, in heights of a digit.
#[derive(Clone, Copy, Debug)]
enum Stroke {
    /// From one point to another.
    Line([f32; 4]),
    /// Of an ellipse: centre, radii, first and last angle in degrees from the right, downwards.
    Arc([f32; 4], f32, f32),
}
use Stroke::{Arc, Line};

/// Half of a stroke's width, the room between signs, and that of a blank or of a sign that is not known.
const PEN: f32 = 0.07;
const GAP: f32 = 0.22;
const BLANK: f32 = 0.3;
/// Straight pieces of an arc: at a height of 200 pixels the middle of one lies half a pixel off.
const PIECES: usize = 20;

/// Width and strokes.
fn sign(sign: char) -> (f32, &'static [Stroke]) {
    match sign {
        '0' => (0.6, &[Arc([0.3, 0.5, 0.3, 0.5], 0.0, 360.0)]),
        '1' => (0.4, &[Line([0.08, 0.2, 0.32, 0.0]), Line([0.32, 0.0, 0.32, 1.0])]),
        '2' => (0.6, &[Arc([0.3, 0.3, 0.3, 0.3], 180.0, 390.0), Line([0.56, 0.45, 0.0, 1.0]), Line([0.0, 1.0, 0.6, 1.0])]),
        '3' => (0.6, &[Arc([0.3, 0.26, 0.28, 0.26], 200.0, 450.0), Arc([0.3, 0.76, 0.3, 0.24], 270.0, 520.0)]),
        '4' => (0.62, &[Line([0.45, 0.0, 0.0, 0.7]), Line([0.0, 0.7, 0.62, 0.7]), Line([0.45, 0.0, 0.45, 1.0])]),
        '5' => (0.6, &[Line([0.54, 0.0, 0.1, 0.0]), Line([0.1, 0.0, 0.06, 0.45]), Arc([0.29, 0.67, 0.31, 0.33], 222.0, 510.0)]),
        '6' => (0.6, &[Arc([0.3, 0.68, 0.3, 0.32], 0.0, 360.0), Arc([0.62, 0.68, 0.62, 0.68], 180.0, 258.0)]),
        '7' => (0.6, &[Line([0.0, 0.0, 0.6, 0.0]), Line([0.6, 0.0, 0.2, 1.0])]),
        '8' => (0.6, &[Arc([0.3, 0.26, 0.25, 0.26], 0.0, 360.0), Arc([0.3, 0.76, 0.3, 0.24], 0.0, 360.0)]),
        '9' => (0.6, &[Arc([0.3, 0.32, 0.3, 0.32], 0.0, 360.0), Arc([-0.02, 0.32, 0.62, 0.68], 0.0, 78.0)]),
        '.' => (0.1, &[Line([0.05, 0.98, 0.05, 1.0])]),
        '-' => (0.4, &[Line([0.0, 0.55, 0.4, 0.55])]),
        '<' => (0.46, &[Line([0.46, 0.34, 0.0, 0.67]), Line([0.0, 0.67, 0.46, 1.0])]),
        '/' => (0.4, &[Line([0.4, 0.0, 0.0, 1.0])]),
        '%' => (0.8, &[Arc([0.15, 0.22, 0.15, 0.22], 0.0, 360.0), Arc([0.65, 0.78, 0.15, 0.22], 0.0, 360.0), Line([0.64, 0.0, 0.16, 1.0])]),
        '²' => (0.32, &[Arc([0.16, 0.15, 0.15, 0.15], 180.0, 390.0), Line([0.29, 0.225, 0.0, 0.5]), Line([0.0, 0.5, 0.32, 0.5])]),
        'l' => (0.1, &[Line([0.05, 0.0, 0.05, 1.0])]),
        'x' => (0.46, &[Line([0.0, 0.34, 0.46, 1.0]), Line([0.46, 0.34, 0.0, 1.0])]),
        'c' => (0.46, &[Arc([0.25, 0.67, 0.25, 0.33], 50.0, 310.0)]),
        'd' => (0.48, &[Arc([0.24, 0.67, 0.24, 0.33], 0.0, 360.0), Line([0.48, 0.0, 0.48, 1.0])]),
        'm' => {
            let bows: &[Stroke] = &[
                Line([0.0, 0.34, 0.0, 1.0]),
                Arc([0.19, 0.53, 0.19, 0.19], 180.0, 360.0),
                Line([0.38, 0.53, 0.38, 1.0]),
                Arc([0.57, 0.53, 0.19, 0.19], 180.0, 360.0),
                Line([0.76, 0.53, 0.76, 1.0]),
            ];
            (0.76, bows)
        }
        'e' => (0.5, &[Line([0.0, 0.66, 0.5, 0.66]), Arc([0.25, 0.67, 0.25, 0.33], 40.0, 360.0)]),
        'r' => (0.32, &[Line([0.0, 0.34, 0.0, 1.0]), Arc([0.24, 0.58, 0.24, 0.24], 180.0, 290.0)]),
        's' => (0.42, &[Arc([0.21, 0.5, 0.2, 0.16], 90.0, 325.0), Arc([0.21, 0.83, 0.21, 0.17], 270.0, 505.0)]),
        'k' => (0.42, &[Line([0.0, 0.0, 0.0, 1.0]), Line([0.38, 0.34, 0.0, 0.74]), Line([0.14, 0.6, 0.42, 1.0])]),
        'W' => {
            let valleys: &[Stroke] =
                &[Line([0.0, 0.0, 0.2, 1.0]), Line([0.2, 1.0, 0.4, 0.2]), Line([0.4, 0.2, 0.6, 1.0]), Line([0.6, 1.0, 0.8, 0.0])];
            (0.8, valleys)
        }
        'h' => (0.44, &[Line([0.0, 0.0, 0.0, 1.0]), Arc([0.22, 0.56, 0.22, 0.22], 180.0, 360.0), Line([0.44, 0.56, 0.44, 1.0])]),
        'K' => (0.54, &[Line([0.0, 0.0, 0.0, 1.0]), Line([0.54, 0.0, 0.0, 0.62]), Line([0.16, 0.46, 0.54, 1.0])]),
        'D' => {
            let bow: &[Stroke] = &[
                Line([0.0, 0.0, 0.0, 1.0]),
                Line([0.0, 0.0, 0.2, 0.0]),
                Arc([0.2, 0.5, 0.4, 0.5], 270.0, 450.0),
                Line([0.2, 1.0, 0.0, 1.0]),
            ];
            (0.6, bow)
        }
        'G' => (0.64, &[Arc([0.32, 0.5, 0.32, 0.5], 0.0, 320.0), Line([0.36, 0.5, 0.64, 0.5])]),
        'P' => {
            let bow: &[Stroke] = &[
                Line([0.0, 0.0, 0.0, 1.0]),
                Line([0.0, 0.0, 0.26, 0.0]),
                Arc([0.26, 0.27, 0.28, 0.27], 270.0, 450.0),
                Line([0.26, 0.54, 0.0, 0.54]),
            ];
            (0.54, bow)
        }
        _ => (BLANK, &[]),
    }
}

/// Width of a text in heights of a digit.
pub(super) fn width(text: &str) -> f32 {
    let signs: f32 = text.chars().map(|letter| sign(letter).0 + GAP).sum();
    (signs - GAP).max(0.0) + 2.0 * PEN
}

/// Calls `dot` with column and row of every pixel that a text covers, its digits so many pixels high, and the share of the pixel.
pub(super) fn draw(text: &str, height: f32, mut dot: impl FnMut(usize, usize, f32)) {
    let (mut left, unit) = (PEN, height / (1.0 + 2.0 * PEN));
    for letter in text.chars() {
        let (width, strokes) = sign(letter);
        let pieces: Vec<[f32; 4]> = strokes.iter().flat_map(|stroke| stroke.pieces()).collect();
        if !pieces.is_empty() {
            let columns = ((left - PEN) * unit).floor().max(0.0) as usize..=((left + width + PEN) * unit).ceil() as usize;
            for (x, y) in columns.flat_map(|x| (0..=height.ceil() as usize).map(move |y| (x, y))) {
                let place = [(x as f32 + 0.5) / unit - left, (y as f32 + 0.5) / unit - PEN];
                let distance = pieces.iter().map(|piece| distance(*piece, place)).fold(f32::MAX, f32::min);
                let share = ((PEN - distance) * unit + 0.5).clamp(0.0, 1.0);
                if share > 0.0 {
                    dot(x, y, share);
                }
            }
        }
        left += width + GAP;
    }
}

impl Stroke {
    /// Straight pieces, from and to.
    fn pieces(self) -> Vec<[f32; 4]> {
        match self {
            Line(ends) => vec![ends],
            Arc([x, y, across, down], first, last) => {
                let at = |piece: usize| {
                    let angle = (first + (last - first) * piece as f32 / PIECES as f32).to_radians();
                    [x + across * angle.cos(), y + down * angle.sin()]
                };
                (0..PIECES).map(|piece| (at(piece), at(piece + 1))).map(|([a, b], [c, d])| [a, b, c, d]).collect()
            }
        }
    }
}

/// From a point to the nearest one between two others.
fn distance([ax, ay, bx, by]: [f32; 4], [x, y]: [f32; 2]) -> f32 {
    let (dx, dy) = (bx - ax, by - ay);
    let length = dx * dx + dy * dy;
    let part = if length > 0.0 { (((x - ax) * dx + (y - ay) * dy) / length).clamp(0.0, 1.0) } else { 0.0 };
    (x - ax - part * dx).hypot(y - ay - part * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn signs_differ_and_stay_in_their_room() {
        let ink = |text: &str| {
            let mut found = Vec::new();
            draw(text, 40.0, |x, y, share| found.push((x, y, (share * 100.0) as u32)));
            found
        };
        let all = "0123456789.-/%²lxcdmehrskWKDGP";
        for (number, letter) in all.chars().enumerate() {
            let text = letter.to_string();
            let found = ink(&text);
            assert!(!found.is_empty() && all.chars().skip(number + 1).all(|other| ink(&other.to_string()) != found), "{letter}");
            let right = (width(&text) * 40.0 / (1.0 + 2.0 * PEN)).ceil() as usize;
            assert!(found.iter().all(|(x, y, _)| *x <= right && *y <= 40), "{letter}");
        }
        assert!(ink("ß ").is_empty() && (width("00") - (2.0 * 0.6 + GAP + 2.0 * PEN)).abs() < 1e-6);
    }
}
