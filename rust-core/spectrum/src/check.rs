//! What makes a list of points a spectrum of a lamp.

use crate::{
    observer::{self, OBSERVED},
    source::{Point, Spectrum, WIDEST_STEP, sums},
};
use gonio_formats::FormatError;

/// The fewest points.
const FEWEST: usize = 5;
/// The most points: a spectrometer of a thousandth of a nanometre has fewer.
pub(crate) const MOST: usize = 1 << 20;
/// The wavelengths that figures are defined over, nm (CIE 15, CIE 224, TM-30).
const WANTED: [f64; 2] = [380.0, 780.0];
/// The widest step within these, nm: beyond it a line of a lamp may be missing.
const WIDEST_GAP: f64 = 20.0;
/// Power below zero is an instrument's noise up to this share of the largest.
const NOISE: f64 = 0.01;
/// The shortest wavelength that can be meant in nm; micrometres lie below.
const SHORTEST: f64 = 50.0;
/// The longest wavelength of a lamp in nm.
const LONGEST: f64 = 100_000.0;

/// A problem at a point's line, or of the whole where it has none.
fn at(point: &Point, problem: String) -> FormatError {
    point.line.map_or_else(|| FormatError::whole(&problem), |line| FormatError::line(line, &problem))
}

/// The points as a spectrum.
pub(crate) fn checked(name: &str, points: Vec<Point>) -> Result<Spectrum, FormatError> {
    check_numbers(&points)?;
    check_order(&points)?;
    let mut notes = Vec::new();
    let floor = noise(&points, &mut notes)?;
    check_gaps(&points, &mut notes)?;
    let spectrum = Spectrum {
        name: name.to_owned(),
        wavelengths_nm: points.iter().map(|point| point.nm).collect(),
        power: points.iter().map(|point| if point.power < 0.0 { 0.0 } else { point.power / floor }).collect(),
        notes,
    };
    check_light(spectrum)
}

fn check_numbers(points: &[Point]) -> Result<(), FormatError> {
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

fn check_order(points: &[Point]) -> Result<(), FormatError> {
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
fn noise(points: &[Point], notes: &mut Vec<String>) -> Result<f64, FormatError> {
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

fn check_gaps(points: &[Point], notes: &mut Vec<String>) -> Result<(), FormatError> {
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

/// Says which wavelengths are missing and which the observer does not know; refuses what nobody sees.
fn check_light(mut spectrum: Spectrum) -> Result<Spectrum, FormatError> {
    let [first, last] = [spectrum.wavelengths_nm[0], spectrum.wavelengths_nm[spectrum.wavelengths_nm.len() - 1]];
    let nodes = spectrum.nodes();
    let [all, observed, luminous] =
        sums(&nodes, |nm| [1.0, if (OBSERVED[0]..=OBSERVED[1]).contains(&nm) { 1.0 } else { 0.0 }, observer::cie_1931(nm)[1]]);
    if luminous <= 0.0 {
        return Err(FormatError::whole(format!("no visible light from {first} to {last} nm")));
    }
    if first > WANTED[0] || last < WANTED[1] {
        let [from, to] = WANTED;
        spectrum.notes.push(format!(
            "the data go from {first} to {last} nm: beyond there is no light to us; the figures are defined over {from} to {to} nm"
        ));
    }
    let share = 100.0 * (1.0 - observed / all);
    if share > 0.005 {
        let [from, to] = OBSERVED;
        spectrum.notes.push(format!(
            "{share:.2} % of the power lies outside the observer's {from} to {to} nm: it counts in the luminous efficacy of radiation alone"
        ));
    }
    Ok(spectrum)
}
