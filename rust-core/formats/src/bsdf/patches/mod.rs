//! Matrices over patches of directions, as Radiance and WINDOW use them (Klems 1994).

mod basis;
mod counted;
mod sample;

pub use basis::Basis;
pub use counted::{PatchCounts, Shares};

use super::colour::Channels;
use super::direction::{Direction, through};
use super::hemispheres::Hemispheres;
use crate::error::{FormatError, Result};

/// What part of the spectrum a matrix is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Band {
    /// Weighted with the eye's sensitivity: CIE Y.
    Visible,
    /// CIE X.
    CieX,
    /// CIE Z.
    CieZ,
    /// CIE 1976 u′ (in tensor trees).
    CieU,
    /// CIE 1976 v′ (in tensor trees).
    CieV,
    /// The whole solar spectrum.
    Solar,
    /// Near infrared.
    Nir,
}

/// The BSDF between patches in one band and one pair of hemispheres, 1/sr, without the cosine.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Which sides light goes between.
    pub hemispheres: Hemispheres,
    /// What part of the spectrum it is for.
    pub band: Band,
    /// The index of the basis for where light comes from.
    pub incident: usize,
    /// The index of the basis for where it leaves to.
    pub outgoing: usize,
    /// Whether patches of each basis (incident, outgoing) are found with x and y negated: incident ones usually are, since bases number
    /// them by where light goes to.
    pub turned: [bool; 2],
    /// One row of incident patches for each outgoing patch.
    pub values: Vec<f32>,
    /// For each outgoing patch the running sums of value × projected solid angle over incident patches, beginning with 0: the
    /// distribution that light is sampled from, one more entry a row than incident patches.
    pub cumulative: Vec<f32>,
}

/// A material of matrices.
#[derive(Clone, Debug, PartialEq)]
pub struct Patches {
    bases: Vec<Basis>,
    matrices: Vec<Matrix>,
    channels: Channels,
}

impl Patches {
    /// Matrices over bases. What is missing of transmission follows from the other side by reciprocity.
    ///
    /// # Errors
    /// When there is no matrix, one refers to no basis, has another size, or a value is negative or not finite.
    pub fn new(bases: Vec<Basis>, mut matrices: Vec<Matrix>) -> Result<Self> {
        if matrices.is_empty() {
            return Err(FormatError::whole("no scattering data"));
        }
        for matrix in &mut matrices {
            matrix.complete(&bases)?;
        }
        for band in [Band::Visible, Band::CieX, Band::CieZ, Band::Solar, Band::Nir] {
            for (given, missing) in [
                (Hemispheres::TransmissionFront, Hemispheres::TransmissionBack),
                (Hemispheres::TransmissionBack, Hemispheres::TransmissionFront),
            ] {
                let find = |pair| matrices.iter().find(|m| m.hemispheres == pair && m.band == band);
                if let (Some(matrix), None) = (find(given), find(missing)) {
                    let reversed = matrix.reversed(&bases)?;
                    matrices.push(reversed);
                }
            }
        }
        let has = |band| matrices.iter().any(|m| m.band == band);
        let channels = if has(Band::CieX) && has(Band::CieZ) && has(Band::Visible) { Channels::Xyz } else { Channels::Luminance };
        Ok(Self { bases, matrices, channels })
    }

    /// The bases that matrices refer to.
    pub fn bases(&self) -> &[Basis] {
        &self.bases
    }

    /// All matrices, those that follow from reciprocity last.
    pub fn matrices(&self) -> &[Matrix] {
        &self.matrices
    }

    /// What [`Patches::eval`] gives: luminance, or XYZ where the file has it.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// The matrix of a band.
    pub fn matrix(&self, hemispheres: Hemispheres, band: Band) -> Option<&Matrix> {
        self.matrices.iter().find(|m| m.hemispheres == hemispheres && m.band == band)
    }

    /// The matrix that light is seen and sampled by: what the eye does not see says nothing of it.
    pub(crate) fn main(&self, hemispheres: Hemispheres) -> Option<&Matrix> {
        self.matrix(hemispheres, Band::Visible)
    }

    /// The BSDF in 1/sr for each channel.
    pub(crate) fn value(&self, hemispheres: Hemispheres, wi: Direction, wo: Direction, out: &mut [f64]) {
        out.fill(0.0);
        let Some(main) = self.main(hemispheres) else { return };
        let (wi, wo) = hemispheres.to_front(wi, wo);
        let luminance = main.value(&self.bases, wi, wo);
        out.fill(luminance);
        if self.channels == Channels::Xyz {
            // Sides without colour are neutral.
            let colour = [Band::CieX, Band::CieZ].map(|band| self.matrix(hemispheres, band));
            if let [Some(x), Some(z)] = colour {
                (out[0], out[2]) = (x.value(&self.bases, wi, wo), z.value(&self.bases, wi, wo));
            }
        }
    }

    /// Hemispherical reflectance or transmittance of light from `wi` for each channel.
    pub(crate) fn albedo(&self, hemispheres: Hemispheres, wi: Direction, out: &mut [f64]) {
        let Some(main) = self.main(hemispheres) else { return };
        out.fill(self.total(main, wi));
        if self.channels == Channels::Xyz {
            let colour = [Band::CieX, Band::CieZ].map(|band| self.matrix(hemispheres, band));
            if let [Some(x), Some(z)] = colour {
                (out[0], out[2]) = (self.total(x, wi), self.total(z, wi));
            }
        }
    }

    /// The total of the patch that `wi` lies in.
    fn total(&self, matrix: &Matrix, wi: Direction) -> f64 {
        let (incident, outgoing) = (&self.bases[matrix.incident], &self.bases[matrix.outgoing]);
        let up = if wi[2] < 0.0 { through(wi) } else { wi };
        let column = incident.patch(turned(up, matrix.turned[0]));
        let value = |row: usize| f64::from(matrix.values[row * incident.count() + column]);
        (0..outgoing.count()).map(|row| outgoing.projected_solid_angle(row) * value(row)).sum()
    }

    /// Hemispherical reflectance or transmittance of light from each incident patch: the sum of value × projected solid angle.
    pub fn totals(&self, matrix: &Matrix) -> Vec<f64> {
        let (columns, outgoing) = (self.bases[matrix.incident].count(), &self.bases[matrix.outgoing]);
        let mut totals = vec![0.0; columns];
        for (row, values) in matrix.values.chunks_exact(columns).enumerate() {
            let weight = outgoing.projected_solid_angle(row);
            totals.iter_mut().zip(values).for_each(|(sum, &v)| *sum += weight * f64::from(v));
        }
        totals
    }
}

impl Matrix {
    /// A matrix of values, one row of incident patches for each outgoing patch, incident ones numbered by where light goes to.
    pub fn new(hemispheres: Hemispheres, band: Band, incident: usize, outgoing: usize, values: Vec<f32>) -> Self {
        Self { hemispheres, band, incident, outgoing, turned: [true, false], values, cumulative: Vec::new() }
    }

    /// Checks the values and sums them up.
    fn complete(&mut self, bases: &[Basis]) -> Result<()> {
        let (Some(incident), Some(outgoing)) = (bases.get(self.incident), bases.get(self.outgoing)) else {
            return Err(FormatError::whole("a matrix refers to a basis that is not there"));
        };
        if self.values.len() != incident.count() * outgoing.count() {
            let (found, rows, columns) = (self.values.len(), outgoing.count(), incident.count());
            return Err(FormatError::whole(format!("{found} values, expected {rows} × {columns}")));
        }
        if let Some(bad) = self.values.iter().find(|v| !(v.is_finite() && **v >= 0.0)) {
            return Err(FormatError::whole(format!("value {bad}, expected zero or more")));
        }
        let weights: Vec<f64> = (0..incident.count()).map(|patch| incident.projected_solid_angle(patch)).collect();
        self.cumulative = Vec::with_capacity(self.values.len() + outgoing.count());
        for row in self.values.chunks_exact(incident.count()) {
            let mut sum = 0.0;
            self.cumulative.push(0.0);
            self.cumulative.extend(row.iter().zip(&weights).map(|(&v, w)| {
                sum += w * f64::from(v);
                sum as f32
            }));
        }
        Ok(())
    }

    /// The matrix of light that goes the opposite way.
    fn reversed(&self, bases: &[Basis]) -> Result<Self> {
        let (columns, rows) = (bases[self.incident].count(), bases[self.outgoing].count());
        let values = (0..columns * rows).map(|i| self.values[i % rows * columns + i / rows]).collect();
        let mut reversed = Self {
            hemispheres: self.hemispheres.reversed(),
            incident: self.outgoing,
            outgoing: self.incident,
            turned: [self.turned[1], self.turned[0]],
            values,
            cumulative: Vec::new(),
            ..*self
        };
        reversed.complete(bases)?;
        Ok(reversed)
    }

    /// The BSDF of two directions at the front.
    fn value(&self, bases: &[Basis], wi: Direction, wo: Direction) -> f64 {
        let column = bases[self.incident].patch(turned(wi, self.turned[0]));
        let row = bases[self.outgoing].patch(turned(wo, self.turned[1]));
        f64::from(self.values[row * bases[self.incident].count() + column])
    }
}

/// `d` after half a turn about the normal, if asked for.
fn turned(d: Direction, turn: bool) -> Direction {
    if turn { [-d[0], -d[1], d[2]] } else { d }
}
