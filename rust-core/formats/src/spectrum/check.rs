//! What makes a list of points the power of a lamp over wavelength.

use super::{MOST, SpectralPoint, SpectralPower};
use crate::error::{FormatError, Result};

/// The fewest points.
const FEWEST: usize = 5;
/// The wavelengths that figures are defined over, nm (CIE 15, CIE 224, TM-30).
const WANTED: [f64; 2] = [380.0, 780.0];
/// The widest step within these, nm: beyond it a line of a lamp may be missing.
const WIDEST_GAP: f64 = 20.0;
/// The widest step that sums take as it is, nm.
const WIDEST_STEP: f64 = 5.0;
/// Power below zero is an instrument's noise up to this share of the largest.
const NOISE: f64 = 0.01;
/// The shortest wavelength that can be meant in nm; micrometres lie below.
const SHORTEST: f64 = 50.0;
/// The longest wavelength of a lamp in nm.
const LONGEST: f64 = 100_000.0;

/// A problem at a point's line, or of the whole where it has none.
fn at(point: &SpectralPoint, problem: String) -> FormatError {
    point.line.map_or_else(|| FormatError::whole(&problem), |line| FormatError::line(line, &problem))
}

impl SpectralPower {
    /// The power of points in their order, relative to the largest.
    ///
    /// # Errors
    /// Fewer than five points, wavelengths that do not increase or are no nanometres, gaps of more than 20 nm in what is visible, power that is not finite
    /// or below zero; with the point's line where it has one.
    pub fn new(name: &str, points: &[SpectralPoint]) -> Result<Self> {
        check_numbers(points)?;
        check_order(points)?;
        let mut notes = Vec::new();
        let floor = noise(points, &mut notes)?;
        check_gaps(points, &mut notes)?;
        Ok(Self {
            name: name.to_owned(),
            wavelengths_nm: points.iter().map(|point| point.nm).collect(),
            power: points.iter().map(|point| if point.power < 0.0 { 0.0 } else { point.power / floor }).collect(),
            notes,
        })
    }
}

fn check_numbers(points: &[SpectralPoint]) -> Result<()> {
    if points.len() < FEWEST {
        let problem = format!("{} points of wavelength and power, a spectrum has at least {FEWEST}", points.len());
        return Err(points.first().map_or_else(|| FormatError::whole(&problem), |point| at(point, problem.clone())));
    }
    if points.len() > MOST {
        return Err(FormatError::whole(format!("more than {MOST} points: no spectrum of a lamp")));
    }
    if let Some(bad) = points.iter().find(|point| !(point.nm.is_finite() && point.nm > 0.0)) {
        return Err(at(bad, format!("wavelength {}, expected a positive number of nm", bad.nm)));
    }
    if let Some(bad) = points.iter().find(|point| !point.power.is_finite()) {
        return Err(at(bad, format!("power {} at {} nm, expected a number", bad.power, bad.nm)));
    }
    let [least, most] = points.iter().fold([f64::INFINITY, 0.0], |[least, most], point| [least.min(point.nm), f64::max(most, point.nm)]);
    if most < SHORTEST {
        return Err(at(&points[0], format!("wavelengths from {least} to {most}: these look like micrometres, expected nm")));
    }
    if least > 3000.0 && most < LONGEST {
        return Err(at(&points[0], format!("wavelengths from {least} to {most}: these look like ångström or wave numbers, expected nm")));
    }
    let strange = points.iter().find(|point| !(SHORTEST..=LONGEST).contains(&point.nm));
    strange.map_or(Ok(()), |bad| Err(at(bad, format!("wavelength {} nm, expected {SHORTEST} to {LONGEST}", bad.nm))))
}

fn check_order(points: &[SpectralPoint]) -> Result<()> {
    let wrong = points.windows(2).find(|pair| pair[1].nm <= pair[0].nm);
    wrong.map_or(Ok(()), |pair| {
        let problem = if pair[0].nm == pair[1].nm {
            format!("{} nm stands twice, expected increasing wavelengths", pair[1].nm)
        } else {
            format!("{} nm after {} nm, expected increasing wavelengths", pair[1].nm, pair[0].nm)
        };
        Err(at(&pair[1], problem))
    })
}

/// The unit of power, its largest, in which no sum overflows; says where power is below zero.
fn noise(points: &[SpectralPoint], notes: &mut Vec<String>) -> Result<f64> {
    let largest = points.iter().map(|point| point.power).fold(0.0, f64::max);
    if largest <= 0.0 {
        return Err(FormatError::whole("no power above zero"));
    }
    if let Some(bad) = points.iter().find(|point| point.power < -NOISE * largest) {
        return Err(at(bad, format!("power {} at {} nm, expected none below zero", bad.power, bad.nm)));
    }
    let below = points.iter().filter(|point| point.power < 0.0).count();
    if below > 0 {
        notes.push(format!("{below} powers below zero, none beyond {} % of the largest, count as zero", NOISE * 100.0));
    }
    // A largest below the normal numbers has no inverse.
    Ok(if largest.is_normal() { largest } else { 1.0 })
}

fn check_gaps(points: &[SpectralPoint], notes: &mut Vec<String>) -> Result<()> {
    let steps =
        || points.windows(2).filter(|pair| pair[1].nm > WANTED[0] && pair[0].nm < WANTED[1]).map(|pair| (pair, pair[1].nm - pair[0].nm));
    if let Some((pair, _)) = steps().find(|(_, step)| *step > WIDEST_GAP) {
        let problem = format!("nothing between {} and {} nm, expected steps of at most {WIDEST_GAP} nm", pair[0].nm, pair[1].nm);
        return Err(at(&pair[1], problem));
    }
    if let Some((pair, widest)) = steps().filter(|(_, step)| *step > WIDEST_STEP + 1e-6).max_by(|a, b| a.1.total_cmp(&b.1)) {
        let widest = (1e4 * widest).round() / 1e4;
        notes.push(format!(
            "steps of up to {widest} nm, as from {} to {} nm: the figures are defined for {WIDEST_STEP} nm and less; linear between points",
            pair[0].nm, pair[1].nm
        ));
    }
    Ok(())
}
