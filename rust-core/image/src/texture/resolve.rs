//! From the colour space asked for and the image at hand to what must be done with its numbers.

use super::image::{Image, Texels};
use crate::colour::{ColourSpace, Curve, Encoding, Stated, Transfer, apply};
use rayon::prelude::*;

/// What turns stored numbers into linear Rec.709.
#[derive(Clone, Debug)]
pub(crate) struct Conversion {
    /// From stored to linear, on colour channels only.
    encoding: Encoding,
    /// Whether the numbers are colours, of which half precision is enough.
    pub(crate) is_colour: bool,
    /// Linear values of all codes of an integer image, for red, green and blue; empty where numbers stay as they are.
    codes: Vec<[f32; 3]>,
}

impl Conversion {
    /// Resolves `space` for `image`.
    pub(crate) fn resolve(space: ColourSpace, image: &Image) -> Self {
        let raw = || Self::new(Encoding::in_rec709(Curve::Named(Transfer::Linear)), false, image);
        match (space, &image.stated) {
            (ColourSpace::Raw, _) => raw(),
            (ColourSpace::Colour { transfer, gamut }, _) => {
                let curve = Curve::Named(transfer);
                Self::new(Encoding { curves: Box::new([curve.clone(), curve.clone(), curve]), to_rec709: gamut.to_rec709() }, true, image)
            }
            (ColourSpace::SrgbTimesAlpha(_), _) => Self::new(Encoding::in_rec709(Curve::Named(Transfer::Srgb)), true, image),
            (ColourSpace::Auto, Stated::Encoding(encoding)) => {
                let mut conversion = Self::new(encoding.clone(), true, image);
                // Numbers that stay as they are stay whole too.
                conversion.is_colour = !conversion.is_identity();
                conversion
            }
            (ColourSpace::Auto, _) if image.is_byte() && image.channels >= 3 => {
                Self::new(Encoding::in_rec709(Curve::Named(Transfer::Srgb)), true, image)
            }
            (ColourSpace::Auto, _) => raw(),
        }
    }

    fn new(mut encoding: Encoding, is_colour: bool, image: &Image) -> Self {
        if image.channels < 3 {
            // Grey is white times a number in every gamut.
            encoding.to_rec709 = None;
        }
        let mut conversion = Self { encoding, is_colour, codes: Vec::new() };
        let largest = match image.texels {
            Texels::Byte(_) => 255_u32,
            Texels::Short(_) => 65535,
            Texels::Half(_) | Texels::Float(_) => 0,
        };
        if largest > 0 && !conversion.is_identity() {
            conversion.codes =
                (0..=largest).into_par_iter().map(|code| conversion.linear([f64::from(code) / f64::from(largest); 3])).collect();
        }
        conversion
    }

    /// The transfer function with a name that is all there is to do; nothing where more is to be done.
    pub(crate) fn transfer(&self) -> Option<Transfer> {
        self.encoding.transfer().filter(|_| self.encoding.to_rec709.is_none())
    }

    /// Whether stored numbers are used as they stand.
    pub(crate) fn is_identity(&self) -> bool {
        self.transfer() == Some(Transfer::Linear)
    }

    fn linear(&self, stored: [f64; 3]) -> [f32; 3] {
        let [r, g, b] = &*self.encoding.curves;
        [r.decode(stored[0]) as f32, g.decode(stored[1]) as f32, b.decode(stored[2]) as f32]
    }

    /// Linear Rec.709 of the texel at `index` (row by row); alpha passes.
    pub(crate) fn texel(&self, image: &Image, index: usize) -> [f32; 4] {
        let stored = image.rgba(index);
        if self.is_identity() {
            return stored;
        }
        let linear = match self.codes.len() {
            0 => self.linear([stored[0], stored[1], stored[2]].map(f64::from)),
            count => {
                let code = |channel: usize| (stored[channel] * (count - 1) as f32 + 0.5) as usize;
                [self.codes[code(0)][0], self.codes[code(1)][1], self.codes[code(2)][2]]
            }
        };
        let [r, g, b] = self.encoding.to_rec709.as_ref().map_or(linear, |matrix| apply(matrix, linear.map(f64::from)).map(|x| x as f32));
        [r, g, b, stored[3]]
    }
}
