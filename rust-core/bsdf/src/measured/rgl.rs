//! RGL's adaptive measurements on lanes (Dupuy and Jakob 2018): evaluation, and sampling by their own warps. The reference is
//! [`gonio_formats::bsdf::Rgl`].

use super::angles::{azimuth, elevation, normal_of, sine, solid_angle_per_square, square_of, turned, unturned};
use super::spectra::SpectralInterpolant;
use super::warp::{Blend, ColourInterpolant, Interpolant, MOST_SLICES, Warp};
use gonio_formats::bsdf::{Channels, Interpolant as Reference, Rgl};
use gonio_simd::{F, Lanes, M, Rgb, Spectrum, Vec3};
use gonio_table::Axis;

/// Below this the measure of normals counts as this: the pole has none.
const LEAST_JACOBIAN: f32 = 1e-6;

/// A measurement of the RGL kind.
#[derive(Clone, Debug)]
pub(super) struct Adaptive {
    phi: Axis,
    theta: Axis,
    /// Normals' distribution and projected area, where values are to be multiplied by `ndf / (4 sigma)`.
    jacobian: Option<[Interpolant; 2]>,
    vndf: Warp,
    luminance: Warp,
    /// BSDF × cosine over the warped square.
    colour: ColourInterpolant,
    /// The same by wavelength, where light has any and the file does.
    spectra: Option<SpectralInterpolant>,
    /// Parts of a turn of which one was measured.
    reduction: u32,
}

/// A pair of directions where the file has it.
struct Query<L: Lanes> {
    wo: Vec3<L>,
    normal: Vec3<L>,
    /// The normal in the square.
    square: [F<L>; 2],
    blend: Blend<L>,
}

/// Where the file has a pair of directions.
struct Found<L: Lanes> {
    /// The place in the warped square.
    place: [F<L>; 2],
    blend: Blend<L>,
    /// Factor on what stands there.
    scale: F<L>,
    pdf: F<L>,
}

impl Adaptive {
    /// The reference's tables, spectra as colours; with `wavelengths` also as they are. `None` where angles are not sound or there are 2³¹ values or more.
    pub(super) fn new(found: &Rgl, wavelengths: bool) -> Option<Self> {
        let sized = |knots: &[f32]| Axis::new(knots.to_vec());
        let jacobian = if found.jacobian { Some([Interpolant::new(&found.ndf)?, Interpolant::new(&found.sigma)?]) } else { None };
        let spectra = match &found.channels {
            Channels::Bands { wavelengths_nm } if wavelengths => Some(SpectralInterpolant::new(&found.spectra, wavelengths_nm)?),
            _ => None,
        };
        Some(Self {
            phi: sized(found.phi_knots())?,
            theta: sized(found.theta_knots())?,
            jacobian,
            vndf: Warp::new(&found.vndf)?,
            luminance: Warp::new(&found.luminance)?,
            colour: colours(&found.spectra, &found.channels.rgb_weights())?,
            spectra,
            reduction: found.reduction(),
        })
    }

    /// Whether only the difference of azimuths counts.
    pub(super) fn is_isotropic(&self) -> bool {
        self.phi.len() <= 2
    }

    /// By how much its spectra differ from the file's, rms over their own.
    pub(super) fn spectral_error(&self) -> f64 {
        self.spectra.as_ref().map_or(0.0, SpectralInterpolant::error)
    }

    /// The slices around a view.
    #[inline(always)]
    fn around<L: Lanes>(&self, l: L, wo: Vec3<L>) -> Blend<L> {
        let theta = self.theta.locate(l, elevation(wo));
        let t = theta.fraction;
        let step = u32::from(self.theta.len() > 1);
        if self.phi.len() == 1 {
            let slice = [theta.index, theta.index + step, theta.index, theta.index];
            return Blend { slice, weight: [1.0 - t, t, t * 0.0, t * 0.0], count: 2 };
        }
        let phi = self.phi.locate(l, wo.y.atan2(wo.x));
        let (near, s) = (phi.index * self.theta.len() as u32 + theta.index, phi.fraction);
        let far = near + self.theta.len() as u32;
        Blend {
            slice: [near, near + step, far, far + step],
            weight: [(1.0 - s) * (1.0 - t), (1.0 - s) * t, s * (1.0 - t), s * t],
            count: MOST_SLICES,
        }
    }

    /// BSDF × cosine and the density of [`Self::sample`], for directions at the front.
    #[inline(always)]
    pub(super) fn eval<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> (Rgb<L>, F<L>) {
        let found = self.found(l, wi, wo);
        (self.colour.eval(l, found.place, &found.blend) * found.scale, found.pdf)
    }

    /// The same at wavelengths in nanometres, where the file's are known.
    #[inline(always)]
    pub(super) fn eval_at<L: Lanes>(&self, l: L, nanometres: Spectrum<L>, wi: Vec3<L>, wo: Vec3<L>) -> Option<(Spectrum<L>, F<L>)> {
        let spectra = self.spectra.as_ref()?;
        let found = self.found(l, wi, wo);
        Some((spectra.eval(l, found.place, &found.blend, nanometres) * found.scale, found.pdf))
    }

    /// Where the file has a pair of directions, and their density.
    #[inline(always)]
    fn found<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> Found<L> {
        let Query { wo, normal, square, blend } = self.query(l, wi, wo);
        let (place, visible) = self.vndf.invert(l, square, &blend);
        let mut scale = l.f(1.0);
        if let Some([ndf, sigma]) = &self.jacobian {
            let still = Blend::one(l.u(0));
            let area = sigma.eval(l, square_of(wo), &still) * 4.0;
            scale = ndf.eval(l, square, &still) / area.max(f32::MIN_POSITIVE);
        }
        let area = solid_angle_per_square(square[0], sine(normal)).max(LEAST_JACOBIAN) * wo.dot(normal) * 4.0;
        let pdf = visible * self.luminance.density(l, place, &blend) / area.max(f32::MIN_POSITIVE);
        Found { place, blend, scale, pdf: pdf.keep_if(area.gt(0.0)) }
    }

    /// A direction in proportion to luminance × cosine for a view at the front; it may be below the surface, where it does not count.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, wo: Vec3<L>, u: [F<L>; 2]) -> (Vec3<L>, M<L>) {
        let signs = self.signs(wo);
        let wo = mirrored(wo, signs);
        let blend = self.around(l, wo);
        let place = self.luminance.sample(l, u, &blend);
        let mut normal = normal_of(self.vndf.sample(l, place, &blend));
        if self.is_isotropic() {
            normal = turned(normal, azimuth(wo));
        }
        let wi = mirrored(wo.reflect(normal), signs);
        (wi, wi.z.gt(0.0))
    }

    /// A pair of directions where the file has it.
    #[inline(always)]
    fn query<L: Lanes>(&self, l: L, wi: Vec3<L>, wo: Vec3<L>) -> Query<L> {
        let signs = self.signs(wo);
        let (wi, wo) = (mirrored(wi, signs), mirrored(wo, signs));
        let normal = (wi + wo).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]));
        let level = if self.is_isotropic() { unturned(normal, azimuth(wo)) } else { normal };
        Query { wo, normal, square: square_of(level), blend: self.around(l, wo) }
    }

    /// Factors of x and y that bring `wo` into the part of the turn that the file holds: the quarter or the half with negative y.
    #[inline(always)]
    fn signs<L: Lanes>(&self, wo: Vec3<L>) -> [F<L>; 2] {
        let one = wo.x.lanes().f(1.0);
        if self.reduction < 2 {
            return [one, one];
        }
        let x = if self.reduction == 4 { wo.x } else { wo.y };
        [-one.copysign(x), -one.copysign(wo.y)]
    }
}

/// Spectra as colours: for each slice the nodes with four values each.
fn colours(found: &Reference, weights: &[[f64; 3]]) -> Option<ColourInterpolant> {
    let nodes = found.rows * found.columns;
    let mut data = Vec::with_capacity(found.data.len() / weights.len() * 4);
    for slice in found.data.chunks_exact(weights.len() * nodes) {
        for node in 0..nodes {
            let sum = |c: usize| weights.iter().enumerate().map(|(band, w)| w[c] * f64::from(slice[band * nodes + node])).sum::<f64>();
            data.extend([sum(0) as f32, sum(1) as f32, sum(2) as f32, 0.0]);
        }
    }
    ColourInterpolant::new(found.columns, found.rows, data)
}

/// `d` with x and y multiplied.
#[inline(always)]
fn mirrored<L: Lanes>(d: Vec3<L>, signs: [F<L>; 2]) -> Vec3<L> {
    Vec3::new(d.x * signs[0], d.y * signs[1], d.z)
}
