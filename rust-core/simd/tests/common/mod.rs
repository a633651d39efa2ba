//! Functions on lanes called on whole slices, at any level.

use gonio_simd::{Execution, F, Lanes, dispatch};

/// A function of two values (the second may be ignored), written once for all lanes.
pub(crate) trait Function {
    /// The function by lane.
    fn call<L: Lanes>(x: F<L>, y: F<L>) -> F<L>;
}

/// Declares a unit type that is a [`Function`].
macro_rules! function {
    ($name:ident, $x:ident, $y:pat => $body:expr) => {
        struct $name;
        impl $crate::common::Function for $name {
            #[inline(always)]
            fn call<L: gonio_simd::Lanes>($x: gonio_simd::F<L>, $y: gonio_simd::F<L>) -> gonio_simd::F<L> {
                $body
            }
        }
    };
}

#[inline(always)]
fn map_batch<L: Lanes, K: Function>(l: L, x: &[f32], y: &[f32], out: &mut [f32]) {
    for at in (0..out.len()).step_by(L::COUNT) {
        K::call(l.load(x, at), l.load(y, at)).store(out, at);
    }
}

/// The function's values at two columns of arguments, padded to whole registers.
pub(crate) fn map_columns<K: Function>(execution: Execution, x: &[f32], y: &[f32], out: &mut [f32]) {
    dispatch!(execution, l => map_batch::<_, K>(l, x, y, out));
}
