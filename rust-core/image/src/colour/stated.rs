//! What image files say of their colours themselves.

use super::{Curve, Gamut, Matrix3, Primaries, Transfer};

/// What a file's header says of its numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Stated {
    /// Nothing.
    #[default]
    Nothing,
    /// How they become light.
    Encoding(Encoding),
    /// Something that cannot be used: words that follow the file's name.
    Unusable(String),
}

/// The way from stored numbers to linear Rec.709.
#[derive(Clone, Debug, PartialEq)]
pub struct Encoding {
    /// From stored to linear, for red, green and blue.
    pub curves: Box<[Curve; 3]>,
    /// From the file's gamut; nothing where it is Rec.709.
    pub to_rec709: Option<Matrix3>,
}

/// What matrices of 16-bit fixed-point profiles differ from the identity where they mean Rec.709.
const NEAR_IDENTITY: f64 = 2e-3;

impl Encoding {
    /// Curves and a matrix, by name and left out where they are all but those of a known space.
    pub fn new(curves: [Curve; 3], to_rec709: Option<Matrix3>) -> Self {
        let is_identity = |m: &Matrix3| {
            let mut elements =
                m.iter().enumerate().flat_map(|(i, row)| row.iter().enumerate().map(move |(j, x)| x - f64::from(u8::from(i == j))));
            elements.all(|difference| difference.abs() < NEAR_IDENTITY)
        };
        Self { curves: Box::new(curves.map(Curve::simplified)), to_rec709: to_rec709.filter(|matrix| !is_identity(matrix)) }
    }

    /// One curve for all channels, and primaries; nothing where the primaries span no gamut.
    pub fn of_primaries(curve: Curve, primaries: &Primaries) -> Option<Self> {
        Some(Self::new([curve.clone(), curve.clone(), curve], Some(primaries.to_rec709()?)))
    }

    /// One curve for all channels, in Rec.709.
    pub fn in_rec709(curve: Curve) -> Self {
        Self::new([curve.clone(), curve.clone(), curve], None)
    }

    /// The transfer function of all three channels, where it has a name.
    pub fn transfer(&self) -> Option<Transfer> {
        match &*self.curves {
            [Curve::Named(r), Curve::Named(g), Curve::Named(b)] if r == g && g == b => Some(*r),
            _ => None,
        }
    }
}

impl Stated {
    /// sRGB.
    pub fn srgb() -> Self {
        Self::Encoding(Encoding::in_rec709(Curve::Named(Transfer::Srgb)))
    }

    /// Linear amounts of primaries; nothing where these are Rec.709's, which says no more than silence, or span no gamut.
    pub fn linear(primaries: &Primaries) -> Self {
        let stated = Some(primaries).filter(|p| !p.is_rec709()).and_then(|p| Encoding::of_primaries(Curve::Named(Transfer::Linear), p));
        stated.map_or(Self::Nothing, Self::Encoding)
    }

    /// The numbers of ITU-T H.273 for primaries and transfer characteristics, as PNG's `cICP` and AVIF's `nclx` have them.
    pub fn from_code_points(primaries: u8, transfer: u8) -> Self {
        let curve = match transfer {
            1 | 6 | 14 | 15 => Curve::REC709_CAMERA,
            2 if primaries == 2 => return Self::Nothing,
            2 | 13 => Curve::Named(Transfer::Srgb),
            4 => Curve::Named(Transfer::Gamma22),
            5 => Curve::Power(2.8),
            8 => Curve::Named(Transfer::Linear),
            16 => return Self::Unusable("has the transfer function PQ, which is not supported".to_owned()),
            18 => return Self::Unusable("has the transfer function HLG, which is not supported".to_owned()),
            other => return Self::Unusable(format!("has the transfer function {other} of ITU-T H.273, which is not supported")),
        };
        let primaries = match primaries {
            1 | 2 => Gamut::Rec709.primaries(),
            5 => Primaries { red: [0.64, 0.33], green: [0.29, 0.60], blue: [0.15, 0.06], white: [0.3127, 0.3290] },
            6 | 7 => Primaries { red: [0.630, 0.340], green: [0.310, 0.595], blue: [0.155, 0.070], white: [0.3127, 0.3290] },
            9 => Gamut::Rec2020.primaries(),
            10 => Gamut::XyzE.primaries(),
            11 => Primaries { white: [0.314, 0.351], ..Gamut::DisplayP3.primaries() },
            12 => Gamut::DisplayP3.primaries(),
            other => return Self::Unusable(format!("has the primaries {other} of ITU-T H.273, which are not supported")),
        };
        Encoding::of_primaries(curve, &primaries).map_or(Self::Nothing, Self::Encoding)
    }
}
