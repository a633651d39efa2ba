//! Light scattered often: once exactly, and more by a fit for Earth; four wavelengths whose sums are colours.

use super::{Atmosphere, Model, distance_to};
use std::f64::consts::{PI, TAU};

/// Values at 630, 560, 490 and 430 nm.
type Four = [f64; 4];

/// Radii of the ground and of the top, km.
const GROUND: f64 = 6371.0;
const TOP: f64 = 6471.0;
/// Pieces of the way that is looked along, and of the way to the sun.
const STEPS: usize = 64;
/// Heights and sines in the table of transmittances.
const TABLE: [usize; 2] = [64, 256];
/// Irradiance outside the atmosphere, W/(m² nm).
const SUN: Four = [1.679, 1.828, 1.986, 1.307];
/// Scattering by air at the sea, 1/km.
const AIR: Four = [6.605e-3, 1.067e-2, 1.842e-2, 3.156e-2];
/// Absorption by ozone in units that the densities below are of, and its amount in Dobson's.
const OZONE: Four = [3.472e-25, 3.914e-25, 1.349e-25, 1.103e-26];
const OZONE_DOBSON: f64 = 334.5;
/// Dust over a city: absorption and scattering, density at the sea and everywhere, and the height in which it thins out, km.
const DUST_ABSORPTION: Four = [2.8722e-24, 4.6168e-24, 7.9706e-24, 1.3578e-23];
const DUST_SCATTERING: Four = [1.5908e-22, 1.7711e-22, 2.0942e-22, 2.4033e-22];
const DUST_DENSITY: f64 = 1.3681e20;
const DUST_BACKGROUND: f64 = 2e6;
const DUST_HEIGHT: f64 = 0.73;
const DUST_MEAN_COSINE: f64 = 0.8;
const GROUND_ALBEDO: f64 = 0.3;
/// Share of the wavelengths in what comes from elsewhere in the atmosphere.
const ELSEWHERE: Four = [0.217, 0.347, 0.594, 1.0];
/// X, Y and Z of each wavelength.
const TRISTIMULUS: [[f64; 3]; 4] = [
    [53.386_917_74, 22.981_337_51, 0.0],
    [43.904_844_47, 71.347_795_70, 0.102_506_87],
    [1.613_727_83, 18.422_960_59, 31.742_921_19],
    [20.762_668_67, 2.361_421_35, 110.480_096_43],
];

/// The atmosphere with its transmittances.
pub(super) struct Multiple {
    radius: f64,
    amounts: [f64; 3],
    /// Towards the sun, by height and by the sine at which the way rises.
    transmittances: Vec<Four>,
}

/// What a kilometre at some height does.
struct Coefficients {
    air: Four,
    dust: Four,
    extinction: Four,
}

impl Multiple {
    pub(super) fn new(of: &Atmosphere) -> Self {
        let radius = GROUND + of.altitude_m.clamp(1.0, 99_999.0) * 1e-3;
        let mut made = Self { radius, amounts: [of.air, of.dust, of.ozone], transmittances: Vec::new() };
        let knot = |index: usize| {
            let [row, column] = [index / TABLE[1], index % TABLE[1]];
            let height = row as f64 / (TABLE[0] - 1) as f64;
            made.transmittance(GROUND + height * (TOP - GROUND), 2.0 * column as f64 / (TABLE[1] - 1) as f64 - 1.0)
        };
        made.transmittances = (0..TABLE[0] * TABLE[1]).map(knot).collect();
        made
    }

    fn coefficients(&self, radius: f64) -> Coefficients {
        let height = (radius - GROUND).max(0.0);
        let logarithm = height.max(1e-4).ln();
        let thin = self.amounts[0] * (-0.077_719_71 * height.powf(1.163_642_43)).exp();
        let dust = self.amounts[1] * DUST_DENSITY * ((-height / DUST_HEIGHT).exp() + DUST_BACKGROUND / DUST_DENSITY);
        let ozone = self.amounts[2] * OZONE_DOBSON * 3.785_473_97e20 * (-(logarithm - 3.222_61).powi(2) * 5.555_555_55 - logarithm).exp();
        Coefficients {
            air: AIR.map(|value| value * thin),
            dust: DUST_SCATTERING.map(|value| value * dust),
            extinction: std::array::from_fn(|i| AIR[i] * thin + (DUST_SCATTERING[i] + DUST_ABSORPTION[i]) * dust + OZONE[i] * ozone),
        }
    }

    /// From a radius to the top, along a way that rises with the sine `up` there.
    fn transmittance(&self, radius: f64, up: f64) -> Four {
        let step = distance_to(radius, up, TOP).unwrap_or(0.0) / STEPS as f64;
        let mut depth = [0.0; 4];
        for index in 0..STEPS {
            let way = (index as f64 + 0.5) * step;
            let here = self.coefficients((radius * radius + way * way + 2.0 * radius * way * up).sqrt());
            depth = std::array::from_fn(|i| depth[i] + step * here.extinction[i]);
        }
        depth.map(|value| (-value).exp())
    }

    /// From the table; `height` is a share of the atmosphere's thickness.
    fn tabulated(&self, height: f64, up: f64) -> Four {
        let [y, x] = [height.clamp(0.0, 1.0) * (TABLE[0] - 1) as f64, (0.5 * up + 0.5).clamp(0.0, 1.0) * (TABLE[1] - 1) as f64];
        let [row, column] = [(y as usize).min(TABLE[0] - 2), (x as usize).min(TABLE[1] - 2)];
        let [v, u] = [y - row as f64, x - column as f64];
        let knot = |down: usize, right: usize| self.transmittances[(row + down) * TABLE[1] + column + right];
        let [a, b, c, d] = [knot(0, 0), knot(0, 1), knot(1, 0), knot(1, 1)];
        std::array::from_fn(|i| (1.0 - v) * ((1.0 - u) * a[i] + u * b[i]) + v * ((1.0 - u) * c[i] + u * d[i]))
    }

    /// Light that comes to a place from the ground and from elsewhere in the atmosphere, over the sun's irradiance and per steradian.
    fn elsewhere(&self, radius: f64, height: f64, sun_up: f64) -> Four {
        let solid_angle = TAU * (1.0 - (1.0 - (GROUND / radius).powi(2)).max(0.0).sqrt());
        let [to_ground, below, here] = [self.tabulated(0.0, sun_up), self.tabulated(0.0, 1.0), self.tabulated(height, 1.0)];
        let spread = 0.02 / (1.0 + 5.0 * (-17.92 * sun_up).exp());
        let ground = solid_angle / (4.0 * PI) * GROUND_ALBEDO / PI * sun_up;
        std::array::from_fn(|i| spread * ELSEWHERE[i] + ground * to_ground[i] * below[i] / here[i])
    }
}

impl Model for Multiple {
    fn radiance(&self, direction: [f64; 3], sun: [f64; 3]) -> [f64; 3] {
        let up = direction[2];
        let cosine: f64 = direction.iter().zip(sun).map(|(a, b)| a * b).sum();
        let [air_phase, dust_phase] = phases(cosine);
        let ground = if up < 0.0 { distance_to(self.radius, up, GROUND) } else { None };
        let step = ground.or_else(|| distance_to(self.radius, up, TOP)).unwrap_or(0.0) / STEPS as f64;
        let (mut passed, mut sum) = ([1.0; 4], [0.0; 4]);
        for index in 0..STEPS {
            let way = (index as f64 + 0.5) * step;
            let place = [direction[0] * way, direction[1] * way, self.radius + up * way];
            let radius = place.iter().map(|x| x * x).sum::<f64>().sqrt();
            let height = (radius - GROUND).max(0.0) / (TOP - GROUND);
            let sun_up = place.iter().zip(sun).map(|(a, b)| a * b).sum::<f64>() / radius;
            let (here, lit, more) = (self.coefficients(radius), self.tabulated(height, sun_up), self.elsewhere(radius, height, sun_up));
            for i in 0..4 {
                let source = here.air[i] * (air_phase * lit[i] + more[i]) + here.dust[i] * (dust_phase * lit[i] + more[i]);
                // The source is even over the piece, the way to it is not.
                let through = (-step * here.extinction[i]).exp();
                sum[i] += passed[i] * SUN[i] * source * (1.0 - through) / here.extinction[i].max(1e-7);
                passed[i] *= through;
            }
        }
        tristimulus(sum)
    }

    fn sun_irradiance(&self, elevation: f64) -> [f64; 3] {
        let through = self.transmittance(self.radius, elevation.sin());
        tristimulus(std::array::from_fn(|i| SUN[i] * through[i]))
    }
}

/// How air (Rayleigh) and dust (Henyey and Greenstein) scatter by an angle, 1/sr.
fn phases(cosine: f64) -> [f64; 2] {
    let g = DUST_MEAN_COSINE;
    [3.0 * (1.0 + cosine * cosine) / (16.0 * PI), (1.0 - g * g) / (4.0 * PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5))]
}

fn tristimulus(four: Four) -> [f64; 3] {
    std::array::from_fn(|axis| four.iter().zip(TRISTIMULUS).map(|(value, xyz)| value * xyz[axis]).sum())
}
