//! Matrices from counts: which share of the light that fell on a sample from one patch of directions left it into another.

use super::super::colour::XYZ_TO_RGB;
use super::super::direction::{Direction, through};
use super::{Band, Basis, Hemispheres, Matrix, Patches, turned};
use crate::error::{FormatError, Result};

/// All shares of one incident patch may add up to that much: more leaves no sample, and counts have their noise.
const MOST: f64 = 1.01;

/// Shares of the incident flux between all patches of a basis, for one pair of hemispheres.
#[derive(Clone, Debug, PartialEq)]
pub struct PatchCounts {
    /// Which sides light goes between.
    pub hemispheres: Hemispheres,
    /// The share of what came from patch `i` that left into patch `o`: `shares[i * basis.count() + o]`.
    ///
    /// Incident patches are those of [`Basis::incident_direction`], outgoing ones those of [`Basis::outgoing_patch`].
    pub shares: Shares,
}

/// Shares by colour.
#[derive(Clone, Debug, PartialEq)]
pub enum Shares {
    /// Of luminous flux.
    Visible(Vec<f64>),
    /// Of linear Rec.709.
    Rgb(Vec<[f64; 3]>),
}

impl Basis {
    /// A direction that light comes from, of an incident patch, uniform in projected solid angle, from two numbers in [0, 1). It points away
    /// from the sample, to its front or its back; on a border itself rounding decides which patch it is in.
    ///
    /// Incident patches are numbered by where light goes to: what passes straight through leaves into the patch of its own number.
    pub fn incident_direction(&self, patch: usize, u: [f64; 2], from_front: bool) -> Direction {
        let up = turned(self.direction(patch, u), true);
        if from_front { up } else { through(up) }
    }

    /// The incident patch of a direction that light comes from, on either side.
    pub fn incident_patch(&self, wi: Direction) -> usize {
        self.patch(turned(up(wi), true))
    }

    /// The outgoing patch of a direction that light leaves to, on either side.
    pub fn outgoing_patch(&self, wo: Direction) -> usize {
        self.patch(up(wo))
    }
}

/// A direction moved to the front.
fn up(d: Direction) -> Direction {
    if d[2] < 0.0 { through(d) } else { d }
}

impl Patches {
    /// A material of what was counted in one basis: the BSDF between two patches is the share over the outgoing one's projected solid angle.
    ///
    /// Shares in Rec.709 become matrices of CIE X, Y (visible) and Z. What is missing of transmission follows from the other side.
    ///
    /// # Errors
    /// Counts of another number than the basis has, shares that are negative or no numbers, or an incident patch of which more than 1.01 left.
    pub fn counted(basis: Basis, counts: &[PatchCounts]) -> Result<Self> {
        let mut matrices = Vec::new();
        for counted in counts {
            for (band, shares) in counted.shares.bands() {
                matrices.push(matrix(&basis, counted.hemispheres, band, &shares)?);
            }
        }
        for from_front in [true, false] {
            check_sums(&basis, counts.iter().filter(|counted| counted.hemispheres.is_from_front() == from_front))?;
        }
        Self::new(vec![basis], matrices)
    }
}

impl Shares {
    /// Shares by part of the spectrum.
    fn bands(&self) -> Vec<(Band, Vec<f64>)> {
        match self {
            Self::Visible(shares) => vec![(Band::Visible, shares.clone())],
            Self::Rgb(shares) => {
                let to_xyz = inverse(XYZ_TO_RGB);
                // Saturated colours may come out below zero by rounding.
                let component =
                    |row: [f64; 3]| shares.iter().map(move |rgb| (row[0] * rgb[0] + row[1] * rgb[1] + row[2] * rgb[2]).max(0.0));
                let bands = [Band::CieX, Band::Visible, Band::CieZ];
                bands.into_iter().zip(to_xyz).map(|(band, row)| (band, component(row).collect())).collect()
            }
        }
    }

    /// How many there are, and whether all are shares.
    fn check(&self, patches: usize) -> Result<()> {
        let (count, bad) = match self {
            Self::Visible(shares) => (shares.len(), shares.iter().find(|share| !is_share(share))),
            Self::Rgb(shares) => (shares.len(), shares.as_flattened().iter().find(|share| !is_share(share))),
        };
        if let Some(bad) = bad {
            return Err(FormatError::whole(format!("a share is {bad}, expected 0 to 1")));
        }
        if count != patches * patches {
            return Err(FormatError::whole(format!("{count} shares, expected {patches} × {patches}")));
        }
        Ok(())
    }

    /// The shares of an incident patch added up, by colour.
    fn sum(&self, incident: usize, patches: usize) -> [f64; 3] {
        let range = incident * patches..(incident + 1) * patches;
        match self {
            Self::Visible(shares) => [shares[range].iter().sum(); 3],
            Self::Rgb(shares) => shares[range].iter().fold([0.0; 3], |sum, rgb| [0, 1, 2].map(|channel| sum[channel] + rgb[channel])),
        }
    }
}

fn is_share(share: &f64) -> bool {
    (0.0..=MOST).contains(share)
}

/// No more leaves on both sides than came.
fn check_sums<'a>(basis: &Basis, counts: impl Iterator<Item = &'a PatchCounts>) -> Result<()> {
    let patches = basis.count();
    let mut sums = vec![[0.0; 3]; patches];
    for counted in counts {
        counted.shares.check(patches)?;
        for (incident, sum) in sums.iter_mut().enumerate() {
            let more = counted.shares.sum(incident, patches);
            sum.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        }
    }
    let most = |sum: &[f64; 3]| sum.iter().copied().fold(0.0, f64::max);
    match sums.iter().position(|sum| most(sum) > MOST) {
        None => Ok(()),
        Some(patch) => Err(FormatError::whole(format!("{:.3} of the light from patch {} left the sample", most(&sums[patch]), patch + 1))),
    }
}

fn matrix(basis: &Basis, hemispheres: Hemispheres, band: Band, shares: &[f64]) -> Result<Matrix> {
    let patches = basis.count();
    if shares.len() != patches * patches {
        return Err(FormatError::whole(format!("{} shares, expected {patches} × {patches}", shares.len())));
    }
    let mut values = Vec::with_capacity(shares.len());
    for outgoing in 0..patches {
        let area = basis.projected_solid_angle(outgoing);
        values.extend((0..patches).map(|incident| (shares[incident * patches + outgoing] / area) as f32));
    }
    Ok(Matrix::new(hemispheres, band, 0, 0, values))
}

/// The inverse of a matrix of three rows, by cofactors.
fn inverse(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let cofactor = |row: usize, column: usize| {
        let [a, b] = [(row + 1) % 3, (row + 2) % 3];
        let [c, d] = [(column + 1) % 3, (column + 2) % 3];
        m[a][c] * m[b][d] - m[a][d] * m[b][c]
    };
    let determinant: f64 = (0..3).map(|column| m[0][column] * cofactor(0, column)).sum();
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| cofactor(column, row) / determinant))
}
