//! Writes a weather file's sky matrix as raw 32-bit floats, a column of patches for each step: `sky_matrix -- FILE FACTOR OUT [solar|sky|sun] [DEGREES]`.

use gonio_annual::{
    Year,
    sky::{Light, Quantity, SkyMatrix, SkyOptions},
};
use std::{error::Error, io::Write, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [weather, factor, to, rest @ ..] = &arguments[..] else { return Err("a weather file, a factor and an output are needed".into()) };
    let mut options = SkyOptions { factor: factor.parse()?, ..SkyOptions::default() };
    match rest.first().map(String::as_str) {
        Some("solar") => options.quantity = Quantity::SolarRadiance,
        Some("sky") => options.light = Light::WithoutSun,
        Some("sun") => options.light = Light::SunAlone { sun_patches: 4 },
        _ => {}
    }
    if let Some(degrees) = rest.get(1) {
        options.rotation_deg = degrees.parse()?;
    }
    let year = Year::read(Path::new(weather), &std::fs::read(weather)?)?;
    year.doubts.iter().for_each(|doubt| eprintln!("{doubt}"));
    let columns = SkyMatrix::new(&year, options)?.columns(&(0..year.steps.len()).collect::<Vec<_>>(), 2);
    let bytes: Vec<u8> = columns.iter().flat_map(|value| value.to_le_bytes()).collect();
    std::fs::File::create(to)?.write_all(&bytes)?;
    Ok(())
}
