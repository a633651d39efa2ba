//! The figures that lighting people ask a goniogram for.

use super::{Goniogram, PhotometricType, Symmetry};

/// Step in degrees at which a plane of photometric types A and B is cut.
const CUT_STEP: f64 = 0.5;

/// Difference, relative to the peak, below which two intensities count as equal where a symmetry is looked for.
const EQUAL: f64 = 1e-3;

/// Share of the greatest intensity that neither C0–C180 nor C90–C270 reaches where the beam's axis lies aside.
pub(crate) const MISSED: f64 = 0.95;

/// Share of the flux, and standard errors, that both horizontal parts of light that leans aside exceed.
const LEANING: f64 = 0.05;
const LEANING_ERRORS: f64 = 4.0;

/// Figures of a goniogram.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Luminous flux in lm.
    pub flux: f64,
    /// Share of it below the horizontal plane (DFF), 0 to 1.
    pub downward_fraction: f64,
    /// Flux over the lamps' flux (LORL); `None` where the file states none.
    pub light_output_ratio: Option<f64>,
    /// Power in W; `None` where the file states none.
    pub watts: Option<f64>,
    /// Luminous efficacy in lm/W.
    pub efficacy: Option<f64>,
    /// The greatest intensity in cd.
    pub peak: f64,
    /// Its C plane and γ in degrees.
    pub peak_direction: [f64; 2],
    /// Where the intensity is 50 % of the plane's greatest, in the planes C0–C180 and C90–C270.
    pub beam: [Spread; 2],
    /// The same at 10 %.
    pub field: [Spread; 2],
    /// The plane of the greatest intensity, where both of these planes miss it.
    pub aside: Option<Aside>,
    /// The highest symmetry within 0.1 % of the peak.
    pub symmetry: Symmetry,
}

/// The range of directions in a plane in which the intensity exceeds a share of the plane's greatest: the outermost ones in the hemisphere
/// that holds the greatest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Spread {
    /// Angles in degrees from nadir, or from zenith for light that goes up; negative towards C180 or C270.
    pub range: [f64; 2],
    /// Whether the angles are from zenith.
    pub up: bool,
    /// Which ends are but the hemisphere's: the intensity does not fall below the share on that side.
    pub open: [bool; 2],
}

/// A beam whose axis lies in none of the planes C0–C180 and C90–C270: their angles are not the beam's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Aside {
    /// The C plane of the axis in degrees.
    pub c: f64,
    /// Where the intensity is 50 % of the greatest in the plane through it and the one across from it.
    pub beam: Spread,
    /// The same at 10 %.
    pub field: Spread,
}

impl Spread {
    /// The angle between the two directions in degrees.
    pub fn angle(&self) -> f64 {
        self.range[1] - self.range[0]
    }
}

impl Goniogram {
    /// The figures of this goniogram.
    pub fn figures(&self) -> Figures {
        let flux = self.flux();
        let lamps = self.lamps();
        let watts = lamps.map(|lamps| lamps.watts).filter(|watts| *watts > 0.0);
        let tops = [0.0, 90.0].map(|c| self.cut(c).iter().map(|point| point[1]).fold(0.0, f64::max));
        let (peak, direction) = (self.peak(), self.peak_direction());
        let missed = tops.iter().all(|top| *top < MISSED * peak).then_some(direction[0]);
        Figures {
            flux,
            downward_fraction: if flux > 0.0 { self.flux_below() / flux } else { 0.0 },
            light_output_ratio: lamps.and_then(|lamps| lamps.flux).map(|lamp_flux| flux / lamp_flux),
            watts,
            efficacy: watts.map(|watts| flux / watts),
            peak,
            peak_direction: direction,
            beam: [self.spread(0.0, 0.5, None), self.spread(90.0, 0.5, None)],
            field: [self.spread(0.0, 0.1, None), self.spread(90.0, 0.1, None)],
            aside: self.leaning(None).or(missed).map(|c| self.aside(c, None)),
            symmetry: self.symmetry_found(EQUAL),
        }
    }

    /// The range of directions in the planes C(c) and the one across from it whose intensity reaches a share of the greatest there, or of `top` cd.
    pub(crate) fn spread(&self, c: f64, share: f64, top: Option<f64>) -> Spread {
        spread(&self.cut_with_horizon(c), share, top)
    }

    /// The C plane, in whole degrees, to which the light leans as a whole, if it lies aside of C0–C180 and C90–C270: by the sum of intensities as vectors,
    /// whose both horizontal parts are more than a twentieth of the flux, and more than four of the standard errors that `errors` tell.
    pub(crate) fn leaning(&self, errors: Option<&[f64]>) -> Option<f64> {
        let own = self.to_type_c();
        // Any symmetry leans within its planes.
        if own.symmetry != Symmetry::None {
            return None;
        }
        let (weights, count) = (own.flux_weights([0.0, 180.0]), own.vertical.len().max(1));
        let direction = |i: usize| PhotometricType::C.direction(own.horizontal[i / count], own.vertical[i % count]);
        let along = |axis: usize| {
            let terms = weights.iter().enumerate().map(|(i, weight)| {
                let error = errors.and_then(|errors| errors.get(i)).copied().unwrap_or(0.0);
                let share = weight * direction(i)[axis];
                [share * own.intensities[i], (share * error).powi(2)]
            });
            terms.fold([0.0; 2], |[sum, variance], [value, square]| [sum + value, variance + square])
        };
        let (x, y) = (along(0), along(1));
        let least = LEANING * own.flux();
        let sure = |[sum, variance]: [f64; 2]| sum.abs() > least.max(LEANING_ERRORS * variance.sqrt());
        (sure(x) && sure(y)).then(|| y[0].atan2(x[0]).to_degrees().round().rem_euclid(360.0))
    }

    /// The beam in its own plane.
    pub(crate) fn aside(&self, c: f64, top: Option<f64>) -> Aside {
        Aside { c, beam: self.spread(c, 0.5, top), field: self.spread(c, 0.1, top) }
    }

    /// C plane and γ in degrees of the greatest intensity.
    fn peak_direction(&self) -> [f64; 2] {
        let peak = self.peak();
        let index = self.intensities.iter().position(|intensity| *intensity >= peak).unwrap_or(0);
        let count = self.vertical.len().max(1);
        let angle = |angles: &[f64], index: usize| angles.get(index).copied().unwrap_or(0.0);
        let (h, v) = (angle(&self.horizontal, index / count), angle(&self.vertical, index % count));
        let [c, gamma] = PhotometricType::C.angles(self.photometric_type.direction(h, v));
        if self.photometric_type == PhotometricType::C { [h, v] } else { [c.rem_euclid(360.0), gamma] }
    }

    /// Intensities in cd in the plane through C(c) and the one across from it, with γ in degrees, negative in the latter; in increasing
    /// order.
    pub fn cut(&self, c: f64) -> Vec<[f64; 2]> {
        self.cut_at(c, &self.cut_angles())
    }

    /// γ in degrees at which a plane is cut: the file's own of type C.
    fn cut_angles(&self) -> Vec<f64> {
        let count = (180.0 / CUT_STEP) as usize;
        let own = self.photometric_type == PhotometricType::C;
        if own { self.vertical.clone() } else { (0..=count).map(|index| index as f64 * CUT_STEP).collect() }
    }

    /// The cut that a spread is taken of: with the horizon, where a hemisphere ends whether or not the file has an angle there.
    fn cut_with_horizon(&self, c: f64) -> Vec<[f64; 2]> {
        let mut angles = self.cut_angles();
        let within = angles.first().is_some_and(|first| *first < 90.0) && angles.last().is_some_and(|last| *last > 90.0);
        if within && !angles.contains(&90.0) {
            angles.push(90.0);
            angles.sort_by(f64::total_cmp);
        }
        self.cut_at(c, &angles)
    }

    fn cut_at(&self, c: f64, angles: &[f64]) -> Vec<[f64; 2]> {
        let own = self.photometric_type == PhotometricType::C;
        let at = |c: f64, gamma: f64| {
            if own { self.intensity_at(c, gamma) } else { self.intensity(PhotometricType::C.direction(c, gamma)) }
        };
        let across = angles.iter().rev().filter(|gamma| **gamma > 0.0).map(|gamma| [-gamma, at(c + 180.0, *gamma)]);
        across.chain(angles.iter().map(|gamma| [*gamma, at(c, *gamma)])).collect()
    }
}

/// The outermost directions of a cut that reach a share of its greatest intensity, or of `top` cd where that is known better.
fn spread(cut: &[[f64; 2]], share: f64, top: Option<f64>) -> Spread {
    let below = |point: &&[f64; 2]| point[0].abs() <= 90.0;
    let above = |point: &&[f64; 2]| point[0].abs() >= 90.0;
    let greatest = |points: &mut dyn Iterator<Item = &[f64; 2]>| points.map(|point| point[1]).fold(0.0, f64::max);
    let tops = [greatest(&mut cut.iter().filter(below)), greatest(&mut cut.iter().filter(above))];
    let up = tops[1] > tops[0];
    let mut points: Vec<[f64; 2]> = cut.iter().filter(|point| if up { above(point) } else { below(point) }).copied().collect();
    if up {
        points.iter_mut().for_each(|point| point[0] = (180.0 - point[0].abs()) * point[0].signum());
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    let level = share * top.unwrap_or(tops[usize::from(up)]);
    if level <= 0.0 {
        return Spread { up, ..Spread::default() };
    }
    let [first, last] = [crossing(points.iter(), level), crossing(points.iter().rev(), level)];
    Spread { range: [first.0, last.0], up, open: [first.1, last.1] }
}

/// Where points in order first reach a level, linear between them, and whether the first does already.
fn crossing<'a>(points: impl Iterator<Item = &'a [f64; 2]>, level: f64) -> (f64, bool) {
    let mut before: Option<&[f64; 2]> = None;
    for point in points {
        if point[1] >= level {
            return match before {
                Some(before) => (before[0] + (level - before[1]) / (point[1] - before[1]) * (point[0] - before[0]), false),
                None => (point[0], true),
            };
        }
        before = Some(point);
    }
    (0.0, false)
}
