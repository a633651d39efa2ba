//! Spectra by name: the CIE's illuminants, blackbodies and daylight.

use crate::{
    illuminant::{DAYLIGHT, daylight, planck, standard_a},
    source::Spectrum,
    table::Table,
};
use gonio_formats::FormatError;
use std::sync::LazyLock;

/// What [`named`] understands, for help and messages.
pub const NAMES: &str = "A, E, D50, D55, D65, D75, FL1 to FL12, FL3.1 to FL3.15, HP1 to HP5, LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1, LED-V2; \
     2700K (a blackbody), D5700K (daylight)";

/// The temperatures of blackbodies, K.
const BLACKBODIES: [f64; 2] = [500.0, 100_000.0];

/// Lamps in steps of 5 nm (CIE 015:2018, tables 10 to 12).
static LAMPS: LazyLock<[Table; 3]> = LazyLock::new(|| {
    [include_str!("../data/fluorescent.csv"), include_str!("../data/discharge.csv"), include_str!("../data/led.csv")].map(Table::new)
});

/// The spectrum of a name as in [`NAMES`], in any letters, with or without CIE before it; `None` where it is no such name.
///
/// # Errors
/// A temperature outside the formula's range.
pub fn named(name: &str) -> Option<Result<Spectrum, FormatError>> {
    if name.trim_start().starts_with('-') {
        return None;
    }
    let plain = plain(name);
    match plain.as_str() {
        "A" => return Some(sampled("CIE A", standard_a)),
        "E" => return Some(sampled("CIE E", |_| 1.0)),
        _ => {}
    }
    for table in LAMPS.iter() {
        if let Some(column) = table.names.iter().position(|lamp| self::plain(lamp) == plain) {
            let (wavelengths, power) = table.column(column);
            return Some(Spectrum::new(&format!("CIE {}", table.names[column]), &wavelengths, power));
        }
    }
    let kelvin = |digits: &str| digits.parse::<f64>().ok().filter(|_| digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.'));
    let within = |kelvin: f64, [least, most]: [f64; 2], what: &str| {
        let problem = || FormatError::whole(format!("{what} of {kelvin:.0} K, expected {least} to {most} K"));
        if (least..=most).contains(&kelvin) { Ok(kelvin) } else { Err(problem()) }
    };
    if let Some(rest) = plain.strip_prefix('D') {
        let digits = rest.strip_suffix('K').unwrap_or(rest);
        let number = kelvin(digits)?;
        let nominal = rest.len() == 2 && digits.len() == 2;
        let found = within(if nominal { nominal_daylight(number) } else { number }, DAYLIGHT, "daylight");
        let title = if nominal { format!("CIE D{digits}") } else { format!("daylight of {number} K") };
        return Some(found.and_then(|kelvin| sampled(&title, daylight(kelvin))));
    }
    let number = kelvin(plain.strip_suffix('K')?)?;
    let title = format!("blackbody of {number} K");
    Some(within(number, BLACKBODIES, "a blackbody").and_then(|kelvin| sampled(&title, |nm| planck(nm, kelvin))))
}

/// The temperature of a D illuminant that is named by hundreds of kelvin, which were kelvin of 1967 (CIE 15, 4.1.2).
pub(crate) fn nominal_daylight(hundreds: f64) -> f64 {
    100.0 * hundreds * 1.4388 / 1.4380
}

/// A name without what people write one way and the other.
fn plain(name: &str) -> String {
    let name = name.trim().to_ascii_uppercase();
    let name = name.strip_prefix("CIE").unwrap_or(&name);
    name.chars().filter(|c| !matches!(c, ' ' | '-' | '_')).collect()
}

/// A formula's spectrum over the observer's wavelengths.
fn sampled(name: &str, power: impl Fn(f64) -> f64) -> Result<Spectrum, FormatError> {
    let wavelengths: Vec<f64> = (360..=830).map(f64::from).collect();
    let power: Vec<f64> = wavelengths.iter().map(|nm| power(*nm)).collect();
    Spectrum::new(name, &wavelengths, &power)
}
