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
