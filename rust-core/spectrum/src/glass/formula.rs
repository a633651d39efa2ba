//! Dispersion formulas of the refractiveindex.info database, by its numbers.

/// What the formulas are called, by their number less one.
const NAMES: [&str; 9] =
    ["Sellmeier", "Sellmeier-2", "polynomial", "RefractiveIndex.INFO", "Cauchy", "gases", "Herzberger", "retro", "exotic"];
/// How many coefficients they may have, at least and at most; formulas of pairs have an odd number.
const COUNTS: [[usize; 2]; 9] = [[1, 17], [1, 17], [1, 17], [5, 17], [1, 11], [1, 11], [2, 6], [4, 4], [6, 6]];

/// A formula with its coefficients, of wavelengths in micrometres.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Formula {
    number: usize,
    coefficients: Vec<f64>,
}

impl Formula {
    /// The formula of a number from 1 to 9.
    ///
    /// # Errors
    /// What is wrong with its coefficients, or that there is none.
    pub(crate) fn new(number: usize, coefficients: Vec<f64>) -> Result<Self, String> {
        let Some([least, most]) = number.checked_sub(1).and_then(|at| COUNTS.get(at)).copied() else {
            return Err(format!("formula {number}, expected one of 1 to {}", COUNTS.len()));
        };
        let (count, name) = (coefficients.len(), NAMES[number - 1]);
        if count < least || count > most {
            let expected = if least == most { format!("{least}") } else { format!("{least} to {most}") };
            return Err(format!("{count} coefficients of formula {number} ({name}), expected {expected}"));
        }
        if number <= 6 && count % 2 == 0 {
            return Err(format!("{count} coefficients of formula {number} ({name}), expected one and pairs"));
        }
        Ok(Self { number, coefficients })
    }

    /// The index at a wavelength in micrometres; no number where the formula has none.
    pub(crate) fn at(&self, um: f64) -> f64 {
        let c = &self.coefficients;
        let part = |place: usize| c.get(place).copied().unwrap_or(0.0);
        let pairs = |term: fn(f64, f64, f64) -> f64, from: usize| {
            c[from.min(c.len())..].chunks(2).map(|pair| term(um, pair[0], pair[1])).sum::<f64>()
        };
        let square = um * um;
        match self.number {
            1 => (1.0 + part(0) + pairs(|um, b, c| b * um * um / (um * um - c * c), 1)).sqrt(),
            2 => (1.0 + part(0) + pairs(|um, b, c| b * um * um / (um * um - c), 1)).sqrt(),
            3 => (part(0) + pairs(power, 1)).sqrt(),
            4 => {
                let term = |at: usize| {
                    if c.len() > at { part(at) * um.powf(part(at + 1)) / (square - part(at + 2).powf(part(at + 3))) } else { 0.0 }
                };
                (part(0) + term(1) + term(5) + pairs(power, 9)).sqrt()
            }
            5 => part(0) + pairs(power, 1),
            6 => 1.0 + part(0) + pairs(|um, b, c| b / (c - 1.0 / (um * um)), 1),
            7 => {
                let bend = 1.0 / (square - 0.028);
                part(0) + part(1) * bend + part(2) * bend * bend + square * (part(3) + square * (part(4) + square * part(5)))
            }
            8 => {
                let ratio = part(0) + part(1) * square / (square - part(2)) + part(3) * square;
                ((1.0 + 2.0 * ratio) / (1.0 - ratio)).sqrt()
            }
            _ => {
                let off = um - part(4);
                (part(0) + part(1) / (square - part(2)) + part(3) * off / (off * off + part(5))).sqrt()
            }
        }
    }
}

fn power(um: f64, factor: f64, exponent: f64) -> f64 {
    factor * um.powf(exponent)
}
