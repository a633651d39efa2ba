//! Tone-mapped light for hosts that add the display's curve themselves.

use super::{CHUNK, DisplaySpace, Look, ToneCurve, curve::operated, rgba, shown};
use crate::film::Image;
use gonio_simd::{Execution, Lanes, Rgb, dispatch};

/// The colour pass after the operator and before the display's curve: linear Rec.709 in [0, 1] with the pass's alpha, RGBA, rows from the top.
/// With sRGB's curve it shows what [`super::display`] gives for that space; the look's own space is left out.
pub fn display_linear(image: &Image, look: &Look, execution: Execution) -> Vec<f32> {
    let mut planes = [[0.0; CHUNK]; 3];
    shown(image, &Look { space: DisplaySpace::Srgb, ..*look }, execution, |values, around, curve, out| {
        dispatch!(execution, l => linear_batch(l, values, around, curve, &mut planes));
        let [red, green, blue] = &planes;
        let colours = red.iter().zip(green).zip(blue);
        out.extend(values.chunks_exact(4).zip(colours).flat_map(|(pixel, ((red, green), blue))| [*red, *green, *blue, pixel[3]]));
    })
}

#[inline(always)]
fn linear_batch<L: Lanes>(l: L, values: &[f32], around: &[f32], curve: &ToneCurve, [red, green, blue]: &mut [[f32; CHUNK]; 3]) {
    for at in (0..values.len() / 4).step_by(L::COUNT) {
        let [r, g, b, _] = rgba(l, values, at);
        let around = if around.is_empty() { None } else { Some(l.load(around, at)) };
        operated(Rgb::new(r, g, b), around, curve).saturate().store([red, green, blue], at);
    }
}
