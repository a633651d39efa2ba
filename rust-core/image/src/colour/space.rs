//! Colour spaces by the names that hosts and files use.

use super::{Gamut, Transfer};

/// How the numbers of an image file mean light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ColourSpace {
    /// Decided by the file: what its header says of its colours, else sRGB for 8-bit images of three or four channels, else raw
    /// (UsdPreviewSurface specification, `sourceColorSpace`).
    Auto,
    /// Numbers that are not colours (normals, roughness, heights): used as they stand.
    Raw,
    /// Colours: decoded by the transfer function, then converted from the gamut.
    Colour {
        /// From stored numbers to linear ones.
        transfer: Transfer,
        /// What the linear numbers are amounts of.
        gamut: Gamut,
    },
    /// sRGB, bytes of which are multiplied by their alpha before they are filtered, as Blender means its images.
    SrgbTimesAlpha(Product),
}

/// What is multiplied by alpha.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Product {
    /// The bytes as they are encoded, cut off to whole numbers, as in Cycles.
    Codes,
    /// The light that they stand for.
    Light,
}

const fn colour(transfer: Transfer, gamut: Gamut) -> ColourSpace {
    ColourSpace::Colour { transfer, gamut }
}

impl ColourSpace {
    /// sRGB, as 8-bit colour textures are stored.
    pub const SRGB_TEXTURE: Self = colour(Transfer::Srgb, Gamut::Rec709);
    /// Linear Rec.709, the space that the renderer works in.
    pub const LINEAR_REC709: Self = colour(Transfer::Linear, Gamut::Rec709);
    /// ACEScg: linear AP1.
    pub const ACES_CG: Self = colour(Transfer::Linear, Gamut::Ap1);
    /// ACES2065-1: linear AP0.
    pub const ACES_2065: Self = colour(Transfer::Linear, Gamut::Ap0);
    /// Display P3 with the transfer function of sRGB.
    pub const DISPLAY_P3: Self = colour(Transfer::Srgb, Gamut::DisplayP3);
    /// Linear Display P3.
    pub const LINEAR_P3: Self = colour(Transfer::Linear, Gamut::DisplayP3);
    /// Linear Rec.2020.
    pub const LINEAR_REC2020: Self = colour(Transfer::Linear, Gamut::Rec2020);
    /// Rec.709 with an exponent of 2.2.
    pub const G22: Self = colour(Transfer::Gamma22, Gamut::Rec709);

    /// The space that USD, MaterialX, OCIO's ACES configurations or Blender call `name`; case and punctuation do not count, and an empty
    /// name is `Auto`.
    pub fn parse(name: &str) -> Result<Self, UnknownColourSpace> {
        let key: String = name.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect();
        let found = NAMES.iter().find(|(names, _)| names.split(' ').any(|known| known == key));
        found
            .map(|(_, space)| *space)
            .or_else(|| key.is_empty().then_some(Self::Auto))
            .ok_or_else(|| UnknownColourSpace { name: name.to_owned() })
    }
}

impl core::str::FromStr for ColourSpace {
    type Err = UnknownColourSpace;
    fn from_str(name: &str) -> Result<Self, UnknownColourSpace> {
        Self::parse(name)
    }
}

/// A colour space's name that is not in the table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownColourSpace {
    /// The name as it was given.
    pub name: String,
}

impl core::fmt::Display for UnknownColourSpace {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "colour space '{}' is not known; expected auto, raw, sRGB, lin_rec709, ACEScg, lin_displayp3, lin_rec2020 or the like",
            self.name
        )
    }
}

impl core::error::Error for UnknownColourSpace {}

/// Names without case and punctuation, parted by spaces, and what they mean.
const NAMES: &[(&str, ColourSpace)] = &[
    ("auto automatic", ColourSpace::Auto),
    ("srgbcodestimesalpha", ColourSpace::SrgbTimesAlpha(Product::Codes)),
    ("srgblighttimesalpha", ColourSpace::SrgbTimesAlpha(Product::Light)),
    ("raw noncolor noncolour none data unknown identity utilityraw utraw inputraw", ColourSpace::Raw),
    (
        "srgb srgbtexture srgbrec709 srgbrec709scene srgbrec709display srgbencodedrec709srgb srgbencodedrec709scene utilitysrgbtexture \
         inputgenericsrgbtexture srgbtx srgbdisplay outputsrgb",
        ColourSpace::SRGB_TEXTURE,
    ),
    (
        "linear linrec709 linrec709scene linrec709srgb linsrgb linearrec709 linearrec709srgb linearsrgb linearbt709 utilitylinearsrgb \
         utilitylinearrec709 scenelinear scenelinearrec709srgb",
        ColourSpace::LINEAR_REC709,
    ),
    ("acescg linap1 linap1scene linearap1 acesacescg lincg", ColourSpace::ACES_CG),
    ("aces20651 aces linap0 linap0scene linearap0 acesaces20651", ColourSpace::ACES_2065),
    ("linp3d65 lindisplayp3 linp3d65scene linearp3d65 lineardisplayp3 lineardcip3d65 utilitylinearp3d65", ColourSpace::LINEAR_P3),
    (
        "displayp3 displayp3display srgbdisplayp3 srgbp3d65 srgbp3d65scene srgbp3d65display srgbencodedp3d65 srgbencodedp3d65texture",
        ColourSpace::DISPLAY_P3,
    ),
    ("linrec2020 linrec2020scene linearrec2020 linearbt2020 utilitylinearrec2020", ColourSpace::LINEAR_REC2020),
    ("g22rec709 g22rec709scene g22rec709tx gamma22 gamma22rec709texture gamma22encodedrec709", ColourSpace::G22),
    ("g18rec709 g18rec709scene gamma18 gamma18rec709texture gamma18encodedrec709", colour(Transfer::Gamma18, Gamut::Rec709)),
    (
        "rec709display g24rec709 g24rec709display gamma24 rec1886 rec1886rec709display gamma24rec709texture gamma24encodedrec709",
        colour(Transfer::Gamma24, Gamut::Rec709),
    ),
    ("g22ap1 g22ap1scene gamma22ap1texture gamma22encodedap1", colour(Transfer::Gamma22, Gamut::Ap1)),
    ("g18ap1 g18ap1scene gamma18ap1texture gamma18encodedap1", colour(Transfer::Gamma18, Gamut::Ap1)),
    ("srgbap1 srgbap1scene srgbencodedap1 srgbencodedap1texture", colour(Transfer::Srgb, Gamut::Ap1)),
    ("adobergb g22adobergb g22adobergbscene gamma22encodedadobergb", colour(Transfer::AdobeRgb, Gamut::AdobeRgb)),
    ("linadobergb linadobergbscene linearadobergb", colour(Transfer::Linear, Gamut::AdobeRgb)),
    ("linciexyzd65 linciexyzd65scene linearciexyzd65 ciexyzd65 ciexyzd65scenereferred", colour(Transfer::Linear, Gamut::XyzD65)),
    ("ciexyz xyz linearciexyze linciexyze", colour(Transfer::Linear, Gamut::XyzE)),
];
