//! The writer.

use crate::photometry::text::{is_date, number, one_line};
use crate::photometry::{Goniogram, PhotometricType, Symmetry};
use crate::spectrum::SpectralPower;
use crate::svg::escape;
use std::borrow::Cow;
use std::fmt::Write;

/// Writes version 1.1 (`IESTM33-22`): absolute photometry in cd, UTF-8. Photometric types A and B are resampled to type C.
///
/// `simulated` says that no laboratory measured it. A head without a date of the form 2025-03-31 leaves the report's date out.
pub fn write(goniogram: &Goniogram, simulated: bool) -> Vec<u8> {
    let goniogram = match goniogram.photometric_type {
        PhotometricType::C => Cow::Borrowed(goniogram),
        _ => Cow::Owned(goniogram.to_type_c()),
    };
    let body = header(&goniogram) + &luminaire(&goniogram) + &emitter(&goniogram, simulated);
    format!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<IESTM33-22>\n<Version>1.1</Version>\n{body}</IESTM33-22>\n").into_bytes()
}

fn element(name: &str, text: &str) -> String {
    format!("<{name}>{}</{name}>\n", escape(&one_line(text)))
}

fn header(goniogram: &Goniogram) -> String {
    let text = |keyword: &str| goniogram.text(keyword).unwrap_or_default();
    let optional = |name: &str, keyword: &str| goniogram.text(keyword).map(|text| element(name, text)).unwrap_or_default();
    let date = ["ISSUEDATE", "DATE", "TESTDATE"].into_iter().map(text).find(|text| is_date(text));
    let mut body = optional("Manufacturer", "MANUFAC") + &optional("CatalogNumber", "LUMCAT");
    body += &element("Description", text("LUMINAIRE"));
    body += &element("Laboratory", text("TESTLAB"));
    body += &element("ReportNumber", text("TEST"));
    body += &date.map(|date| element("ReportDate", date)).unwrap_or_default();
    body.extend(goniogram.header.iter().filter(|line| line.keyword == "OTHER").map(|line| element("Comment", &line.text)));
    format!("<Header>\n{body}</Header>\n")
}

fn luminaire(goniogram: &Goniogram) -> String {
    let [x, y, z] = goniogram.opening.size;
    let [length, mut width, height] = if goniogram.body == [0.0; 3] { [y, x, z] } else { goniogram.body };
    if width == 0.0 {
        // Round: as wide as it is long.
        width = length;
    }
    let [length, width, height] = [length, width, height].map(|metres| number(metres * 1000.0));
    let dimensions = element("Length", &length) + &element("Width", &width) + &element("Height", &height);
    let gonioradiometer = "<Equipment>\n<Gonioradiometer>\n<Type>CIE_C</Type>\n</Gonioradiometer>\n</Equipment>\n";
    format!("<Luminaire>\n<Dimensions>\n{dimensions}</Dimensions>\n<NumEmitter>1</NumEmitter>\n</Luminaire>\n{gonioradiometer}")
}

fn emitter(goniogram: &Goniogram, simulated: bool) -> String {
    let lamps = goniogram.lamps();
    let mut body = element("Quantity", "1");
    body += &element("Description", lamps.map_or("", |lamps| lamps.name.as_str()));
    if let Some(flux) = lamps.filter(|lamps| !lamps.absolute).and_then(|lamps| lamps.flux) {
        body += &element("RatedLumens", &number(flux));
    }
    body += &element("InputWattage", &number(lamps.map_or(0.0, |lamps| lamps.watts)));
    if let Some(kelvin) = lamps.and_then(|lamps| kelvin(&lamps.colour)) {
        body += &format!("<ColorTemperature>\n<FixedCCT>{kelvin}</FixedCCT>\n</ColorTemperature>\n");
    }
    if simulated {
        body += "<DataGeneration>\n<Simulation>true</Simulation>\n</DataGeneration>\n";
    }
    let flux = element("LuminousFlux", &number(goniogram.flux()));
    let spectrum = goniogram.spectrum.as_ref().map(spectral).unwrap_or_default();
    format!("<Emitter>\n{body}<LuminousData>\n{}{flux}</LuminousData>\n{spectrum}</Emitter>\n", intensities(goniogram))
}

/// The emitter's spectrum, relative.
fn spectral(spectrum: &SpectralPower) -> String {
    let mut text = String::from("<SpectralData>\n<EmitterSpectral>\n");
    if !spectrum.name.is_empty() {
        text += &element("EmitterName", &spectrum.name);
    }
    text += &element("NumberWavelength", &spectrum.power.len().to_string());
    text += &element("Normalized", "true");
    for (nm, power) in spectrum.wavelengths_nm.iter().zip(&spectrum.power) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "<PwrData w=\"{}\">{power}</PwrData>", number(*nm));
    }
    text + "</EmitterSpectral>\n</SpectralData>\n"
}

/// The colour temperature that a lamp's colour begins with, such as 3000 K.
fn kelvin(colour: &str) -> Option<u32> {
    let digits: String = colour.trim().chars().take_while(char::is_ascii_digit).collect();
    digits.parse().ok().filter(|kelvin| (500..=100_000).contains(kelvin))
}

fn intensities(goniogram: &Goniogram) -> String {
    let expanded = (goniogram.symmetry != Symmetry::Rotational).then(|| goniogram.expanded());
    let (horizontal, values) = match &expanded {
        Some(grid) => (&grid.horizontal, &grid.intensities),
        None => (&goniogram.horizontal, &goniogram.intensities),
    };
    let symmetry = if expanded.is_some() { "Symm_None" } else { "Symm_Full" };
    let mut text = String::from("<LuminousIntensity>\n");
    text += &element("AbsolutePhotometry", "true");
    text += &element("Symm", symmetry);
    text += &element("NumberMeasured", &values.len().to_string());
    text += &element("NumberHorz", &horizontal.len().to_string());
    text += &element("NumberVert", &goniogram.vertical.len().to_string());
    for (h, plane) in horizontal.iter().zip(values.chunks(goniogram.vertical.len().max(1))) {
        for (v, value) in goniogram.vertical.iter().zip(plane) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "<IntData h=\"{}\" v=\"{}\">{}</IntData>", number(*h), number(*v), number(*value));
        }
    }
    text + "</LuminousIntensity>\n"
}
