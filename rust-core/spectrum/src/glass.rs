//! Glasses, crystals, plastics and liquids by their index of refraction: sets by name and files.

mod formula;

pub(crate) use formula::Formula;

use crate::index::{increasing, nanometres, plain};
use gonio_formats::FormatError;

/// The wavelengths that an index must know, nm: from the mercury line g to the cadmium line C', within which measurements by spectral lines lie.
const WANTED: [f64; 2] = [440.0, 640.0];
/// Those that spectral pictures use, nm.
const USED: [f64; 2] = [380.0, 780.0];
/// The fewest points.
const FEWEST: usize = 3;
/// The least and the largest index of what lets visible light pass.
pub(crate) const POSSIBLE: [f64; 2] = [1.0, 5.0];
/// Wavelengths of the lines d, F and C, nm, by which indices and Abbe numbers are stated.
const LINES: [f64; 3] = [587.5618, 486.1327, 656.2725];

/// Sets by name: the formula's number (0 is a table), the first and the last wavelength in micrometres, and coefficients or wavelengths and indices.
const SETS: &str = include_str!("../data/glasses.csv");

/// What sets are called beside their names.
const WORDS: [(&str, &str); 36] = [
    ("BK7", "N-BK7"),
    ("BOROSILICATE", "BOROFLOAT33"),
    ("WINDOWGLASS", "SodaLime-Rubin"),
    ("WINDOW", "SodaLime-Rubin"),
    ("SODALIME", "SodaLime-Rubin"),
    ("FUSEDSILICA", "SiO2-Malitson"),
    ("SILICA", "SiO2-Malitson"),
    ("SIO2", "SiO2-Malitson"),
    ("QUARTZ", "Quartz-Ghosh"),
    ("FLUORITE", "CaF2-Malitson"),
    ("CAF2", "CaF2-Malitson"),
    ("MGF2", "MgF2-Dodge"),
    ("SALT", "NaCl-Li"),
    ("NACL", "NaCl-Li"),
    ("SAPPHIRE", "Al2O3-Malitson"),
    ("RUBY", "Al2O3-Malitson"),
    ("CORUNDUM", "Al2O3-Malitson"),
    ("AL2O3", "Al2O3-Malitson"),
    ("DIAMOND", "Diamond-Peter"),
    ("MOISSANITE", "SiC-Wang"),
    ("SIC", "SiC-Wang"),
    ("RUTILE", "TiO2-Devore"),
    ("TIO2", "TiO2-Devore"),
    ("WATER", "H2O-Daimon"),
    ("H2O", "H2O-Daimon"),
    ("ICE", "Ice-Warren"),
    ("ETHANOL", "Ethanol-Sani"),
    ("ALCOHOL", "Ethanol-Sani"),
    ("PMMA", "PMMA-Sultanova"),
    ("ACRYLIC", "PMMA-Sultanova"),
    ("ACRYLICGLASS", "PMMA-Sultanova"),
    ("PC", "PC-Sultanova"),
    ("POLYCARBONATE", "PC-Sultanova"),
    ("PS", "PS-Sultanova"),
    ("POLYSTYRENE", "PS-Sultanova"),
    ("B270I", "B270"),
];

/// The index of refraction over wavelength: between its points linear in one over the square of the wavelength, as dispersion nearly is, and held
/// beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct GlassIndex {
    /// What it is called.
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Refractive index at each.
    pub n: Vec<f64>,
    /// What is to be known of the data.
    pub notes: Vec<String>,
}

impl GlassIndex {
    /// An index of points.
    ///
    /// # Errors
    /// Wavelengths that do not increase or leave out a part of 440 to 640 nm, indices out of 1 to 5.
    pub fn new(name: &str, wavelengths_nm: Vec<f64>, n: Vec<f64>) -> Result<Self, FormatError> {
        let count = wavelengths_nm.len();
        if count < FEWEST || n.len() != count {
            let found = format!("{count} wavelengths and {} indices, expected as many of each, {FEWEST} at least", n.len());
            return Err(FormatError::whole(found));
        }
        if let Some(bad) = n.iter().find(|value| !(POSSIBLE[0]..=POSSIBLE[1]).contains(*value)) {
            return Err(FormatError::whole(format!("an index of {bad}, expected {} to {}", POSSIBLE[0], POSSIBLE[1])));
        }
        increasing(&wavelengths_nm)?;
        let mut made = Self { name: name.to_owned(), notes: Vec::new(), wavelengths_nm, n };
        made.check_reach([made.wavelengths_nm[0], made.wavelengths_nm[count - 1]], "its ends are held")?;
        Ok(made)
    }

    /// An index by a formula that holds from one wavelength in nm to another; up to those of light it goes on.
    pub(crate) fn of_formula(name: &str, formula: &Formula, reach: [f64; 2]) -> Result<Self, FormatError> {
        let wavelengths: Vec<f64> = (USED[0] as u32..=USED[1] as u32).map(f64::from).collect();
        let n = wavelengths.iter().map(|nm| formula.at(nm / 1000.0)).collect();
        let mut made = Self::new(name, wavelengths, n)?;
        made.check_reach(reach, "its formula goes on")?;
        Ok(made)
    }

    /// Refuses data that know too little of light, and says where they end within it.
    fn check_reach(&mut self, [first, last]: [f64; 2], beyond: &str) -> Result<(), FormatError> {
        if !(first > 0.0 && first <= WANTED[0] && last >= WANTED[1]) {
            let [from, to] = WANTED;
            return Err(FormatError::whole(format!("the index goes from {first} to {last} nm, expected {from} to {to} nm at least")));
        }
        if first > USED[0] || last < USED[1] {
            let [from, to] = USED;
            self.notes.push(format!("the index goes from {first} to {last} nm; up to {from} and {to} nm {beyond}"));
        }
        Ok(())
    }

    /// The index at a wavelength in nm.
    pub fn at(&self, nm: f64) -> f64 {
        let last = self.wavelengths_nm.len() - 1;
        let above = self.wavelengths_nm.partition_point(|point| *point < nm).clamp(1, last);
        let [low, here, high] = [self.wavelengths_nm[above - 1], nm, self.wavelengths_nm[above]].map(|nm| 1.0 / (nm * nm));
        let t = ((here - low) / (high - low)).clamp(0.0, 1.0);
        self.n[above - 1] + t * (self.n[above] - self.n[above - 1])
    }

    /// The index at 587.56 nm, by which glass is named: what it has where light is computed as colour.
    pub fn stated(&self) -> f64 {
        self.at(LINES[0])
    }

    /// The Abbe number by the lines d, F and C; infinite without dispersion.
    pub fn abbe(&self) -> f64 {
        let [d, f, c] = LINES.map(|nm| self.at(nm));
        (d - 1.0) / (f - c)
    }
}

/// The glass or liquid of a name: a set (`N-BK7`, `SiO2-Malitson`) or a word (`water`), in any letters. `None` where there is none.
pub fn glass(name: &str) -> Option<GlassIndex> {
    let asked = plain(name);
    let meant = WORDS.iter().find(|(word, _)| *word == asked).map_or(asked, |(_, set)| plain(set));
    let row = rows().find(|row| plain(row[0]) == meant)?;
    let number = |text: &str| text.parse::<f64>().ok();
    let values = row[4].split(' ').map(number).collect::<Option<Vec<f64>>>()?;
    let reach = [number(row[2])?, number(row[3])?].map(nanometres);
    match row[1].parse().ok()? {
        0 => {
            let (wavelengths, n) = values.chunks(2).map(|pair| (nanometres(pair[0]), pair[1])).unzip();
            GlassIndex::new(row[0], wavelengths, n).ok()
        }
        formula => GlassIndex::of_formula(row[0], &Formula::new(formula, values).ok()?, reach).ok(),
    }
}

/// The sets that [`glass`] knows, for help and messages.
pub fn glass_sets() -> Vec<&'static str> {
    rows().map(|row| row[0]).collect()
}

/// The cells of the table's rows.
fn rows() -> impl Iterator<Item = [&'static str; 5]> {
    SETS.lines().skip(1).filter_map(|line| line.split(',').collect::<Vec<_>>().try_into().ok())
}
