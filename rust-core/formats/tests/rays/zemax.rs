//! Zemax.

use crate::{RAYS, are_the_rays, close};
use gonio_formats::bsdf::cie_1931;
use gonio_formats::rays::{FluxUnit, LengthUnit, RayColour, RayFormat, read, zemax};

/// A binary file of rays of any width.
pub(crate) fn binary<const N: usize>(rays: &[[f32; N]], kind: i32, flux_type: i32, unit: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    bytes.extend(1010_i32.to_le_bytes());
    bytes.extend((rays.len() as u32).to_le_bytes());
    let mut description = b"an LED".to_vec();
    description.resize(100, 0);
    bytes.extend(description);
    [8.0_f32, 8.0, 0.55, 0.0, 90.0, 0.0, 360.0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend(unit.to_le_bytes());
    [0.0_f32, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    [kind, flux_type, 0, 0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    assert_eq!(bytes.len(), 208);
    rays.iter().flatten().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes
}

/// Rays with a wavelength in µm.
fn spectral() -> Vec<[f32; 8]> {
    let wavelengths = [0.55, 0.45, 0.62];
    RAYS.iter().zip(wavelengths).map(|(ray, last)| [ray[0], ray[1], ray[2], ray[3], ray[4], ray[5], ray[6], last]).collect()
}

#[test]
fn lumens_and_watts_in_every_unit() {
    let units = [1.0, 0.0254, 0.01, 0.3048, 0.001];
    for (unit, metres) in units.into_iter().enumerate() {
        let file = read(&binary(&RAYS, 0, 1, unit as u32), "lamp.dat", false).unwrap();
        assert_eq!((file.format, file.unit, file.left_out, file.warnings.len()), (RayFormat::Zemax, FluxUnit::Lumens, 0, 0));
        assert_eq!((file.description.as_str(), &file.colour), ("an LED", &RayColour::Unknown));
        are_the_rays(&file, metres, 8.0);
    }
    let file = read(&binary(&RAYS, 0, 0, 4), "", false).unwrap();
    assert_eq!((file.unit, file.length_unit), (FluxUnit::Watts, LengthUnit::Millimetres));
    are_the_rays(&file, 1e-3, 8.0);
    assert_eq!(zemax::write(&file).map(|bytes| read(&bytes, "", false).unwrap().unit), Ok(FluxUnit::Watts));
}

#[test]
fn wavelengths_give_lumens() {
    let file = read(&binary(&spectral(), 2, 0, 4), "", false).unwrap();
    let lumens = |watts: f64, nanometres: f64| 683.0 * watts * cie_1931(nanometres)[1];
    let total = lumens(2.0, 550.0) + lumens(1.0, 450.0) + lumens(5.0, 620.0);
    are_the_rays(&file, 1e-3, total);
    assert_eq!(file.unit, FluxUnit::Lumens);
    let RayColour::Wavelengths(wavelengths) = &file.colour else { panic!("expected wavelengths, found {:?}", file.colour) };
    wavelengths.iter().zip([550.0, 450.0, 620.0]).for_each(|(found, expected)| close((*found).into(), expected, 1e-6));
    let again = read(&zemax::write(&file).unwrap(), "", false).unwrap();
    are_the_rays(&again, 1e-3, total);
    again.fluxes.iter().zip(&file.fluxes).for_each(|(found, expected)| close((*found).into(), (*expected).into(), 1e-5));
}

#[test]
fn text_is_read() {
    let text = "3 4\r\n1 2 3 0 0 1 2\r\n-1 0.5 0 0.6 0 0.8 1\r\n\r\n0 0 0 0 -1 0 5\r\n";
    let file = read(text.as_bytes(), "lamp.dat", false).unwrap();
    assert_eq!((file.format, file.unit), (RayFormat::ZemaxText, FluxUnit::Relative));
    are_the_rays(&file, 1e-3, 8.0);
    assert!(zemax::write(&file).unwrap_err().problem.contains("state a flux"));
    // Columns may be filled up, as OpticStudio's own exports are.
    let wide = "2.000000\t1.0\t0.0\t0.0\t0.0\t0.0\t0.0\t0.0\n1 0 0 0 0 1 1 0.55\n1 0 0 0 0 1 1 0.55\n";
    let file = read(wide.as_bytes(), "", false).unwrap();
    assert_eq!((file.unit, file.origins[0][0]), (FluxUnit::Lumens, 0.0254));
    close(file.total, 2.0 * 683.0 * cie_1931(550.0)[1], 1e-6);
    let problem = |text: &str, lenient: bool| read(text.as_bytes(), "", lenient).map(|file| file.len()).map_err(|error| error.to_string());
    assert_eq!(problem("3 4\n1 2 3 0 0 1 2\n", false), Err("the first line states 3 rays, 1 are there".into()));
    assert_eq!(problem("3 4\n1 2 3 0 0 1 2\n", true), Ok(1));
    assert_eq!(problem("1000000000000 4\n1 2 3 0 0 1 2\n", true), Ok(1));
    assert_eq!(problem("2 4\n1 2 3 0 0 1 2\n1 2 3 0\n", false), Err("line 3: 4 numbers, expected 7 of a ray".into()));
}

#[test]
fn what_is_wrong_is_counted_and_told() {
    let mut rays = RAYS.to_vec();
    rays.push([f32::NAN, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0]);
    rays.push([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, f32::INFINITY]);
    rays.push([0.0; 7]);
    rays.push([0.0, 0.0, 0.0, 0.0, 0.0, 1.0, -1.0]);
    rays[2][4] = -2.0;
    let file = read(&binary(&rays, 0, 1, 4), "", false).unwrap();
    assert_eq!(file.left_out, 4);
    let told: Vec<&str> = file.warnings.iter().map(|warning| warning.problem.as_str()).collect();
    let expected = [
        "2 of 7 rays with numbers that are none were left out",
        "1 of 7 rays without a direction were left out",
        "1 of 7 rays of negative flux were left out",
        "1 directions were not of unit length",
    ];
    assert_eq!(told, expected);
    are_the_rays(&file, 1e-3, 8.0);
    let problem = |bytes: &[u8]| read(bytes, "", false).unwrap_err().to_string();
    assert_eq!(problem(&binary(&[[f32::NAN; 7]; 2], 0, 1, 4)), "no ray is left after 2 were left out");
    assert_eq!(problem(&binary(&[[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0]], 0, 1, 4)), "no ray has any flux");
    assert!(problem(&binary(&RAYS, 1, 1, 4)).contains("the kind of rays is 1, expected 0 (flux) or 2 (spectral)"));
    assert!(problem(&binary(&RAYS, 0, 1, 5)).contains("the unit of length is 5"));
    assert!(problem(&binary(&[[0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.5]], 2, 0, 4)).contains("no ray has a wavelength that is seen"));
}

#[test]
fn fewer_rays_than_stated_are_refused_or_told() {
    let whole = binary(&RAYS, 0, 1, 4);
    let cut = &whole[..whole.len() - 5];
    assert_eq!(read(cut, "", false).unwrap_err().problem, "the head states 3 rays, 2 are there");
    let file = read(cut, "", true).unwrap();
    assert_eq!((file.len(), file.warnings[0].problem.as_str()), (2, "the head states 3 rays, 2 are there"));
    let mut absurd = whole.clone();
    absurd[4..8].copy_from_slice(&u32::MAX.to_le_bytes());
    assert_eq!(read(&absurd, "", false).unwrap_err().problem, "the head states 4294967295 rays, 3 are there");
    are_the_rays(&read(&absurd, "", true).unwrap(), 1e-3, 8.0);
    assert!(read(&whole[..207], "", true).is_err());
    assert!(read(&whole[..208], "", true).is_err());
    let more = [&whole[..], &[0; 9]].concat();
    assert_eq!(read(&more, "", false).unwrap().warnings[0].problem, "9 bytes behind the last ray are not read");
}
