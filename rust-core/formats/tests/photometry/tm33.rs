//! TM-33.

use crate::{close, steps, type_c};
use gonio_formats::photometry::{OpeningShape, PhotometricType, Symmetry, read, tm33};

/// A file of version 1.0 with one emitter.
fn file(emitter: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<IESTM33-18><Version>1.0</Version><Header><Manufacturer>maker</Manufacturer>\
         <Description>lamp</Description><Laboratory>lab</Laboratory><ReportNumber>7</ReportNumber><ReportDate>2025-03-31</ReportDate></Header>\
         <Luminaire><Dimensions><Length>1200</Length><Width>300</Width><Height>80</Height></Dimensions><NumEmitter>1</NumEmitter></Luminaire>\
         <Equipment><Gonioradiometer><Type>CIE_C</Type></Gonioradiometer></Equipment><Emitter>{emitter}</Emitter></IESTM33-18>"
    )
}

fn intensities(data: &str) -> String {
    format!(
        "<Quantity>1</Quantity><Description>LED</Description><RatedLumens>1000</RatedLumens><InputWattage>12.5</InputWattage>\
         <ColorTemperature><FixedCCT>4000</FixedCCT></ColorTemperature><LuminousData><LuminousIntensity>\
         <AbsolutePhotometry>true</AbsolutePhotometry><NumberMeasured>4</NumberMeasured>{data}</LuminousIntensity></LuminousData>"
    )
}

#[test]
fn version_1_0_is_read() {
    let data = "<IntData h=\"90\" v=\"0\">30</IntData><IntData h=\"0\" v=\"0\">30</IntData>\
                <IntData h=\"0\" v=\"90\">10</IntData><IntData h=\"90\" v=\"90\">20.5</IntData>";
    let areas = "<EmissionAreas><BottomFace><NumberBottom>1</NumberBottom><BottomArea><Length>1150</Length><Width>250</Width>\
                 <LengthOffset>0</LengthOffset><WidthOffset>0</WidthOffset></BottomArea></BottomFace></EmissionAreas>";
    let goniogram = read(file(&(intensities(data) + areas)).as_bytes(), "").unwrap();
    assert_eq!((goniogram.symmetry, goniogram.photometric_type), (Symmetry::Quadrants, PhotometricType::C));
    assert_eq!((&goniogram.horizontal[..], &goniogram.vertical[..]), (&[0.0, 90.0][..], &[0.0, 90.0][..]));
    assert_eq!(goniogram.intensities, [30.0, 10.0, 30.0, 20.5]);
    assert_eq!((goniogram.opening.shape, goniogram.opening.size), (OpeningShape::Rectangle, [0.25, 1.15, 0.0]));
    assert_eq!(goniogram.body, [1.2, 0.3, 0.08]);
    let lamps = goniogram.lamps().unwrap();
    assert_eq!((lamps.flux, lamps.watts, lamps.colour.as_str(), lamps.name.as_str()), (Some(1000.0), 12.5, "4000 K", "LED"));
    assert_eq!((goniogram.text("MANUFAC"), goniogram.text("ISSUEDATE")), (Some("maker"), Some("2025-03-31")));
    assert_eq!(goniogram.warnings, []);
}

#[test]
fn written_files_come_back() {
    let odd = |c: f64, gamma: f64| 1234.567 + 300.0 * (c.to_radians() * 3.0 + 0.3).sin() + gamma / 7.0;
    for horizontal in [vec![0.0], vec![0.0, 13.0, 90.0], vec![0.0, 50.0, 180.0], vec![90.0, 170.0, 270.0], steps(0.0, 360.0, 12)] {
        let goniogram = type_c(&[0.0, 4.0, 11.1, 90.0, 180.0], &horizontal, odd);
        let again = read(&tm33::write(&goniogram, true), "").unwrap();
        assert_eq!(again.warnings, []);
        assert_eq!(again.symmetry == Symmetry::Rotational, goniogram.symmetry == Symmetry::Rotational);
        assert_eq!(again.text("LUMINAIRE"), Some("lamp"));
        close(again.flux(), goniogram.flux(), 1e-8);
        for c in steps(1.0, 355.3, 20) {
            let direction = PhotometricType::C.direction(c, 17.0);
            close(again.intensity(direction), goniogram.intensity(direction), 1e-8);
        }
    }
    let text = String::from_utf8(tm33::write(&type_c(&[0.0, 90.0], &[0.0], |_, _| 5.0), false)).unwrap();
    assert!(text.contains("<IESTM33-22>\n<Version>1.1</Version>") && !text.contains("Simulation") && !text.contains("ReportDate"));
}

/// A file whose emitter has these data, all behind line 1.
fn emitter_of(data: &str) -> String {
    file(&format!("<Quantity>1</Quantity><Description>LED</Description><InputWattage>10</InputWattage>\n{data}"))
}

/// Two planes of two angles.
const GRID: &str = "<IntData h=\"0\" v=\"0\">3</IntData><IntData h=\"0\" v=\"90\">1</IntData>\
                    <IntData h=\"90\" v=\"0\">3</IntData><IntData h=\"90\" v=\"90\">2</IntData>";

/// A spectrum of one row a line.
fn spectral(points: impl Iterator<Item = (f64, f64)>, more: &str) -> String {
    let rows: String = points.map(|(nm, power)| format!("<PwrData w=\"{nm}\">{power}</PwrData>\n")).collect();
    format!("<SpectralData><EmitterSpectral>\n{rows}{more}</EmitterSpectral></SpectralData>")
}

/// Even power from 380 to 780 nm in steps of 10 nm.
fn even() -> impl Iterator<Item = (f64, f64)> {
    (0..41).map(|k| (380.0 + 10.0 * f64::from(k), 2.0))
}

#[test]
fn spectra_are_read_and_written() {
    let luminous = format!("<LuminousData><LuminousIntensity>{GRID}</LuminousIntensity></LuminousData>");
    let found = read(emitter_of(&(luminous.clone() + &spectral(even(), ""))).as_bytes(), "").unwrap();
    let spectrum = found.spectrum.clone().unwrap();
    assert_eq!((spectrum.name.as_str(), spectrum.wavelengths_nm.len()), ("LED", 41));
    assert_eq!((spectrum.power[0], found.warnings.len()), (1.0, 0));
    let again = read(&tm33::write(&found, false), "").unwrap();
    assert_eq!(again.spectrum, Some(spectrum));
    assert_eq!(tm33::spectra(&tm33::write(&found, false)).unwrap().len(), 1);
    // Of a bad spectrum the light stays.
    for (points, told) in [
        (vec![(500.0, 1.0), (490.0, 1.0)], "line 4: its spectrum is left out: 2 points"),
        (
            even().map(|(nm, power)| (nm / 1000.0, power)).collect(),
            "line 4: its spectrum is left out: wavelengths from 0.38 to 0.78: these look like micro",
        ),
        (even().map(|(nm, power)| (1160.0 - nm, power)).collect(), "line 5: its spectrum is left out: 770 nm after 780 nm"),
        (even().map(|(nm, _)| (nm, 530.0 - nm)).collect(), "line 20: its spectrum is left out: power -10 at 540 nm"),
        (
            even().filter(|(nm, _)| !(500.0..530.0).contains(nm)).collect(),
            "line 16: its spectrum is left out: nothing between 490 and 530 nm",
        ),
    ] {
        let found = read(emitter_of(&(luminous.clone() + &spectral(points.into_iter(), ""))).as_bytes(), "").unwrap();
        assert_eq!(found.spectrum, None);
        assert!(found.warnings[0].to_string().starts_with(told), "{} for {told}", found.warnings[0]);
    }
    let text = |more: &str| emitter_of(&(luminous.clone() + &spectral(even(), more)));
    let told = |text: &str| read(text.as_bytes(), "").unwrap().warnings[0].to_string();
    assert!(told(&text("<Quantum>1</Quantum>")).contains("a spectrum with the <Quantum> '1', expected power"));
    assert!(
        told(&text("").replace("w=\"400\">2", "w=\"400\">two"))
            .starts_with("line 6: its spectrum is left out: the power 'two' at 400 nm is no number")
    );
    assert!(told(&text("").replace("w=\"400\"", "v=\"400\"")).contains("the wavelength '' of a <PwrData> is no number of nm"));
    assert!(tm33::spectra(text("").replace(">2<", ">-2<").as_bytes()).unwrap_err().to_string().starts_with("no power above zero"));
    assert!(tm33::spectra(file("").as_bytes()).unwrap_err().problem.contains("no emitter with an <EmitterSpectral>"));
}

#[test]
fn watts_and_photons_are_candela_by_the_spectrum() {
    let data = |kind: &str, [from, to]: [f64; 2], more: &str| {
        format!(
            "<{kind}Data><MinWavelength>{from}</MinWavelength><MaxWavelength>{to}</MaxWavelength><{kind}Intensity>{more}{GRID}</{kind}Intensity></{kind}Data>"
        )
    };
    let candela = |text: &str| read(emitter_of(text).as_bytes(), "").map(|found| found.intensities[0]);
    // A line of 1 nm about 555 nm: 683 lm/W, and 4.6395 µmol/J by h c N_A = 0.119627 J m/mol.
    let line = || {
        spectral(
            (0..81).flat_map(|k| {
                let nm = 380.0 + 5.0 * f64::from(k);
                if k == 35 { vec![(554.0, 0.0), (554.5, 1.0), (555.0, 1.0), (555.5, 1.0), (556.0, 0.0)] } else { vec![(nm, 0.0)] }
            }),
            "",
        )
    };
    let range = [380.0, 780.0];
    close(candela(&(data("Radiant", range, "") + &line())).unwrap(), 3.0 * 683.0, 1e-3);
    close(candela(&(data("Photon", range, "") + &line())).unwrap(), 3.0 * 683.0 / (555e-9 / 0.119_626_566 * 1e6), 1e-3);
    close(candela(&(data("Radiant", range, "<Multiplier>2</Multiplier>") + &line())).unwrap(), 6.0 * 683.0, 1e-3);
    // Of even power the integral of V over 106.857 nm counts, of which the range holds a part of the watts.
    close(candela(&(data("Radiant", range, "") + &spectral(even(), ""))).unwrap(), 3.0 * 683.002 * 106.857 / 400.0, 2e-3);
    close(candela(&(data("Radiant", [400.0, 700.0], "") + &spectral(even(), ""))).unwrap(), 3.0 * 683.002 * 106.857 / 300.0, 2e-3);
    let refused = |text: &str| candela(text).unwrap_err().to_string();
    assert!(refused(&data("Radiant", range, "")).starts_with("line 3: radiant intensities (W/sr) and no spectrum to be used"));
    assert!(refused(&data("Photon", range, "")).contains("photon intensities (µmol/(s sr)) and no spectrum"));
    assert!(refused(&(data("Photon", [300.0, 900.0], "") + &line())).contains("of 300 to 900 nm and a spectrum of 380 to 780 nm"));
    assert!(refused(&(data("Radiant", range, "<Absolute>false</Absolute>") + &line())).contains("relative radiant intensities"));
    // Candela come first where there are any.
    let both =
        data("Radiant", range, "") + &format!("<LuminousData><LuminousIntensity>{GRID}</LuminousIntensity></LuminousData>") + &line();
    close(candela(&both).unwrap(), 3.0, 1e-12);
}

#[test]
fn bad_files_say_what_is_wrong() {
    let problem = |text: &str| tm33::read(text.as_bytes()).unwrap_err().problem;
    assert!(problem("<IESTM33-18><Emitter>").starts_with("not XML"));
    assert!(problem("<Luminaire/>").contains("expected a root whose name begins with IESTM33"));
    assert!(problem(&file("<Quantity>1</Quantity>")).contains("no emitter with luminous intensities"));
    let holes = "<IntData h=\"0\" v=\"0\">30</IntData><IntData h=\"0\" v=\"90\">1</IntData><IntData h=\"90\" v=\"0\">1</IntData>";
    assert!(problem(&file(&intensities(holes))).contains("no whole grid"));
    let twice = holes.replace("h=\"90\" v=\"0\"", "h=\"0\" v=\"90\"").replace("30<", "3<") + "<IntData h=\"90\" v=\"90\">1</IntData>";
    assert!(problem(&file(&intensities(&twice))).contains("come again"));
    assert!(problem(&file(&intensities("<IntData h=\"0\">1</IntData>"))).contains("with the angles h and v"));
    assert!(problem(&file(&intensities("<IntData h=\"0\" v=\"0\">nan</IntData>"))).contains("expected an intensity"));
    let bomb = "<!DOCTYPE a [<!ENTITY b \"bbbb\">]><IESTM33-18>&b;</IESTM33-18>";
    assert!(problem(bomb).starts_with("not XML"));
}
