//! Phase functions as their papers have them, in double precision.

use crate::phase::Phase;
use std::f64::consts::PI;

pub(super) const RAYLEIGH: Phase = Phase::Draine { g: 0.0, alpha: 1.0 };

/// Phase functions with their mean cosines: of Draine by his equation 7, of the others by quadrature in double precision.
pub(super) fn all() -> Vec<(Phase, f64)> {
    let draine = |g: f32, alpha: f32| (Phase::Draine { g, alpha }, of_draine(g.into(), alpha.into()));
    let fournier_forand = |ior, backscatter, mean| (Phase::FournierForand { ior, backscatter }, mean);
    let mie = |diameter, mean| (Phase::Mie { diameter }, mean);
    vec![
        (Phase::HenyeyGreenstein { g: 0.0 }, 0.0),
        (Phase::HenyeyGreenstein { g: -0.8 }, f64::from(-0.8_f32)),
        (Phase::HenyeyGreenstein { g: 0.99 }, f64::from(0.99_f32)),
        (RAYLEIGH, 0.0),
        draine(0.5, 0.5),
        draine(-0.6, 3.0),
        draine(0.011, 250.0),
        draine(0.05, 250.0),
        draine(0.01, 0.5),
        draine(0.99, 30.0),
        fournier_forand(1.33, 0.1, 0.715464),
        fournier_forand(1.1, 0.02, 0.924727),
        fournier_forand(1.2, 0.3, 0.333105),
        fournier_forand(1.33, 0.499, 0.001551),
        fournier_forand(2.0, 0.4, 0.151680),
        fournier_forand(1.5, 0.1, 0.718644),
        mie(0.0, 0.0),
        mie(1.0, 0.824053),
        mie(3.0, 0.813869),
        mie(5.0, 0.843424),
        mie(20.0, 0.879310),
        mie(50.0, 0.891194),
    ]
}

fn of_draine(g: f64, alpha: f64) -> f64 {
    g * (1.0 + alpha * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0)
}

fn draine(g: f64, alpha: f64, cos: f64) -> f64 {
    let kernel = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cos).powf(1.5) / (4.0 * PI);
    kernel * (1.0 + alpha * cos * cos) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0)
}

/// Equation 13 of Fournier and Jonasz, Computer-based underwater imaging analysis (1999), ν by the part that goes back.
fn fournier_forand(n: f64, backscatter: f64, cos: f64) -> f64 {
    let delta = |squared_sine: f64| 4.0 / (3.0 * (n - 1.0).powi(2)) * squared_sine;
    let (across, back) = (delta(0.5), delta(1.0));
    let nu = -(2.0 * backscatter * (across - 1.0) + 1.0).ln() / across.ln();
    let sine = (1.0 - cos) / 2.0;
    let d = delta(sine);
    let power = d.powf(nu);
    let bracket = nu * (1.0 - d) - (1.0 - power) + (d * (1.0 - power) - nu * (1.0 - d)) / sine;
    let last = (1.0 - back.powf(nu)) / (16.0 * PI * (back - 1.0) * back.powf(nu)) * (3.0 * cos * cos - 1.0);
    bracket / (4.0 * PI * (1.0 - d).powi(2) * power) + last
}

/// A phase function in double precision; `None` of droplets, whose fits are no closed form, and where the paper's quotient is 0 over 0.
pub(super) fn exact(phase: Phase, cos: f64) -> Option<f64> {
    match phase {
        Phase::HenyeyGreenstein { g } => Some(draine(g.into(), 0.0, cos)),
        Phase::Draine { g, alpha } => Some(draine(g.into(), alpha.into(), cos)),
        Phase::FournierForand { ior, backscatter } => {
            let delta = 2.0 * (1.0 - cos) / (3.0 * (f64::from(ior) - 1.0).powi(2));
            ((delta - 1.0).abs() > 1e-4).then(|| fournier_forand(ior.into(), backscatter.into(), cos))
        }
        Phase::Mie { .. } => None,
    }
}

/// The part of Fournier and Forand's function that lies nearer than all places: the limit of its distribution, Mobley and others' equation 8.
pub(super) fn nearest(phase: Phase) -> f64 {
    let Phase::FournierForand { ior, backscatter } = phase else { return 0.0 };
    let back = 4.0 / (3.0 * (f64::from(ior) - 1.0).powi(2));
    let nu = -(2.0 * f64::from(backscatter) * (back * 0.5 - 1.0) + 1.0).ln() / (back * 0.5).ln();
    (back * 0.5e-11).powf(-nu)
}
