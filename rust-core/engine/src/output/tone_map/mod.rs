//! From scene-linear light to display values, on lanes.

mod curve;
mod exposure;
mod linear;
mod local;
mod space;
mod straight;
#[cfg(test)]
mod tests;

pub use curve::{KEY, ToneCurve, map_lanes};
pub use exposure::{Adaptation, log_average};
pub use linear::display_linear;
pub use space::DisplaySpace;

use crate::{
    error::{Error, Result},
    film::Image,
    scene::Aov,
};
use gonio_simd::{Execution, F, Lanes, Rgb, U, dispatch};
use straight::{show_lamps, straight};

/// Pixels that are worked on at a time; a multiple of all registers.
const CHUNK: usize = 4096;

/// How radiance becomes display values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum ToneMap {
    /// The display's curve alone, values above white clipped.
    None,
    /// The photographic operator (Reinhard et al. 2002) on the log-average luminance.
    #[default]
    Photographic,
    /// The same, dodging and burning: each pixel is compressed by the luminance of its surroundings.
    Local,
    /// A fixed exposure: luminance 1.2 · 2^EV100 becomes white, then as `None`.
    Ev100(f32),
}

impl ToneMap {
    /// The operator of a name: `photographic`, `local`, `none`, or `ev100=12`.
    pub fn by_name(text: &str) -> Result<Self> {
        let ev = || text.strip_prefix("ev100=").and_then(|ev| ev.parse::<f32>().ok()).filter(|ev| ev.is_finite());
        let named = match text {
            "photographic" => Some(Self::Photographic),
            "local" => Some(Self::Local),
            "none" => Some(Self::None),
            _ => ev().map(Self::Ev100),
        };
        named.ok_or_else(|| Error::setting("tonemap", format!("'{text}' was found, expected photographic, local, none or ev100=NUMBER")))
    }

    /// Whether the exposure follows the picture's log-average luminance.
    pub fn adapts(self) -> bool {
        matches!(self, Self::Photographic | Self::Local)
    }
}

/// How a picture is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// The operator.
    pub tone_map: ToneMap,
    /// Powers of two by which it is brightened.
    pub stops: f32,
    /// Luminance at which the photographic operators reach white, where the log-average luminance is 0.18.
    pub white: f32,
    /// The log-average luminance that the photographic operators adapt to; the picture's own if `None`.
    pub adapted: Option<f32>,
    /// What the values mean.
    pub space: DisplaySpace,
}

impl Default for Look {
    fn default() -> Self {
        Self { tone_map: ToneMap::default(), stops: 0.0, white: 6.0, adapted: None, space: DisplaySpace::default() }
    }
}

impl Look {
    /// A look whose numbers are checked.
    pub fn new(tone_map: ToneMap, stops: f32, white: f32, adapted: Option<f32>, space: DisplaySpace) -> Result<Self> {
        let positive = |x: f32| x > 0.0 && x.is_finite();
        if !stops.is_finite() {
            return Err(Error::setting("exposure", format!("{stops} was found, expected a finite number of stops")));
        }
        let luminances = [("white", Some(white)), ("adapted", adapted)];
        if let Some((name, Some(wrong))) = luminances.into_iter().find(|(_, x)| x.is_some_and(|x| !positive(x))) {
            return Err(Error::setting(name, format!("a luminance of {wrong} was found, expected more than 0")));
        }
        Ok(Self { tone_map, stops, white, adapted, space })
    }
}

/// The colour pass as 8-bit RGBA, rows from the top: colours are not multiplied by coverage, and what is seen of a sky covers.
pub fn display(image: &Image, look: &Look, execution: Execution) -> Vec<u8> {
    let Some(layer) = image.layer(Aov::Color) else { return Vec::new() };
    let values = straight(image, layer);
    let mut bytes = bytes(image, &values, look, execution);
    show_lamps(&mut bytes, &values, u8::MAX);
    bytes
}

/// The colour pass over black as 8-bit RGBA, opaque, rows from the top.
pub fn display_over_black(image: &Image, look: &Look, execution: Execution) -> Vec<u8> {
    let Some(layer) = image.layer(Aov::Color) else { return Vec::new() };
    let mut bytes = bytes(image, &layer.values, look, execution);
    bytes.iter_mut().skip(3).step_by(4).for_each(|coverage| *coverage = u8::MAX);
    bytes
}

/// The colour pass as 16-bit RGBA, else as [`display`] has it.
pub fn display_deep(image: &Image, look: &Look, execution: Execution) -> Vec<u16> {
    let Some(layer) = image.layer(Aov::Color) else { return Vec::new() };
    let (values, mut halves) = (straight(image, layer), [[0; CHUNK], [0; CHUNK]]);
    let mut words = shown(image, &values, look, execution, |values, around, curve, words| {
        dispatch!(execution, l => words_batch(l, values, around, curve, &mut halves));
        let both = halves[0].iter().zip(&halves[1]).take(values.len() / 4);
        words.extend(both.flat_map(|(rg, ba)| [*rg as u16, (*rg >> 16) as u16, *ba as u16, (*ba >> 16) as u16]));
    });
    show_lamps(&mut words, &values, u16::MAX);
    words
}

fn bytes(image: &Image, values: &[f32], look: &Look, execution: Execution) -> Vec<u8> {
    let mut pixels = [0; CHUNK];
    shown(image, values, look, execution, |values, around, curve, bytes| {
        dispatch!(execution, l => bytes_batch(l, values, around, curve, &mut pixels));
        bytes.extend_from_slice(bytemuck::cast_slice(&pixels[..values.len() / 4]));
    })
}

/// Runs `encode` on pieces of RGBA values in the place of the colour pass's, the luminance around each pixel (empty unless the operator is local),
/// and the curve.
fn shown<T>(
    image: &Image,
    values: &[f32],
    look: &Look,
    execution: Execution,
    mut encode: impl FnMut(&[f32], &[f32], &ToneCurve, &mut Vec<T>),
) -> Vec<T> {
    let Some(layer) = image.layer(Aov::Color).filter(|layer| layer.values.len() >= 4) else { return Vec::new() };
    let average = || look.adapted.unwrap_or_else(|| log_average(image, execution));
    let curve = ToneCurve::new(look, if look.tone_map.adapts() { average() } else { KEY });
    let around =
        if look.tone_map == ToneMap::Local { local::surroundings(layer, image.size(), curve.scale, execution) } else { Vec::new() };
    let mut out = Vec::with_capacity(values.len());
    for (number, values) in values.chunks(4 * CHUNK).enumerate() {
        encode(values, around.get(number * CHUNK..).unwrap_or_default(), &curve, &mut out);
    }
    out
}

#[inline(always)]
fn bytes_batch<L: Lanes>(l: L, values: &[f32], around: &[f32], curve: &ToneCurve, out: &mut [u32]) {
    for at in (0..values.len() / 4).step_by(L::COUNT) {
        let ([r, g, b], a) = pixels(l, values, around, curve, at);
        (whole(r, 255.0) | (whole(g, 255.0) << 8) | (whole(b, 255.0) << 16) | (whole(a, 255.0) << 24)).store(out, at);
    }
}

#[inline(always)]
fn words_batch<L: Lanes>(l: L, values: &[f32], around: &[f32], curve: &ToneCurve, [first, second]: &mut [[u32; CHUNK]; 2]) {
    for at in (0..values.len() / 4).step_by(L::COUNT) {
        let ([r, g, b], a) = pixels(l, values, around, curve, at);
        (whole(r, 65_535.0) | (whole(g, 65_535.0) << 16)).store(first, at);
        (whole(b, 65_535.0) | (whole(a, 65_535.0) << 16)).store(second, at);
    }
}

/// Display values and alpha of a register of pixels.
#[inline(always)]
fn pixels<L: Lanes>(l: L, values: &[f32], around: &[f32], curve: &ToneCurve, at: usize) -> ([F<L>; 3], F<L>) {
    let [r, g, b, alpha] = rgba(l, values, at);
    let around = if around.is_empty() { None } else { Some(l.load(around, at)) };
    let Rgb { r, g, b } = map_lanes(Rgb::new(r, g, b), around, curve);
    ([r, g, b], alpha.saturate())
}

/// A register of pixels; beyond the last one it is again there.
#[inline(always)]
fn rgba<L: Lanes>(l: L, values: &[f32], at: usize) -> [F<L>; 4] {
    let whole = 4 * (at + L::COUNT) <= values.len();
    if whole { l.load_quads(values, at) } else { l.gather_quads(values, (l.iota() + at as u32) << 2) }
}

/// The nearest of so many steps.
#[inline(always)]
fn whole<L: Lanes>(x: F<L>, steps: f32) -> U<L> {
    x.mul_add(steps, 0.5).to_i32()
}
