//! EULUMDAT: one value a line, intensities in cd/klm (the format pages of DIAL and AGi32).

mod fields;
mod read;
mod write;

pub use read::read;
pub use write::write;

use crate::photometry::text::parse;

/// Whether lines 2 to 6 hold what EULUMDAT has there: type, symmetry, and the planes' and angles' numbers.
pub(crate) fn looks_like(bytes: &[u8]) -> bool {
    let mut lines = bytes.split(|byte| *byte == b'\n').skip(1).take(5);
    let mut number = || lines.next().and_then(|line| std::str::from_utf8(line).ok()).and_then(|line| parse(line.trim()));
    let within = |value: Option<f64>, most: f64| value.is_some_and(|value| (0.0..=most).contains(&value));
    within(number(), 3.0) && within(number(), 4.0) && number().is_some()
}
