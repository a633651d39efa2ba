//! Colour that is not multiplied by coverage, as PNG files hold it (ISO/IEC 15948, 12.3), and back.

use crate::film::{Image, Layer};
use std::borrow::Cow;

/// The colour pass with its light divided by what is covered of each pixel, which stands in the place of its coverage. Light before nothing, as lamps
/// that are seen are, stays as it is.
pub(super) fn straight<'a>(image: &Image, layer: &'a Layer) -> Cow<'a, [f32]> {
    let mut values = Cow::Borrowed(&layer.values[..]);
    let (pixels, _) = layer.values.as_chunks::<4>();
    for (number, [light @ .., by_surfaces]) in pixels.iter().enumerate() {
        let coverage = image.backdrop.coverage(number, *by_surfaces).clamp(0.0, 1.0);
        if coverage == *by_surfaces && matches!(coverage, 0.0 | 1.0) {
            continue;
        }
        let factor = if coverage > 0.0 { coverage.recip() } else { 1.0 };
        let [red, green, blue] = light.map(|x| x * factor);
        values.to_mut()[4 * number..4 * number + 4].copy_from_slice(&[red, green, blue, coverage]);
    }
    values
}

/// Gives pixels of light before nothing, of which `values` tell no coverage, the least that shows it; `whole` covers all.
pub(super) fn show_lamps<T: Copy + Default + Ord + Into<u32> + TryFrom<u32>>(rgba: &mut [T], values: &[f32], whole: T) {
    for ([red, green, blue, coverage], of) in rgba.as_chunks_mut::<4>().0.iter_mut().zip(values.as_chunks::<4>().0) {
        let most = (*red).max(*green).max(*blue);
        // Black has a code of its own in some spaces.
        let is_lit = of[..3].iter().any(|light| *light > 0.0);
        if of[3] <= 0.0 && is_lit && most > T::default() {
            let scaled = |x: T| T::try_from((x.into() * whole.into() + most.into() / 2) / most.into()).unwrap_or(whole);
            [*red, *green, *blue, *coverage] = [scaled(*red), scaled(*green), scaled(*blue), most];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lamps_before_nothing_are_as_bright_over_black() {
        let mut pixels = [51_u8, 102, 0, 0, 0, 0, 0, 0, 10, 20, 30, 0, 255, 255, 255, 0];
        let coverage = [0.0, 0.0, 1e-3, 0.0].map(|coverage| [1.0, 1.0, 1.0, coverage]);
        show_lamps(&mut pixels, coverage.as_flattened(), 255);
        assert_eq!(pixels, [128, 255, 0, 102, 0, 0, 0, 0, 10, 20, 30, 0, 255, 255, 255, 255]);
        let mut deep = [65_535_u16, 1, 0, 0, 1, 1, 1, 0];
        show_lamps(&mut deep, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], 65_535);
        assert_eq!(deep, [65_535, 1, 0, 65_535, 1, 1, 1, 0]);
    }
}
