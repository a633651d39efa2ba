//! The phase functions by their parameters, and the numbers that kernels read of each.
//!
//! All but Fournier and Forand's are a sum of Henyey and Greenstein's and Draine's.

use core::f64::consts::PI;

/// Numbers of a phase function: two loads of four.
pub(super) const ROW: usize = 8;
/// The power of the distance from straight on (1 − cosine) that directions are drawn by, where the function is finite there.
const POWER: f64 = 0.25;

/// How what floats in a medium scatters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Phase {
    /// Henyey and Greenstein's function of a mean cosine above −1 and below 1.
    HenyeyGreenstein {
        /// Mean cosine.
        g: f32,
    },
    /// Draine, Scattering by Interstellar Dust Grains (2003), equation 6. Rayleigh's function is that of g 0 and α 1.
    Draine {
        /// Above −1 and below 1.
        g: f32,
        /// Weight of the squared cosine, 0 or more.
        alpha: f32,
    },
    /// Fournier and Forand, Analytic phase function for ocean water (1994), by the part that is scattered back: Mobley, Sundman and Boss, Phase
    /// function effects on oceanic light fields (2002).
    FournierForand {
        /// Refractive index of the particles within their liquid, above 1.
        ior: f32,
        /// The part that goes back, above 0 and below 0.5.
        backscatter: f32,
    },
    /// Droplets of water: Jendersie and d'Eon, An Approximate Mie Scattering Function for Fog and Cloud Rendering (2023), with their supplement.
    Mie {
        /// Micrometres, from 0 to 50.
        diameter: f32,
    },
}

impl Default for Phase {
    fn default() -> Self {
        Self::HenyeyGreenstein { g: 0.0 }
    }
}

impl Phase {
    /// The mean cosine of Henyey and Greenstein's function; `None` of others.
    pub fn henyey_greenstein(self) -> Option<f32> {
        if let Self::HenyeyGreenstein { g } = self { Some(g) } else { None }
    }

    /// What kernels read of it.
    pub(super) fn numbers(self) -> [f32; ROW] {
        let numbers = match self {
            Self::HenyeyGreenstein { g } => Blend { g_hg: g.into(), ..Blend::default() }.numbers(),
            Self::Draine { g, alpha } => Blend { g_hg: 0.0, g_draine: g.into(), alpha: alpha.into(), weight: 1.0 }.numbers(),
            Self::FournierForand { ior, backscatter } => fournier_forand(ior.into(), backscatter.into()),
            Self::Mie { diameter } => Blend::of_droplets(diameter.into()).numbers(),
        };
        numbers.map(|x| x as f32)
    }
}

/// A sum of Henyey and Greenstein's function and of Draine's.
#[derive(Clone, Copy, Debug, Default)]
struct Blend {
    g_hg: f64,
    g_draine: f64,
    alpha: f64,
    /// Draine's part.
    weight: f64,
}

impl Blend {
    /// Jendersie and d'Eon's fits; equations 7 to 10 of the paper, 11 to 22 of the supplement.
    fn of_droplets(d: f64) -> Self {
        let l = d.ln();
        if d <= 0.1 {
            let [g_hg, g_draine] = [13.8 * d * d, 1.1456 * d * (9.29044 * d).sin()];
            return Self { g_hg, g_draine, alpha: 250.0, weight: 0.252977 - 312.983 * d.powf(4.3) };
        }
        if d < 1.5 {
            let inner = (l - 0.238604) * (l + 1.00667) / (0.507522 - 0.15677 * l);
            return Self {
                g_hg: 0.862 - 0.143 * l * l,
                g_draine: 0.379685 * (1.19692 * inner.cos() + 1.37932 * l + 0.0625835).cos() + 0.344213,
                alpha: 250.0,
                weight: 0.146209 * (3.38707 * l + 2.11193).cos() + 0.316072 + 0.0778917 * l,
            };
        }
        if d < 5.0 {
            return Self {
                g_hg: 0.0604931 * l.ln() + 0.940256,
                g_draine: 0.500411 - 0.081287 / (-2.0 * l + l.tan() + 1.27551),
                alpha: 7.30354 * l + 6.31675,
                weight: 0.026914 * (l - (5.68947 * (l.ln() - 0.0292149)).cos()) + 0.376475,
            };
        }
        Self {
            g_hg: (-0.0990567 / (d - 1.67154)).exp(),
            g_draine: (-2.20679 / (d + 3.91029) - 0.428934).exp(),
            alpha: (3.62489 - 8.29288 / (d + 5.52825)).exp(),
            weight: (-0.599085 / (d - 0.641583) - 0.665888).exp(),
        }
    }

    /// Both mean cosines with the factors before their kernels, α, what draws by, and that it is a blend.
    fn numbers(self) -> [f64; ROW] {
        let Self { g_hg, g_draine, alpha, weight } = self;
        let of_hg = (1.0 - weight) * (1.0 - g_hg * g_hg) / (4.0 * PI);
        let whole = 1.0 + alpha * (1.0 + 2.0 * g_draine * g_draine) / 3.0;
        let of_draine = weight * (1.0 - g_draine * g_draine) / (4.0 * PI * whole);
        [g_hg, of_hg, g_draine, of_draine, alpha, POWER.recip(), 0.0, 0.0]
    }
}

/// Fournier and Forand's ν, the logarithm of their δ over 1 − cosine, one minus their δ straight back, the factor of the last term, what draws by,
/// and that it is no blend.
fn fournier_forand(ior: f64, backscatter: f64) -> [f64; ROW] {
    let back = 4.0 / (3.0 * (ior - 1.0) * (ior - 1.0));
    let across = back * 0.5 - 1.0;
    // The limits where δ is 1 across, and straight back.
    let nu = if across == 0.0 { -2.0 * backscatter } else { -(2.0 * backscatter * across).ln_1p() / across.ln_1p() };
    let last = if back == 1.0 { -nu } else { (-nu * back.ln()).exp_m1() / (back - 1.0) } / (16.0 * PI);
    [nu, (back * 0.5).ln(), 1.0 - back, last, 0.0, POWER.min(-nu).recip(), 1.0, 0.0]
}
