use crate::{Spectrum, read};

/// A file's spectrum.
#[track_caller]
fn found(text: &str) -> Spectrum {
    read(text.as_bytes(), "lamp").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Lines from 380 to 780 nm with a mark between numbers.
fn lines(mark: &str, decimal: &str) -> String {
    (0..=40).map(|k| format!("{}{decimal}0{mark}0{decimal}{}\n", 380 + 10 * k, 25 + k)).collect()
}

#[test]
fn numbers_stand_apart_in_many_ways() {
    let expected = found(&lines(",", "."));
    assert_eq!([expected.wavelengths_nm[0], expected.wavelengths_nm[40]], [380.0, 780.0]);
    for text in [
        lines(", ", "."),
        lines(";", "."),
        lines(" ; ", ","),
        lines("\t", ","),
        lines("\t", "."),
        lines("  ", "."),
        lines(" ", ","),
        lines(",", ".").replace('\n', "\r\n"),
        format!("\u{feff}Lamp 7\nnm,W/nm\n# made by hand\n\n{}>>> end <<<\n", lines(",", ".")),
        format!("wavelength;power\n400 W lamp\n{}\n\n", lines(";", ",")),
        lines(",", ".").lines().map(|line| format!("\"{}\"\n", line.replace(',', "\",\""))).collect(),
    ] {
        assert_eq!(found(&text), expected, "{text}");
    }
    let wide: Vec<u8> = [0xfeff].into_iter().chain(lines(";", ",").encode_utf16()).flat_map(u16::to_le_bytes).collect();
    assert_eq!(read(&wide, "lamp"), Ok(expected));
}

#[test]
fn further_columns_are_told() {
    let text: String = (0..=80).map(|k| format!("{},{},0.5,0.25\n", 380 + 5 * k, k + 1)).collect();
    let lamp = found(&text);
    assert_eq!(lamp.notes, ["the second column is the spectrum, columns 3 to 4 are left out"]);
}

#[test]
fn what_is_not_as_wanted_is_told() {
    let noted = |text: &str, part: &str| {
        let lamp = found(text);
        assert!(lamp.notes.iter().any(|note| note.contains(part)), "{:?}", lamp.notes);
    };
    noted(&lines(",", "."), "steps of up to 10 nm");
    let from = |first: u32, last: u32| -> String { (first..=last).map(|nm| format!("{nm} 1\n")).collect() };
    noted(&from(400, 700), "the data go from 400 to 700 nm");
    noted(&from(300, 830), "of the power lies outside the observer's 360 to 830 nm");
    noted(&from(380, 780).replace("780 1", "780 -0.001"), "1 powers below zero");
}

fn spdx(data: &str) -> String {
    let head = "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n<Header><Description>Street lamp</Description></Header>\n";
    let inside = "<SpectralQuantity>flux</SpectralQuantity><BandwidthFWHM>5</BandwidthFWHM>";
    format!("{head}<SpectralDistribution>{inside}\n{data}</SpectralDistribution></IESTM2714>\n")
}

#[test]
fn tm27_is_read() {
    let data: String =
        (0..=80).map(|k| format!("<SpectralData wavelength=\"{}\">{}</SpectralData>\n", 380 + 5 * k, 0.1 + f64::from(k))).collect();
    let lamp = found(&spdx(&data));
    assert_eq!((lamp.name.as_str(), lamp.power.len()), ("Street lamp", 81));
    let broken = spdx(&data.replace(">3.1<", ">n/a<"));
    assert_eq!(read(broken.as_bytes(), "").expect_err("no number").to_string(), "line 8: power 'n/a' is no number");
    let surface = spdx(&data).replace("flux", "reflectance");
    let error = read(surface.as_bytes(), "").expect_err("no light").to_string();
    assert!(error.contains("'reflectance' is no power of a source"), "{error}");
    let licence = read(b"SPDXVersion: SPDX-2.3\nDataLicense: CC0-1.0\n", "").expect_err("a licence").to_string();
    assert!(licence.contains("no line of wavelength in nm and power"), "{licence}");
}
