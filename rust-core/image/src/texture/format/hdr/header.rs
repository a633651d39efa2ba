//! What stands before the pixels of a Radiance picture (Ward, "Radiance File Formats"; Radiance's `header.c` and `resolu.c`).

use crate::colour::{Gamut, Primaries};
use crate::texture::error::TextureError;

/// Lumens of a watt of Radiance's white light.
const WHITE_EFFICACY: f64 = 179.0;

/// The primaries of pictures that state none, whose white is the equal-energy illuminant.
const USUAL_PRIMARIES: Primaries = Primaries { red: [0.64, 0.33], green: [0.29, 0.60], blue: [0.15, 0.06], white: [1.0 / 3.0, 1.0 / 3.0] };

/// The header of a Radiance picture.
#[derive(Clone, Debug, PartialEq)]
pub struct RadianceHeader {
    /// What the pixels were multiplied by, all `EXPOSURE` lines together.
    pub exposure: f64,
    /// What red, green and blue were multiplied by, all `COLORCORR` lines together.
    pub correction: [f64; 3],
    /// What `PRIMARIES` says; those of XYZ in an XYZE picture.
    pub primaries: Option<Primaries>,
    /// Whether pixels are CIE XYZ, Y in cd/m², instead of watts a steradian and square metre.
    pub is_xyz: bool,
    /// What follows the last `VIEW=`, such as `-vta -vh 180 -vv 180`.
    pub view: Option<String>,
    /// Pixels across and down of the picture that stands upright.
    pub size: [u32; 2],
    /// Bytes before the pixels.
    pub(super) length: usize,
    order: Order,
}

/// Which way scan lines go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Order {
    /// Scan lines are columns.
    by_columns: bool,
    /// The first pixel is at the bottom.
    from_bottom: bool,
    /// The first pixel is at the right.
    from_right: bool,
}

impl RadianceHeader {
    /// Reads the header at the beginning of a picture's bytes.
    ///
    /// # Errors
    /// It ends before its resolution, or a line of it that changes pixels cannot be understood, with the line's number.
    pub fn read(bytes: &[u8]) -> Result<Self, TextureError> {
        let mut header = Self {
            exposure: 1.0,
            correction: [1.0; 3],
            primaries: None,
            is_xyz: false,
            view: None,
            size: [0; 2],
            length: 0,
            order: Order::default(),
        };
        let mut number = 0;
        loop {
            number += 1;
            let line = header.next_line(bytes)?;
            if line.is_empty() && number > 1 {
                break;
            }
            header.take(&line).ok_or_else(|| TextureError::malformed(format!("line {number}: '{line}' cannot be understood")))?;
        }
        let line = header.next_line(bytes)?;
        let (size, order) = resolution(&line)
            .ok_or_else(|| TextureError::malformed(format!("line {}: '{line}', expected a resolution as '-Y 480 +X 640'", number + 1)))?;
        (header.size, header.order) = (size, order);
        if header.is_xyz {
            header.primaries = Some(Gamut::XyzE.primaries());
        }
        Ok(header)
    }

    /// The next line without its end.
    fn next_line(&mut self, bytes: &[u8]) -> Result<String, TextureError> {
        let rest = &bytes[self.length..];
        let end = rest.iter().position(|byte| *byte == b'\n').ok_or_else(|| TextureError::malformed("the header does not end"))?;
        self.length += end + 1;
        Ok(String::from_utf8_lossy(&rest[..end]).trim_end().to_owned())
    }

    /// Takes what a line says; `None` where it says something that pixels depend on and that makes no sense. Lines that begin with a blank are those
    /// of pictures that this one was made of.
    fn take(&mut self, line: &str) -> Option<()> {
        let Some((key, value)) = line.split_once('=') else { return Some(()) };
        match key {
            "EXPOSURE" => self.exposure *= positive::<1>(value)?[0],
            "COLORCORR" => {
                let more = positive::<3>(value)?;
                self.correction.iter_mut().zip(more).for_each(|(known, factor)| *known *= factor);
            }
            "PRIMARIES" => {
                let [rx, ry, gx, gy, bx, by, wx, wy] = numbers::<8>(value)?;
                self.primaries = Some(Primaries { red: [rx, ry], green: [gx, gy], blue: [bx, by], white: [wx, wy] });
            }
            "FORMAT" => {
                self.is_xyz = value.trim() == "32-bit_rle_xyze";
                (self.is_xyz || value.trim() == "32-bit_rle_rgbe").then_some(())?;
            }
            "VIEW" => self.view = Some(value.trim().to_owned()),
            _ => {}
        }
        Some(())
    }

    /// What pixels are multiplied with to undo what the header says was done to them.
    pub(super) fn factors(&self) -> [f64; 3] {
        self.correction.map(|correction| 1.0 / (self.exposure * correction))
    }

    /// Weights of a decoded texel's channels in its luminance in cd/m².
    pub fn luminance_weights(&self) -> [f64; 3] {
        if self.is_xyz {
            return [0.0, 1.0, 0.0];
        }
        let stated = self.primaries.and_then(|primaries| primaries.to_xyz());
        let [_, luminance, _] = stated.or_else(|| USUAL_PRIMARIES.to_xyz()).unwrap_or([[1.0 / 3.0; 3]; 3]);
        luminance.map(|weight| weight * WHITE_EFFICACY)
    }

    /// Scan lines, and pixels in each.
    pub(super) fn scan_lines(&self) -> [u32; 2] {
        let [width, height] = self.size;
        if self.order.by_columns { [width, height] } else { [height, width] }
    }

    /// Texels by scan lines as rows from the top, from left to right.
    pub(super) fn upright(&self, texels: &[[f32; 3]]) -> Vec<f32> {
        if self.order == Order::default() {
            return texels.as_flattened().to_vec();
        }
        let [width, height] = self.size.map(|side| side as usize);
        let turned = |turn: bool, at: usize, count: usize| if turn { count - 1 - at } else { at };
        let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        let texel = |(x, y)| {
            let (x, y) = (turned(self.order.from_right, x, width), turned(self.order.from_bottom, y, height));
            texels[if self.order.by_columns { x * height + y } else { y * width + x }]
        };
        places.flat_map(texel).collect()
    }
}

/// So many numbers and nothing else.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let numbers = text.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>().ok()?;
    let numbers: [f64; N] = numbers.try_into().ok()?;
    numbers.iter().all(|x| x.is_finite()).then_some(numbers)
}

/// So many numbers above zero.
fn positive<const N: usize>(text: &str) -> Option<[f64; N]> {
    numbers::<N>(text).filter(|numbers| numbers.iter().all(|x| *x > 0.0))
}

/// Width, height and order of a resolution line such as `-Y 480 +X 640`.
fn resolution(line: &str) -> Option<([u32; 2], Order)> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [first, lines, second, length] = words[..] else { return None };
    let (lines, length): (u32, u32) = (lines.parse().ok()?, length.parse().ok()?);
    let (size, vertical, horizontal, by_columns) = match (first, second) {
        ("-Y" | "+Y", "+X" | "-X") => ([length, lines], first, second, false),
        ("+X" | "-X", "-Y" | "+Y") => ([lines, length], second, first, true),
        _ => return None,
    };
    let order = Order { by_columns, from_bottom: vertical == "+Y", from_right: horizontal == "-X" };
    (lines > 0 && length > 0).then_some((size, order))
}
