//! LightTools.

use crate::{RAYS, are_the_rays, close};
use gonio_formats::bsdf::cie_1931;
use gonio_formats::rays::{FluxUnit, RayColour, RayFormat, read};

/// A binary file: version, kind of flux, far field, colour, unit; flux 6.
fn binary(words: [u32; 5], rays: &[Vec<f32>]) -> Vec<u8> {
    let mut bytes = b"LTRF".to_vec();
    [words[0], 0, words[1], words[2], words[3], words[4]].iter().for_each(|word| bytes.extend(word.to_le_bytes()));
    [0.0_f32, 0.0, 0.0, 6.0].iter().for_each(|value| bytes.extend(value.to_le_bytes()));
    if words[0] == 3 {
        bytes.extend(0_u32.to_le_bytes());
    }
    rays.iter().flatten().for_each(|value| bytes.extend(value.to_le_bytes()));
    bytes.extend(b"LTRFEND");
    bytes
}

fn rays() -> Vec<Vec<f32>> {
    RAYS.iter().map(|ray| ray.to_vec()).collect()
}

#[test]
fn binary_data_have_the_heads_flux() {
    for (version, unit, metres) in [(2, 1, 1e-3), (3, 2, 1e-2), (2, 3, 1.0), (2, 4, 0.0254), (2, 5, 0.3048), (2, 6, 1e-6)] {
        let file = read(&binary([version, 1, 0, 0, unit], &rays()), "", false).unwrap();
        assert_eq!((file.format, file.unit, file.warnings.len()), (RayFormat::LightTools, FluxUnit::Lumens, 0));
        are_the_rays(&file, metres, 6.0);
    }
    let watts = read(&binary([2, 0, 0, 0, 1], &rays()), "", false).unwrap();
    assert_eq!((watts.unit, watts.total), (FluxUnit::Watts, 6.0));
    let mut coloured = rays();
    coloured.iter_mut().zip([450.0, 550.0, 650.0]).for_each(|(ray, wavelength)| ray.push(wavelength));
    let file = read(&binary([2, 0, 0, 2, 1], &coloured), "", false).unwrap();
    assert_eq!(file.colour, RayColour::Wavelengths(vec![450.0, 550.0, 650.0]));
    let [blue, green, red] = [450.0, 550.0, 650.0].map(|wavelength| cie_1931(wavelength)[1]);
    close(file.total, 683.0 * 6.0 / 8.0 * (2.0 * blue + green + 5.0 * red), 1e-6);
    let far: Vec<Vec<f32>> = RAYS.iter().map(|ray| ray[3..].to_vec()).collect();
    let file = read(&binary([2, 1, 1, 0, 1], &far), "", false).unwrap();
    assert_eq!((file.origins[1], file.directions[2]), ([0.0; 3], [0.0, -1.0, 0.0]));
}

#[test]
fn binary_data_that_end_early_are_refused_or_told() {
    let whole = binary([2, 1, 0, 0, 1], &rays());
    let cut = &whole[..whole.len() - 12];
    assert!(read(cut, "", false).unwrap_err().problem.starts_with("2 whole rays are there, but no mark of the end"));
    let file = read(cut, "", true).unwrap();
    assert_eq!((file.len(), file.total), (2, 6.0));
    let problem = |bytes: &[u8]| read(bytes, "", false).unwrap_err().problem;
    assert!(problem(&binary([2, 1, 0, 1, 1], &rays())).contains("tristimulus values"));
    assert!(problem(&binary([4, 1, 0, 0, 1], &rays())).contains("the version is 4"));
    assert!(problem(&binary([2, 1, 0, 0, 9], &rays())).contains("the unit of length is 9"));
    assert_eq!(problem(&binary([2, 1, 0, 0, 1], &[])), "no ray is left");
    assert!(read(&whole[..30], "", true).is_err());
}

/// A text file.
fn text(kind: &str, colour: &str, rays: &str) -> String {
    format!(
        "# LightTools 8.7.0 \n# Ray Data Export File\nlt_rdf_version: 2.0\ndataname: a lamp\nlt_datatype: {kind}\nlt_far_field_data: no\n\
         lt_color_info: {colour}\nlt_length_units: millimeters\nlt_data_origin:          0          0          0\nlt_radiant_flux: 6\n\
         lt_startofdata\n{rays}lt_endofdata"
    )
}

const LINES: &str = "  1  2.0e+000  3  0 0 1 2\n-1 0.5 0 0.6 6.123234e-017 0.8 1\n0 0 0 0 -1 0 5\n";

#[test]
fn text_is_read() {
    let file = read(text("luminous_flux", "none", LINES).as_bytes(), "", false).unwrap();
    assert_eq!((file.format, file.unit, file.description.as_str()), (RayFormat::LightToolsText, FluxUnit::Lumens, "a lamp"));
    are_the_rays(&file, 1e-3, 6.0);
    let coloured = LINES.replace(" 2\n", " 2 550\n").replace(" 1\n", " 1 550\n").replace(" 5\n", " 5 550\n");
    let file = read(text("radiant_power", "wavelength", &coloured).as_bytes(), "", false).unwrap();
    are_the_rays(&file, 1e-3, 6.0 * 683.0 * cie_1931(550.0)[1]);
}

#[test]
fn text_that_is_wrong_names_its_line() {
    let problem = |text: &str| read(text.as_bytes(), "", false).unwrap_err().to_string();
    let good = text("luminous_flux", "none", LINES);
    assert!(problem(good.trim_end_matches("lt_endofdata")).contains("3 rays are there, but no lt_endofdata"));
    assert_eq!(read(good.trim_end_matches("lt_endofdata").as_bytes(), "", true).unwrap().len(), 3);
    assert_eq!(problem(&good.replace("0 0 0 0 -1 0 5", "0 0 0 0 -1 0")), "line 14: 6 numbers, expected 7 of a ray");
    assert!(problem(&text("photons", "none", LINES)).starts_with("line 5: lt_datatype is 'photons'"));
    assert!(problem(&text("luminous_flux", "tristimulus", LINES)).starts_with("line 7: lt_color_info is 'tristimulus'"));
    assert!(problem(&good.replace("millimeters", "furlongs")).starts_with("line 8"));
    let file = read(good.replace("3  0 0 1 2", "nan 0 0 1 2").as_bytes(), "", false).unwrap();
    assert_eq!((file.left_out, file.len(), file.total), (1, 2, 6.0));
}
