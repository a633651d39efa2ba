//! Colour of a black body, as UsdLux defines it.

/// Planckian colours in linear Rec.709 from 1000 K in steps of 500 K, cut to the gamut and scaled to a largest component of 1: the values that
/// UsdLux's `BlackbodyTemperatureAsRgb` has at these temperatures. From 2000 K on they are Planck's law under the CIE 1931 observer to 0.1 %.
const KNOTS: [[f64; 3]; 19] = [
    [1.0, 0.02749, 0.0],
    [1.0, 0.14966, 0.0],
    [1.0, 0.25664, 0.00809],
    [1.0, 0.37203, 0.06745],
    [1.0, 0.47673, 0.1536],
    [1.0, 0.57038, 0.2592],
    [1.0, 0.65348, 0.37716],
    [1.0, 0.72688, 0.50161],
    [1.0, 0.79154, 0.62805],
    [1.0, 0.84846, 0.75323],
    [1.0, 0.89858, 0.8749],
    [1.0, 0.94277, 0.99164],
    [0.90695, 0.89046, 1.0],
    [0.82825, 0.84184, 1.0],
    [0.76579, 0.8019, 1.0],
    [0.71526, 0.76858, 1.0],
    [0.67368, 0.74042, 1.0],
    [0.63899, 0.71636, 1.0],
    [0.60968, 0.69559, 1.0],
];
const FIRST: f64 = 1000.0;
const STEP: f64 = 500.0;

/// Linear Rec.709 colour of luminance 1 of a black body, between 1000 K and 10000 K (held there outside): a Catmull–Rom spline through [`KNOTS`],
/// cut to the gamut. Not a number gives the colour of 1000 K.
pub fn blackbody_rgb(kelvin: f32) -> [f32; 3] {
    let last = KNOTS.len() - 1;
    let place = ((f64::from(kelvin).max(FIRST) - FIRST) / STEP).min(last as f64);
    let segment = (place as usize).min(last - 1);
    let t = place - segment as f64;
    let knots = [KNOTS[segment.saturating_sub(1)], KNOTS[segment], KNOTS[segment + 1], KNOTS[(segment + 2).min(last)]];
    let mut colour = [0.0; 3];
    for (k, value) in colour.iter_mut().enumerate() {
        let [a, b, c, d] = knots.map(|knot| knot[k]);
        let cubic = 2.0 * b + t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
        *value = (0.5 * cubic).max(0.0);
    }
    let luminance = gonio_image::colour::luminance(colour);
    colour.map(|x| (x / luminance) as f32)
}
