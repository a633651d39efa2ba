//! How far points of an area are apart (EN 12193, EN 12464-1).

/// Metres that points are apart at most.
const FARTHEST: f64 = 10.0;

/// The side d of an area that its points are divided by, the longer, or the shorter where the longer has twice its length; and the greatest spacing,
/// p = 0.2 · 5^log₁₀ d, at most 10. Metres.
pub(crate) fn side_and_spacing(sides: [f64; 2]) -> [f64; 2] {
    let (longer, shorter) = (sides[0].max(sides[1]), sides[0].min(sides[1]));
    let d = if longer >= 2.0 * shorter { shorter } else { longer };
    [d, (0.2 * 5.0_f64.powf(d.log10())).min(FARTHEST)]
}
