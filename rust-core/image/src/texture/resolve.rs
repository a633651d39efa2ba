//! From the colour space asked for and the image at hand to what must be done with its numbers.

use super::image::Image;
use crate::colour::{ColourSpace, Matrix3, Transfer, apply};

/// What turns stored numbers into linear Rec.709.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Conversion {
    /// From stored to linear, on colour channels only.
    pub(crate) transfer: Transfer,
    /// From the file's gamut; nothing where it is Rec.709 or the numbers are not colours.
    pub(crate) gamut: Option<Matrix3>,
    /// Whether the numbers are colours, of which half precision is enough.
    pub(crate) is_colour: bool,
}

impl Conversion {
    /// Resolves `space` for `image`; `fallback` is used by `Auto` where neither the image's depth nor its header decides.
    pub(crate) fn resolve(space: ColourSpace, fallback: Option<ColourSpace>, image: &Image) -> Self {
        let raw = Self { transfer: Transfer::Linear, gamut: None, is_colour: false };
        match space {
            ColourSpace::Raw => raw,
            ColourSpace::Colour { transfer, gamut } => Self { transfer, gamut: gamut.to_rec709(), is_colour: true },
            ColourSpace::Auto => {
                let stated = image.primaries.filter(|p| !p.is_rec709()).and_then(|p| p.to_rec709());
                match (stated, fallback) {
                    (Some(matrix), _) => Self { gamut: Some(matrix), is_colour: true, ..raw },
                    (None, Some(space)) if space != ColourSpace::Auto => Self::resolve(space, None, image),
                    _ if image.is_byte() && image.channels >= 3 => Self { transfer: Transfer::Srgb, is_colour: true, ..raw },
                    _ => raw,
                }
            }
        }
    }

    /// Whether stored numbers are used as they stand.
    pub(crate) fn is_identity(&self) -> bool {
        self.transfer == Transfer::Linear && self.gamut.is_none()
    }

    /// Linear Rec.709 of a stored texel; alpha passes.
    pub(crate) fn convert(&self, texel: [f32; 4]) -> [f32; 4] {
        if self.is_identity() {
            return texel;
        }
        let linear = [texel[0], texel[1], texel[2]].map(|x| self.transfer.decode(f64::from(x)));
        let [r, g, b] = self.gamut.as_ref().map_or(linear, |matrix| apply(matrix, linear));
        [r as f32, g as f32, b as f32, texel[3]]
    }
}
