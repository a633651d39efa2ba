//! Correlated colour temperature: the blackbody nearest in the CIE 1960 diagram (CIE 15), and how far it is, Duv (ANSI C78.377).

use crate::{illuminant::planck, observer, white::turned};
use std::sync::LazyLock;

/// The lowest temperature that is looked for, K.
pub const LOWEST_CCT: f64 = 1000.0;
/// The highest, K, where daylight of the CIE ends.
pub const HIGHEST_CCT: f64 = 25_000.0;
/// How far from the blackbodies a light may be and still have a correlated colour temperature (CIE 15, 9.4).
pub const LARGEST_DUV: f64 = 0.05;

/// Temperatures of the first search over one another.
const RATIO: f64 = 1.01;

/// Steps of the second search: 1.02 × 0.618^40 is 5e-9 of the temperature.
const STEPS: usize = 40;

/// Blackbodies in steps of one per cent from below the lowest to above the highest temperature: ln K, u, v.
static LOCUS: LazyLock<Vec<(f64, [f64; 2])>> = LazyLock::new(|| {
    let [from, to] = [(LOWEST_CCT / RATIO.powi(2)).ln(), (HIGHEST_CCT * RATIO.powi(2)).ln()];
    let count = ((to - from) / RATIO.ln()).ceil() as usize;
    (0..=count).map(|k| from + (to - from) * k as f64 / count as f64).map(|log| (log, blackbody(log))).collect()
});

/// u, v of the blackbody of exp(`log`) kelvin.
fn blackbody(log: f64) -> [f64; 2] {
    let kelvin = log.exp();
    let mut sums = [0.0; 3];
    for nm in 360..=830 {
        let power = planck(f64::from(nm), kelvin);
        let observed = gonio_formats::bsdf::cie_1931(f64::from(nm));
        sums.iter_mut().zip(observed).for_each(|(sum, observed)| *sum += power * observed);
    }
    observer::uv(sums)
}

/// The same between the places of [`LOCUS`], by the cubic through the four about it, to 1e-9.
fn between(log: f64) -> [f64; 2] {
    let place = (log - LOCUS[0].0) / (LOCUS[1].0 - LOCUS[0].0);
    let below = (place as usize).clamp(1, LOCUS.len() - 3);
    let t = place - below as f64;
    let weights =
        [-t * (t - 1.0) * (t - 2.0) / 6.0, (t * t - 1.0) * (t - 2.0) / 2.0, -t * (t + 1.0) * (t - 2.0) / 2.0, t * (t * t - 1.0) / 6.0];
    let of = |axis: usize| weights.iter().enumerate().map(|(k, weight)| weight * LOCUS[below - 1 + k].1[axis]).sum();
    [of(0), of(1)]
}

/// Correlated colour temperature in K, to about a kelvin, and Duv of linear Rec.709, for pictures; `None` where it is not white.
pub fn cct_of_colour(rec709: [f64; 3]) -> Option<(f64, f64)> {
    cct_nearby(observer::uv(turned(&REC709_TO_XYZ, rec709)))
}

/// Correlated colour temperature in K, to about a kelvin, and Duv of a chromaticity in the 1960 diagram; `None` where it is not white.
pub(crate) fn cct_nearby(uv: [f64; 2]) -> Option<(f64, f64)> {
    let squared = |place: usize| distance(uv, LOCUS[place].1).powi(2);
    let nearest = (0..LOCUS.len()).min_by(|a, b| squared(*a).total_cmp(&squared(*b)))?.clamp(1, LOCUS.len() - 2);
    // The parabola through the three squares has its least between them.
    let [below, here, above] = [nearest - 1, nearest, nearest + 1].map(squared);
    let shift = 0.5 * (below - above) / (below - 2.0 * here + above);
    let step = LOCUS[1].0 - LOCUS[0].0;
    let kelvin = (LOCUS[nearest].0 + shift * step).exp();
    let part = |k: usize| {
        let [a, b, c] = [nearest - 1, nearest, nearest + 1].map(|place| LOCUS[place].1[k]);
        b + shift * (0.5 * (c - a) + 0.5 * shift * (a - 2.0 * b + c))
    };
    let on = [part(0), part(1)];
    let duv = distance(uv, on).copysign(uv[1] - on[1]);
    ((LOWEST_CCT..=HIGHEST_CCT).contains(&kelvin) && duv.abs() <= LARGEST_DUV).then_some((kelvin, duv))
}

/// To tristimulus values from linear Rec.709.
const REC709_TO_XYZ: [[f64; 3]; 3] = [
    [0.412_390_799_265_959, 0.357_584_339_383_878, 0.180_480_788_401_834],
    [0.212_639_005_871_51, 0.715_168_678_767_756, 0.072_192_315_360_734],
    [0.019_330_818_715_592, 0.119_194_779_794_626, 0.950_532_152_249_661],
];

fn distance([u0, v0]: [f64; 2], [u1, v1]: [f64; 2]) -> f64 {
    (u1 - u0).hypot(v1 - v0)
}

/// The correlated colour temperature in K and Duv of a chromaticity in the 1960 diagram; `None` where the nearest blackbody lies beyond
/// [`LOWEST_CCT`] or [`HIGHEST_CCT`].
pub(crate) fn cct(uv: [f64; 2]) -> Option<(f64, f64)> {
    let nearest = (0..LOCUS.len()).min_by(|a, b| distance(uv, LOCUS[*a].1).total_cmp(&distance(uv, LOCUS[*b].1)))?;
    let [mut low, mut high] = [LOCUS[nearest.saturating_sub(1)].0, LOCUS[(nearest + 1).min(LOCUS.len() - 1)].0];
    // Golden section: the distance has one minimum between neighbours of the nearest.
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let at = |log: f64| (log, distance(uv, between(log)));
    let mut inner = [at(high - golden * (high - low)), at(low + golden * (high - low))];
    for _ in 0..STEPS {
        if inner[0].1 < inner[1].1 {
            high = inner[1].0;
            inner = [at(high - golden * (high - low)), inner[0]];
        } else {
            low = inner[0].0;
            inner = [inner[1], at(low + golden * (high - low))];
        }
    }
    let log = 0.5 * (low + high);
    let kelvin = log.exp();
    let on = between(log);
    let duv = distance(uv, on).copysign(uv[1] - on[1]);
    // The search's own resolution, so that a blackbody of the limit is within.
    let slack = 1.0 + 1e-6;
    (LOWEST_CCT / slack..=HIGHEST_CCT * slack).contains(&kelvin).then_some((kelvin, duv))
}

/// The correlated colour temperature in K and Duv of tristimulus values (1931); `None` of light that is not white.
pub fn cct_of_xyz(xyz: [f64; 3]) -> Option<(f64, f64)> {
    cct(observer::uv(xyz)).filter(|(_, duv)| duv.abs() <= LARGEST_DUV)
}

/// Weights of X, Y and Z whose sum is zero for light of a correlated colour temperature, above zero for cooler light and below for warmer: the isotherm
/// crosses the blackbodies at a right angle in the 1960 diagram. Over X + 15 Y + 3 Z the sum is the logarithm of the temperatures' ratio, nearby.
pub fn isotherm(kelvin: f64) -> [f64; 3] {
    const STEP: f64 = 1e-3;
    let log = kelvin.clamp(LOWEST_CCT, HIGHEST_CCT).ln();
    let ([u, v], [cooler, warmer]) = (between(log), [between(log + STEP), between(log - STEP)]);
    let along = [0, 1].map(|k| (cooler[k] - warmer[k]) / (2.0 * STEP));
    let square = along[0] * along[0] + along[1] * along[1];
    let own = u * along[0] + v * along[1];
    // (4 X, 6 Y) over X + 15 Y + 3 Z is u, v.
    [4.0 * along[0] - own, 6.0 * along[1] - 15.0 * own, -3.0 * own].map(|weight| weight / square)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn isotherms_part_cooler_light_from_warmer() {
        let xyz = |[u, v]: [f64; 2]| {
            // Y = 1: u = 4 X / d, v = 6 / d, d = X + 15 + 3 Z.
            let d = 6.0 / v;
            let x = u * d / 4.0;
            [x, 1.0, (d - x - 15.0) / 3.0]
        };
        for kelvin in [1800.0_f64, 2700.0, 4000.0, 6500.0, 15_000.0] {
            let weights = isotherm(kelvin);
            let sum = |[x, y, z]: [f64; 3]| (weights[0] * x + weights[1] * y + weights[2] * z) / (x + 15.0 * y + 3.0 * z);
            for ratio in [0.98_f64, 1.02] {
                assert!((sum(xyz(blackbody((kelvin * ratio).ln()))) - ratio.ln()).abs() < 2e-3, "{kelvin} {ratio}");
            }
            // Off the blackbodies as well: a light on the isotherm has that temperature.
            let (on, next) = (blackbody(kelvin.ln()), blackbody(kelvin.ln() + 1e-3));
            let along = [next[0] - on[0], next[1] - on[1]];
            let length = along[0].hypot(along[1]);
            let off = xyz([on[0] - 0.01 * along[1] / length, on[1] + 0.01 * along[0] / length]);
            assert!(sum(off).abs() < 1e-2, "{kelvin}: {}", sum(off));
            let (found, duv) = cct_of_xyz(off).expect("white light");
            assert!((found / kelvin - 1.0).abs() < 1e-3 && (duv.abs() - 0.01).abs() < 1e-6, "{kelvin}: {found} {duv}");
        }
        assert_eq!(cct_of_xyz([0.0, 1.0, 0.0]), None);
    }

    #[test]
    fn blackbodies_between_those_of_the_table_are_blackbodies() {
        let count = 3000;
        for k in 0..=count {
            let log = LOWEST_CCT.ln() + (HIGHEST_CCT / LOWEST_CCT).ln() * f64::from(k) / f64::from(count);
            let [at, own] = [between(log), blackbody(log)];
            assert!(distance(at, own) < 1e-9, "{}: {at:?} {own:?}", log.exp());
            let (kelvin, duv) = cct(own).expect("a blackbody");
            assert!((kelvin / log.exp() - 1.0).abs() < 1e-6 && duv.abs() < 1e-8, "{}: {kelvin} {duv}", log.exp());
        }
    }
}
