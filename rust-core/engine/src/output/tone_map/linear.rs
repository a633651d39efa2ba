//! Tone-mapped light for hosts that add the display's curve themselves.

use super::{CHUNK, DisplaySpace, Look, ToneCurve, curve::operated, rgba, shown, straight::straight};
use crate::{film::Image, scene::Aov};
use gonio_simd::{Execution, Lanes, Rgb, dispatch};

/// The colour pass after the operator and before the display's curve: linear Rec.709 in [0, 1] times what is covered, with the pass's alpha, RGBA,
/// rows from the top. Divided by what is covered it shows, with sRGB's curve, what [`super::display`] gives for that space; the look's own space is
/// left out.
pub fn display_linear(image: &Image, look: &Look, execution: Execution) -> Vec<f32> {
    let Some(layer) = image.layer(Aov::Color) else { return Vec::new() };
    let mut planes = [[0.0; CHUNK]; 3];
    let mut linear =
        shown(image, &straight(image, layer), &Look { space: DisplaySpace::Srgb, ..*look }, execution, |values, around, curve, out| {
            dispatch!(execution, l => linear_batch(l, values, around, curve, &mut planes));
            let [red, green, blue] = &planes;
            let colours = red.iter().zip(green).zip(blue);
            out.extend(values.chunks_exact(4).zip(colours).flat_map(|(pixel, ((red, green), blue))| {
                // Light before nothing stays.
                let coverage = if pixel[3] > 0.0 { pixel[3] } else { 1.0 };
                [*red * coverage, *green * coverage, *blue * coverage, 0.0]
            }));
        });
    linear.iter_mut().zip(&layer.values).skip(3).step_by(4).for_each(|(shown, by_surfaces)| *shown = *by_surfaces);
    linear
}

#[inline(always)]
fn linear_batch<L: Lanes>(l: L, values: &[f32], around: &[f32], curve: &ToneCurve, [red, green, blue]: &mut [[f32; CHUNK]; 3]) {
    for at in (0..values.len() / 4).step_by(L::COUNT) {
        let [r, g, b, _] = rgba(l, values, at);
        let around = if around.is_empty() { None } else { Some(l.load(around, at)) };
        operated(Rgb::new(r, g, b), around, curve).saturate().store([red, green, blue], at);
    }
}
