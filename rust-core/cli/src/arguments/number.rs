//! Numbers on the command line, in the same forms for all commands.

use gonio::scene::parse_bytes;
use std::{fmt::Display, ops::RangeInclusive, str::FromStr};

/// Factors of a count's last letter.
const LETTERS: [(char, f64); 3] = [('k', 1e3), ('M', 1e6), ('G', 1e9)];

/// What reads a count within a range: `500000`, `2e9`, `200M`, `5G`, `20k`.
pub(crate) fn count<T: TryFrom<u64>>(range: RangeInclusive<u64>) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static {
    move |text: &str| {
        let text = text.trim();
        let letter = LETTERS.into_iter().find_map(|(letter, factor)| Some((text.strip_suffix(letter)?, factor)));
        let (digits, factor) = letter.unwrap_or((text, 1.0));
        let (least, most) = (range.start(), range.end());
        let wrong = || format!("'{text}' was found, expected a whole number such as 500000, 2e9 or 20M, from {least} to {most}");
        // Digits alone are exact beyond what a floating number holds.
        let value = match (digits.parse::<u64>(), digits.parse::<f64>()) {
            (Ok(whole), _) if factor == 1.0 => whole,
            (_, Ok(number)) if (number * factor).fract() == 0.0 && (0.0..1.8e19).contains(&(number * factor)) => (number * factor) as u64,
            _ => return Err(wrong()),
        };
        let fits = range.contains(&value).then(|| T::try_from(value).ok()).flatten();
        fits.ok_or_else(wrong)
    }
}

/// Reads a number that is finite.
pub(crate) fn finite<T: FromStr + Display + Into<f64> + Copy>(text: &str) -> Result<T, String> {
    let value = text.trim().parse().ok().filter(|value: &T| (*value).into().is_finite());
    value.ok_or_else(|| format!("'{text}' was found, expected a number"))
}

/// Reads a number that is finite and above 0.
pub(crate) fn positive<T: FromStr + Display + Into<f64> + Copy>(text: &str) -> Result<T, String> {
    let value = finite::<T>(text)?;
    if value.into() > 0.0 { Ok(value) } else { Err(format!("'{text}' was found, expected a number above 0")) }
}

/// Reads an amount of memory, bytes: `512M`, `4G`; digits alone are mebibytes.
pub(crate) fn mebibytes(text: &str) -> Result<u64, String> {
    match text.trim().parse::<u64>() {
        Ok(number) => Ok(number.saturating_mul(1 << 20)),
        Err(_) => parse_bytes(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_are_written_in_several_ways() {
        let read = count::<u64>(1..=1 << 40);
        assert_eq!(
            ["500", "2e9", "200M", "20k", "1.5M", "3G"].map(|text| read(text).ok()),
            [Some(500), Some(2_000_000_000), Some(200_000_000), Some(20_000), Some(1_500_000), Some(3_000_000_000)]
        );
        for bad in ["", "M", "-3", "0", "1e99", "nan", "inf", "5T", "5µ", "1.5", "2000G"] {
            assert!(read(bad).is_err(), "{bad}");
        }
        assert_eq!(count::<u64>(0..=u64::MAX)("18446744073709551615"), Ok(u64::MAX));
        assert_eq!(count::<u32>(0..=u64::from(u32::MAX))("5G").ok(), None);
    }

    #[test]
    fn memory_is_in_mebibytes_or_says_its_unit() {
        assert_eq!(["1024", "512M", "1G"].map(|text| mebibytes(text).ok()), [Some(1 << 30), Some(512 << 20), Some(1 << 30)]);
        assert!(mebibytes("-1").is_err() && mebibytes("x").is_err());
    }

    #[test]
    fn numbers_are_finite() {
        assert_eq!((finite::<f64>("-1e-3"), finite::<f32>(" 2.5 ")), (Ok(-1e-3), Ok(2.5)));
        for bad in ["nan", "inf", "-inf", "1e999", "", "x"] {
            assert!(finite::<f64>(bad).is_err(), "{bad}");
        }
    }
}
