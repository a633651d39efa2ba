//! Ray files.

use crate::Reader;
use gonio_formats::rays::{FluxUnit, LengthUnit, RayColour, RayFile, RayFormat, Spectrum, read, tm25, zemax};

/// The reader of all kinds, strict and lenient.
pub(crate) fn readers() -> Vec<Reader> {
    vec![Reader {
        name: "rays",
        seeds,
        read: |bytes| {
            let strict = read(bytes, "", false);
            read(bytes, "", true).iter().chain(&strict).for_each(use_all);
            strict.is_ok()
        },
        memory: 1 << 20,
    }]
}

/// Everything that is done with rays.
fn use_all(file: &RayFile) {
    let sum: f64 = file.fluxes.iter().map(|flux| f64::from(*flux)).sum();
    assert!(file.total > 0.0 && (sum / file.total - 1.0).abs() < 1e-3, "flux {sum} and {}", file.total);
    assert!(file.origins.len() == file.len() && file.directions.len() == file.len(), "as many of each");
    assert!(file.origins.iter().flatten().all(|part| part.is_finite()), "origins");
    let unit = |d: &[f32; 3]| (d.iter().map(|part| f64::from(*part).powi(2)).sum::<f64>() - 1.0).abs() < 1e-5;
    assert!(file.directions.iter().all(unit), "directions");
    drop([tm25::write(file), zemax::write(file)]);
}

fn seeds() -> Vec<Vec<u8>> {
    let file = |colour: RayColour| RayFile {
        format: RayFormat::Tm25,
        origins: vec![[0.0, 0.1, 0.2], [0.0; 3]],
        directions: vec![[0.0, 0.0, 1.0], [0.6, 0.0, 0.8]],
        fluxes: vec![1.0, 2.0],
        unit: FluxUnit::Lumens,
        total: 3.0,
        colour,
        description: "a seed".into(),
        length_unit: LengthUnit::Millimetres,
        left_out: 0,
        warnings: Vec::new(),
    };
    let spectrum = Spectrum { wavelengths: vec![400.0, 550.0, 700.0], weights: vec![0.1, 1.0, 0.3] };
    let colours = [
        RayColour::Unknown,
        RayColour::Wavelength(550.0),
        RayColour::Wavelengths(vec![500.0, 600.0]),
        RayColour::Tristimulus(vec![[1.0; 3], [2.0; 3]]),
        RayColour::Spectrum(spectrum.clone()),
        RayColour::Spectra { spectra: vec![spectrum], index: vec![0, 0] },
    ];
    let binary = colours.into_iter().map(file).flat_map(|file| [tm25::write(&file), zemax::write(&file)]).filter_map(Result::ok);
    let text = "2 4\n1 2 3 0 0 1 2\n-1 0.5 0 0.6 0 0.8 1\n";
    let light_tools = "lt_rdf_version: 2.0\nlt_datatype: radiant_power\nlt_far_field_data: no\nlt_color_info: wavelength\n\
        lt_length_units: millimeters\nlt_data_origin: 0 0 0\nlt_radiant_flux: 6\nlt_startofdata\n1 2 3 0 0 1 2 550\n\
        -1 0.5 0 0.6 0 0.8 1 450\nlt_endofdata";
    let mut words = b"LTRF".to_vec();
    [2_u32, 0, 1, 0, 0, 1].iter().for_each(|word| words.extend(word.to_le_bytes()));
    [0.0_f32, 0.0, 0.0, 6.0, 1.0, 2.0, 3.0, 0.0, 0.0, 1.0, 2.0].iter().for_each(|value| words.extend(value.to_le_bytes()));
    words.extend(b"LTRFEND");
    binary.chain([text.as_bytes().to_vec(), light_tools.as_bytes().to_vec(), words]).collect()
}
