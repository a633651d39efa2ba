//! The reciprocal of a square root, for which a level may have an estimate: cheaper than a root and a division.

#[cfg(target_arch = "x86_64")]
use core::arch::x86_64::*;
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Level, f32x16, kernel, x86::*};
use fearless_simd::{Simd, prelude::*};

/// Implemented once for every level.
pub(crate) trait InverseRoot: Simd {
    /// `1 / √x` within two units in the last place.
    fn inverse_root(self, x: Self::f32s) -> Self::f32s;
}

#[cfg(target_arch = "x86_64")]
kernel!(
    #[inline(always)]
    fn inverse_root_avx512(simd: Avx512, x: f32x16<Avx512>) -> f32x16<Avx512> {
        let x: __m512 = x.into();
        // Fourteen bits, doubled by Newton's step; those of zero and infinity are right as they are, where the step would give NaN.
        let estimate = _mm512_rsqrt14_ps(x);
        let root = _mm512_mul_ps(x, estimate);
        let error = _mm512_fnmadd_ps(root, estimate, _mm512_set1_ps(1.0));
        let usual = _mm512_cmp_ps_mask::<_CMP_ORD_Q>(root, root);
        _mm512_mask_fmadd_ps(estimate, usual, _mm512_mul_ps(error, _mm512_set1_ps(0.5)), estimate).simd_into(simd)
    }
);

impl<S: Simd> InverseRoot for S {
    #[inline(always)]
    fn inverse_root(self, x: S::f32s) -> S::f32s {
        match self.level() {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512(t) => S::f32s::from_slice(self, inverse_root_avx512(t, f32x16::from_slice(t, x.as_slice())).as_slice()),
            _ => S::f32s::splat(self, 1.0) / x.sqrt(),
        }
    }
}
