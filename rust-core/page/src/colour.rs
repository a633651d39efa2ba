//! Colours of values.

/// Dark to light: matplotlib's viridis in nine equal steps, which those see too who do not tell red from green.
const RAMP: [[f64; 3]; 10] = [
    [68.0, 1.0, 84.0],
    [72.0, 40.0, 120.0],
    [62.0, 73.0, 137.0],
    [49.0, 104.0, 142.0],
    [38.0, 130.0, 142.0],
    [31.0, 158.0, 137.0],
    [53.0, 183.0, 121.0],
    [110.0, 206.0, 88.0],
    [181.0, 222.0, 43.0],
    [253.0, 231.0, 37.0],
];
/// From where on black is read more easily than white.
const LIGHT: f64 = 0.5;

/// The colour of a share of the scale, as `#rrggbb`.
pub fn colour(share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (RAMP.len() - 1) as f64;
    let low = (at as usize).min(RAMP.len() - 2);
    let part = at - low as f64;
    let mixed = |k: usize| (RAMP[low][k] + part * (RAMP[low + 1][k] - RAMP[low][k])).round() as u8;
    format!("#{:02x}{:02x}{:02x}", mixed(0), mixed(1), mixed(2))
}

/// The colour of a text over that.
pub fn ink(share: f64) -> &'static str {
    if share > LIGHT { "#000" } else { "#fff" }
}
