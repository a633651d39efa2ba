//! The two numbers that describe a surface.

use super::Kind;
use crate::{results::SurfaceFigures, standard::Standard};

/// The rectangle of luminaires that the mean is taken over (CIE 144), in mounting heights: towards the observer, away from the observer, to a side.
const BEHIND: f64 = 4.0;
const AHEAD: f64 = 12.0;
const ASIDE: f64 = 3.0;
/// Parts of a mounting height.
const PARTS: usize = 20;

/// Q0 = ∫ q dΩ / ∫ dΩ over a rectangle of luminaires, and S1 = r(β 0, tan γ 2) / r(0, 0).
///
/// With dΩ = cos³γ dx dy / H² both integrals are sums over places of equal area, of r and of cos³γ.
pub(super) fn figures(kind: &Kind, name: &str) -> SurfaceFigures {
    let steps = |length: f64| (length * PARTS as f64) as usize;
    let mut sums = [0.0; 2];
    for column in 0..steps(BEHIND + AHEAD) {
        let x = (column as f64 + 0.5) / PARTS as f64 - BEHIND;
        for row in 0..steps(ASIDE) {
            let y = (row as f64 + 0.5) / PARTS as f64;
            let tangent = x.hypot(y);
            sums[0] += kind.reduced(y.atan2(x).to_degrees(), tangent, Standard::En13201);
            sums[1] += (1.0 + tangent * tangent).powf(-1.5);
        }
    }
    let overhead = kind.reduced(0.0, 0.0, Standard::En13201);
    let specular = kind.reduced(0.0, 2.0, Standard::En13201) / overhead;
    SurfaceFigures { name: name.to_owned(), q0: sums[0] / sums[1], s1: (overhead > 0.0).then_some(specular) }
}
