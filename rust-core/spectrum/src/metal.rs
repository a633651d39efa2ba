//! Metals by their complex index of refraction: sets by name, files, and what they look like as colours.

use crate::{
    index::{increasing, plain},
    integral::Integral,
    table::Table,
    white,
};
use gonio_formats::FormatError;
use std::sync::LazyLock;

/// The wavelengths that an index must know, nm: the observer's nearly all.
const WANTED: [f64; 2] = [400.0, 700.0];
/// Those that spectral pictures use, nm.
const USED: [f64; 2] = [380.0, 780.0];
/// The fewest points.
const FEWEST: usize = 3;
/// The largest index or extinction of a metal in the visible.
const LARGEST: f64 = 100.0;
/// Normal reflectance of a colour channel above this counts as this: beyond 1 no index has it.
const MOST: f64 = 0.995;
/// The cosine at which a metal's colour towards the edge is taken (82 degrees).
const EDGE: f64 = 1.0 / 7.0;

/// Sets by name: two columns each, n and k.
static SETS: LazyLock<Table> = LazyLock::new(|| Table::new(include_str!("../data/metals.csv")));

/// What metals are called beside the symbol, which means the first set that has it.
const WORDS: [(&str, &str); 43] = [
    ("SILVER", "Ag"),
    ("ALUMINIUM", "Al"),
    ("ALUMINUM", "Al"),
    ("GOLD", "Au"),
    ("ELECTRUM", "AuAg"),
    ("BERYLLIUM", "Be"),
    ("BISMUTH", "Bi"),
    ("GRAPHITE", "C"),
    ("COBALT", "Co"),
    ("CHROMIUM", "Cr"),
    ("CHROME", "Cr"),
    ("CAESIUM", "Cs"),
    ("COPPER", "Cu"),
    ("BRASS", "Cu70Zn30"),
    ("REDBRASS", "Cu85Zn15"),
    ("TOMBAC", "Cu90Zn10"),
    ("IRON", "Fe"),
    ("GERMANIUM", "Ge"),
    ("MERCURY", "Hg"),
    ("INDIUM", "In"),
    ("IRIDIUM", "Ir"),
    ("POTASSIUM", "K"),
    ("LITHIUM", "Li"),
    ("MAGNESIUM", "Mg"),
    ("MANGANESE", "Mn"),
    ("MOLYBDENUM", "Mo"),
    ("SODIUM", "Na"),
    ("NIOBIUM", "Nb"),
    ("NICKEL", "Ni"),
    ("PERMALLOY", "NiFe"),
    ("OSMIUM", "Os"),
    ("LEAD", "Pb"),
    ("PALLADIUM", "Pd"),
    ("PLATINUM", "Pt"),
    ("RHODIUM", "Rh"),
    ("SILICON", "Si"),
    ("TANTALUM", "Ta"),
    ("TITANIUM", "Ti"),
    ("TITANIUMNITRIDE", "TiN"),
    ("VANADIUM", "V"),
    ("TUNGSTEN", "W"),
    ("ZINC", "Zn"),
    ("ZIRCONIUM", "Zr"),
];

/// The complex index of refraction n + i k over wavelength, linear between its points and held beyond them.
#[derive(Clone, Debug, PartialEq)]
pub struct MetalIndex {
    /// What it is called.
    pub name: String,
    /// nm, strictly increasing.
    pub wavelengths_nm: Vec<f64>,
    /// Refractive index at each.
    pub n: Vec<f64>,
    /// Extinction coefficient at each.
    pub k: Vec<f64>,
    /// What is to be known of the data.
    pub notes: Vec<String>,
}

impl MetalIndex {
    /// An index of points.
    ///
    /// # Errors
    /// Wavelengths that do not increase or leave out a part of 400 to 700 nm, numbers that no metal has.
    pub fn new(name: &str, wavelengths_nm: Vec<f64>, n: Vec<f64>, k: Vec<f64>) -> Result<Self, FormatError> {
        let count = wavelengths_nm.len();
        if count < FEWEST || n.len() != count || k.len() != count {
            let found =
                format!("{count} wavelengths, {} values of n, {} of k, expected as many of each, {FEWEST} at least", n.len(), k.len());
            return Err(FormatError::whole(found));
        }
        if let Some(bad) = n.iter().chain(&k).find(|value| !(0.0..=LARGEST).contains(*value)) {
            return Err(FormatError::whole(format!("an index or extinction of {bad}, expected 0 to {LARGEST}")));
        }
        increasing(&wavelengths_nm)?;
        let [first, last] = [wavelengths_nm[0], wavelengths_nm[count - 1]];
        if !(first > 0.0 && first <= WANTED[0] && last >= WANTED[1]) {
            let [from, to] = WANTED;
            return Err(FormatError::whole(format!("the index goes from {first} to {last} nm, expected {from} to {to} nm at least")));
        }
        let mut notes = Vec::new();
        if first > USED[0] || last < USED[1] {
            let [from, to] = USED;
            notes.push(format!("the index goes from {first} to {last} nm; up to {from} and {to} nm its ends are held"));
        }
        Ok(Self { name: name.to_owned(), wavelengths_nm, n, k, notes })
    }

    /// n and k at a wavelength in nm.
    pub fn at(&self, nm: f64) -> [f64; 2] {
        let last = self.wavelengths_nm.len() - 1;
        let above = self.wavelengths_nm.partition_point(|point| *point < nm).clamp(1, last);
        let [low, high] = [self.wavelengths_nm[above - 1], self.wavelengths_nm[above]];
        let t = ((nm - low) / (high - low)).clamp(0.0, 1.0);
        [&self.n, &self.k].map(|values| values[above - 1] + t * (values[above] - values[above - 1]))
    }

    /// Reflectance at a wavelength in nm for unpolarised light from vacuum at the cosine `cos`.
    pub fn reflectance(&self, nm: f64, cos: f64) -> f64 {
        reflectance(self.at(nm), cos)
    }

    /// Linear Rec.709 of what it reflects of daylight D65 at a cosine, white being 1; components may lie outside 0 to 1.
    pub fn colour(&self, cos: f64) -> [f64; 3] {
        let reflected = |nm: f64| white::colour(nm).map(|part| part * self.reflectance(nm, cos));
        Integral::new(&self.wavelengths_nm, reflected).all()
    }

    /// n and k of red, green and blue with the metal's colour at normal incidence and at 82 degrees by daylight D65: what it is where light is
    /// computed as colour. Components of the colours beyond 0 to 0.995 are held there.
    pub fn colour_index(&self) -> [[f32; 3]; 2] {
        let (normal, edge) = (self.colour(1.0), self.colour(EDGE));
        let channels: [[f64; 2]; 3] = std::array::from_fn(|c| channel_index(normal[c].clamp(1e-3, MOST), edge[c]));
        [0, 1].map(|part| channels.map(|channel| channel[part] as f32))
    }
}

/// Fresnel's reflectance of a conductor n + i k from vacuum, unpolarised.
fn reflectance([n, k]: [f64; 2], cos: f64) -> f64 {
    let (c2, s2) = (cos * cos, 1.0 - cos * cos);
    let t0 = n * n - k * k - s2;
    let a2b2 = (t0 * t0 + 4.0 * n * n * k * k).sqrt();
    let t2 = 2.0 * cos * ((a2b2 + t0) * 0.5).max(0.0).sqrt();
    let s = (a2b2 + c2 - t2) / (a2b2 + c2 + t2);
    let (t3, t4) = (c2 * a2b2 + s2 * s2, t2 * s2);
    0.5 * s * (1.0 + (t3 - t4) / (t3 + t4))
}

/// The index with the normal reflectance `r` whose reflectance at 82 degrees comes nearest to `edge`: along Gulbrandsen's edge tint, by halving.
fn channel_index(r: f64, edge: f64) -> [f64; 2] {
    let root = r.sqrt();
    let index = |tint: f64| {
        let n = (1.0 + root) / (1.0 - root) * (1.0 - tint) + (1.0 - r) / (1.0 + r) * tint;
        [n, ((r * (n + 1.0).powi(2) - (n - 1.0).powi(2)) / (1.0 - r)).max(0.0).sqrt()]
    };
    let at_edge = |tint: f64| reflectance(index(tint), EDGE);
    let rising = at_edge(1.0) > at_edge(0.0);
    let [mut low, mut high] = [0.0, 1.0];
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if (at_edge(middle) < edge) == rising { low = middle } else { high = middle }
    }
    index(0.5 * (low + high))
}

/// The metal of a name: a symbol (`Au`), a word (`gold`), or a set (`Au-McPeak`), in any letters. `None` where there is none.
pub fn metal(name: &str) -> Option<MetalIndex> {
    let asked = plain(name);
    let symbol = WORDS.iter().find(|(word, _)| *word == asked).map_or(asked.clone(), |(_, symbol)| plain(symbol));
    let is_meant = |set: &&str| plain(set) == asked || set.split('-').next().is_some_and(|of| plain(of) == symbol);
    let place = SETS.names.iter().position(is_meant)?;
    let (wavelengths, n) = SETS.column(place);
    let (_, k) = SETS.column(place + 1);
    MetalIndex::new(SETS.names[place], wavelengths, n.to_vec(), k.to_vec()).ok()
}

/// The sets that [`metal`] knows, for help and messages.
pub fn metal_sets() -> Vec<&'static str> {
    SETS.names.iter().step_by(2).copied().collect()
}
