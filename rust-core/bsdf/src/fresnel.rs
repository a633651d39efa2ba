//! Reflectance of smooth interfaces, and its mean over the cosine-weighted hemisphere.

use super::film::Film;
use gonio_simd::{F, Lanes, Spectrum};

/// Normal reflectance of an interface; `eta` = far over near index.
#[inline(always)]
pub(crate) fn normal_reflectance<L: Lanes>(eta: F<L>) -> F<L> {
    ((eta - 1.0) / (eta + 1.0)).squared()
}

/// Exact reflectance of a dielectric at cosine `c` ≥ 0 of light polarised across and along the plane of incidence; 1 under total internal reflection.
#[inline(always)]
pub(crate) fn dielectric_polarised<L: Lanes>(c: F<L>, eta: F<L>) -> [F<L>; 2] {
    // The floor keeps 0 / 0 away at grazing angles of equal indices.
    let c = c.max(1e-6);
    let squared = 1.0 - (1.0 - c * c) / (eta * eta);
    let t = squared.safe_sqrt();
    let s = (c - eta * t) / (c + eta * t);
    let p = (eta * c - t) / (eta * c + t);
    let (total, one) = (squared.le(0.0), c.lanes().f(1.0));
    [total.select(one, s * s), total.select(one, p * p)]
}

/// The same of unpolarised light.
#[inline(always)]
pub(crate) fn dielectric<L: Lanes>(c: F<L>, eta: F<L>) -> F<L> {
    let [s, p] = dielectric_polarised(c, eta);
    (s + p) * 0.5
}

/// The exact curve moved to run from 0 at normal incidence to 1 at grazing.
#[inline(always)]
pub(crate) fn dielectric_share<L: Lanes>(c: F<L>, eta: F<L>) -> F<L> {
    let f0 = normal_reflectance(eta);
    ((dielectric(c, eta) - f0) / (1.0 - f0)).saturate()
}

/// Mean reflectance of a dielectric (fits of Kulla, Conty 2017).
#[inline(always)]
pub(crate) fn dielectric_mean<L: Lanes>(eta: F<L>) -> F<L> {
    let dense = (eta - 1.0) / (eta * 1.00071 + 4.08567);
    let thin = eta.mul_add(eta.mul_add(eta.mul_add(-0.130_607, -0.965_241), 0.1014), 0.997_118);
    eta.ge(1.0).select(dense, thin).saturate()
}

/// (1 − c)⁵.
#[inline(always)]
pub(crate) fn schlick_share<L: Lanes>(c: F<L>) -> F<L> {
    let x = (1.0 - c).saturate();
    x.squared().squared() * x
}

/// Exact unpolarised reflectance of a conductor with index `n` + i `k`, from vacuum, at cosine `c`.
#[inline(always)]
fn conductor_channel<L: Lanes>(c: F<L>, n: F<L>, k: F<L>) -> F<L> {
    let (c2, s2) = (c * c, 1.0 - c * c);
    let t0 = n * n - k * k - s2;
    let a2b2 = (t0 * t0 + n * n * k * k * 4.0).sqrt();
    let t1 = a2b2 + c2;
    let t2 = ((a2b2 + t0) * 0.5).safe_sqrt() * c * 2.0;
    let s = (t1 - t2) / (t1 + t2);
    let t3 = c2.mul_add(a2b2, s2 * s2);
    let t4 = t2 * s2;
    (s * ((t3 - t4) / (t3 + t4)) + s) * 0.5
}

/// Index and extinction of a conductor with normal reflectance `r` and edge tint `g` (Gulbrandsen 2014).
#[inline(always)]
pub(super) fn gulbrandsen_channel<L: Lanes>(r: F<L>, g: F<L>) -> [F<L>; 2] {
    let root = r.sqrt();
    let n = ((1.0 + root) / (1.0 - root)).lerp((1.0 - r) / (1.0 + r), g);
    [n, ((r * (n + 1.0).squared() - (n - 1.0).squared()) / (1.0 - r)).safe_sqrt()]
}

/// Mean of the F82 curve.
#[inline(always)]
fn f82_mean<L: Lanes>(l: L, f0: Spectrum<L>, drop: Spectrum<L>) -> Spectrum<L> {
    (f0.lerp(Spectrum::one(l), l.f(1.0 / 21.0)) - drop * (1.0 / 126.0)).saturate()
}

/// Factor between the drop of the F82 curve under Schlick's at c = 1/7 and its coefficient: 7 / (6/7)⁶.
const DROP: f32 = 17.651_385;
/// Schlick's share at c = 1/7, (6/7)⁵.
const SHARE_82: f32 = 0.462_664_36;

/// The F82 curve's value at c = 1/7.
#[inline(always)]
pub(super) fn f82_coefficients<L: Lanes>(f0: Spectrum<L>, drop: Spectrum<L>) -> Spectrum<L> {
    let l = f0.lanes();
    (f0.lerp(Spectrum::one(l), l.f(SHARE_82)) - drop * (1.0 / DROP)).saturate()
}

/// The F82 curve at cosine `c` from its normal value and its value at c = 1/7.
#[inline(always)]
pub(super) fn f82_channel<L: Lanes>(c: F<L>, f0: F<L>, at_82: F<L>) -> F<L> {
    let drop = (f0.lerp(1.0, SHARE_82) - at_82) * DROP;
    let share = schlick_share(c);
    (f0.lerp(1.0, share) - drop * c * share * (1.0 - c)).saturate()
}

/// A reflectance as a function of the half-angle cosine.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Curve<L: Lanes> {
    /// 1 everywhere.
    One,
    /// The exact curve moved to the ends `f0` and `f90`.
    Dielectric {
        /// Index that shapes the curve.
        eta: F<L>,
        /// Value at normal incidence.
        f0: Spectrum<L>,
        /// Value at grazing.
        f90: Spectrum<L>,
    },
    /// Schlick's curve.
    Schlick {
        /// Value at normal incidence.
        f0: Spectrum<L>,
        /// Value at grazing.
        f90: Spectrum<L>,
    },
    /// Schlick's curve less `drop` c (1 − c)⁶.
    F82 {
        /// Value at normal incidence.
        f0: Spectrum<L>,
        /// Coefficient of the drop.
        drop: Spectrum<L>,
    },
    /// The exact curve of a conductor.
    Conductor {
        /// Refractive index.
        n: Spectrum<L>,
        /// Extinction coefficient.
        k: Spectrum<L>,
    },
    /// A film over the moved exact curve.
    FilmDielectric {
        /// The film.
        film: Film<L>,
        /// Index that shapes the curve under it.
        eta: F<L>,
        /// The curve's value at normal incidence.
        f0: Spectrum<L>,
        /// The curve's value at grazing.
        f90: Spectrum<L>,
    },
    /// A film over a metal with the F82 curve.
    FilmF82 {
        /// The film.
        film: Film<L>,
        /// The curve's value at normal incidence.
        f0: Spectrum<L>,
        /// Coefficient of the drop.
        drop: Spectrum<L>,
    },
    /// A film over a conductor.
    FilmConductor {
        /// The film.
        film: Film<L>,
        /// Refractive index.
        n: Spectrum<L>,
        /// Extinction coefficient.
        k: Spectrum<L>,
    },
}

impl<L: Lanes> Curve<L> {
    /// The curve under a film; `eta` shapes what is dielectric.
    #[inline(always)]
    pub(crate) fn filmed(self, film: Film<L>, eta: F<L>) -> Self {
        match self {
            Self::Dielectric { f0, f90, .. } => Self::FilmDielectric { film, eta, f0, f90 },
            Self::Schlick { f0, .. } => Self::FilmF82 { film, f0, drop: Spectrum::zero(eta.lanes()) },
            Self::F82 { f0, drop } => Self::FilmF82 { film, f0, drop },
            Self::Conductor { n, k } => Self::FilmConductor { film, n, k },
            other => other,
        }
    }
    /// The film's share and its reflectance, if there is a film.
    #[inline(always)]
    pub(crate) fn through_film(&self, c: F<L>) -> Option<(F<L>, Spectrum<L>)> {
        match *self {
            Self::FilmDielectric { film, eta, f0, f90 } => Some((film.weight, film.over_tinted(c, eta, f0, f90))),
            Self::FilmF82 { film, f0, drop } => Some((film.weight, film.over_f82(c, f0, drop))),
            Self::FilmConductor { film, n, k } => Some((film.weight, film.over_conductor(c, n, k))),
            _ => None,
        }
    }
    /// The F82 curve from its normal value and its tint at 82 degrees.
    #[inline(always)]
    pub(crate) fn f82(f0: Spectrum<L>, tint: Spectrum<L>) -> Self {
        let white = Spectrum::one(f0.lanes());
        let at_82 = f0.lerp(white, f0.lanes().f(SHARE_82));
        Self::F82 { f0, drop: (white - tint) * at_82 * DROP }
    }
    /// Gulbrandsen's conductor with normal reflectance `r` and edge tint `g`.
    #[inline(always)]
    pub(crate) fn gulbrandsen(r: Spectrum<L>, g: Spectrum<L>) -> Self {
        let [n, k] = r.clamp(0.0, 0.99).zip(
            g,
            #[inline(always)]
            |r, g| gulbrandsen_channel(r, g),
        );
        Self::Conductor { n, k }
    }
    /// Reflectance at half-angle cosine `c`.
    #[inline(always)]
    pub(crate) fn reflectance(&self, c: F<L>) -> Spectrum<L> {
        match self.through_film(c) {
            Some((weight, filmed)) => self.plain(c).lerp(filmed, weight),
            None => self.plain(c),
        }
    }
    /// Reflectance without a film.
    #[inline(always)]
    pub(crate) fn plain(&self, c: F<L>) -> Spectrum<L> {
        match *self {
            Self::One => Spectrum::one(c.lanes()),
            Self::Dielectric { eta, f0, f90 } | Self::FilmDielectric { eta, f0, f90, .. } => f0.lerp(f90, dielectric_share(c, eta)),
            Self::Schlick { f0, f90 } => f0.lerp(f90, schlick_share(c)),
            Self::F82 { f0, drop } | Self::FilmF82 { f0, drop, .. } => {
                let white = Spectrum::one(c.lanes());
                let x = (1.0 - c).saturate();
                let fifth = x.squared().squared() * x;
                (f0.lerp(white, fifth) - drop * (c * fifth * x)).saturate()
            }
            Self::Conductor { n, k } | Self::FilmConductor { n, k, .. } => {
                let [reflectance] = n.zip(
                    k,
                    #[inline(always)]
                    |n, k| [conductor_channel(c, n, k)],
                );
                reflectance
            }
        }
    }
    /// Mean reflectance over the cosine-weighted hemisphere, without the film.
    #[inline(always)]
    pub(crate) fn mean(&self, l: L) -> Spectrum<L> {
        match *self {
            Self::One => Spectrum::one(l),
            Self::Dielectric { eta, f0, f90 } | Self::FilmDielectric { eta, f0, f90, .. } => {
                let normal = normal_reflectance(eta);
                f0.lerp(f90, ((dielectric_mean(eta) - normal) / (1.0 - normal)).saturate())
            }
            Self::Schlick { f0, f90 } => f0.lerp(f90, l.f(1.0 / 21.0)),
            Self::F82 { f0, drop } | Self::FilmF82 { f0, drop, .. } => f82_mean(l, f0, drop),
            Self::Conductor { .. } | Self::FilmConductor { .. } => {
                let f0 = self.plain(l.f(1.0));
                let at_82 = f0.lerp(Spectrum::one(l), l.f(SHARE_82));
                let drop = (at_82 - self.plain(l.f(1.0 / 7.0))) * DROP;
                f82_mean(l, f0, drop)
            }
        }
    }
}
