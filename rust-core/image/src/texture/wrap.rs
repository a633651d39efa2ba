//! Where a lookup falls among the texels: wrapping outside the unit square, and the neighbours to mix.

use gonio_simd::{F, Lanes, M, U};

/// What lies outside the unit square, along one axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The texels of the edge.
    Clamp,
    /// The image, every other time mirrored.
    Mirror,
    /// Zero in all four channels; the edge fades over half a texel.
    Black,
}

/// How texels are mixed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Filter {
    /// Four texels on each of two levels of the pyramid.
    #[default]
    Trilinear,
    /// The one texel of the finest level in which the point lies.
    Nearest,
    /// As [`Filter::Trilinear`] with sixteen texels of each level, weighed by cubic B-splines, which smooth the image.
    Cubic,
    /// As [`Filter::Trilinear`], but bytes of sRGB of the finest level are mixed as they are encoded. Coarser levels are light in any case, so that
    /// images keep their mean.
    TrilinearCodes,
    /// As [`Filter::Cubic`], with bytes mixed as for [`Filter::TrilinearCodes`].
    CubicCodes,
}

impl Filter {
    /// Whether each level is filtered by sixteen texels.
    pub(crate) fn is_cubic(self) -> bool {
        matches!(self, Self::Cubic | Self::CubicCodes)
    }
    /// Whether codes of the finest level are mixed as they are.
    pub(crate) fn mixes_codes(self) -> bool {
        matches!(self, Self::TrilinearCodes | Self::CubicCodes)
    }
}

/// The two texels along an axis that a lookup mixes.
#[derive(Clone, Copy)]
pub(crate) struct Taps<L: Lanes> {
    /// The texel before the point.
    pub(crate) low: U<L>,
    /// The texel behind it.
    pub(crate) high: U<L>,
    /// The shares of the two; they sum to 1, or less where the outside is black.
    pub(crate) weights: [F<L>; 2],
}

impl Wrap {
    /// The coordinate brought into the unit interval (`Black`: near it), ready for any level's size. NaN and infinities become 0.
    #[inline(always)]
    pub(crate) fn position<L: Lanes>(self, coordinate: F<L>) -> F<L> {
        let x = coordinate.keep_if(coordinate.is_finite());
        match self {
            Self::Repeat => x - x.floor(),
            Self::Clamp => x.saturate(),
            Self::Mirror => 1.0 - ((x - (x * 0.5).floor() * 2.0) - 1.0).abs(),
            Self::Black => x.clamp(-1.0, 2.0),
        }
    }

    /// The neighbours of a position on an axis of `size` texels.
    #[inline(always)]
    pub(crate) fn taps<L: Lanes>(self, position: F<L>, size: F<L>) -> Taps<L> {
        let x = position.mul_add(size, -0.5);
        let low = x.floor();
        let (high, t) = (low + 1.0, x - low);
        let last = size - 1.0;
        let (mut first, mut second, mut weights) = (low.max(0.0), high.min(last), [1.0 - t, t]);
        match self {
            Self::Repeat => {
                first = low.lt(0.0).select(last, low);
                second = high.gt(last).select(high - size, high);
            }
            Self::Clamp | Self::Mirror => {}
            Self::Black => {
                weights = [weights[0].keep_if(inside(low, last)), weights[1].keep_if(inside(high, last))];
                (first, second) = (first.min(last), second.max(0.0));
            }
        }
        Taps { low: first.to_i32(), high: second.to_i32(), weights }
    }

    /// The texel in which a position lies, and whether it lies in any.
    #[inline(always)]
    pub(crate) fn nearest<L: Lanes>(self, position: F<L>, size: F<L>) -> (U<L>, M<L>) {
        let (texel, last) = ((position * size).floor(), size - 1.0);
        let within = match self {
            // The upper edge itself belongs to the last texel.
            Self::Black => position.ge(0.0) & position.le(1.0),
            _ => position.lanes().m(true),
        };
        (texel.clamp(0.0, last).to_i32(), within)
    }
}

#[inline(always)]
fn inside<L: Lanes>(texel: F<L>, last: F<L>) -> M<L> {
    texel.ge(0.0) & texel.le(last)
}
