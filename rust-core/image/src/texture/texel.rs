//! How texels lie in memory, and how lanes read them.
//!
//! Words are 32 bits, kept as `f32` so that one kind of gather serves all: two neighbours on a row come with one 64-bit load a lane.

use gonio_simd::{F, Lanes, U};
use half::f16;

/// How a texture's texels are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TexelFormat {
    /// 8-bit RGBA in one word, colours decoded after the fetch: 4 bytes a texel.
    Byte,
    /// One float, grey with alpha 1: 4 bytes a texel.
    Grey,
    /// Half-float RGBA in two words: 8 bytes a texel.
    Half,
    /// Float RGBA in four words: 16 bytes a texel.
    Float,
}

impl TexelFormat {
    /// 32-bit words a texel.
    pub const fn words(self) -> usize {
        match self {
            Self::Byte | Self::Grey => 1,
            Self::Half => 2,
            Self::Float => 4,
        }
    }
}

/// Four channels in each lane.
pub(crate) type Rgba<L> = [F<L>; 4];

/// Reads of one storage format; `index` counts texels.
pub(crate) trait Texel {
    /// One texel a lane.
    fn one<L: Lanes>(l: L, words: &[f32], table: &[f32; 256], index: U<L>) -> Rgba<L>;
    /// The texel at `index` and its right neighbour.
    fn pair<L: Lanes>(l: L, words: &[f32], table: &[f32; 256], index: U<L>) -> [Rgba<L>; 2];
}

/// From an 8-bit code to its linear value.
pub(crate) trait ByteDecode {
    /// The linear value of a code.
    fn decode<L: Lanes>(l: L, table: &[f32; 256], code: U<L>) -> F<L>;
}

/// Codes that are linear.
pub(crate) struct LinearCode;
/// Codes in sRGB.
pub(crate) struct SrgbCode;
/// Codes in any other transfer function.
pub(crate) struct TableCode;

impl ByteDecode for LinearCode {
    #[inline(always)]
    fn decode<L: Lanes>(_: L, _: &[f32; 256], code: U<L>) -> F<L> {
        code.i32_to_float() * (1.0 / 255.0)
    }
}
impl ByteDecode for SrgbCode {
    #[inline(always)]
    fn decode<L: Lanes>(l: L, table: &[f32; 256], code: U<L>) -> F<L> {
        // Measured: nine products beat a gather of sixteen values by 1.1 to 1.4, and lose to a gather of eight or fewer.
        if L::COUNT < 16 {
            return l.gather(table, code);
        }
        let x = code.i32_to_float() * (1.0 / 255.0);
        x.lt(SRGB_CURVE_FROM).select(x * (1.0 / 12.92), srgb_curve(x))
    }
}
impl ByteDecode for TableCode {
    #[inline(always)]
    fn decode<L: Lanes>(l: L, table: &[f32; 256], code: U<L>) -> F<L> {
        l.gather(table, code)
    }
}

/// Between codes 10 and 11: below, sRGB is linear.
const SRGB_CURVE_FROM: f32 = 10.5 / 255.0;

/// The curved part of sRGB at the codes 11 to 255: a fit of degree 8, within 1.2e-5 of each value (a 25th of a code's step at worst).
#[inline(always)]
fn srgb_curve<L: Lanes>(x: F<L>) -> F<L> {
    const C: [f32; 9] =
        [8.412_814e-4, 3.590_055e-2, 0.475_831_24, 0.933_735_2, -1.147_528_6, 1.569_605, -1.502_836_4, 0.831_419_9, -0.196_979_43];
    let mut y = x.mul_add(C[8], C[7]);
    for k in (0..7).rev() {
        y = y.mul_add(x, C[k]);
    }
    y
}

/// Four 8-bit codes in a word, red lowest.
pub(crate) struct Byte<D>(core::marker::PhantomData<D>);

impl<D: ByteDecode> Byte<D> {
    #[inline(always)]
    fn unpack<L: Lanes>(l: L, table: &[f32; 256], word: U<L>) -> Rgba<L> {
        let [r, g, b] = [word & 255, (word >> 8) & 255, (word >> 16) & 255];
        [D::decode(l, table, r), D::decode(l, table, g), D::decode(l, table, b), (word >> 24).i32_to_float() * (1.0 / 255.0)]
    }
}

impl<D: ByteDecode> Texel for Byte<D> {
    #[inline(always)]
    fn one<L: Lanes>(l: L, words: &[f32], table: &[f32; 256], index: U<L>) -> Rgba<L> {
        Self::unpack(l, table, l.gather(words, index).to_bits())
    }
    #[inline(always)]
    fn pair<L: Lanes>(l: L, words: &[f32], table: &[f32; 256], index: U<L>) -> [Rgba<L>; 2] {
        let [a, b] = l.gather_pairs(words, index);
        [Self::unpack(l, table, a.to_bits()), Self::unpack(l, table, b.to_bits())]
    }
}

/// One float: grey, opaque.
pub(crate) struct Grey;

impl Texel for Grey {
    #[inline(always)]
    fn one<L: Lanes>(l: L, words: &[f32], _: &[f32; 256], index: U<L>) -> Rgba<L> {
        let x = l.gather(words, index);
        [x, x, x, l.f(1.0)]
    }
    #[inline(always)]
    fn pair<L: Lanes>(l: L, words: &[f32], _: &[f32; 256], index: U<L>) -> [Rgba<L>; 2] {
        let [a, b] = l.gather_pairs(words, index);
        [[a, a, a, l.f(1.0)], [b, b, b, l.f(1.0)]]
    }
}

/// Four half floats in two words.
pub(crate) struct Half;

/// The low half of each word as a float; the number is finite.
#[inline(always)]
fn half_to_float<L: Lanes>(half: U<L>) -> F<L> {
    let bits = half & 0x7fff;
    // Subnormal halves by way of integers: subnormal floats in between would cost a hundred cycles each.
    let subnormal = bits.i32_to_float() * SMALLEST_HALF;
    let normal = F::from_bits((bits << 13) + REBASE);
    let magnitude = bits.lt(0x400).select(subnormal, normal);
    F::from_bits(magnitude.to_bits() | ((half & 0x8000) << 16))
}

/// 2^-24.
const SMALLEST_HALF: f32 = 1.0 / 16_777_216.0;
/// The difference of the two exponents' biases, in place.
const REBASE: u32 = (127 - 15) << 23;

impl Texel for Half {
    #[inline(always)]
    fn one<L: Lanes>(l: L, words: &[f32], _: &[f32; 256], index: U<L>) -> Rgba<L> {
        let [rg, ba] = l.gather_pairs(words, index << 1);
        let (rg, ba) = (rg.to_bits(), ba.to_bits());
        [half_to_float(rg), half_to_float(rg >> 16), half_to_float(ba), half_to_float(ba >> 16)]
    }
    #[inline(always)]
    fn pair<L: Lanes>(l: L, words: &[f32], table: &[f32; 256], index: U<L>) -> [Rgba<L>; 2] {
        [Self::one(l, words, table, index), Self::one(l, words, table, index + 1)]
    }
}

/// Four floats.
pub(crate) struct Float;

impl Texel for Float {
    #[inline(always)]
    fn one<L: Lanes>(l: L, words: &[f32], _: &[f32; 256], index: U<L>) -> Rgba<L> {
        let at = index << 2;
        let ([r, g], [b, a]) = (l.gather_pairs(words, at), l.gather_pairs(words, at + 2));
        [r, g, b, a]
    }
    #[inline(always)]
    fn pair<L: Lanes>(l: L, words: &[f32], table: &[f32; 256], index: U<L>) -> [Rgba<L>; 2] {
        [Self::one(l, words, table, index), Self::one(l, words, table, index + 1)]
    }
}

/// 8-bit RGBA codes as a word.
pub(crate) fn pack_bytes(codes: [u8; 4]) -> f32 {
    f32::from_bits(u32::from_le_bytes(codes))
}

/// RGBA as two words of half floats, held to what a half can say.
pub(crate) fn pack_halves(texel: [f32; 4]) -> [f32; 2] {
    let [r, g, b, a] = texel.map(|x| u32::from(f16::from_f32(x.clamp(-65504.0, 65504.0)).to_bits()));
    [f32::from_bits(r | (g << 16)), f32::from_bits(b | (a << 16))]
}

/// The four halves of two words.
pub(crate) fn unpack_halves(words: [f32; 2]) -> [f32; 4] {
    let half = |bits: u32| f16::from_bits((bits & 0xffff) as u16).to_f32();
    let [rg, ba] = words.map(f32::to_bits);
    [half(rg), half(rg >> 16), half(ba), half(ba >> 16)]
}
